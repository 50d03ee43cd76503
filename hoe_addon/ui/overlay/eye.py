# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pupil, gaze, eye relief and eyebox as lines, in mm in the frame of the device."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.scene_view import gaze_direction
from . import colours
from .lines import Lines, arrow_heads, between, circle, path

_GAZE_PUPILS = 2.5
"""Length of the line of gaze in pupil diameters."""

_TICK_MM = 1.0
"""Half the length of the ends of a dimension line."""

_CLEAR_MM = 3.0
"""Distance of the dimension line from what it runs beside."""

_DOT_SHARE = 0.09
"""Half the size of a dot of the eyebox, over the pitch."""


@dataclass(frozen=True)
class Label:
    """A word at a place of the scene.

    Attributes:
        text: The word.
        place: Where it stands.
    """

    text: str
    place: tuple[float, float, float]

    def moved(self, matrix: FloatArray) -> "Label":
        """Give the same word elsewhere.

        Args:
            matrix: From its frame to another, shape ``(4, 4)``.
        """
        x, y, z = (matrix @ (*self.place, 1.0))[:3]
        return Label(self.text, (float(x), float(y), float(z)))


def pupil_lines(spec: DeviceSpec) -> tuple[Lines, tuple[Label, ...]]:
    """Draw the pupil in its true size and where it looks; of a light guide the eye relief too.

    Args:
        spec: The document.

    Returns:
        Its lines, and what is written beside them.
    """
    eye = spec.eye
    middle = np.asarray(eye.position_mm, dtype=np.float64)
    is_guide = isinstance(spec, LightGuideSpec)
    gaze = gaze_direction((0.0, 0.0) if is_guide else spec.gaze_deg)
    rim = circle(middle, gaze, eye.pupil_diameter_mm / 2.0)
    tip = middle + _GAZE_PUPILS * eye.pupil_diameter_mm * gaze
    looks = [between(middle, tip), arrow_heads(tip[None], gaze, 0.35 * eye.pupil_diameter_mm)]
    parts = [
        Lines.of(rim, colours.PUPIL),
        Lines.of(np.concatenate(looks), colours.PUPIL, 0.7),
    ]
    if not isinstance(spec, LightGuideSpec):
        return Lines.joined(parts), ()
    relief, label = _relief(spec, middle)
    return Lines.joined([*parts, relief]), (label,)


def _relief(spec: LightGuideSpec, middle: FloatArray) -> tuple[Lines, Label]:
    """A dimension line from the pupil to the guide."""
    face = spec.guide.face_z_mm("eye")
    rows, pitch = spec.eyebox.grid[1], spec.eyebox.pitch_mm[1]
    below = max((rows - 1) * pitch / 2.0, spec.eye.pupil_diameter_mm / 2.0) + _CLEAR_MM
    ends = np.array([middle, middle]) - (0.0, below, 0.0)
    ends[1, 2] = face
    tick = np.array((0.0, _TICK_MM, 0.0))
    ticks = [between(end - tick, end + tick) for end in ends]
    heads = arrow_heads(ends, np.array([(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]), _TICK_MM)
    lines = Lines.of(np.concatenate([path(ends), *ticks, heads]), colours.MEASURE, 0.8)
    x, y, z = ends.mean(axis=0)
    relief = middle[2] - face
    return lines, Label(f"{relief:.4g} mm", (float(x), float(y), float(z)))


def eyebox_lines(spec: DeviceSpec) -> Lines:
    """Draw the places of the pupil that an eyebox study looks at, and a frame around them.

    Args:
        spec: The document; only a light guide has an eyebox.

    Returns:
        Its lines.
    """
    if not isinstance(spec, LightGuideSpec):
        return Lines.joined([])
    (columns, rows), pitch = spec.eyebox.grid, np.asarray(spec.eyebox.pitch_mm)
    across = (np.arange(columns) - (columns - 1) / 2.0) * pitch[0]
    up = (np.arange(rows) - (rows - 1) / 2.0) * pitch[1]
    x, y = np.meshgrid(across, up)
    places = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=-1) + spec.eye.position_mm
    size = _DOT_SHARE * float(pitch.min())
    strokes = size * np.array([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0)])
    dots = [between(places - stroke, places + stroke) for stroke in strokes]
    half = np.array((across[-1], up[-1], 0.0))
    corners = half * np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
    frame = path(corners + spec.eye.position_mm, closed=True)
    return Lines.joined(
        [
            Lines.of(np.concatenate(dots), colours.EYEBOX),
            Lines.of(frame, colours.EYEBOX, 0.6),
        ]
    )
