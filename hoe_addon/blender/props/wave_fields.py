# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of recording waves, as properties that are fields of their texts; and their colour."""

from functools import lru_cache
from typing import Any

import numpy as np
from bpy.props import FloatVectorProperty

from ...core.colour import linear_rgb_bar
from ...core.units import nm_to_m
from ..ids import Beam, Choice
from .detail_fields import choice, in_details, number, vector
from .detail_fitting import fit_source

_PLACE: dict[str, Any] = {
    "subtype": "XYZ",
    "soft_min": -1000.0,
    "soft_max": 1000.0,
    "step": 100,
    "precision": 3,
}
_DIRECTION: dict[str, Any] = {
    "subtype": "XYZ",
    "soft_min": -1.0,
    "soft_max": 1.0,
    "step": 1,
    "precision": 4,
}
_LENGTH: dict[str, Any] = {"soft_min": 0.1, "soft_max": 500.0, "step": 100, "precision": 3}
_LENGTHS = (1e-6, 1e6)
_INDEX: dict[str, Any] = {"soft_max": 2.5, "step": 1, "precision": 4}
_INDICES = (1.0, 10.0)


class SourceShape(Choice):
    """Shapes of an extended source."""

    DISC = "disc", 0, "Disc", "A round disc"
    RECTANGLE = "rectangle", 1, "Rectangle", "A rectangle"
    LINE = "line", 2, "Line", "A straight line"
    MESH = "mesh", 3, "Mesh", "Triangles, by their corners in the document"


class WaveFields:
    """Of a wave that is neither a plane wave nor a point."""

    own_position_mm: vector(
        in_details("position_mm"),
        "Position",
        "Place of the source in the frame of the hologram, in mm",
        (0.0, 0.0, -100.0),
        **_PLACE,
    )
    own_beam: choice(in_details("beam"), "Beam", "Which way the wave runs", Beam, Beam.DIVERGING)
    own_index: number(
        in_details("index"),
        "Index",
        "Refractive index of the medium in which the wave arrives",
        1.0,
        _INDICES,
        **_INDEX,
    )
    source_index: number(
        in_details("source_index"),
        "Source Index",
        "Refractive index of the medium around the point",
        1.0,
        _INDICES,
        **_INDEX,
    )
    window_position_mm: vector(
        in_details("window.position_mm"),
        "Window",
        "A point of the window's face toward the source, in mm",
        (0.0, 0.0, -20.0),
        **_PLACE,
    )
    window_normal: vector(
        in_details("window.normal"),
        "Window Normal",
        "Normal of the window, from the source to the hologram",
        (0.0, 0.0, 1.0),
        **_DIRECTION,
    )
    window_thickness_mm: number(
        in_details("window.thickness_mm"),
        "Window Thickness",
        "Thickness of the window in mm; 0 is a plain boundary",
        0.0,
        (0.0, 1e6),
        soft_max=50.0,
        step=10,
        precision=3,
    )
    window_index: number(
        in_details("window.index"),
        "Window Index",
        "Refractive index of the window",
        1.0,
        _INDICES,
        **_INDEX,
    )
    first_mm: vector(
        in_details("first_mm"),
        "First Focus",
        "Where the chief ray crosses the straight focal line, in mm",
        (0.0, 0.0, -100.0),
        **_PLACE,
    )
    second_mm: vector(
        in_details("second_mm"),
        "Second Focus",
        "Where the chief ray crosses the second focal line, in mm",
        (0.0, 0.0, -150.0),
        **_PLACE,
    )
    line_direction: vector(
        in_details("line_direction"),
        "Line Direction",
        "Direction of the first focal line",
        (1.0, 0.0, 0.0),
        **_DIRECTION,
    )
    source_shape: choice(
        in_details("shape.shape"),
        "Shape",
        "Shape of the source",
        SourceShape,
        SourceShape.DISC,
        fit_source,
    )
    source_diameter_mm: number(
        in_details("shape.diameter_mm"),
        "Diameter",
        "Diameter of the disc, in mm",
        2.0,
        _LENGTHS,
        **_LENGTH,
    )
    source_size_mm: vector(
        in_details("shape.size_mm"),
        "Size",
        "Width and height of the rectangle, in mm",
        (2.0, 2.0),
        _LENGTHS,
        **_LENGTH,
    )
    source_length_mm: number(
        in_details("shape.length_mm"),
        "Length",
        "Length of the line, in mm",
        2.0,
        _LENGTHS,
        **_LENGTH,
    )
    source_normal: vector(
        in_details("normal"), "Normal", "Normal of the source", (0.0, 0.0, 1.0), **_DIRECTION
    )


def swatch(field: str) -> Any:
    """Make a property that shows the colour of a wavelength.

    Args:
        field: Property of the same group that holds the wavelength in nm.
    """
    return FloatVectorProperty(
        name="Colour",
        description="Colour of this wavelength; beyond what can be seen it is grey",
        subtype="COLOR",
        get=lambda group: wavelength_rgb(round(getattr(group, field))),
    )


@lru_cache(maxsize=1024)
def wavelength_rgb(wavelength_nm: int) -> tuple[float, float, float]:
    """Give the colour of a wavelength.

    Args:
        wavelength_nm: Vacuum wavelength in nm.

    Returns:
        Linear RGB, each from 0 to 1; dark toward both ends of what can be seen, and grey beyond.
    """
    rgb = np.maximum(linear_rgb_bar(nm_to_m(float(wavelength_nm))), 0.0)
    strongest = float(np.max(rgb))
    if strongest < _INVISIBLE:
        return _GREY
    shown = rgb / strongest * min(1.0, (strongest / _DIM) ** 0.5)
    red, green, blue = (float(part) for part in np.maximum(shown, 0.02))
    return red, green, blue


_INVISIBLE = 1e-3
"""Matching function below which a wavelength cannot be seen."""
_DIM = 0.3
"""Matching function below which a wavelength is shown darker."""
_GREY = (0.1, 0.1, 0.1)
