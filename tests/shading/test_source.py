# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader text: flat, the same for the same arguments, and exact in its numbers."""

import re

import numpy as np
import pytest

from hoe_addon.resources import OSL_DIR
from hoe_addon.shading.probe import direction_world_shader, position_shader, ray_camera_shader
from hoe_addon.shading.source import ShaderSource, array, specialised
from hoe_addon.shading.wavelength import display_shader, filter_shader, wavelength_shader

SHADERS = sorted(path.stem for path in OSL_DIR.glob("*.osl"))
HEADERS = sorted(OSL_DIR.glob("*.h"))

INCLUDE = re.compile(r'^\s*#\s*include "', re.MULTILINE)
LICENCE = "// SPDX-License-Identifier: GPL-3.0-or-later"


def numbers_of(initialiser: str) -> list[float]:
    assert initialiser.startswith("{ ")
    assert initialiser.endswith(" }")
    return [float(part) for part in initialiser[2:-2].split(", ")]


def every_float32(rng: np.random.Generator, count: int) -> np.ndarray:
    """Finite numbers of all exponents and signs, by random bits."""
    numbers = rng.integers(0, 2**32, size=count, dtype=np.uint32).view(np.float32)
    return numbers[np.isfinite(numbers)]


@pytest.mark.parametrize("name", SHADERS)
def test_a_text_is_flat_and_says_what_it_is(name: str) -> None:
    source = specialised(name, {"HOE_NOTHING": "1"})
    head = source.text.splitlines()
    assert head[0] == f"// Made from {name}.osl by hoe_addon."
    assert head[1] == "#define HOE_NOTHING 1"
    assert LICENCE in head
    assert not INCLUDE.search(source.text)
    assert "\r" not in source.text
    assert source.text.endswith("}\n")


@pytest.mark.parametrize("name", SHADERS)
def test_no_header_is_pasted_twice(name: str) -> None:
    text = specialised(name, {}).text
    for header in HEADERS:
        guard = f"#define {header.stem.upper()}_H\n"
        assert guard in header.read_text(encoding="utf-8")
        assert text.count(guard) <= 1


def test_same_arguments_give_the_same_bytes() -> None:
    first, second = (specialised("hoe_thin_lens", {"A": "1", "B": "2"}) for _ in range(2))
    assert first == second
    assert first.text.encode() == second.text.encode()
    assert first.digest == second.digest


def test_other_definitions_give_another_digest() -> None:
    texts = [specialised("hoe_thin_lens", given) for given in ({}, {"A": "1"}, {"A": "2"})]
    assert len({source.digest for source in texts}) == len(texts)


def test_digest_is_short_and_hexadecimal() -> None:
    assert re.fullmatch("[0-9a-f]{16}", ShaderSource("name", "text").digest)


def test_a_shader_that_is_not_shipped_is_our_own_mistake() -> None:
    with pytest.raises(FileNotFoundError, match=r"hoe_nothing\.osl"):
        specialised("hoe_nothing", {})


def test_float32_numbers_come_back_to_the_last_bit(rng: np.random.Generator) -> None:
    numbers = every_float32(rng, 20_000)
    back = np.array(numbers_of(array(numbers)), dtype=np.float64).astype(np.float32)
    np.testing.assert_array_equal(back.view(np.uint32), numbers.view(np.uint32))


def test_numbers_at_the_ends_of_float32_come_back() -> None:
    ends = np.array([0.0, -0.0, 1e-45, 1.17549435e-38, 3.4028235e38, 1.0000001], dtype=np.float32)
    back = np.array(numbers_of(array(ends))).astype(np.float32)
    np.testing.assert_array_equal(back.view(np.uint32), ends.view(np.uint32))


def test_tables_stand_in_the_text_as_they_were_given() -> None:
    nodes_nm = np.linspace(400.0, 700.0, 7)
    text = wavelength_shader(nodes_nm).text
    assert "#define HOE_NODES 7\n" in text
    assert f"#define HOE_WAVELENGTH_NODES {array(nodes_nm)}\n" in text


def test_channels_of_filter_and_display_keep_their_order() -> None:
    """The filter's table has one row a node, the display's one row a primary."""
    response = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])
    text = filter_shader(response).text
    for name, values in (("RED", [1, 4]), ("GREEN", [2, 5]), ("BLUE", [3, 6])):
        assert f"#define HOE_RESPONSE_{name} {array(values)}\n" in text
    emission = np.arange(12.0).reshape(3, 4)
    text = display_shader(emission).text
    assert "#define HOE_NODES 4\n" in text
    for name, values in zip(("RED", "GREEN", "BLUE"), emission, strict=True):
        assert f"#define HOE_EMISSION_{name} {array(values)}\n" in text


def test_ray_camera_holds_start_and_direction_of_each_ray() -> None:
    text = ray_camera_shader(np.array([[1.0, 2, 3], [4, 5, 6]]), np.eye(3)[:2]).text
    assert "#define HOE_RAYS 2\n" in text
    assert "#define HOE_RAY_NUMBERS 12\n" in text
    assert f"#define HOE_RAY_TABLE {array([1, 2, 3, 1, 0, 0, 4, 5, 6, 0, 1, 0])}\n" in text


def test_probes_without_numbers_are_the_shipped_texts() -> None:
    assert direction_world_shader() == specialised("hoe_probe_direction", {})
    assert position_shader() == specialised("hoe_probe_position", {})
