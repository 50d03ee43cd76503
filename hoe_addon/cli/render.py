# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``render``: what an eye sees through a device."""

import argparse
from typing import Any

from .picture_options import VIEW_FILES, add_picture_options, device_of, open_device
from .progress import progress_bar

_DESCRIPTION = """\
Render what the eye sees through a device. Writes view.exr (32-bit float, scene-linear Rec. 709),
view.png (as shown on a screen), view.blend (opens and renders in Blender without this add-on) and
metrics.json (settings, seconds, luminance in cd/m2, mean u'v').
"""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "render", help="what an eye sees through a device", description=_DESCRIPTION
    )
    add_picture_options(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Render and write the results.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import writable_folder

    spec = device_of(args)
    folder = writable_folder(args.out, VIEW_FILES)
    device = open_device(args, spec)

    from ..blender.view import render_view, save_view

    with progress_bar("render") as progress:
        view = render_view(device, progress)
    metrics = save_view(device, view, folder, clean=args.denoise)
    print(f"{folder}: view.exr, view.png, view.blend, metrics.json")
    print(f"picture: mean {metrics['picture']['mean_cd_m2']:.1f} cd/m2; {_emitted(metrics)}")
    print(f"{metrics['samples']} samples per pixel in {metrics['seconds']:.1f} s")
    return 0


def _emitted(metrics: dict[str, Any]) -> str:
    """What the metrics say of the light of displays and lamps."""
    if "emitters" in metrics:
        light, words = metrics["emitters"], "light of displays and lamps"
    else:
        light, words = (
            metrics["display_field"]["display_light"],
            "light of the display over its field",
        )
    return f"{words}: mean {light['mean_cd_m2']:.1f}, peak {light['peak_cd_m2']:.1f} cd/m2"
