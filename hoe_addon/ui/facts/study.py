# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The last results of studies, as lines of text, for as long as Blender is open."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any

import bpy

from .device import Line

_MOST_COLOURS = 400
"""Each is compared with each."""

_MOST_COLUMNS = 9
"""Wider grids do not fit into a panel; the picture and the file have them."""


@dataclass(frozen=True)
class EyeboxFacts:
    """The last eyebox study of a scene.

    Attributes:
        lines: Its numbers.
        rows: Mean luminance of a white display at each pupil in cd/m2, the top row first; empty
            where there are too many.
        folder: Where its files are.
    """

    lines: tuple[Line, ...]
    rows: tuple[tuple[str, ...], ...]
    folder: str


@dataclass
class _State:
    """Results by the session id of the scene."""

    eyeboxes: dict[int, EyeboxFacts] = field(default_factory=dict[int, EyeboxFacts])


_state = _State()


def keep_eyebox(scene: int, report: Mapping[str, Any], folder: str) -> None:
    """Keep the result of an eyebox study.

    Args:
        scene: Session id of the scene.
        report: What eyebox.json holds.
        folder: Where the files are.
    """
    _state.eyeboxes[scene] = eyebox_facts(report, folder)


def eyebox_of(scene: bpy.types.Scene) -> EyeboxFacts | None:
    """The last eyebox study of a scene, or None."""
    return _state.eyeboxes.get(scene.session_uid)


def eyebox_facts(report: Mapping[str, Any], folder: str) -> EyeboxFacts:
    """Put an eyebox study into words.

    Args:
        report: What eyebox.json holds.
        folder: Where the files are.

    Returns:
        Its numbers.
    """
    positions = report["positions"]
    means = [each["mean_cd_m2"] for each in positions]
    darkest = min(each["uniformity"] for each in positions)
    lines = [
        Line("Brightest Pupil", f"{max(means):.3g} cd/m2"),
        Line("Darkest Pupil", f"{min(means):.3g} cd/m2"),
        Line("Eyebox", f"{report['eyebox_uniformity'] * 100:.0f} % min/max"),
        Line("Field", f"{darkest * 100:.0f} %, worst pupil"),
    ]
    colours = [
        (each["u_prime"], each["v_prime"]) for each in positions if each["u_prime"] is not None
    ]
    if 1 < len(colours) <= _MOST_COLOURS:
        apart = max(math.dist(one, other) for one, other in combinations(colours, 2))
        lines.append(Line("Colour", f"{apart:.3f} largest delta u'v'"))
    return EyeboxFacts(tuple(lines), _rows(report), folder)


def _rows(report: Mapping[str, Any]) -> tuple[tuple[str, ...], ...]:
    columns, rows = report["grid"]
    positions = report["positions"]
    if max(columns, rows) > _MOST_COLUMNS or len(positions) != columns * rows:
        return ()
    ordered = sorted(positions, key=lambda each: (each["row"], each["column"]))
    texts = [f"{each['mean_cd_m2']:.3g}" for each in ordered]
    return tuple(tuple(texts[row * columns : (row + 1) * columns]) for row in range(rows))


def register() -> None:
    """Nothing is known yet."""


def unregister() -> None:
    """Forget all results."""
    _state.eyeboxes.clear()
