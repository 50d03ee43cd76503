# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader text of characteristic functions: what it depends on, and what never gets into it."""

import re
from typing import Any

import pytest

from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.shading.hologram import Frame, hologram_shader, hologram_sockets

PAIRS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "linear": ({"lines_per_mm": 500}, {"lines_per_mm": 700, "azimuth_deg": 3}),
    "radial": ({"lines_per_mm": 500}, {"lines_per_mm": 700}),
    "even_radial": (
        {"coefficients": [1, 2]},
        {"coefficients": [3, -4], "normalization_mm": 3, "unit": "mm"},
    ),
    "polynomial": (
        {"terms": [{"x": 1, "y": 2, "coefficient": 3}, {"x": 0, "y": 1, "coefficient": 1}]},
        {"terms": [{"x": 0, "y": 1, "coefficient": 7}, {"x": 1, "y": 2, "coefficient": 5}]},
    ),
    "zernike": (
        {"index": "noll", "coefficients": {"4": 1, "7": 2}, "normalization_mm": 9, "unit": "mm"},
        {"index": "noll", "coefficients": {"7": 5, "4": 3}, "normalization_mm": 8, "unit": "waves"},
    ),
    "formula": (
        {"formula": "2*sin(x)+r^3", "unit": "mm"},
        {"formula": " 2.0*sin( x )+ r**3", "unit": "waves"},
    ),
}


def hologram(kind: str, **fields: Any) -> HologramSpec:
    return hologram_from(
        {
            "schema": 1,
            "name": "pattern",
            "surface": {"shape": "plane", "size_mm": [9, 9]},
            "media": {},
            "characteristic": {"kind": kind, "wavelength_nm": 532, **fields},
            "efficiency": {"model": "constant", "table": {"T": {"1": 0.3}}},
        }
    )


@pytest.mark.parametrize("kind", PAIRS)
def test_numbers_do_not_change_the_text(kind: str) -> None:
    first, second = (hologram(kind, **fields) for fields in PAIRS[kind])
    assert hologram_shader(first).text == hologram_shader(second).text
    assert hologram_sockets(first, Frame()) != hologram_sockets(second, Frame())


@pytest.mark.parametrize("kind", PAIRS)
def test_every_socket_is_a_declared_parameter(kind: str) -> None:
    spec = hologram(kind, **PAIRS[kind][0])
    text = hologram_shader(spec).text
    for name in hologram_sockets(spec, Frame()):
        assert re.search(rf"(float|vector|int) {name} =", text), name


def test_the_structure_of_a_sum_does_change_it() -> None:
    texts = {
        hologram_shader(hologram("even_radial", coefficients=[1.0] * count)).text
        for count in (1, 2, 3)
    }
    assert len(texts) == 3


def test_names_and_signs_of_a_formula_never_reach_the_text() -> None:
    constants = {"emission": 1.5, "system": 2.5, "ray_portal_bsdf_": 3.5, "hoe_secret": 4.5}
    formula = "emission*x + system*y + ray_portal_bsdf_*sin(x) + hoe_secret*phi"
    spec = hologram("formula", formula=formula, unit="mm", constants=constants)
    text = hologram_shader(spec).text
    assert "system" not in text
    assert "hoe_secret" not in text
    assert "ray_portal_bsdf_*" not in text
    assert "ray_portal_bsdf_ " not in text
    body = text[text.index("int hoe_formula(") :].split("\n}\n")[0]
    ours = r"[xyr]|along_[xy]|radial|turning|t[0-9]+|ok|hoe_[a-z0-9]+"
    allowed = rf"({ours}|float|int|output|if|return|isfinite|abs|sqrt)"
    words = set(re.findall(r"[A-Za-z_][A-Za-z_0-9]*", body))
    assert {word for word in words if not re.fullmatch(allowed, word)} == set()


def test_scene_units_scale_lengths_and_leave_angles() -> None:
    for kind in ("even_radial", "polynomial", "zernike"):
        spec = hologram(kind, **PAIRS[kind][0])
        one, ten = (hologram_sockets(spec, Frame(), units) for units in (1.0, 10.0))
        assert one["inverse_normalization"] == pytest.approx(10.0 * ten["inverse_normalization"])
        del one["inverse_normalization"], ten["inverse_normalization"]
        assert one == ten
    spec = hologram("formula", **PAIRS["formula"][0])
    assert hologram_sockets(spec, Frame(), 10.0)["formula_mm"] == pytest.approx(0.1)
