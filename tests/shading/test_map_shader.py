# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pattern that needs a map puts into the shader's text."""

import copy
import json
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.shading.hologram import (
    Frame,
    hologram_shader,
    hologram_sockets,
    one_order_shader,
    unit_efficiency_shader,
)
from hoe_addon.shading.map import coordinates_shader
from hoe_addon.shading.pattern import pattern_part

LENS = json.loads(
    (Path(__file__).parents[1] / "documents" / "lens.json").read_text(encoding="utf-8")
)
BEHIND: dict[str, Any] = {
    "kind": "system",
    "source": {"kind": "plane", "direction": [0, 0, 1]},
    "surfaces": [
        {
            "shape": "plane",
            "vertex_mm": [0, 0, -9],
            "semi_diameter_mm": 99,
            "medium": "N-BK7",
        }
    ],
}
PASSES = "#define HOE_EACH_UNRECORDED(X) X(0, HOE_TRANSMITTED, 1.0)"
REFLECTS = "#define HOE_UNRECORDED_REFLECTED 1"


def spec(*roles: str, folds: bool = False):
    document = copy.deepcopy(LENS)
    for role in roles:
        document["recording"][role] = BEHIND
    document["efficiency"]["total_internal_reflection"] = folds
    return hologram_from(document)


def test_one_wave_from_a_map_the_other_by_its_formula():
    part = pattern_part(spec("object").pattern, 1.0)
    assert [sign for sign, _ in part.map.terms] == [1]
    assert "gradient -= " in part.code and "gradient += " not in part.code
    part = pattern_part(spec("reference").pattern, 1.0)
    assert [sign for sign, _ in part.map.terms] == [-1]
    assert "gradient += " in part.code and "gradient -= " not in part.code


def test_two_waves_make_one_map():
    part = pattern_part(spec("object", "reference").pattern, 1.0)
    assert [sign for sign, _ in part.map.terms] == [1, -1]
    assert hologram_shader(spec("object", "reference")).text.count("vector map_gradient") == 1


def test_the_map_comes_by_links_and_not_by_numbers():
    text = hologram_shader(spec("object")).text
    assert "gradient += map_gradient;" in text
    assert (
        "if (map_recorded < 0.9999 || map_gradient == vector(1.0, 0.0, 1.0)) recorded = 0;" in text
    )
    assert not {"map_gradient", "map_recorded"} & set(hologram_sockets(spec("object"), Frame()))


@pytest.mark.parametrize("folds", [False, True])
def test_unrecorded_places_pass_light_in_order_0_alone(folds):
    mapped = spec("object", folds=folds)
    text = hologram_shader(mapped).text
    assert PASSES in text
    assert (REFLECTS in text) == folds
    for shader in (one_order_shader, unit_efficiency_shader):
        assert PASSES in shader(mapped, TRANSMITTED_ZERO).text
        assert PASSES not in shader(mapped, Branch(1)).text
        assert REFLECTS not in shader(mapped, Branch(1)).text
        assert (REFLECTS in shader(mapped, REFLECTED_ZERO).text) == folds


def test_nothing_of_this_is_in_a_text_without_a_map():
    text = hologram_shader(spec(folds=True)).text
    assert "map_gradient" not in text
    assert PASSES not in text and REFLECTS not in text


def test_the_place_is_found_on_the_true_surface():
    curved = copy.deepcopy(LENS)
    curved["surface"] = {"shape": "sphere", "size_mm": [4, 4], "radius_mm": 30}
    flat, round_ = (
        coordinates_shader(hologram_from(document).surface).text for document in (LENS, curved)
    )
    assert "float surface_curvature" in round_ and "float surface_curvature" not in flat
