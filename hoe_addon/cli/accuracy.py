# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``accuracy``: what accuracy costs in time, on one device and on this machine."""

import argparse
import math
from typing import TYPE_CHECKING

from ..core.errors import HoeError
from .interrupt import EXIT_INTERRUPTED, first_interrupt_asks
from .parser import parse_number
from .picture_options import OF_DOCUMENT, add_effects_option, device_of, open_device, size
from .progress import progress_bar

if TYPE_CHECKING:
    from pathlib import Path

    from ..blender.accuracy.results import Accuracy
    from ..model.device import DeviceSpec
    from .accuracy_report import Report

_DESCRIPTION = """\
Measure error against time for each setting by itself, starting from the device as it is, and for
good combinations: samples, denoiser, wavelengths, order selection, orders kept, effects, tables and
harmonics. Errors are against a picture of the same device with everything on and many samples,
which takes half of the budget and whose own error is printed: relative RMS error of luminance over
the display's field, worst-region bias, mean difference in u'v', contrast at 5 cycles per degree.
Writes accuracy.json, accuracy.csv, accuracy.png (error against time) and accuracy.html (one file,
pictures side by side). Ctrl-C keeps what is done.
"""

FILES = ("accuracy.json", "accuracy.csv", "accuracy.png", "accuracy.html")
"""What a measurement writes into its folder."""

_BUDGET = 120.0
_BUDGETS = (5.0, 86400.0)
_PIXELS = 128 * 96
"""Pixels of a picture where no size is asked for: few, so that there is time for many samples."""

_LEAST_SIDE = 16


def register(subparsers: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "accuracy", help="what accuracy costs in time", description=_DESCRIPTION
    )
    add = parser.add_argument
    add("device", metavar="PRESET|FILE.json", help="name of a preset, or a device's JSON file")
    add("--out", metavar="DIR", required=True, help="folder for the results, made if need be")
    add(
        "--budget",
        metavar="SECONDS",
        type=_budget,
        default=_BUDGET,
        help=f"about how long all takes together (default: {_BUDGET:g}); the reference and the "
        "device as it is are measured in any case",
    )
    add(
        "--size",
        metavar="WxH",
        type=size,
        help="pixels of a picture (default: the device's shape with about 12,000 pixels)",
    )
    add("--seed", metavar="N", type=int, help=f"first seed of the random numbers ({OF_DOCUMENT})")
    add(
        "--set",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        dest="assignments",
        help="change a field of the device first, such as render.wavelengths=uniform; may be "
        "given more than once",
    )
    add_effects_option(parser)
    # What the device itself says holds for the other options of a picture.
    parser.set_defaults(run=run, samples=None, mode=None, method=None)


def run(args: argparse.Namespace) -> int:
    """Measure and write the results.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import writable_folder
    from .accuracy_plot import require_plots
    from .accuracy_table import table

    require_plots()
    spec = _sized(args, device_of(args))
    folder = writable_folder(args.out, FILES)
    found = _measured(args, spec)
    report = write_accuracy(spec, found, args.budget, folder)
    print("\n".join(table(report)))
    print(f"{folder}: {', '.join(FILES)}")
    return EXIT_INTERRUPTED if found.stopped else 0


def _measured(args: argparse.Namespace, spec: "DeviceSpec") -> "Accuracy":
    from ..blender.accuracy.runs import measure_accuracy

    with first_interrupt_asks() as asked, progress_bar("accuracy") as progress:
        return measure_accuracy(
            spec, lambda variant: open_device(args, variant), args.budget, asked.is_set, progress
        )


def write_accuracy(
    spec: "DeviceSpec", found: "Accuracy", budget: float, folder: "Path", *, plot: bool = True
) -> "Report":
    """Write all files of a measurement.

    Args:
        spec: The device that was measured.
        found: What was found.
        budget: Seconds that were asked for.
        folder: Where the files go.
        plot: Whether the diagram is drawn, which needs matplotlib.

    Returns:
        What accuracy.json holds.

    Raises:
        OutputError: A file cannot be written.
    """
    from ..files import write_text
    from .accuracy_page import page
    from .accuracy_plot import write_plot
    from .accuracy_report import report_of, written_csv, written_json

    report = report_of(spec, found, budget)
    diagram = folder / "accuracy.png" if plot else None
    write_text(folder / "accuracy.json", written_json(report))
    write_text(folder / "accuracy.csv", written_csv(report))
    if diagram is not None:
        write_plot(diagram, report)
    write_text(folder / "accuracy.html", page(report, found, diagram))
    return report


def small(spec: "DeviceSpec") -> "DeviceSpec":
    """The device with a picture of few pixels, so that there is time for many samples."""
    from msgspec import structs

    width, height = spec.render.size
    scale = min(1.0, math.sqrt(_PIXELS / (width * height)))
    sides = tuple(max(1, round(side * scale)) for side in (width, height))
    return structs.replace(spec, render=structs.replace(spec.render, size=sides))


def _sized(args: argparse.Namespace, spec: "DeviceSpec") -> "DeviceSpec":
    """The device with a picture of few pixels, unless a size is asked for."""
    if args.size is None:
        spec = small(spec)
    least_size(spec, "--size")
    return spec


def least_size(spec: "DeviceSpec", option: str = "size") -> None:
    """Refuse pictures that are too small to be measured in.

    Args:
        spec: The device with the size of the pictures.
        option: What gave the size, for the message.

    Raises:
        HoeError: A side is too short.
    """
    if min(spec.render.size) < _LEAST_SIDE:
        shape = "x".join(map(str, spec.render.size))
        raise HoeError(f"{option}: both sides must be at least {_LEAST_SIDE} pixels, got {shape}")


def _budget(text: str) -> float:
    low, high = _BUDGETS
    try:
        value = parse_number(text)
    except ValueError:
        value = math.nan
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"must be from {low:g} to {high:g}, got {text!r}")
    return value
