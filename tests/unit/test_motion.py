# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves carried to another frame are the same waves there."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.units import mm_to_m
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.motion import DIRECTION_FIELDS, POINT_FIELDS, moved, to_wave
from hoe_addon.model.waves import WAVES

WAVE_DOCUMENTS: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "documents" / "waves.json").read_text(encoding="utf-8")
)
SAME_DIRECTION = 1e-12
"""Some roundings of coordinates of up to 500 mm, over distances of some 10 mm."""


def turned(rng: np.random.Generator) -> np.ndarray:
    matrix, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return matrix * np.sign(np.linalg.det(matrix))


def is_number(value: object) -> bool:
    return isinstance(value, int | float)


def names_of_vectors(document: Any) -> set[str]:
    """Fields that hold three plain numbers, at any depth but inside a shape of its own frame."""
    if not isinstance(document, dict):
        return set()
    found = {
        name
        for name, item in document.items()
        if isinstance(item, list) and len(item) == 3 and all(map(is_number, item))
    }
    return found.union(*(names_of_vectors(v) for n, v in document.items() if n != "shape"), set())


@pytest.mark.parametrize("name", list(WAVE_DOCUMENTS))
def test_every_vector_of_a_wave_is_a_point_or_a_direction(name: str) -> None:
    document = json.loads(json.dumps(WAVE_DOCUMENTS[name]))
    assert names_of_vectors(document) <= POINT_FIELDS | DIRECTION_FIELDS


@pytest.mark.parametrize("name", list(WAVE_DOCUMENTS))
def test_moved_wave_is_the_same_wave(name: str, rng: np.random.Generator) -> None:
    wave = to_wave(WAVE_DOCUMENTS[name])
    rotation, origin_mm = turned(rng), rng.uniform(-300.0, 300.0, 3)
    carried = moved(wave, rotation, origin_mm)
    points_mm = np.column_stack([rng.uniform(-10.0, 10.0, (100, 2)), np.zeros(100)])
    before, after = wave_from(wave), wave_from(carried)
    draws = rng.random((100, before.draws))
    expected = before.gradient(mm_to_m(points_mm), draws) @ rotation.T
    found = after.gradient(mm_to_m(points_mm @ rotation.T + origin_mm), draws)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=SAME_DIRECTION)
    assert np.isfinite(found).any()


def test_every_kind_that_can_follow_is_tried() -> None:
    tried = {type(to_wave(document)) for document in WAVE_DOCUMENTS.values()}
    assert {kind.__name__ for kind in WAVES} - {kind.__name__ for kind in tried} == {
        "SystemWaveSpec"
    }


def test_errors_name_the_field_inside_the_wave() -> None:
    with pytest.raises(SpecError, match=r"^position_mm\[1\]: must be a number"):
        to_wave({"kind": "point", "position_mm": [0, None, 1]})
    with pytest.raises(SpecError, match=r"^index: must be at least 1"):
        to_wave({"kind": "plane", "direction": [0, 0, 1], "index": 0.5})


def test_a_wave_too_far_away_is_told() -> None:
    wave = to_wave({"kind": "point", "position_mm": [0, 0, 1]})
    with pytest.raises(SpecError, match="position_mm"):
        moved(wave, np.eye(3), np.array((0.0, 0.0, 1e13)))
