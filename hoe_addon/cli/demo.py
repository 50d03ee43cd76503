# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``demo``: the first preset, straight ahead and from nine pupils, in under three minutes."""

import argparse
import time
from typing import Any

from ..files import VIEW_FILES
from .eyebox import EYEBOX_FILES, summary, view_files, write_survey
from .picture_options import light_guide_of, open_device
from .progress import progress_bar

_DESCRIPTION = """\
Render the preset two_hologram_ar straight ahead (view.*) and its 3x3 eyebox (eyebox.*, views/).
"""

_PRESET = "two_hologram_ar"
_VIEW = ("render.size=[640,480]", "render.samples=32")
_EYEBOX_SIZE = (216, 162)
_EYEBOX_SAMPLES = 24
_EYEBOX_FIELD_DEG = 23.0  # little more than the display's, to read it on a small picture
_FIELD_SAMPLES = 96


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "demo", help="the AR light guide: one view and its eyebox", description=_DESCRIPTION
    )
    parser.add_argument(
        "--out",
        metavar="DIR",
        default="out/demo",
        help="folder for the results, made if need be (default: %(default)s)",
    )
    parser.set_defaults(run=run, device=_PRESET, assignments=[], size=None)
    parser.set_defaults(samples=None, seed=None, mode=None, method=None, effects=None)


def run(args: argparse.Namespace) -> int:
    """Render everything and say what came out.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import writable_folder

    started = time.perf_counter()
    spec = light_guide_of(args, _VIEW)
    folder = writable_folder(args.out, (*VIEW_FILES, *EYEBOX_FILES))
    views = writable_folder(folder / "views", view_files(spec))
    device = open_device(args, spec)

    from msgspec import structs

    from ..blender.build.eye import set_pupil
    from ..blender.pictures.render_settings import set_picture
    from ..blender.pictures.view import render_view, save_view

    with progress_bar("view") as progress:
        view = render_view(device, progress)
    metrics = save_view(device, view, folder, clean=True)
    set_picture(device.scene, _EYEBOX_SIZE, _EYEBOX_SAMPLES)
    set_pupil(device.camera, structs.replace(spec.eye, field_deg=_EYEBOX_FIELD_DEG))
    with progress_bar("eyebox") as progress:
        report = write_survey(device, folder, views, _FIELD_SAMPLES, True, progress)
    field = metrics["display_field"]["display_light"]
    print(f"results: {folder.resolve()}")
    print(f"view.png: {spec.title}")
    print(
        f"picture: mean {metrics['picture']['mean_cd_m2']:.1f} cd/m2, display's light over its "
        f"field {field['mean_cd_m2']:.1f} cd/m2, {metrics['samples']} samples per pixel"
    )
    print(summary(report))
    print(f"time: {time.perf_counter() - started:.0f} s after start-up")
    return 0
