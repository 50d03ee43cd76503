# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two line foci of an astigmatic wave."""

import numpy as np

from ...core.arrays import FloatArray, as_float, dot, unit
from ...model.waves import AstigmaticSpec
from .lines import path

_ARC_SIDES = 16


def crossings_mm(wave: AstigmaticSpec, points_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Find where rays cross the straight focal line and the focal arc.

    Args:
        wave: The wave.
        points_mm: Places that the rays pass, shape ``(n, 3)``.

    Returns:
        Places on the line and on the arc, each of shape ``(n, 3)``.
    """
    first, line = as_float(wave.first_mm), _line(wave)
    chief = as_float(wave.second_mm) - first
    away = points_mm - first
    height = dot(away, line)
    outward = away - height[:, None] * line
    radial = unit(outward) * np.where(dot(outward, chief) < 0.0, -1.0, 1.0)[:, None]
    radius = float(np.linalg.norm(chief))
    on_arc = first + radius * radial
    # In the plane through the axis: the straight way from the arc to the place, at distance 0.
    distance = dot(outward, radial)
    with np.errstate(divide="ignore", invalid="ignore"):
        on_axis = height * radius / (radius - distance)
    return first + on_axis[:, None] * line, on_arc


def lines_mm(
    wave: AstigmaticSpec, crossed: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Draw the focal line and the focal arc as far as rays cross them.

    Args:
        wave: The wave.
        crossed: Where they cross them, from `crossings_mm`.

    Returns:
        Pieces of each, shape ``(m, 2, 3)``.
    """
    first, line = as_float(wave.first_mm), _line(wave)
    on_axis, on_arc = crossed
    along = dot(on_axis - first, line)
    along = along[np.isfinite(along)]
    reach = (along.min(), along.max()) if len(along) else (0.0, 0.0)
    straight = path(first + np.asarray(reach)[:, None] * line)
    chief = as_float(wave.second_mm) - first
    side = np.cross(line, chief)
    angle = np.arctan2(dot(on_arc - first, side), dot(on_arc - first, chief))
    angle = angle[np.isfinite(angle)]
    angles = np.linspace(angle.min(), angle.max(), _ARC_SIDES + 1) if len(angle) else np.zeros(2)
    return straight, path(first + np.cos(angles)[:, None] * chief + np.sin(angles)[:, None] * side)


def _line(wave: AstigmaticSpec) -> FloatArray:
    """Direction of the straight focal line, at a right angle to the chief ray."""
    chief = unit(np.subtract(wave.second_mm, wave.first_mm))
    line = unit(wave.line_direction)
    return unit(line - dot(line, chief) * chief)
