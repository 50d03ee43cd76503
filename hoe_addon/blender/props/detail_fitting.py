# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts of details that fit a kind that was just chosen: what both kinds have stays.

So a choice in a menu gives a valid document at once, and sliders to go on from.
"""

import json
from copy import deepcopy
from typing import Any, cast

import bpy
import msgspec

from ...model.characteristic import CHARACTERISTICS
from ...model.efficiency.rcwa_profile import PROFILES, RELIEFS
from ...model.efficiency.relief_shapes import RELIEF_SHAPES
from ...model.source_shapes import SOURCE_SHAPES
from ...model.surface import SURFACES
from ...model.waves import WAVES
from ..ids import Shape, WaveKind
from .changes import mark
from .detail_fields import document
from .values import numbers

type Document = dict[str, Any]
type Kinds = dict[str, type[msgspec.Struct]]


def _by_tag(structs: tuple[type[msgspec.Struct], ...]) -> Kinds:
    return {str(struct.__struct_config__.tag): struct for struct in structs}


_WAVES, _FUNCTIONS, _SURFACES = _by_tag(WAVES), _by_tag(CHARACTERISTICS), _by_tag(SURFACES)
_RELIEFS, _PROFILES, _SOURCES = _by_tag(RELIEF_SHAPES), _by_tag(PROFILES), _by_tag(SOURCE_SHAPES)

_START: Document = {
    # waves
    "position_mm": [0.0, 0.0, -100.0],
    "window": {"position_mm": [0.0, 0.0, -20.0], "thickness_mm": 5.0, "index": 1.5},
    "first_mm": [0.0, 0.0, -100.0],
    "second_mm": [0.0, 0.0, -150.0],
    "line_direction": [1.0, 0.0, 0.0],
    "source": {"kind": "point", "position_mm": [0.0, 0.0, -160.0]},
    "surfaces": [
        {"shape": "plane", "vertex_mm": [0, 0, -60], "semi_diameter_mm": 30, "medium": "N-BK7"},
        {
            "shape": "sphere",
            "vertex_mm": [0, 0, -45],
            "radius_mm": -60,
            "semi_diameter_mm": 30,
            "medium": 1.0,
        },
    ],
    # sources with an extent
    "diameter_mm": 2.0,
    "length_mm": 2.0,
    "vertices_mm": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]],
    "faces": [[0, 1, 2]],
    # characteristic functions; those that make a lens have a focal length of 100 mm
    "wavelength_nm": 532.0,
    "lines_per_mm": 600.0,
    "coefficients": [-0.5],
    "normalization_mm": 10.0,
    "unit": "mm",
    "terms": [{"x": 2, "y": 0, "coefficient": -0.5}, {"x": 0, "y": 2, "coefficient": -0.5}],
    "index": "noll",
    "origin_mm": [-60.0, -60.0],
    "pitch_mm": [40.0, 40.0],
    "formula": "-r^2 / 200",
    "file": "",
    # surfaces
    "size_mm": [40.0, 40.0],
    "radius_mm": 100.0,
    "conic": -1.0,
    "axis": "x",
    # reliefs
    "depth_um": 0.5,
    "levels": 4,
    "slant_deg": 20.0,
    "points": [[0.0, 0.0], [0.5, 0.0], [0.25, 0.5]],
    "heights_um": [0.0, 0.25, 0.5, 0.25],
    "heights": [0.0, 0.5, 1.0, 0.5],
    "layers": [
        {
            "thickness_um": 0.5,
            "segments": [{"width": 0.5, "index": 1.5}, {"width": 0.5, "index": 1}],
        }
    ],
    "thickness_um": 10.0,
    "modulation": 0.02,
}
"""Where a field that has to be given begins."""

_OWN_START: dict[str, Document] = {
    "zernike": {"coefficients": {"4": -0.144}},
    "spline": {"coefficients": [[-6.0 * (x + y) for x in range(4)] for y in range(4)]},
    "extended": {"shape": {"shape": "disc", "diameter_mm": 2.0}},
    "rectangle": {"size_mm": [2.0, 2.0]},
    "volume": {"index": 1.5},
}
"""The same for fields that have another meaning in some kind."""
_GIVEN_ANYWAY = {
    "even_radial": ("unit", "normalization_mm"),
    "polynomial": ("unit", "normalization_mm"),
    "sampled": ("heights",),
}
"""Fields that may be left out, but have a better start than their default."""


def fitted(found: Document, kind: str, kinds: Kinds) -> Document:
    """Make a part of a document fit a kind.

    Args:
        found: What is there, for whatever kind.
        kind: The kind.
        kinds: Struct of each kind.

    Returns:
        Of what is there, the fields that the kind has and that are valid in it; and the fields
        that it must have.
    """
    struct = kinds[kind]
    own = _OWN_START.get(kind, {})
    start: Document = {}
    for field in msgspec.structs.fields(struct):
        needed = field.required or field.name in _GIVEN_ANYWAY.get(kind, ())
        if needed:
            start[field.name] = deepcopy(own.get(field.name, _START.get(field.name)))
    names = {field.name for field in msgspec.structs.fields(struct)}
    kept = {name: item for name, item in found.items() if name in names}
    for attempt in (start | kept, start | _plain_only(kept)):
        if _is_valid({_tag(struct): kind} | attempt, struct):
            return attempt
    return start


def _plain_only(kept: Document) -> Document:
    """What means the same in all kinds."""
    shared = ("wavelength_nm", "size_mm", "outline", "position_mm", "beam", "depth_um")
    return {name: item for name, item in kept.items() if name in shared}


def _tag(struct: type[msgspec.Struct]) -> str:
    return cast("str", struct.__struct_config__.tag_field)


def _is_valid(part: Document, struct: type[msgspec.Struct]) -> bool:
    try:
        msgspec.convert(part, struct, strict=True)
    except msgspec.ValidationError:
        return False
    return True


def wave_changed(group: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Fit the details of a wave to its new kind; an ``update``."""
    if group.kind not in (WaveKind.PLANE, WaveKind.POINT):
        here = {"position_mm": numbers(group, "position_mm"), "beam": group.beam}
        _settle(group, group.kind, _WAVES, here)
    mark(group, context)


def function_changed(group: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Fit the details of a characteristic function to its new kind; an ``update``."""
    _settle(group, group.kind, _FUNCTIONS, {})
    mark(group, context)


def surface_changed(group: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Fit the details of a surface to its new shape; an ``update``."""
    if group.shape != Shape.PLANE:
        here = {"size_mm": numbers(group, "size_mm"), "outline": group.outline}
        _settle(group, group.shape, _SURFACES, here)
    mark(group, context)


def _settle(group: bpy.types.PropertyGroup, kind: str, kinds: Kinds, here: Document) -> None:
    """Write what fits into the text, unless it fits already.

    ``here`` are properties that mean the same, for a text that does not have them.
    """
    kept = document(group.details)
    if not _is_valid({_tag(kinds[kind]): kind} | kept, kinds[kind]):
        group.details = json.dumps(fitted(here | kept, kind, kinds))


def fit_relief(found: Document) -> Document:
    """Fit the relief of a kinoform to its new shape."""
    return found | {"profile": _shaped(found["profile"], _RELIEFS)}


def fit_source(found: Document) -> Document:
    """Fit an extended source to its new shape."""
    return found | {"shape": _shaped(found["shape"], _SOURCES)}


def fit_profile(found: Document) -> Document:
    """Fit a rigorous grating to its new cross-section: only reliefs have a ridge and a groove."""
    profile = _shaped(found["profile"], _PROFILES)
    rest = {name: item for name, item in found.items() if name not in ("ridge", "groove")}
    if issubclass(_PROFILES[profile["shape"]], RELIEFS):
        rest |= {"ridge": found.get("ridge", 1.5)}
        if "groove" in found:
            rest["groove"] = found["groove"]
    return rest | {"profile": profile}


def _shaped(part: Document, kinds: Kinds) -> Document:
    shape = part["shape"]
    return {"shape": shape} | fitted(part, shape, kinds)
