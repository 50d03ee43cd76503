# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``bench``: how fast our surfaces render, and how soon efficiencies are there."""

import argparse
import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from .bench_rcwa import RcwaSpeed, measure_rcwa, rcwa_lines
from .parser import parse_number

if TYPE_CHECKING:
    from ..blender.bench.effects import EffectSpeed
    from ..blender.bench.surfaces import Benchmark
    from ..blender.bench.tables import LookupSpeed

_DESCRIPTION = """\
Four measurements, of which --only picks some; effects is left out unless it is picked.
surfaces: two parallel faces in one and the same view with Cycles' Glass (without roughness, under
OSL), with our dielectric, and with a hologram of 1, 3 and 9 orders, each in turn and several times
over. Prints samples per second by the clock (wall) and by processor time of all threads (cpu), and
the ratio to the glass by processor time: the median of the rounds and the distance of their
quartiles (spread). Scene set-up is left out: each number is the slope between renders with few and
with many samples.
rigorous: tables of 31 wavelengths x 64 angles x s and p by rigorous coupled waves, and the ratio to
a plain loop over single calls.
lookups: one hologram by formula, by an interpolated table, and by drawing from the table: time of a
sample, its deviation, the time to the same error, and whether the mean pictures are alike.
effects: every preset with everything simulated, and with what its plan of effects leaves: time and
variance of a sample, how much sooner a given error is reached, whether the mean pictures are alike,
and what is left out. Takes some minutes.
"""
_PARTS = ("surfaces", "rigorous", "lookups", "effects")
_USUAL = _PARTS[:3]
_SECONDS = (1.0, 3600.0)
_PIXELS = (4, 4096)


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "bench", help="speed beside Cycles' own glass", description=_DESCRIPTION
    )
    add = parser.add_argument
    add(
        "--json",
        metavar="FILE|-",
        nargs="?",
        const="-",
        help="write the result as JSON, to the standard output unless a file is named",
    )
    add(
        "--seconds",
        metavar="S",
        type=_seconds,
        default=60.0,
        help="about how long the measured renders take together (default: 60)",
    )
    add(
        "--only",
        metavar="LIST",
        type=_parts,
        default=_USUAL,
        help=f"what to measure, some of {','.join(_PARTS)} (default: {','.join(_USUAL)})",
    )
    add("--size", metavar="WxH", type=_size, default=(256, 256), help="pixels (default: 256x256)")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Measure, and print or write the result.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import replacing, write_pieces

    if args.json is None or args.json == "-":
        result = _measured(args)
        print(_json(result) if args.json else _table(result), end="")
        return 0
    with replacing(args.json) as temporary:
        write_pieces(args.json, temporary, [_json(_measured(args))])
    return 0


def _measured(args: argparse.Namespace) -> "_Results":
    surfaces = rigorous = lookups = effects = None
    if "surfaces" in args.only:
        from ..blender.bench.surfaces import run_benchmark

        with _bar("surfaces") as show:
            surfaces = run_benchmark(args.seconds, args.size, show)
    if "rigorous" in args.only:
        with _bar("rigorous") as show:
            rigorous = measure_rcwa(show)
    if "lookups" in args.only:
        from ..blender.bench.tables import compare_lookups

        with _bar("lookups") as show:
            lookups = compare_lookups(progress=show)
    if "effects" in args.only:
        from ..blender.bench.effects import measure_effects

        with _bar("effects") as show:
            effects = measure_effects(progress=show)
    return _Results(surfaces, rigorous, lookups, effects)


@contextmanager
def _bar(name: str) -> Iterator[Callable[[float], None]]:
    from tqdm import tqdm

    with tqdm(total=1.0, desc=name, disable=None, bar_format="{l_bar}{bar}| {elapsed}") as bar:

        def show(done: float) -> None:
            bar.update(done - bar.n)

        yield show


@dataclass(frozen=True)
class _Results:
    """What was measured; None where it was not asked for."""

    surfaces: "Benchmark | None"
    rigorous: list[RcwaSpeed] | None
    lookups: "tuple[LookupSpeed, ...] | None"
    effects: "tuple[EffectSpeed, ...] | None"


def _json(result: _Results) -> str:
    document: dict[str, Any] = asdict(result.surfaces) if result.surfaces else {}
    if result.rigorous:
        document["rigorous"] = [asdict(speed) | {"ratio": speed.ratio} for speed in result.rigorous]
    if result.lookups:
        document["lookups"] = [asdict(speed) for speed in result.lookups]
    if result.effects:
        document["effects"] = [asdict(speed) for speed in result.effects]
    return json.dumps(document, indent=2) + "\n"


def _table(result: _Results) -> str:
    blocks: list[list[str]] = []
    if result.surfaces:
        blocks.append(_surface_lines(result.surfaces))
    if result.rigorous:
        blocks.append(rcwa_lines(result.rigorous))
    if result.lookups:
        blocks.append(_lookup_lines(result.lookups))
    if result.effects:
        blocks.append(_effect_lines(result.effects))
    return "\n\n".join("\n".join(lines) for lines in blocks) + "\n"


def _surface_lines(result: "Benchmark") -> list[str]:
    lines = [f"{'':12}  {'wall 1/s':>10}  {'cpu 1/s':>10}  {'ratio':>6}  {'spread':>6}"]
    lines += [
        f"{speed.name:12}  {speed.samples_per_second:10.3g}  {speed.samples_per_cpu_second:10.3g}"
        f"  {speed.ratio:6.3f}  {speed.spread:6.3f}"
        for speed in result.speeds
    ]
    return lines


def _lookup_lines(speeds: "Sequence[LookupSpeed]") -> list[str]:
    heads = ("us/sample", "deviation", "time to error", "difference/sigma")
    lines = ["efficiencies in the shader, 6 orders", f"{'':12}  {'  '.join(heads)}"]
    lines += [
        f"{speed.form:12}  {speed.microseconds:9.2f}  {speed.deviation:9.3f}"
        f"  {speed.time_to_error:13.2f}  {speed.difference:16.2f}"
        for speed in speeds
    ]
    return lines


def _effect_lines(speeds: "Sequence[EffectSpeed]") -> list[str]:
    heads = ("us/sample", "planned", "variance", "planned", "speed-up", "sigmas", "squares")
    lines = [f"{'effects':20}  {'  '.join(f'{head:>9}' for head in heads)}  left out"]
    for speed in speeds:
        (whole, part), (noise, rest) = speed.microseconds, speed.variance
        numbers = (whole, part, noise, rest, speed.speed_up, speed.sigmas, speed.blocks)
        shown = "  ".join(f"{number:9.3g}" for number in numbers)
        lines.append(f"{speed.device:20}  {shown}  {', '.join(speed.left_out) or 'nothing'}")
    return lines


def _parts(text: str) -> tuple[str, ...]:
    asked = tuple(text.split(","))
    wrong = [part for part in asked if part not in _PARTS]
    if wrong:
        raise argparse.ArgumentTypeError(f"must be some of {','.join(_PARTS)}, got {wrong[0]!r}")
    return asked


def _seconds(text: str) -> float:
    low, high = _SECONDS
    try:
        value = parse_number(text)
    except ValueError:
        value = math.nan
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"must be from {low:g} to {high:g}, got {text!r}")
    return value


def _size(text: str) -> tuple[int, int]:
    low, high = _PIXELS
    match = re.fullmatch(r"(\d{1,4})x(\d{1,4})", text, re.ASCII)
    if not match or not all(low <= int(side) <= high for side in match.groups()):
        rule = f"must be WxH, each from {low} to {high} pixels"
        raise argparse.ArgumentTypeError(f"{rule}, got {text!r}")
    return int(match[1]), int(match[2])
