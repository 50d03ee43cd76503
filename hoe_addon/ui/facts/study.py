# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last results of studies, kept in the file, as lines of text."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from typing import Any

import bpy
import msgspec

from ...blender.job_files import JobKind
from .device import Line

_MOST_COLOURS = 400
"""Each is compared with each."""

_MOST_COLUMNS = 9
"""Wider grids do not fit into a panel; the picture and the file have them."""


class _Position(msgspec.Struct, frozen=True):
    """What eyebox.json says of one pupil."""

    row: int
    column: int
    mean_cd_m2: float
    standard_error_cd_m2: float
    uniformity: float
    u_prime: float | None
    v_prime: float | None
    uniformity_standard_error: float | None = None

    def luminance(self) -> str:
        """Its mean luminance with the standard error."""
        return f"{_with_error(self.mean_cd_m2, self.standard_error_cd_m2)} cd/m²"


class _Survey(msgspec.Struct, frozen=True):
    """What eyebox.json says."""

    grid: tuple[int, int]
    eyebox_uniformity: float
    positions: tuple[_Position, ...]
    eyebox_uniformity_standard_error: float | None = None


class EyeboxResult(msgspec.Struct, frozen=True):
    """The last study of an eyebox, as a scene keeps it.

    Attributes:
        report: What eyebox.json holds.
        folder: Where the files are.
        digest: Hash of the device that was studied.
    """

    report: _Survey
    folder: str
    digest: str


class AccuracyResult(msgspec.Struct, frozen=True):
    """The last study of accuracy, as a scene keeps it.

    Attributes:
        words: What came of it, one line.
        page: The page with the whole result.
        digest: Hash of the device that was studied.
    """

    words: str
    page: str
    digest: str


@dataclass(frozen=True)
class EyeboxFacts:
    """The last eyebox study of a scene.

    Attributes:
        lines: Its numbers.
        rows: Mean luminance of a white display at each pupil in cd/m², the top row first; empty
            where there are too many.
        folder: Where its files are.
        digest: Hash of the device that was studied.
    """

    lines: tuple[Line, ...]
    rows: tuple[tuple[str, ...], ...]
    folder: str
    digest: str


def keep_result(
    scene: bpy.types.Scene, kind: JobKind, result: Mapping[str, Any], digest: str
) -> None:
    """Keep the result of a study in its scene.

    Args:
        scene: The scene.
        kind: Which study; other jobs have nothing to keep.
        result: What the job gave.
        digest: Hash of the device that was studied.
    """
    if kind == JobKind.EYEBOX:
        report = msgspec.convert(result["report"], _Survey)
        kept = EyeboxResult(report, result["folder"], digest)
        scene.hologram.eyebox_result = msgspec.json.encode(kept).decode()
    elif kind == JobKind.ACCURACY:
        kept = AccuracyResult(result["words"], result["page"], digest)
        scene.hologram.accuracy_result = msgspec.json.encode(kept).decode()


def eyebox_of(scene: bpy.types.Scene) -> EyeboxFacts | None:
    """The last eyebox study of a scene, or None."""
    return _eyebox_facts(scene.hologram.eyebox_result)


def accuracy_of(scene: bpy.types.Scene) -> AccuracyResult | None:
    """The last study of accuracy of a scene, or None."""
    return _read(scene.hologram.accuracy_result, AccuracyResult)


@lru_cache(maxsize=16)
def _eyebox_facts(text: str) -> EyeboxFacts | None:
    kept = _read(text, EyeboxResult)
    if kept is None or not kept.report.positions:
        return None
    positions = kept.report.positions
    brightest = max(positions, key=lambda each: each.mean_cd_m2)
    darkest = min(positions, key=lambda each: each.mean_cd_m2)
    worst = min(positions, key=lambda each: each.uniformity)
    field = _percent(worst.uniformity, worst.uniformity_standard_error)
    eyebox = _percent(kept.report.eyebox_uniformity, kept.report.eyebox_uniformity_standard_error)
    lines = [
        Line("Brightest Pupil", brightest.luminance()),
        Line("Darkest Pupil", darkest.luminance()),
        Line("Eyebox", f"{eyebox} min/max"),
        Line("Field", f"{field}, worst pupil"),
    ]
    colours = [
        (each.u_prime, each.v_prime)
        for each in positions
        if each.u_prime is not None and each.v_prime is not None
    ]
    if 1 < len(colours) <= _MOST_COLOURS:
        apart = max(math.dist(one, other) for one, other in combinations(colours, 2))
        lines.append(Line("Colour", f"{apart:.3f} largest delta u'v'"))
    return EyeboxFacts(tuple(lines), _rows(kept.report), kept.folder, kept.digest)


def _percent(share: float, error: float | None) -> str:
    return f"{_with_error(share * 100.0, None if error is None else error * 100.0)} %"


def _with_error(value: float, error: float | None) -> str:
    """A number with its standard error, both to the first digit of the error that counts.

    Results of older versions have no error; a black display has none above 0.
    """
    if error is None or not error > 0.0:
        return f"{value:.3g}"
    digits = min(max(0, -math.floor(math.log10(float(f"{error:.1g}")))), 6)
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def _rows(report: _Survey) -> tuple[tuple[str, ...], ...]:
    columns, rows = report.grid
    if max(columns, rows) > _MOST_COLUMNS or len(report.positions) != columns * rows:
        return ()
    ordered = sorted(report.positions, key=lambda each: (each.row, each.column))
    texts = [f"{each.mean_cd_m2:.3g}" for each in ordered]
    return tuple(tuple(texts[row * columns : (row + 1) * columns]) for row in range(rows))


def _read[T](text: str, kind: type[T]) -> T | None:
    """Read what a scene keeps; a file of a stranger may hold any text, which is no result."""
    try:
        return msgspec.json.decode(text, type=kind) if text else None
    except (msgspec.MsgspecError, RecursionError):
        return None
