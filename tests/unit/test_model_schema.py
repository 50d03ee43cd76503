# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shipped JSON Schema files: equal to what the specs make, and useful to other programs."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from hoe_addon.model.document import load_device, load_hologram, to_document
from hoe_addon.model.schema import SCHEMA_DIR, device_schema, hologram_schema, schema_text
from hoe_addon.resources import preset_paths

LENS = Path(__file__).parents[1] / "documents" / "lens.json"
RENEW = "python -c 'from hoe_addon.model import schema; schema.write_shipped()'"


def shipped(name: str) -> Any:
    return json.loads((SCHEMA_DIR / f"{name}.schema.json").read_text(encoding="utf-8"))


def validator(name: str) -> jsonschema.Draft202012Validator:
    schema = shipped(name)
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


@pytest.mark.parametrize(
    ("name", "made"), [("hologram-1", hologram_schema()), ("device-1", device_schema())]
)
def test_shipped_file_is_what_the_specs_make(name: str, made: dict[str, Any]) -> None:
    text = (SCHEMA_DIR / f"{name}.schema.json").read_text(encoding="utf-8")
    assert text == schema_text(made), f"renew with: {RENEW}"


def test_hologram_example_is_valid_as_read_and_as_written() -> None:
    check = validator("hologram-1")
    assert not list(check.iter_errors(json.loads(LENS.read_text(encoding="utf-8"))))
    assert not list(check.iter_errors(to_document(load_hologram(LENS))))


@pytest.mark.parametrize("name", preset_paths())
def test_presets_are_valid_as_read_and_as_written(name: str) -> None:
    check = validator("device-1")
    assert not list(check.iter_errors(json.loads(preset_paths()[name].read_text("utf-8"))))
    assert not list(check.iter_errors(to_document(load_device(name))))


@pytest.mark.parametrize(
    "broken",
    [
        {"schema": 2},
        {"extra": 1},
        {"orders": []},
        {"orders": [1, 1]},
        {"media": {"back": 0.5}},
        {"media": {"back": "glass"}},
        {"surface": {"size_mm": [1, 1]}},
        {"surface": {"shape": "plane", "size_mm": [0, 1]}},
        {
            "efficiency": {
                "model": "kinoform",
                "levels": 1,
                "design_wavelength_nm": 532,
                "relief": 2,
            }
        },
        {"efficiency": {"model": "constant", "table": {"T": {"+1": 0.5}}}},
        {"efficiency": {"model": "constant", "table": {"T": {"1": 1.5}}}},
    ],
)
def test_schema_refuses_what_it_can_express(broken: dict[str, Any]) -> None:
    document = json.loads(LENS.read_text(encoding="utf-8")) | broken
    assert not validator("hologram-1").is_valid(document)
