# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""When a table is used, what of it stands in the text, and what is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.model.efficiency import ConstantSpec
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.shading.efficiency.form import efficiency_form
from hoe_addon.shading.hologram import Frame, hologram_shader, hologram_sockets, one_order_shader

WAYS = (Branch(0), Branch(1), Branch(1, reflected=True))
STOCHASTIC = {"form": "table", "choice": "stochastic"}


def spec(lookup: dict[str, Any] | None = None, **changes: Any) -> HologramSpec:
    efficiency = {"model": "constant", "table": {"T": {"0": 0.3, "1": 0.5}, "R": {"1": 0.1}}}
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.3, 0.1, 0.949]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": efficiency | {"lookup": lookup} | changes,
            "orders": [0, 1],
        }
    )


def table(counts: tuple[int, ...] = (3, 2, 1, 1, 1), **changes: Any) -> EfficiencyTable:
    """Two sides and three ways out; every number is its own place over 1000."""
    ends = ((400e-9, 700e-9), (-0.9, 0.9), (-0.5, 0.5), (-0.01, 0.01), (-0.02, 0.02))
    axes = [np.linspace(*pair, count) for pair, count in zip(ends, counts, strict=True)]
    shape = (2, *counts, len(WAYS))
    values = np.arange(np.prod(shape)).reshape(shape) / 1000.0
    made = EfficiencyTable(WAYS, *axes, ("back", "front"), values)
    return replace(made, **changes)


def head(text: str) -> str:
    return text.split("// SPDX")[0]


def test_lookup_says_when_a_table_is_used(monkeypatch: pytest.MonkeyPatch) -> None:
    forms = ("auto", "formula", "table")
    assert [spec({"form": form}).efficiency.uses_table for form in forms] == [False, False, True]
    assert not spec().efficiency.uses_table
    monkeypatch.setattr(ConstantSpec, "has_formula", False)
    assert spec().efficiency.uses_table
    assert spec({"choice": "stochastic"}).efficiency.uses_table
    with pytest.raises(SpecError, match=r"efficiency\.lookup\.form: must be auto or table"):
        spec({"form": "formula"})


def test_formula_needs_no_table() -> None:
    assert hologram_shader(spec()).text == hologram_shader(spec({"choice": "stochastic"})).text
    assert "table_shares" not in head(hologram_shader(spec()).text)
    with pytest.raises(ValueError, match="needs its table"):
        hologram_shader(spec({"form": "table"}))


def test_collapsed_axes_are_not_in_the_text() -> None:
    text = head(hologram_shader(spec({"form": "table"}), None, table()).text)
    assert "float table_wavelength_nodes[3] = { 400, 550, 700 };" in text
    assert "float table_along_nodes[2] = { -0.9, 0.9 };" in text
    for name in ("across", "x", "y"):
        assert f"table_{name}_nodes" not in text
    assert "table_weights[4]" in text
    assert "mm_per_unit" not in text
    flat = head(hologram_shader(spec({"form": "table"}), None, table((1, 1, 1, 1, 1))).text)
    assert "_nodes" not in flat
    assert "table_weights[1]" in flat


def test_orders_stand_side_by_side_in_the_order_of_the_shader() -> None:
    wider = table((1, 1, 1, 1, 1))
    shuffled = replace(wider, branches=WAYS[::-1], values=wider.values[..., ::-1])
    texts = {
        hologram_shader(spec({"form": "table"}), None, made).text for made in (wider, shuffled)
    }
    assert len(texts) == 1
    assert "{ 0, 0.001, 0.002, 0.003, 0.004, 0.005 }" in head(texts.pop())


def test_place_has_a_scale_and_is_always_clamped() -> None:
    by_place = table((1, 1, 1, 3, 2), beyond="zero")
    text = head(hologram_shader(spec({"form": "table"}), None, by_place).text)
    assert "float table_x_nodes[3] = { -10, 0, 10 };" in text
    assert "hoe_table_holds" not in text
    sockets = hologram_sockets(spec({"form": "table"}), Frame(), 0.5, None, by_place)
    assert sockets["mm_per_unit"] == 2.0
    assert not any(name.startswith("efficiency_") for name in sockets)
    angular = head(hologram_shader(spec({"form": "table"}), None, table(beyond="zero")).text)
    assert angular.count("hoe_table_holds") == 2


def test_one_way_out_is_drawn_but_not_along_the_light() -> None:
    stochastic = spec(STOCHASTIC)
    text = head(hologram_shader(stochastic, None, table()).text)
    assert "#define HOE_EACH_ORDER(X) X(table_steps, table_side, table_weight)\n" in text
    along = head(one_order_shader(stochastic, Branch(1), table()).text)
    assert "HOE_FORWARD" in along
    assert "table_weight)" not in along


def test_way_out_that_the_table_lacks_gets_nothing() -> None:
    other = one_order_shader(spec({"form": "table"}), Branch(-2), table())
    assert "#define HOE_EACH_ORDER(X) \n" in head(other.text)


def test_share_of_order_0_is_folded() -> None:
    folding = spec(STOCHASTIC, total_internal_reflection=True)
    text = head(hologram_shader(folding, None, table()).text)
    assert "HOE_ZERO_ORDER_TRANSMITTED (table_way == 0 ? table_weight : 0.0)" in text


def test_too_large_a_table_is_refused_in_one_line() -> None:
    values = np.zeros((2, 110, 100, 1, 1, 1, 3))
    axes = (np.linspace(4e-7, 7e-7, 110), np.linspace(-0.9, 0.9, 100))
    one = np.zeros(1)
    large = EfficiencyTable(WAYS, *axes, one, one, one, ("back", "front"), values)
    with pytest.raises(SpecError, match="efficiency: its table has 66000 numbers") as caught:
        hologram_shader(spec({"form": "table"}), None, large)
    assert "\n" not in str(caught.value)


def test_haze_is_compiled_in_only_where_there_is_one() -> None:
    assert "HOE_HAZE" not in head(hologram_shader(spec()).text)
    hazy = spec(haze={"share": 0.2, "width_deg": 3.0})
    text = head(hologram_shader(hazy).text)
    assert "#define HOE_HAZE_SHARE(side) haze_share\n" in text
    other = spec(haze={"share": 0.3, "width_deg": 5.0})
    assert hologram_shader(hazy).text == hologram_shader(other).text
    sockets = hologram_sockets(hazy, Frame())
    assert sockets["haze_share"] == 0.2
    assert sockets["haze_sine"] == pytest.approx(np.sin(np.radians(3.0)))
    rough = spec(haze={"roughness_nm": 12.0, "width_deg": 3.0})
    assert hologram_sockets(rough, Frame())["haze_roughness_nm"] == 12.0
    assert "hoe_rough_share(haze_roughness_nm" in head(hologram_shader(rough).text)
    assert "HOE_HAZE" not in head(one_order_shader(hazy, Branch(1)).text)


def test_form_is_stated_with_error_and_cost() -> None:
    form, error, cost, worst = efficiency_form(spec())
    assert (form, error, worst) == ("formula", 1e-7, 1e-7)
    assert cost
    form, error, cost, _worst = efficiency_form(spec({"form": "table"}))
    assert (form, error) == ("table, bilinear", pytest.approx(0.0, abs=1e-7))
    assert cost == "6 numbers in the shader; at each hit 1 of them for every order"
    form, _error, cost, _worst = efficiency_form(spec(STOCHASTIC))
    assert form == "table, stochastic"
    assert "at each hit 1 random numbers, one node and one order" in cost
