# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON Schema of the documents, made from the specs; the shipped files are its output.

A schema cannot say everything: sums of efficiencies, lengths of directions, or overlaps are told
by the reader alone. What a schema refuses, the reader refuses too.
"""

import json
from pathlib import Path
from typing import Any, Union

import msgspec

from ..core.media import CATALOGUE
from . import fields
from .device import LightGuideSpec
from .hologram import HologramSpec
from .quality import QUALITIES
from .scene import SceneSpec
from .surface import MOST_COEFFICIENTS

SCHEMA_DIR = Path(__file__).with_name("schema")

_DRAFT = "https://json-schema.org/draft/2020-12/schema"
_WAVELENGTH = dict(zip(("minimum", "maximum"), fields.WAVELENGTH_RANGE_NM, strict=True))
_POSITIVE = {"exclusiveMinimum": 0}
_MEDIA_FIELDS = ("back", "front", "medium", "outside", "relief")
_POSITIVE_FIELDS = (
    "depth_waves",
    "thickness_mm",
    "depth_um",
    "relief_mm",
    "fwhm_nm",
    "focal_length_mm",
    "diameter_mm",
    "distance_mm",
    "pupil_diameter_mm",
    "luminance_per_unit_cd_m2",
    "length_mm",
    "normalization_mm",
    "semi_diameter_mm",
)
_NOT_NEGATIVE_FIELDS = (("FlatWindowSpec", "thickness_mm"),)
"""Struct and field, where the name alone would say positive."""
_SURFACE_RULES: dict[tuple[str, str], dict[str, Any]] = {
    **{
        (f"{kind}Surface", "radius_mm"): {"not": {"const": 0}}
        for kind in ("Sphere", "Conic", "Cylinder", "Asphere")
    },
    ("SphereOptic", "radius_mm"): {"not": {"const": 0}},
    ("ConicOptic", "radius_mm"): {"not": {"const": 0}},
    ("AsphereSurface", "coefficients"): {"maxItems": MOST_COEFFICIENTS},
}
_NAMED_OTHERWISE = {("KogelnikSpec", "index"): "medium"}
"""Struct and field, and the name whose rules it has."""
_SHARES = {
    "propertyNames": {"pattern": "^(0|-?[1-9][0-9]?|-?100)$"},
    "additionalProperties": {"type": "number", "minimum": 0, "maximum": 1},
}


def hologram_schema() -> dict[str, Any]:
    """JSON Schema of a hologram document.

    Returns:
        The schema, as plain data.
    """
    return _schema("hologram-1", HologramSpec)


def device_schema() -> dict[str, Any]:
    """JSON Schema of a device document.

    Returns:
        The schema, as plain data.
    """
    return _schema("device-1", LightGuideSpec, SceneSpec)


def schema_text(schema: dict[str, Any]) -> str:
    """Write a schema as it is shipped.

    Args:
        schema: The schema.

    Returns:
        Its text.
    """
    return json.dumps(schema, indent=2) + "\n"


def write_shipped() -> None:
    """Write the shipped schema files anew, after a change of the specs."""
    for name, schema in (("hologram-1", hologram_schema()), ("device-1", device_schema())):
        (SCHEMA_DIR / f"{name}.schema.json").write_text(schema_text(schema), encoding="utf-8")


def _schema(name: str, *kinds: type[msgspec.Struct]) -> dict[str, Any]:
    made = msgspec.json.schema(Union[kinds])  # noqa: UP007  (made of a list)
    definitions: dict[str, Any] = made["$defs"]
    for kind in kinds:
        root = definitions[kind.__name__]
        root["required"] = ["schema", *(field for field in root["required"] if field != "schema")]
    for struct, definition in definitions.items():
        definition["description"] = definition.get("description", "").split("\n")[0]
        for field, rule in definition["properties"].items():
            if (struct, field) in _NOT_NEGATIVE_FIELDS:
                rule["minimum"] = 0
            elif (struct, field) in _SURFACE_RULES:
                rule |= _SURFACE_RULES[struct, field]
            else:
                _add_rules(_NAMED_OTHERWISE.get((struct, field)) or field, rule)
    return {"$schema": _DRAFT, "$id": f"{name}.schema.json", **made}


def _add_rules(field: str, rule: dict[str, Any]) -> None:
    """Add what the type alone does not say."""
    if field in _MEDIA_FIELDS:
        for option in rule.get("anyOf", ()):
            if option.get("type") == "number":
                option["minimum"] = 1
            elif option.get("type") == "string":
                option["enum"] = list(CATALOGUE)
    elif field == "quality":
        for option in rule["anyOf"]:
            if option.get("type") == "string":
                option["enum"] = list(QUALITIES)
    elif field in ("wavelength_nm", "design_wavelength_nm", "preview_wavelength_nm", "centre_nm"):
        rule |= _WAVELENGTH
    elif field in ("index", "source_index") and rule.get("type") == "number":
        rule["minimum"] = 1
    elif field == "levels":
        rule |= {"minimum": 0, "not": {"const": 1}}
    elif field in ("T", "R"):
        rule |= _SHARES
    elif field == "orders":
        rule |= {"maxItems": fields.MAX_ORDERS, "uniqueItems": True}
        rule["items"] |= {"minimum": -fields.MAX_ORDER, "maximum": fields.MAX_ORDER}
        rule.pop("default", None)
    elif field in _POSITIVE_FIELDS:
        rule |= _POSITIVE
    elif field in ("size_mm", "pitch_mm"):
        for item in rule["prefixItems"]:
            item |= _POSITIVE
