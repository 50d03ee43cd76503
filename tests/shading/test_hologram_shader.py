# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a hologram's document is compiled in, and what travels in sockets."""

import copy
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.shading.hologram import (
    Frame,
    hologram_shader,
    hologram_sockets,
    one_order_shader,
    unit_efficiency_shader,
)

LENS = Path(__file__).parents[1] / "documents" / "lens.json"

PLANE = {"kind": "plane", "direction": [0.3, -0.4, 1.2], "index": 1.5}
POINT = {"kind": "point", "position_mm": [10, 5, -100], "beam": "diverging", "index": 1.0}
KINOFORM = {"model": "kinoform", "levels": 8, "design_wavelength_nm": 532, "relief": 1.5}
CONSTANT = {"model": "constant", "table": {"T": {"0": 0.6, "1": 0.3}, "R": {"1": 0.05}}}

UNIT_LENGTH = 1e-15
"""Of a direction that is divided by its length in float64: a few roundings."""


def spec_with(**changes: Any) -> HologramSpec:
    """The README's hologram with other parts; `object` and `reference` are waves."""
    document = json.loads(LENS.read_text(encoding="utf-8"))
    for role in ("object", "reference", "wavelength_nm"):
        if role in changes:
            document["recording"][role] = copy.deepcopy(changes.pop(role))
    return hologram_from(document | copy.deepcopy(changes))


def text_of(**changes: Any) -> str:
    return hologram_shader(spec_with(**changes)).text


def defined(text: str) -> set[str]:
    """Macros that stand before the first line of the shipped file."""
    return set(re.findall(r"^#define (HOE_\w+)", text.split("// SPDX")[0], re.MULTILINE))


def test_same_document_gives_the_same_bytes() -> None:
    assert text_of().encode() == text_of().encode()


@pytest.mark.parametrize(
    "numbers",
    [
        {"object": POINT | {"position_mm": [-3.25, 1e-3, 77]}},
        {"object": POINT | {"beam": "converging", "index": 1.33}},
        {"reference": PLANE},
        {"wavelength_nm": 633.0},
        {"media": {"back": "N-BK7", "front": 1.0}},
        {"surface": {"shape": "plane", "size_mm": [1, 2]}},
        {"efficiency": KINOFORM | {"levels": 0, "design_wavelength_nm": 450, "relief": "PMMA"}},
        {"name": "another"},
    ],
    ids=lambda numbers: next(iter(numbers)),
)
def test_numbers_do_not_change_the_text(numbers: dict[str, Any]) -> None:
    """They travel in sockets, so that a slider compiles nothing."""
    assert text_of(**numbers) == text_of()


def test_shares_do_not_change_the_text() -> None:
    other = {"model": "constant", "table": {"T": {"0": 0.1, "1": 0.2}, "R": {"1": 0.0}}}
    assert text_of(efficiency=CONSTANT) == text_of(efficiency=other)


def test_kinds_and_orders_change_the_text() -> None:
    more = {"model": "constant", "table": {"T": {"0": 0.6, "1": 0.3}, "R": {"0": 0.05}}}
    texts = [
        text_of(),
        text_of(object=PLANE),
        text_of(reference=POINT),
        text_of(object=PLANE, reference=POINT),
        text_of(orders=[0, 1]),
        text_of(efficiency=KINOFORM | {"total_internal_reflection": True}),
        text_of(efficiency=CONSTANT),
        text_of(efficiency=CONSTANT | {"total_internal_reflection": True}),
        text_of(efficiency=more),
    ]
    assert len(set(texts)) == len(texts)


def test_total_internal_reflection_without_order_0_changes_nothing() -> None:
    """There is no share to be reflected."""
    folding = KINOFORM | {"total_internal_reflection": True}
    assert text_of(efficiency=folding, orders=[-1, 1]) == text_of(orders=[-1, 1])


@pytest.mark.parametrize(
    ("changes", "macros"),
    [
        ({}, set()),
        (
            {"object": PLANE, "efficiency": KINOFORM | {"total_internal_reflection": True}},
            {"HOE_TOTAL_INTERNAL_REFLECTION", "HOE_ZERO_ORDER_TRANSMITTED"},
        ),
    ],
    ids=["plain", "folding"],
)
def test_definitions_say_what_is_called_for(changes: dict[str, Any], macros: set[str]) -> None:
    always = {
        "HOE_PATTERN_PARAMETERS",
        "HOE_FIND_GRADIENT",
        "HOE_SURFACE_PARAMETERS",
        "HOE_FIND_NORMAL",
        "HOE_EFFICIENCY_PARAMETERS",
        "HOE_PREPARE_EFFICIENCY",
        "HOE_EACH_ORDER",
    }
    assert defined(text_of(**changes)) == macros | always


def test_every_order_has_its_line() -> None:
    head = text_of(efficiency=CONSTANT, orders=[0, 1]).split("// SPDX")[0]
    orders = re.findall(r"X\((-?\d+), (HOE_\w+), (\w+)\)", head)
    assert orders == [
        ("0", "HOE_TRANSMITTED", "efficiency_t_p0"),
        ("1", "HOE_TRANSMITTED", "efficiency_t_p1"),
        ("1", "HOE_REFLECTED", "efficiency_r_p1"),
    ]


def test_text_is_flat_and_licensed() -> None:
    text = text_of()
    assert '#include "hoe_' not in text
    assert "// SPDX-License-Identifier: GPL-3.0-or-later" in text


def test_one_order_of_many() -> None:
    """The probe's shader has one way out, even one that the document does not trace."""
    spec = spec_with(efficiency=KINOFORM)
    for order in (1, 7):
        head = one_order_shader(spec, Branch(order)).text.split("// SPDX")[0]
        assert re.findall(r"X\((-?\d+), HOE_\w+", head) == [str(order)]
    full = unit_efficiency_shader(spec, Branch(-2, reflected=True)).text
    assert "#define HOE_EACH_ORDER(X) X(-2, HOE_REFLECTED, 1.0)\n" in full


def test_plane_directions_have_unit_length(rng: np.random.Generator) -> None:
    for direction in rng.normal(size=(20, 3)) * 10.0 ** rng.uniform(-6, 6, size=(20, 1)):
        spec = spec_with(reference={"kind": "plane", "direction": direction.tolist(), "index": 1})
        sockets = hologram_sockets(spec, Frame())
        found = np.array(sockets["reference_direction"])
        assert np.linalg.norm(found) == pytest.approx(1.0, abs=UNIT_LENGTH)
        np.testing.assert_allclose(found, direction / np.linalg.norm(direction), atol=UNIT_LENGTH)
        assert "reference_converging" not in sockets


def test_points_are_scaled_and_say_where_their_light_goes() -> None:
    sockets = hologram_sockets(spec_with(), Frame(), units_per_mm=0.5)
    assert sockets["object_position"] == (5.0, 2.5, -50.0)
    assert sockets["object_converging"] == 0
    converging = spec_with(object=POINT | {"beam": "converging"})
    assert hologram_sockets(converging, Frame())["object_converging"] == 1


def test_sockets_hold_the_numbers_of_the_document() -> None:
    frame = Frame((1.0, 2.0, 3.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    sockets = hologram_sockets(spec_with(), frame)
    assert sockets["frame_origin"] == frame.origin
    assert (sockets["frame_x"], sockets["frame_y"]) == (frame.x, frame.y)
    assert sockets["recording_wavelength_nm"] == 532.0
    assert sockets["levels"] == 8.0
    assert sockets["design_wavelength_nm"] == 532.0
    assert sockets["relief_a"] == pytest.approx(2.25)
    assert sockets["back_a"] == 1.0
    shares = hologram_sockets(spec_with(efficiency=CONSTANT, orders=[0, 1]), frame)
    assert shares["efficiency_t_p0"] == 0.6
    assert shares["efficiency_r_p1"] == 0.05


@pytest.mark.parametrize("normalization_mm", [1e-3, 1e-2, 20.0, 30.0])
def test_powers_of_the_radius_fit_float32_whatever_the_normalization(
    normalization_mm: float,
) -> None:
    """They are scaled to the element's reach, so the same V gives the same sockets."""

    def sockets(length_mm: float) -> dict[str, Any]:
        grows = length_mm / 20.0
        coefficients = [5000 * grows**2, 0, 0, 0, 0, 0, 0, 20000 * grows**16]
        kind = {"kind": "even_radial", "wavelength_nm": 532, "coefficients": coefficients}
        document = json.loads(LENS.read_text(encoding="utf-8"))
        del document["recording"]
        document["characteristic"] = kind | {"normalization_mm": length_mm}
        return hologram_sockets(hologram_from(document), Frame())

    found, expected = sockets(normalization_mm), sockets(20.0)
    for name in ("inverse_normalization", "radial_2", "radial_16"):
        assert found[name] == pytest.approx(expected[name], rel=1e-9)
        assert 1e-30 < abs(np.float32(found[name])) < 1e30
