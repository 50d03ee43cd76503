# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``map``: the map of grad V that a hologram needs, its error, and where nothing is recorded."""

import argparse
from time import perf_counter
from typing import Any

from .one_hologram import add_hologram_arguments, hologram_of

_DESCRIPTION = """\
Make the map of grad V that a hologram needs whose pattern has no formula: waves behind optics,
splines, files. It is kept in the cache, where renders find it. Printed are, for every source behind
optics, where its rays could be fitted on the element and where not, and the size and the
interpolation error of the map, absolute in grad V = n_O s_O - n_R s_R, which is about radians.
"""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "map", help="bake what has no formula, and report on it", description=_DESCRIPTION
    )
    add_hologram_arguments(parser)
    parser.add_argument(
        "--out", metavar="MAP.exr", help="write the map here too: 32-bit float, 4 channels"
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Make the map and report.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import refuse_own_input, replacing
    from ..model.maps import MapRequest, fit_reports, map_file
    from ..model.reading import naming
    from ..shading.pattern import pattern_part
    from .progress import progress_bar

    spec = hologram_of(args)
    source = pattern_part(spec.pattern, 1.0).map
    if not source.terms:
        print("no map is needed: every part of the pattern has a formula")
        return 0
    request = MapRequest(source, spec.surface, spec.pattern.wavelength_nm)
    if args.out:
        refuse_own_input(args.out, args.document)
    with naming(args.document):
        for line in fit_reports(request):
            print(f"rays behind optics: {line}")
        start = perf_counter()
        with progress_bar("map") as progress:
            path, made = map_file(request, progress=progress)
    texels = made.texels
    width, height = spec.surface.size_mm
    print(f"map: {len(texels)} x {len(texels)} texels over {width:g} x {height:g} mm")
    print(f"recorded: {100.0 * texels[..., 3].mean():.2f} % of the texels")
    print(f"interpolation error: {made.error:.1e} in grad V")
    print(f"seconds: {perf_counter() - start:.2f}")
    print(f"file: {path}")
    if args.out:
        with replacing(args.out) as part:
            part.write_bytes(path.read_bytes())
    return 0
