# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plot of efficiencies: its numbers, its pixels, and that it follows the properties in time."""

import math
import time
from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.props import changes
from hoe_addon.model.document import hologram_from, load_device
from hoe_addon.model.evaluate import efficiencies, incident_direction
from hoe_addon.model.scene_parts import HologramElement
from hoe_addon.ui.facts.curves import ANGLES_DEG, WAVELENGTHS_NM, curves_of
from hoe_addon.ui.facts.material import FACTS
from hoe_addon.ui.facts.plot import SIZE, colour_of, plot_pixels

MOST_MS = 50.0
"""Processor time of all facts of a hologram, on a core of 2020 or later."""

VOLUME = {"model": "kogelnik", "thickness_um": 15, "index": 1.5, "modulation": 0.02}
SLANTED = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0, 0, 1]},
    "reference": {"kind": "plane", "direction": [0.5, 0, math.sqrt(0.75)]},
}


@pytest.fixture
def volume(lens: dict[str, Any]) -> dict[str, Any]:
    """A volume hologram between two plane waves, 30 degrees apart."""
    return lens | {"efficiency": VOLUME, "recording": SLANTED, "orders": [0, 1]}


def test_curves_are_the_efficiencies(lens: dict[str, Any]) -> None:
    spec = hologram_from(lens)
    curves = curves_of(spec)
    orders = [order for order, _ in curves.ways]
    sides = [int(reflected) for _, reflected in curves.ways]
    toward = incident_direction(curves.light.theta_deg, 0.0, from_front=curves.light.from_front)
    expected = efficiencies(spec, np.tile(toward, (201, 1)), WAVELENGTHS_NM, orders)
    for place, side in enumerate(sides):
        np.testing.assert_allclose(
            curves.by_wavelength[:, place], expected[:, place, side], atol=1e-12
        )


def test_rings_have_curves_though_their_middle_has_none() -> None:
    disc = load_device("compact_disc")
    own = next(each for each in disc.elements if isinstance(each, HologramElement)).hologram
    curves = curves_of(own)
    assert {order for order, _ in curves.ways} == {-2, -1, 0, 1, 2}
    assert np.nanmax(curves.by_angle) > 0.1


def test_curves_by_angle(volume: dict[str, Any]) -> None:
    spec = hologram_from(volume)
    curves = curves_of(spec)
    assert curves.light.theta_deg == pytest.approx(30.0, abs=0.01)
    toward = incident_direction(ANGLES_DEG, 0.0, from_front=False)
    expected = efficiencies(spec, toward, np.full(len(ANGLES_DEG), 532.0), [1])[:, 0, 0]
    place = curves.ways.index((1, False))
    np.testing.assert_allclose(curves.by_angle[:, place], expected, atol=1e-12)
    assert ANGLES_DEG[np.argmax(expected)] == pytest.approx(30.0, abs=0.5)


def test_table_for_light_that_is_walked_backward(lens: dict[str, Any]) -> None:
    """A table of a shader holds, at the reverse of each way out, the share of that way out."""
    spec = hologram_from(lens)
    model = spec.efficiency.model()

    class Table:
        def shares(self, ways: Any, light: Any, polarization: Any) -> Any:
            (way,) = ways
            there = light.reversed(way.steps, reflected=way.reflected)
            return model.shares(ways, there, polarization)

    direct, looked_up = curves_of(spec), curves_of(spec, Table())
    assert looked_up.ways == direct.ways
    np.testing.assert_allclose(looked_up.by_angle, direct.by_angle, atol=1e-12)
    np.testing.assert_allclose(looked_up.by_wavelength, direct.by_wavelength, atol=1e-12)


def test_medium_without_an_index_everywhere_leaves_a_gap(lens: dict[str, Any]) -> None:
    rows = [[500.0, 1.5, 0.0], [600.0, 1.5, 0.0]]
    profile = {"shape": "volume", "thickness_um": 1, "index": {"table": rows}, "modulation": 0.01}
    spec = hologram_from(lens | {"efficiency": {"model": "rcwa", "profile": profile}})
    table = curves_of(hologram_from(lens))
    assert np.isfinite(table.by_wavelength).all()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("hoe_addon.ui.facts.curves.ANGLES_DEG", np.array([0.0]))
        patch.setattr("hoe_addon.ui.facts.curves.WAVELENGTHS_NM", np.array([450.0, 550.0]))
        curves = curves_of(spec)
    assert np.isnan(curves.by_wavelength[0]).all()
    assert np.isfinite(curves.by_wavelength[1]).all()


def test_each_curve_is_drawn_in_its_colour(lens: dict[str, Any]) -> None:
    curves = curves_of(hologram_from(lens))
    pixels = plot_pixels(curves)
    assert pixels.shape == (SIZE, SIZE, 4)
    assert pixels.dtype == np.float32
    assert (pixels[..., 3] == 1.0).all()
    for order, _ in curves.ways:
        same = np.abs(pixels[..., :3] - colour_of(order)).max(axis=-1) < 1e-3
        assert same[:-42].sum() > 200, order
        assert same[-42:].sum() > 20, f"{order} is not in the key"


def test_curve_has_the_right_height(volume: dict[str, Any]) -> None:
    """At the Bragg angle the peak of order +1 stands where its share is on the axis."""
    curves = curves_of(hologram_from(volume))
    pixels = plot_pixels(curves)
    column = round(52 + (30.0 + 90.0) / 180.0 * (468 - 52))
    near = np.abs(pixels[36:206, column - 1 : column + 2, :3] - colour_of(1)).max(axis=-1) < 0.05
    highest = 36 + np.flatnonzero(near.any(axis=1)).max()
    peak = curves.by_angle[:, curves.ways.index((1, False))].max()
    assert highest == pytest.approx(36 + 6 + peak * (206 - 36 - 12), abs=3.0)


def test_words_fit_into_the_picture(lens: dict[str, Any]) -> None:
    pixels = plot_pixels(curves_of(hologram_from(lens)))[..., :3]
    for edge in (pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]):
        assert np.ptp(edge, axis=0).max() < 0.05


def test_facts_follow_a_change(make_hologram: Callable[..., Any], lens: dict[str, Any]) -> None:
    material = make_hologram(lens, compiled=True)
    before = FACTS.update_now(material)
    material.hologram.efficiency.levels = 2
    changes._tell()
    after = FACTS.shown(material)
    assert after is not None
    assert after.efficiency != before.efficiency
    step = next(line for line in after.efficiency if line.label == "Step")
    depth = next(line for line in after.efficiency if line.label == "Relief Depth")
    # A relief of two levels has one step, half of a whole wave deep.
    assert float(step.value.split()[0]) == pytest.approx(
        1e3 * float(depth.value.split()[0]), rel=1e-3
    )


def test_invalid_hologram_has_its_problem(
    make_hologram: Callable[..., Any], lens: dict[str, Any]
) -> None:
    material = make_hologram(lens)
    material.hologram.efficiency.levels = 1
    facts = FACTS.update_now(material)
    assert facts.problem.startswith("efficiency.levels: ")
    assert not facts.plot
    assert not facts.efficiency


def test_facts_are_forgotten_with_the_file(
    make_hologram: Callable[..., Any], lens: dict[str, Any]
) -> None:
    FACTS.update_now(make_hologram(lens))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert not FACTS._known


@pytest.mark.parametrize("name", ["lens", "volume"])
def test_facts_are_quick(
    make_hologram: Callable[..., Any], name: str, request: pytest.FixtureRequest
) -> None:
    material = make_hologram(request.getfixturevalue(name))
    FACTS.update_now(material)
    times: list[float] = []
    for _ in range(5):
        start = time.process_time()
        FACTS.update_now(material)
        times.append(1e3 * (time.process_time() - start))
    assert min(times) < MOST_MS
