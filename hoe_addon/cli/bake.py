# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``bake``: the efficiencies of a hologram as a table, no larger than its error allows."""

import argparse
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .interrupt import EXIT_INTERRUPTED
from .one_hologram import add_hologram_arguments, hologram_of
from .progress import progress_bar

if TYPE_CHECKING:
    from ..core.efficiency.baked import BakedTable
    from ..model.hologram import HologramSpec
    from ..model.tables.light import TableRange

_DESCRIPTION = """\
Write the shares of the light as a table over wavelength, two direction cosines (along the grating
and across it), place on the element, and the side that the light comes from. The model is sampled
more finely where interpolation misses it, until the error measured at random points is below the
tolerance or the table is as large as allowed. What does not matter is collapsed. Ctrl-C leaves a
file TABLE.part.npz; the same call goes on from there.
"""

_RANGE_HELP = "A:B"
_LARGEST_TOLERANCE = 0.5
_RIGHT_ANGLE_DEG = 90.0
_MOST_NUMBERS = 4_000_000
_FEWEST_NUMBERS = 64


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "bake", help="efficiencies as a table, with its error", description=_DESCRIPTION
    )
    add_hologram_arguments(parser)
    add = parser.add_argument
    add("--out", metavar="TABLE", required=True, help=".npz, .csv, .txt, .bsdf or .exr file")
    add("--exr", metavar="F.exr", help="write it as float EXR too")
    add("--tolerance", metavar="E", type=float, default=1e-3, help="of the share, default 1e-3")
    add(
        "--wavelengths",
        metavar=_RANGE_HELP,
        type=_range,
        help="nm, two ends without a step, default 380:780",
    )
    add(
        "--angles",
        metavar=_RANGE_HELP,
        type=_range,
        help="degrees along the grating, two ends, default all with a cosine up to 0.98",
    )
    add(
        "--across",
        metavar=_RANGE_HELP,
        type=_range,
        help="degrees across the grating, two ends, default as wide as --angles allows at most",
    )
    add(
        "--from",
        dest="side",
        choices=("back", "front", "both"),
        default="both",
        help="side that the light comes from, default both",
    )
    add("--polarization", choices=("s", "p", "u"), default="u", help="default u, the mean of both")
    add("--largest", metavar="N", type=int, default=65_536, help="most numbers, default 65536")
    add("--walked", action="store_true", help="for rays that are walked backward, as in pictures")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Make the table, write it, and report.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import OutputError, check_target, refuse_own_input
    from ..model.reading import naming
    from ..model.tables.file import check_suffix, write_table

    _check(args)
    targets = [Path(name) for name in (args.out, args.exr) if name]
    for option, path in zip(("--out", "--exr"), targets, strict=False):
        with naming(f"{option}: {path}"):
            check_suffix(path)
        check_target(path)
        if not path.resolve().parent.is_dir():
            raise OutputError(f"{path}: cannot be written: its folder does not exist")
        refuse_own_input(path, args.document)
    spec = hologram_of(args)
    _refuse_own_table(spec, targets)
    part = Path(f"{args.out}.part.npz")
    try:
        with progress_bar("bake") as progress, naming(args.document):
            made = _bake(spec, args, part, progress)
    except KeyboardInterrupt:
        kept = f"; {part} holds what is done, the same call goes on from there"
        print(f"hoe: error: stopped by the user{kept if part.exists() else ''}", file=sys.stderr)
        return EXIT_INTERRUPTED
    for path in targets:
        write_table(path, made.table)
    part.unlink(missing_ok=True)
    for line in report(made):
        print(line)
    print(f"file: {', '.join(map(str, targets))}")
    return 0


def _bake(spec: "HologramSpec", args: argparse.Namespace, part: Path, progress: Any) -> Any:
    from ..core.efficiency import Polarization
    from ..model.tables.making import bake_hologram

    return bake_hologram(
        spec,
        args.tolerance,
        _within(args),
        polarization=Polarization(args.polarization),
        backward=args.walked,
        largest=args.largest,
        progress=progress,
        part=part,
    )


def report(made: "BakedTable") -> list[str]:
    """Say what a table is and how good it is.

    Args:
        made: The table.

    Returns:
        Lines.
    """
    from ..core.efficiency.table_check import AXES, SIDES, shown

    table = made.table
    nodes = " x ".join(
        f"{len(axis)} {name}" for name, axis in zip(AXES, table.axes, strict=True) if len(axis) > 1
    )
    sides = " and ".join(table.sides)
    lines = [
        f"table: {table.size} numbers: {nodes or 'one node'}, {len(table.branches)} orders, "
        f"light from {sides}",
        f"collapsed: {', '.join(made.collapsed) or 'nothing'}",
        f"interpolation error: 99 % of {made.checks} random points within {made.quantile:.1e}, "
        f"worst seen {made.error:.1e}, rms {made.rms:.1e}; "
        f"tolerance {made.tolerance:g} {'met' if made.reached else 'NOT met'}",
    ]
    if made.landmark is not None:
        side, *values = made.landmark.tolist()
        above = "; above the tolerance" if made.landmark_error > made.tolerance else ""
        where = ", ".join(shown(axis, value) for axis, value in enumerate(values))
        lines.append(
            f"on Bragg and beside: {made.landmark_error:.1e} at most of {made.landmarks} nodes, "
            f"at {where} from the {SIDES[int(side)]}{above}"
        )
    if made.cutoff_part > 0.0:
        lines.append(
            f"beside cut-offs of orders ({100.0 * made.cutoff_part:.1f} % of the points): "
            f"{made.cutoff_error:.1e} at most"
        )
    lines.append(f"s against p: {made.spread:.1e} at most, {made.mean_spread:.1e} in the mean")
    if made.excess > 0.0:
        lines.append(f"shares above 1 in sum, scaled down: by {made.excess:.1e} at most")
    if made.settled is not None:
        found = made.settled
        nearness = "" if math.isnan(found.error) else f", within {found.error:.1e} of a search"
        lines.append(f"harmonics: {found.harmonics} for all nodes{nearness} at {found.rays} nodes")
    lines.append(f"evaluations of the model: {made.evaluated}")
    return lines


def _check(args: argparse.Namespace) -> None:
    from ..core.errors import SpecError
    from ..model import fields

    if not 1e-6 <= args.tolerance <= _LARGEST_TOLERANCE:
        rule = f"must be from 1e-06 to {_LARGEST_TOLERANCE}"
        raise SpecError(f"--tolerance: {rule}, got {args.tolerance}")
    if not _FEWEST_NUMBERS <= args.largest <= _MOST_NUMBERS:
        rule = f"must be from {_FEWEST_NUMBERS} to {_MOST_NUMBERS}"
        raise SpecError(f"--largest: {rule}, got {args.largest}")
    for option, ends in (("--angles", args.angles), ("--across", args.across)):
        if ends and max(map(abs, ends)) >= _RIGHT_ANGLE_DEG:
            raise SpecError(f"{option}: must be between -90 and 90, got {ends[0]:g}:{ends[1]:g}")
    for end in args.wavelengths or ():
        fields.wavelength_value("--wavelengths", end)


def _within(args: argparse.Namespace) -> "TableRange":
    from ..core.efficiency.table_check import SIDES
    from ..model.efficiency.common import VISIBLE_NM
    from ..model.tables.light import WIDEST_COSINE, TableRange

    def cosines(ends: tuple[float, float] | None) -> tuple[float, float]:
        if ends is None:
            return -WIDEST_COSINE, WIDEST_COSINE
        return math.sin(math.radians(ends[0])), math.sin(math.radians(ends[1]))

    return TableRange(
        args.wavelengths or VISIBLE_NM,
        cosines(args.angles),
        cosines(args.across),
        SIDES if args.side == "both" else (args.side,),
    )


def _refuse_own_table(spec: "HologramSpec", targets: list[Path]) -> None:
    """Refuse to write over the table that the hologram is made of."""
    from ..files import refuse_own_input

    file = getattr(spec.efficiency, "file", None)
    for path in targets:
        if isinstance(file, str) and file:
            refuse_own_input(path, file)


def _range(text: str) -> tuple[float, float]:
    try:
        first, last = (float(part) for part in text.split(":"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be {_RANGE_HELP}, got {text!r}") from None
    if not (math.isfinite(first) and math.isfinite(last) and first <= last):
        raise argparse.ArgumentTypeError(f"must be {_RANGE_HELP} with A not above B, got {text!r}")
    return first, last
