# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``trace``: rays through one hologram, in numpy or through the shipped shader in Cycles."""

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .one_hologram import add_hologram_arguments, hologram_of

if TYPE_CHECKING:
    from ..model.hologram import HologramSpec
    from ..model.rays import RayTable, TraceResult

_DESCRIPTION = """\
Send rays through one hologram, in its own frame: the origin lies on the surface and z along the
normal there. RAYS.csv has the columns x_mm, y_mm, z_mm, l, m, n, wavelength_nm, order, side (T or
R); a ray with n > 0 comes from the back. Directions may have any length but zero. OUT.csv adds
hit_x_mm, hit_y_mm, out_l, out_m, out_n, status (ok, evanescent, miss, undefined) and efficiency;
undefined is an order where nothing is recorded; what does not exist is nan. Any order may be asked
for: the efficiency is the value of the model, the document's "orders" only limit what a picture
traces.
"""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "trace", help="directions of rays through one hologram", description=_DESCRIPTION
    )
    add_hologram_arguments(parser)
    add = parser.add_argument
    add("rays", metavar="RAYS.csv", help="rays to send")
    add("--out", metavar="OUT.csv", required=True, help="file to write")
    add(
        "--engine",
        choices=("numpy", "cycles"),
        default="numpy",
        help="numpy (float64, the default) or the shipped shader in a Cycles render (float32)",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Trace the rays and write what became of them.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import refuse_own_input, replacing, write_pieces
    from ..model.reading import naming
    from .ray_files import ray_table, read_rays, result_lines

    spec = hologram_of(args)
    rows = read_rays(args.rays)
    refuse_own_input(args.out, args.document, args.rays)
    with replacing(args.out) as temporary:
        with naming(args.document):
            result = _engine(args.engine)(spec, ray_table(rows))
        write_pieces(args.out, temporary, result_lines(rows, result))
    return 0


def _engine(name: str) -> "Callable[[HologramSpec, RayTable], TraceResult]":
    if name == "cycles":
        return _trace_cycles
    from ..model.evaluate import trace

    return trace


def _trace_cycles(spec: "HologramSpec", rays: "RayTable") -> "TraceResult":
    from ..blender.pictures.trace import trace_cycles
    from ..blender.quiet import forget_removed_engines
    from .progress import progress_bar

    forget_removed_engines()
    with progress_bar("cycles") as progress:
        return trace_cycles(spec, rays, progress)
