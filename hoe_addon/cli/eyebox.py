# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``eyebox``: the device seen from a grid of pupil positions."""

import argparse
import json
import math
from typing import TYPE_CHECKING, Any

from .picture_options import OF_DOCUMENT, add_picture_options, light_guide_of, open_device, size
from .progress import progress_bar
from .with_error import with_error

if TYPE_CHECKING:
    from pathlib import Path

    from ..blender.build.device import DeviceScene
    from ..blender.pictures.eyebox import PupilResult
    from ..model.device import LightGuideSpec

_DESCRIPTION = """\
Look through a device from a grid of pupil positions. Writes eyebox.png (a labelled contact sheet),
eyebox.json (per position: pupil centre in mm; mean, min and max luminance of a white display over
its field in cd/m2; uniformity = min / max; mean u'v'; all but u'v' with standard errors) and
views/ (an EXR and a PNG per position). The luminances are measured without the room's light.
"""

_FIELD_SAMPLES = 512
_MAX_FIELD_SAMPLES = 1_000_000

_NOISY = 0.1
"""A uniformity with a larger relative standard error is called noisy."""

EYEBOX_FILES = ("eyebox.png", "eyebox.json")
"""What a survey writes into its folder, beside the folder of views."""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "eyebox", help="the device from a grid of pupil positions", description=_DESCRIPTION
    )
    add_picture_options(parser)
    add = parser.add_argument
    add("--grid", metavar="NXxNY", type=size, help=f"positions along x and y ({OF_DOCUMENT})")
    add(
        "--pitch-mm",
        metavar="X,Y",
        type=_pair,
        help=f"distance of neighbours along x and y in mm ({OF_DOCUMENT})",
    )
    add(
        "--field-samples",
        metavar="N",
        type=int,
        default=_FIELD_SAMPLES,
        help=f"samples per cell of the luminance measurement (default {_FIELD_SAMPLES})",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Survey the eyebox and write the results.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..core.errors import SpecError
    from ..files import writable_folder

    if not 4 <= args.field_samples <= _MAX_FIELD_SAMPLES:
        rule = f"must be from 4 to {_MAX_FIELD_SAMPLES}"
        raise SpecError(f"--field-samples: {rule}, got {args.field_samples}")
    changes = []
    if args.grid is not None:
        changes.append(f"eyebox.grid={json.dumps(args.grid)}")
    if args.pitch_mm is not None:
        changes.append(f"eyebox.pitch_mm={json.dumps(args.pitch_mm)}")
    spec = light_guide_of(args, changes)
    folder = writable_folder(args.out, EYEBOX_FILES)
    views = writable_folder(folder / "views", view_files(spec))
    with progress_bar("eyebox") as progress:
        report = write_survey(
            open_device(args, spec), folder, views, args.field_samples, args.denoise, progress
        )
    print(f"{folder}: eyebox.png, eyebox.json, views/")
    print(summary(report))
    return 0


def write_survey(
    device: "DeviceScene",
    folder: "Path",
    views: "Path",
    field_samples: int,
    clean: bool,
    progress: Any,
) -> dict[str, Any]:
    """Survey the eyebox of a device and write everything.

    Args:
        device: The device in its scene.
        folder: Where eyebox.png and eyebox.json go.
        views: Where the single views go.
        field_samples: Samples per cell of the luminance measurement.
        clean: Whether PNG files are denoised.
        progress: Told the finished share; where it raises CancelledError, the positions that are
            done are kept.

    Returns:
        What eyebox.json holds; ``positions`` has fewer than the grid where it was stopped.

    Raises:
        CancelledError: It was stopped before a position was done.
    """
    from ..blender.pictures import exr
    from ..blender.pictures.eyebox import survey
    from ..blender.pictures.view import clean_picture, save_png
    from ..core.errors import CancelledError
    from ..files import write_text
    from .contact_sheet import write_contact_sheet

    found: list[dict[str, Any]] = []
    try:
        for result in survey(device, field_samples, progress):
            name = result.position.name
            exr.write(views / f"{name}.exr", result.view.picture)
            shown = clean_picture(result.view) if clean else result.view.picture
            save_png(device.scene, shown, views / f"{name}.png")
            found.append(_position(result))
    except CancelledError:
        if not found:
            raise
    report = _report(device, found, field_samples)
    write_text(folder / "eyebox.json", (json.dumps(report, indent=2), "\n"))
    write_contact_sheet(folder / "eyebox.png", views, report)
    return report


def _position(result: "PupilResult") -> dict[str, Any]:
    """What eyebox.json says of one position."""
    return {
        "name": result.position.name,
        "column": result.position.column,
        "row": result.position.row,
        "pupil_mm": list(result.position.centre_mm),
        **result.field.to_dict(),
        "seconds": round(result.view.seconds, 3),
    }


def view_files(spec: "LightGuideSpec") -> list[str]:
    """Names of the files that a survey writes into the folder of views."""
    from ..model.eyebox import pupil_positions

    names = [position.name for position in pupil_positions(spec)]
    return [f"{name}.{kind}" for name in names for kind in ("exr", "png")]


def summary(report: dict[str, Any]) -> str:
    """One line on a survey."""
    positions = report["positions"]
    darkest, brightest = _darkest_and_brightest(positions)
    worst = min(positions, key=lambda each: each["uniformity"])
    value, error = worst["uniformity"], worst["uniformity_standard_error"]
    eyebox = report["eyebox_uniformity"], report["eyebox_uniformity_standard_error"]
    noisy = "; noisy, use more field samples" if error > _NOISY * value else ""
    return (
        f"white field: brightest pupil {_mean(brightest)} cd/m2, darkest {_mean(darkest)} cd/m2, "
        f"uniformity over the eyebox {with_error(*eyebox, 3)} (min / max of the means), "
        f"over the field of the worst pupil {with_error(value, error, 3)}{noisy}"
    )


def _mean(position: dict[str, Any]) -> str:
    return with_error(position["mean_cd_m2"], position["standard_error_cd_m2"], 1)


def _darkest_and_brightest(
    positions: list[dict[str, Any]],
) -> tuple[dict[str, Any], dict[str, Any]]:
    ordered = sorted(positions, key=lambda each: each["mean_cd_m2"])
    return ordered[0], ordered[-1]


def _report(
    device: "DeviceScene", positions: list[dict[str, Any]], field_samples: int
) -> dict[str, Any]:
    from ..core.extremes import ratio
    from ..core.picture_error import Estimate
    from ..model.document import to_document
    from ..model.field import field_degrees

    spec = device.guide_spec
    darkest, brightest = (
        Estimate(each["mean_cd_m2"], each["standard_error_cd_m2"])
        for each in _darkest_and_brightest(positions)
    )
    uniformity = ratio(darkest, brightest)
    return {
        "device": spec.name,
        "grid": list(spec.eyebox.grid),
        "pitch_mm": list(spec.eyebox.pitch_mm),
        "pupil_diameter_mm": spec.eye.pupil_diameter_mm,
        "field_deg": list(field_degrees(spec)),
        "display_luminance_cd_m2": spec.display.luminance_cd_m2,
        "measured": "white display, no other light, whole field",
        "field_samples": field_samples,
        "stopped_by_user": len(positions) < math.prod(spec.eyebox.grid),
        "settings": to_document(spec.render),
        "eyebox_uniformity": uniformity.value,
        "eyebox_uniformity_standard_error": uniformity.standard_error,
        "positions": positions,
    }


def _pair(text: str) -> list[float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be two numbers X,Y, got {text!r}") from None
    return [x, y]
