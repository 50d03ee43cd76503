# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves in the shader's text: what is compiled in, and what travels in sockets."""

import copy
import json
import re
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from hoe_addon.model.waves import WaveSpec
from hoe_addon.shading.part import ShaderPart
from hoe_addon.shading.waves import wave_part

DOCUMENTS = json.loads(
    (Path(__file__).parents[1] / "documents" / "waves.json").read_text(encoding="utf-8")
)
LENGTHS = ("position", "first", "second", "radius", "thickness", "span")
"""Words in the names of sockets that are lengths, or places."""


def part(document: dict[str, Any], units_per_mm: float = 1.0, role: str = "object") -> ShaderPart:
    return wave_part(role, "+", msgspec.convert(document, WaveSpec), units_per_mm)


def other_numbers(value: Any) -> Any:
    """The same document with every number a little larger; a mesh stays."""
    if isinstance(value, dict):
        return (
            value
            if value.get("shape") == "mesh"
            else {name: other_numbers(item) for name, item in value.items()}
        )
    if isinstance(value, list):
        return [other_numbers(item) for item in value]
    return value * 1.01 + 0.003 if isinstance(value, int | float) else value


@pytest.mark.parametrize("name", DOCUMENTS)
def test_numbers_travel_in_sockets(name: str) -> None:
    """A slider, or a source that moves, compiles nothing."""
    first, other = part(DOCUMENTS[name]), part(other_numbers(DOCUMENTS[name]))
    assert (first.parameters, first.code) == (other.parameters, other.code)
    assert first.sockets != other.sockets
    assert first.sockets.keys() == other.sockets.keys()


@pytest.mark.parametrize("name", DOCUMENTS)
def test_every_socket_is_a_parameter_with_words(name: str) -> None:
    made = part(DOCUMENTS[name])
    declared = re.findall(
        r"(?:float|int|vector) (\w+) = [^\[]+"
        r'\[\[ string label = "[^"]+", string help = "[^"]+" \]\],',
        made.parameters,
    )
    assert sorted(declared) == sorted(made.sockets)
    assert all(socket.startswith("object_") for socket in declared)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_lengths_are_scaled_to_the_scene(name: str) -> None:
    millimetres, metres = part(DOCUMENTS[name]).sockets, part(DOCUMENTS[name], 0.001).sockets
    for socket, value in millimetres.items():
        is_length = any(word in socket for word in LENGTHS) and "line_direction" not in socket
        np.testing.assert_allclose(
            metres[socket], np.multiply(value, 0.001 if is_length else 1.0), rtol=1e-15
        )


@pytest.mark.parametrize("name", DOCUMENTS)
def test_the_two_roles_share_no_name(name: str) -> None:
    first, second = part(DOCUMENTS[name]), part(DOCUMENTS[name], role="reference")
    assert not first.sockets.keys() & second.sockets.keys()
    text = f"{second.parameters} {second.code}"
    assert "object" not in re.sub(r'"[^"]*"', "", text)


def test_a_mesh_is_a_table_in_the_text() -> None:
    document = copy.deepcopy(DOCUMENTS["mesh"])
    before = part(document).parameters
    assert "float object_corners_mm[36] = { -2, -1, 0, 2, -1, 0.5, " in before
    assert "float object_shares[4] = { " in before
    document["shape"]["vertices_mm"][0][0] = -3
    assert part(document).parameters != before


def test_sources_draw_independently() -> None:
    codes = [part(DOCUMENTS["disc"], role=role).code for role in ("object", "reference")]
    numbers = [re.findall(r"hoe_random\(\d+, \d+\)", code) for code in codes]
    assert [len(set(found)) for found in numbers] == [2, 2]
    assert not set(numbers[0]) & set(numbers[1])
