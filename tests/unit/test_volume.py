# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms of documents: fields, rules, branches, and how waves share the light."""

import copy
from typing import Any

import jsonschema
import numpy as np
import pytest

from hoe_addon.core.efficiency.sharing import Taken, share_out
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.model.efficiency import KogelnikSpec
from hoe_addon.model.evaluate import efficiencies
from hoe_addon.model.schema import hologram_schema

EXACT = 1e-12
PLANES = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0, 0, -1], "index": 1.5},
    "reference": {"kind": "plane", "direction": [0, 0, 1], "index": 1.5},
}
SYSTEM = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [2, 1, -110], "medium": "air"},
    "surfaces": [
        {
            "shape": "sphere",
            "vertex_mm": [0, 0, -60],
            "radius_mm": 50,
            "semi_diameter_mm": 12,
            "medium": "N-BK7",
        },
        {
            "shape": "plane",
            "vertex_mm": [0, 0, -55],
            "semi_diameter_mm": 12,
            "medium": 1.0,
        },
    ],
}
LINES = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 1000}
EFFICIENCY = {"model": "kogelnik", "thickness_um": 8, "index": 1.5, "modulation": 0.03}
THREE = [{"wavelength_nm": 633, "modulation": 0.02}, {"wavelength_nm": 450, "modulation": 0.01}]


def document(changes: dict[str, Any], pattern: dict[str, Any] | None = None) -> dict[str, Any]:
    return {
        "schema": 1,
        "name": "volume",
        "surface": {"shape": "plane", "size_mm": [20, 10]},
        "media": {"back": 1.5, "front": 1.5},
        **copy.deepcopy(pattern or {"recording": PLANES}),
        "efficiency": {**EFFICIENCY, **changes},
    }


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"thickness_um": 0}, "thickness_um: must be above 0, got 0"),
        ({"thickness_um": "9"}, "thickness_um"),
        ({"thickness_um": {"formula": "x"}}, "thickness_um: must be above 0 all over the surface"),
        ({"thickness_um": {"formula": "9 +"}}, "thickness_um.formula: "),
        ({"thickness_um": {"formula": "1/x"}}, "thickness_um: must have a smooth value"),
        ({"modulation": -0.01}, "modulation: must be at least 0, got -0.01"),
        ({"modulation": 1.5}, "modulation: must be at most 1, got 1.5"),
        ({"modulation": 0.5}, "modulation: must be below index - 1 = 0.5, of all exposures in sum"),
        ({"modulation": 0.48, "exposures": THREE}, "modulation: must be below index - 1 = 0.5"),
        ({"modulation": {"formula": "0.4 + 0.02*x"}}, "modulation: must be below index - 1 = 0.5"),
        ({"modulation": {"formula": "1/x"}}, "modulation: must have a smooth value"),
        ({"modulation": {"formula": "0.01*y"}}, "modulation: must be at least 0 all over"),
        ({"index": 0.9}, "index: must be at least 1, got 0.9"),
        ({"index_shift": -0.5, "index": 1.2}, "index_shift: must leave an index of at least 1"),
        ({"shrinkage": 1}, "shrinkage: must be at most 0.5, got 1"),
        ({"absorption_per_mm": -1}, "absorption_per_mm: must be at least 0, got -1"),
        ({"absorption_modulation_per_mm": 1}, "absorption_modulation_per_mm: must be at most abs"),
        ({"normal_period_um": 1}, "normal_period_um: must be left out beside recording"),
        ({"normal_period_um": 0}, "normal_period_um: must be at least 0.01 in size, got 0"),
        ({"exposures": [THREE[0], THREE[0]]}, "exposures[1].wavelength_nm: must be another"),
        ({"exposures": [{"wavelength_nm": 532, "modulation": 0.01}]}, "exposures[0].wavelength_nm"),
        ({"exposures": [{"wavelength_nm": 5, "modulation": 0.01}]}, "exposures[0].wavelength_nm"),
        ({"exposures": [{"wavelength_nm": 600, "modulation": -1}]}, "exposures[0].modulation"),
        ({"exposures": THREE * 4}, "exposures: must have from 0 to 7 items, got 8"),
        ({"thicknes": 3}, "thicknes"),
    ],
)
def test_bad_fields_are_named(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError) as caught:
        hologram_from(document(changes))
    assert str(caught.value).startswith(f"efficiency.{message}")
    assert "\n" not in str(caught.value)


def test_exposures_need_waves() -> None:
    with pytest.raises(SpecError, match=r"efficiency\.exposures: must be left out beside char"):
        hologram_from(document({"exposures": THREE}, {"characteristic": LINES}))


def test_two_waves_of_one_map_cannot_be_told_apart() -> None:
    one = document({}, {"recording": {**PLANES, "object": SYSTEM}})
    assert isinstance(hologram_from(one).efficiency, KogelnikSpec)
    with pytest.raises(SpecError, match=r"efficiency\.model: must not be kogelnik where both"):
        hologram_from(
            document({}, {"recording": {**PLANES, "object": SYSTEM, "reference": SYSTEM}})
        )


def test_orders_may_be_left_out_and_each_exposure_has_its_branches() -> None:
    spec = hologram_from(document({"exposures": THREE}))
    assert spec.orders == (-1, 0, 1)
    assert isinstance(spec.efficiency, KogelnikSpec)
    found = spec.efficiency.branches((2, 0, 1), 532.0)
    assert found == (
        Branch(0),
        *(
            Branch(1, reflected=side, frequency=frequency)
            for frequency in (1.0, 532.0 / 633.0, 532.0 / 450.0)
            for side in (False, True)
        ),
    )


def test_a_document_is_written_as_it_was_read_and_keeps_to_the_schema() -> None:
    changes = {
        "thickness_um": {"formula": "8 + 0.1*x"},
        "shrinkage": 0.02,
        "index_shift": -0.01,
        "absorption_per_mm": 3.0,
        "absorption_modulation_per_mm": 1.0,
        "exposures": [*THREE, {"wavelength_nm": 600, "modulation": {"formula": "0.01 + 0.001*y"}}],
    }
    made = document(changes)
    jsonschema.validate(made, hologram_schema())
    spec = hologram_from(made)
    assert hologram_from(to_document(spec)) == spec
    for broken in ({"index": 0.9}, {"index": "sand"}, {"thickness_um": [8]}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(document(broken), hologram_schema())


def test_other_orders_get_exactly_nothing() -> None:
    spec = hologram_from(document({"exposures": THREE}))
    found = efficiencies(spec, [0.0, 0.0, 1.0], 532.0, (-3, -2, 2, 3))
    assert (found == 0.0).all()


@pytest.mark.parametrize("count", [1, 2, 3, 8])
def test_sharing_keeps_the_energy(count: int, rng: np.random.Generator) -> None:
    waves = rng.uniform(size=(count, 2, 500)) ** 3
    alone = [[Taken(wave, 1.0 - wave) for wave in pair] for pair in waves]
    zero, given = share_out(alone, np.ones(500))
    np.testing.assert_allclose(zero + np.sum(given, axis=(0, 1)), 1.0, rtol=0.0, atol=EXACT)
    assert np.min(given) >= 0.0
    assert zero.min() >= 0.0


def test_a_wave_that_is_alone_has_its_own_efficiency(rng: np.random.Generator) -> None:
    strong, weak = rng.uniform(size=500), rng.uniform(0.0, 0.5, size=500)
    weak = weak * strong
    for swap in (False, True):
        pair = [Taken(strong, 1.0 - strong), Taken(weak, 1.0 - weak)]
        zero, ((first, second),) = share_out([pair[::-1] if swap else pair], np.ones(500))
        kept, rest = (second, first) if swap else (first, second)
        np.testing.assert_array_equal(kept, strong)
        np.testing.assert_allclose(rest, weak * (1.0 - strong), rtol=1e-9, atol=1e-16)
        np.testing.assert_allclose(zero, (1.0 - strong) * (1.0 - weak), rtol=1e-9, atol=1e-16)


def test_sharing_does_not_jump_where_both_orders_are_alike() -> None:
    wave = np.linspace(0.3, 0.5, 2001)
    still = np.full_like(wave, 0.4)
    _, ((first, second),) = share_out(
        [[Taken(wave, 1.0 - wave), Taken(still, 1.0 - still)]], np.ones_like(wave)
    )
    assert first[1000] == pytest.approx(second[1000], abs=EXACT)
    assert np.abs(np.diff(first)).max() < 2e-4


def test_absorbing_layers_never_give_more_than_there_is(rng: np.random.Generator) -> None:
    """A grating of pure absorption lets more through on Bragg than the bare layer."""
    spec = hologram_from(
        document(
            {
                "modulation": 0.0,
                "absorption_per_mm": 300.0,
                "absorption_modulation_per_mm": 300.0,
            },
            {"characteristic": LINES},
        )
    )
    angle = np.arcsin(0.532 / (2.0 * 1.5))
    on = efficiencies(spec, [-np.sin(angle), 0.0, np.cos(angle)], 532.0, (-1, 0, 1))
    off = efficiencies(spec, [0.3, 0.0, np.sqrt(0.91)], 532.0, (-1, 0, 1))
    assert on[1, 0] > np.exp(-2.0 * 300.0 * 8e-3 / np.cos(angle)) * 1.5
    assert off[1, 0] == pytest.approx(np.exp(-2.0 * 300.0 * 8e-3 / np.sqrt(0.91)), rel=0.05)
    tangent = rng.uniform(-0.6, 0.6, (500, 2))
    normal = np.sqrt(1.0 - np.sum(tangent**2, axis=1))
    found = efficiencies(spec, np.column_stack((tangent, normal)), 532.0, (-1, 0, 1))
    assert (found.sum(axis=(1, 2)) <= 1.0).all()


@pytest.mark.filterwarnings("error")
def test_light_that_does_not_enter_the_emulsion_gets_nothing(rng: np.random.Generator) -> None:
    made = document({"index": 1.3}, {"characteristic": LINES})
    spec = hologram_from(made)
    angle = rng.uniform(0.0, 0.5 * np.pi, 300)
    direction = np.column_stack((np.sin(angle), np.zeros(300), np.cos(angle)))
    found = efficiencies(spec, direction, 532.0, (-1, 0, 1))
    assert np.isfinite(found).all()
    outside = 1.5 * np.sin(angle) >= 1.3
    assert outside.any()
    assert (found[outside] == 0.0).all()
    np.testing.assert_allclose(found[~outside].sum(axis=(1, 2)), 1.0, atol=EXACT)


@pytest.mark.filterwarnings("error")
def test_a_recording_wave_that_does_not_enter_records_nothing() -> None:
    steep = {"kind": "plane", "direction": [2, 0, 1], "index": 1.5}
    spec = hologram_from(document({"index": 1.3}, {"recording": {**PLANES, "object": steep}}))
    found = efficiencies(spec, [0.1, 0.0, np.sqrt(0.99)], 532.0, (-1, 0, 1))
    np.testing.assert_allclose(found, [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]], atol=EXACT)
    assert found[0, 0] == found[2, 0] == 0.0
