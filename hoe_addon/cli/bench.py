# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``bench``: how fast our surfaces render beside Cycles' own glass."""

import argparse
import json
import math
import re
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from .parser import parse_number

if TYPE_CHECKING:
    from ..blender.bench import Benchmark

_DESCRIPTION = """\
Render two parallel faces in one and the same view with Cycles' Glass (without roughness, under
OSL), with our dielectric, and with a hologram of 1, 3 and 9 orders, each in turn and several times
over. Prints samples per second by the clock (wall) and by processor time of all threads (cpu), and
the ratio to the glass by processor time: the median of the rounds and the distance of their
quartiles (spread). Scene set-up is left out: each number is the slope between renders with few and
with many samples.
"""
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


def _measured(args: argparse.Namespace) -> "Benchmark":
    from tqdm import tqdm

    from ..blender.bench import run_benchmark

    with tqdm(total=1.0, desc="bench", disable=None, bar_format="{l_bar}{bar}| {elapsed}") as bar:

        def show(done: float) -> None:
            bar.update(done - bar.n)

        return run_benchmark(args.seconds, args.size, show)


def _json(result: "Benchmark") -> str:
    return json.dumps(asdict(result), indent=2) + "\n"


def _table(result: "Benchmark") -> str:
    lines = [f"{'':12}  {'wall 1/s':>10}  {'cpu 1/s':>10}  {'ratio':>6}  {'spread':>6}"]
    lines += [
        f"{speed.name:12}  {speed.samples_per_second:10.3g}  {speed.samples_per_cpu_second:10.3g}"
        f"  {speed.ratio:6.3f}  {speed.spread:6.3f}"
        for speed in result.speeds
    ]
    return "\n".join(lines) + "\n"


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
