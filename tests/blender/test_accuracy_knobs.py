# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `accuracy` turns on a device: every variant is a valid document that differs as it says."""

import pytest

from hoe_addon.blender.accuracy.knobs import KNOBS, Variant, reference_spec, variants
from hoe_addon.blender.accuracy.orders import holograms_of, weakest_orders, without_orders
from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.efficiency import ConstantSpec
from hoe_addon.resources import preset_paths


def found_in(name: str, *changes: str) -> dict[str, list[Variant]]:
    by_knob: dict[str, list[Variant]] = {}
    for variant in variants(load_device(name, changes))[0]:
        by_knob.setdefault(variant.knob, []).append(variant)
    return by_knob


@pytest.mark.parametrize("name", ["two_hologram_ar", "grating_rainbow", "point_lens"])
def test_every_variant_is_a_document_of_its_own(name: str) -> None:
    found, missing = variants(load_device(name))
    assert found[0] == Variant("samples", "as it is", load_device(name))
    for variant in found:
        assert device_from(to_document(variant.spec)) == variant.spec
    texts = [(str(to_document(each.spec)), each.denoised) for each in found]
    assert len(set(texts)) == len(texts)
    # Each knob either has a result to come or a reason why not.
    assert {knob.name for knob in KNOBS} <= {each.knob for each in [*found, *missing]}
    assert all(each.why for each in missing)


def test_published_algorithm() -> None:
    published = next(
        v for v in found_in("two_hologram_ar")["combination"] if v.value == "published"
    )
    render = published.spec.render
    assert (render.wavelengths, render.order_selection) == ("uniform", "significance")
    assert render.effects == ("all",)


def test_reference_has_everything_on() -> None:
    spec = load_device(
        "two_hologram_ar", ["render.wavelengths=lines", "render.mode=preview", "render.effects=[]"]
    )
    render = reference_spec(spec).render
    assert (render.mode, render.wavelengths, render.effects) == ("spectral", "spectrum", ("all",))


def test_orders_go_from_the_weakest_on() -> None:
    spec = load_device("grating_rainbow")
    shares = [each.share for each in weakest_orders(spec)]
    assert shares == sorted(shares)
    assert shares == pytest.approx([0.07, 0.07, 0.2, 0.2])
    fewest = found_in("grating_rainbow")["orders kept"][-1].spec
    assert [hologram.orders for _, hologram in holograms_of(fewest)] == [(0,)]


def test_order_that_is_left_out_leaves_the_others_as_they_are() -> None:
    spec = load_device("grating_rainbow")
    document = to_document(spec)
    without_orders(weakest_orders(spec)[:1])(document)
    ((_, before),) = holograms_of(spec)
    ((_, after),) = holograms_of(device_from(document))
    assert isinstance(before.efficiency, ConstantSpec)
    assert isinstance(after.efficiency, ConstantSpec)
    kept = {order: share for order, share in before.efficiency.table.T.items() if order != "-2"}
    assert kept == after.efficiency.table.T


@pytest.mark.parametrize("name", sorted(preset_paths()))
def test_no_hologram_loses_all_its_orders(name: str) -> None:
    for variant in found_in(name).get("orders kept", []):
        assert all(hologram.orders for _, hologram in holograms_of(variant.spec))


def test_tables_of_a_kinoform() -> None:
    found = found_in("point_lens")
    for variant in (*found["table resolution"], *found["interpolation"]):
        ((_, hologram),) = holograms_of(variant.spec)
        assert hologram.efficiency.uses_table
    assert "RCWA harmonics" not in found


def test_constant_shares_have_no_table() -> None:
    _, missing = variants(load_device("two_hologram_ar"))
    whole = {each.knob: each.why for each in missing if not each.value}
    assert whole["table resolution"] == "needs a hologram whose shares depend on the light"
    assert "RCWA harmonics" in whole


def test_harmonics_of_a_rigorous_grating() -> None:
    grating = {
        "model": "rcwa",
        "profile": {"shape": "binary", "depth_um": 0.5, "duty": 0.5},
        "ridge": 1.5,
    }
    document = to_document(load_device("grating_rainbow"))
    document["elements"][0]["hologram"]["efficiency"] = grating
    found, _ = variants(device_from(document))
    harmonics = [each for each in found if each.knob == "RCWA harmonics"]
    counts = [holograms_of(each.spec)[0][1].efficiency.harmonics for each in harmonics]
    assert counts == [5, 11, 21]


def test_effects_of_the_plan_are_turned_one_by_one() -> None:
    found, missing = variants(load_device("point_lens"))
    texts = [each.value for each in [*found, *missing] if each.knob == "effects"]
    assert texts[0] == "all on"
    assert len(set(texts)) == len(texts)
    for each in found:
        if each.knob == "effects" and each.value != "all on":
            assert each.value in each.spec.render.effects
