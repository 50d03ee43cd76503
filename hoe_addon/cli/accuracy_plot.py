# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""accuracy.png: error against time, all pictures at the top, one knob each below."""

import math
from collections.abc import Callable
from itertools import batched
from pathlib import Path
from typing import Any

from ..core.errors import HoeError
from ..files import replacing
from .accuracy_report import Report
from .accuracy_table import name_of

_COLUMNS = 3
_CURVES = 4
"""Most curves of one small diagram beside that of the device as it is."""

_COLOURS = ("tab:blue", "tab:red", "tab:green", "tab:purple")
_MARKERS = ("o", "s", "^", "D")
_WIDTH, _TOP, _ROW = 13.0, 5.2, 3.6
_LONGEST = 44
_ROOM = 14
"""Most entries of the key in letters of the usual size."""

_TOP_WIDTH, _TOP_HEIGHT, _CLOSE = 8.0, 4.2, 0.25
"""Size of the large diagram, and how near numbers may come, in inches."""

_FRONT = {
    "linestyle": "-",
    "marker": "o",
    "color": "black",
    "markerfacecolor": "gold",
    "markersize": 8,
    "label": "Pareto front",
}
_HOLLOW = "hollow: limited by the reference"


def require_plots() -> None:
    """Make sure, before any work, that the diagram can be drawn.

    Raises:
        HoeError: matplotlib is not installed, as in Blender's own Python.
    """
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError as error:
        raise HoeError(
            "accuracy: needs matplotlib, which this Python does not have (Blender's own has it "
            "not); install it, for instance with: python -m pip install matplotlib"
        ) from error


def write_plot(path: Path, report: Report) -> None:
    """Draw error against time.

    Args:
        path: PNG file to write.
        report: What `accuracy_report.report_of` gave.

    Raises:
        HoeError: The file cannot be written.
    """
    from matplotlib.figure import Figure

    panels = _panels(report["runs"][1:])
    rows = -(-len(panels) // _COLUMNS)
    figure = Figure(figsize=(_WIDTH, _TOP + _ROW * rows), layout="constrained")
    grid = figure.add_gridspec(1 + rows, _COLUMNS, height_ratios=[_TOP, *[_ROW] * rows])
    top = figure.add_subplot(grid[0, :2])
    _draw_all(top, figure.add_subplot(grid[0, 2]), report)
    for place, (title, runs) in enumerate(panels):
        cell = grid[1 + place // _COLUMNS, place % _COLUMNS]
        axes = figure.add_subplot(cell, sharex=top, sharey=top)
        _draw_panel(axes, title, report["runs"][0], runs)
    width, height = report["size"]
    figure.suptitle(f"What accuracy costs: {report['device']}, {width} x {height} pixels")
    with replacing(path) as part:
        figure.savefig(part, dpi=100)


def _panels(runs: list[Report]) -> list[tuple[str, list[Report]]]:
    """Small diagrams: a knob each, in several parts where it has many values."""
    found: list[tuple[str, list[Report]]] = []
    for knob in dict.fromkeys(run["knob"] for run in runs):
        parts = list(batched((run for run in runs if run["knob"] == knob), _CURVES, strict=False))
        for number, part in enumerate(parts, start=1):
            title = f"{knob} ({number} of {len(parts)})" if len(parts) > 1 else knob
            found.append((title, list(part)))
    return found


def _draw_all(axes: Any, key: Any, report: Report) -> None:
    """All pictures, those on the Pareto front numbered, and the key to the numbers."""
    for number, run in enumerate(report["runs"]):
        label = "one line: one setting, 8, 16, 32 ... samples" if number == 0 else None
        axes.loglog(*_curve(run), "-", color="0.75", linewidth=0.8, label=label)
        for point in run["points"]:
            face = _face(point, "0.75")
            axes.plot(*_place(point), ".", color="0.75", markerfacecolor=face, markersize=5)
    front = [
        (point["seconds"], point["shown_error"], run, point)
        for run in report["runs"]
        for point in run["points"]
        if point["on_pareto_front"]
    ]
    front.sort(key=lambda each: each[0])
    places = [each[:2] for each in front]
    axes.loglog(*zip(*places, strict=True), **_FRONT)
    for _, _, _, point in front:
        axes.plot(
            *_place(point), **{**_FRONT, "label": None, "markerfacecolor": _face(point, "gold")}
        )
    axes.plot([], [], "o", color="black", markerfacecolor="white", label=_HOLLOW)
    own = report["reference"]["own_errors"]["error"]
    axes.axhline(own, color="tab:orange", linestyle="--", label=f"reference's own error, {own:.2%}")
    axes.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, frameon=False)
    _label(axes, "")
    _number(axes, places)
    lines = ["On the Pareto front:", ""]
    for number, (seconds, error, run, point) in enumerate(front, start=1):
        lines.append(f"{number:2}  {_short(name_of(run))}")
        sign = "< " if _is_limited(point) else ""
        lines.append(f"      {point['samples']} samples, {seconds:.3g} s, {sign}{error:.2%}")
    key.axis("off")
    small = len(front) > _ROOM
    key.text(
        0.0, 1.0, "\n".join(lines), va="top", fontsize=6 if small else 8, transform=key.transAxes
    )


def _number(axes: Any, places: list[tuple[float, float]]) -> None:
    """Write numbers below and left of the front, where no picture can be."""
    spans = [math.log(high / low) for low, high in (axes.get_xlim(), axes.get_ylim())]
    depth, last = 0, None
    for number, (seconds, error) in enumerate(places, start=1):
        here = (
            _TOP_WIDTH * math.log(seconds) / spans[0],
            _TOP_HEIGHT * math.log(error) / spans[1],
        )
        depth = (depth + 1) % 3 if last is not None and math.dist(here, last) < _CLOSE else 0
        last = here
        axes.annotate(
            str(number),
            (seconds, error),
            xytext=(-5.0, -9.0 - 11.0 * depth),
            textcoords="offset points",
            ha="right",
            va="center",
            fontsize=8,
        )


def _draw_panel(axes: Any, title: str, base: Report, runs: list[Report]) -> None:
    """The device as it is, and some values of one knob."""
    axes.loglog(*_curve(base), "-", color="0.6", linewidth=3, label="as it is")
    for run, colour, marker in zip(runs, _COLOURS, _MARKERS, strict=False):
        axes.loglog(*_curve(run), "-", color=colour, linewidth=1)
        axes.plot([], [], marker=marker, color=colour, label=_short(run["value"]))
        for point in run["points"]:
            error, spread = point["shown_error"], point["error"]["standard_error"]
            axes.errorbar(
                [point["seconds"]],
                [error],
                # A bar that reaches zero has no place on a logarithmic axis.
                yerr=[[min(spread, 0.9 * error)], [spread]],
                fmt=marker,
                color=colour,
                markerfacecolor=_face(point, colour),
                markersize=5,
                elinewidth=1,
                capsize=2,
            )
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(0.0, -0.2), frameon=False)
    _label(axes, title)


def _label(axes: Any, title: str) -> None:
    from matplotlib.ticker import LogLocator, NullFormatter

    axes.set_title(title, fontsize=10)
    for axis, shown in ((axes.xaxis, "{:g}"), (axes.yaxis, "{:.3g}")):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(_formatted(shown))
        axis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("render time / s, without set-up", fontsize=8)
    axes.set_ylabel("relative RMS error of luminance", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(alpha=0.3, which="both")


def _formatted(form: str) -> Callable[[float, int], str]:
    return lambda value, _place: form.format(value)


def _curve(run: Report) -> tuple[list[float], list[float]]:
    points = run["points"]
    return [point["seconds"] for point in points], [point["shown_error"] for point in points]


def _place(point: Report) -> tuple[list[float], list[float]]:
    return [point["seconds"]], [point["shown_error"]]


def _is_limited(point: Report) -> bool:
    return "error" in point["limited"]


def _face(point: Report, colour: str) -> str:
    """Colour inside a mark: none where the reference limits the error."""
    return "white" if _is_limited(point) else colour


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 3]}..."
