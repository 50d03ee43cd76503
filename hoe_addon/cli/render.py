# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``render``: what an eye sees through a device."""

import argparse
import json
import os
import sys
import time
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..files import VIEW_FILES, writable_folder
from ..model.methods import QUALITY_ERRORS
from .interrupt import EXIT_INTERRUPTED, first_interrupt_asks
from .picture_options import add_picture_options, device_of, open_device
from .progress import progress_bar
from .with_error import with_error

if TYPE_CHECKING:
    from ..blender.pictures.asked_view import AskedView
    from ..blender.pictures.reached import Reached

_DESCRIPTION = """\
Render what the eye sees through a device. Writes view.exr (32-bit float, scene-linear Rec. 709),
view.png (as shown on a screen), view.blend (opens and renders in Blender without this add-on) and
metrics.json (settings, seconds, luminance in cd/m2, mean u'v'). The standard error of a mean
luminance is told by neighbouring pixels, and is at most that: detail of the picture adds to it.

--error, --seconds and --quality ask for a result instead of a number of samples. The error is the
root mean square error of the luminance of a pixel of view.exr, relative to the mean luminance, over
the display's field of a light guide or over the lit picture of a scene. It is told by two
independent halves of the samples; the render ends when its upper bound (95 % confidence) meets the
request, when the time is over, or after an hour where no time is given. Ctrl-C ends it early and
keeps the picture so far. Set-up and the first samples are never cut short; a time that is passed
by them is told. The denoised view.png has an error of its own, which is told too; below 16 samples
per pixel it cannot be known, and view.png is not denoised."""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "render", help="what an eye sees through a device", description=_DESCRIPTION
    )
    add_picture_options(parser)
    add = parser.add_argument
    add(
        "--error",
        metavar="X",
        type=float,
        help="render until the relative error is at most this: 0.1 is 10 %%",
    )
    add(
        "--seconds",
        metavar="S",
        type=float,
        help="render for so long by the wall clock, set-up counted",
    )
    names = ", ".join(f"{name} {error:g}" for name, error in QUALITY_ERRORS.items())
    add("--quality", metavar="NAME", help=f"render until the error has a name's value: {names}")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Render and write the results.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..model.quality import requested

    started = time.perf_counter()
    spec = device_of(args, _quality(args))
    _check_folder(args.out)
    device = open_device(args, spec)
    request = requested(spec.render.quality)

    from ..blender.pictures.asked_view import keep_asked_view

    # A number of samples is all or nothing: there Ctrl-C ends the process at once.
    asks = first_interrupt_asks() if request is not None else nullcontext()
    with asks as asked, progress_bar("render") as progress:
        made = keep_asked_view(
            device,
            request,
            args.out,
            clean=args.denoise,
            started=started,
            progress=progress,
            stopped=None if asked is None else asked.is_set,
        )
    _tell(made)
    if made.reached is not None:
        _tell_reached(made.reached)
        _tell_passed(made.reached, time.perf_counter() - started)
    if made.stopped:
        print("hoe: stopped by the user; the picture so far is written", file=sys.stderr)
        return EXIT_INTERRUPTED
    return 0


def _check_folder(path: str) -> None:
    """Refuse a folder that cannot be written; one that is new is made only with its results."""
    new = [each for each in (Path(path), *Path(path).parents) if not os.path.lexists(each)]
    writable_folder(path, VIEW_FILES)
    for each in new:
        with suppress(OSError):  # somebody else has put something into it meanwhile
            each.rmdir()


def _quality(args: argparse.Namespace) -> list[str]:
    """What the options ask for, in the form of ``--set``."""
    from ..core.errors import SpecError

    names = ("samples", "quality", "error", "seconds")
    given = {name: getattr(args, name) for name in names if getattr(args, name) is not None}
    if len(given) > 1 and set(given) != {"error", "seconds"}:
        first, second, *_ = given
        raise SpecError(f"--{first}: cannot be given together with --{second}")
    if not given:
        return []
    # A number of samples from the command line wins over a request in the document.
    value = None if "samples" in given else given.get("quality", given)
    return [f"render.quality={json.dumps(value)}"]


def _tell(made: "AskedView") -> None:
    metrics = made.metrics
    print(f"{made.folder}: view.exr, view.png, view.blend, metrics.json")
    print(f"picture: mean {_mean(metrics['picture'])} cd/m2; {_emitted(metrics)}")
    print(f"{metrics['samples']} samples per pixel in {metrics['seconds']:.1f} s")


def _tell_reached(reached: "Reached") -> None:
    """Say which errors were reached, with which confidence, and why it ended there."""
    from ..blender.pictures.reached import END_WORDS

    wanted, found = reached.request.error, reached.picture
    sure = f"with {found.confidence:.0%} confidence"
    line = f"view.exr: error {found.error:.3g}, at most {found.upper:.3g} {sure}"
    if wanted is not None and reached.end != "reached":
        line += f"; {wanted:g} was not reached: {END_WORDS[reached.end]}"
    print(line)
    if reached.png is not None:
        png = reached.png
        # Chance can make the estimate of a small square negative.
        estimate = f"error {png.error:.3g}" if png.error > 0.0 else "error too small to tell"
        kept = "" if reached.denoising_helps else "; view.png is not denoised"
        print(f"denoised: {estimate}, at most {png.upper:.3g} {sure}{kept}")
    elif reached.too_few:
        print("denoised: too few samples to tell its error; view.png is not denoised")


def _tell_passed(reached: "Reached", seconds: float) -> None:
    """Say so where more time was taken than was asked for, and by what."""
    wanted = reached.request.seconds
    if wanted is None or seconds <= wanted:
        return
    if reached.set_up > wanted:
        why = f"set-up alone, with the first samples, took {reached.set_up:.1f} s"
    else:
        why = f"{seconds:.1f} s with the files"
    print(f"{wanted:g} s was passed: {why}")


def _emitted(metrics: dict[str, Any]) -> str:
    """What the metrics say of the light of displays and lamps."""
    if "emitters" in metrics:
        light, words = metrics["emitters"], "light of displays and lamps"
    else:
        light, words = (
            metrics["display_field"]["display_light"],
            "light of the display over its field",
        )
    return f"{words}: mean {_mean(light)}, peak {light['peak_cd_m2']:.1f} cd/m2"


def _mean(light: dict[str, Any]) -> str:
    """Mean luminance with its standard error."""
    return with_error(light["mean_cd_m2"], light["mean_standard_error_at_most_cd_m2"], 1)
