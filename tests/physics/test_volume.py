# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms: published values, what development does, and Bragg's law at every point."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.arrays import unit
from hoe_addon.core.efficiency import Polarization
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.units import m_to_mm, mm_to_m
from hoe_addon.model.convert import recording_from
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.model.element import element_shape
from hoe_addon.model.evaluate import efficiencies, fan, trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "reference" / "kogelnik.json").read_text(encoding="utf-8")
)
PRINTED = 1e-5
"""Five printed digits."""
EXACT = 1e-10
"""Phases of some hundred rad in double precision."""
PLANE = {"shape": "plane", "size_mm": [20, 20]}
SPHERE = {"shape": "sphere", "size_mm": [20, 20], "radius_mm": 60}
AXIS = [0.0, 0.0, 1.0]
MIRROR = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0, 0, -1], "index": 1.5},
    "reference": {"kind": "plane", "direction": [0, 0, 1], "index": 1.5},
}
THROUGH = {
    "wavelength_nm": 532,
    "object": {"kind": "point", "position_mm": [40, 8, -70]},
    "reference": {"kind": "point", "position_mm": [-25, 5, -120]},
}
BACK = {
    "wavelength_nm": 532,
    "object": {"kind": "point", "position_mm": [30, -12, 80]},
    "reference": {"kind": "point", "position_mm": [-25, 5, -120]},
}


def hologram(
    pattern: dict[str, Any], surface: dict[str, Any] = PLANE, outside: float = 1.5, **fields: Any
) -> HologramSpec:
    return hologram_from(
        {
            "schema": 1,
            "name": "volume",
            "surface": surface,
            "media": {"back": outside, "front": outside},
            **pattern,
            "efficiency": {
                "model": "kogelnik",
                "thickness_um": 8.0,
                "index": 1.5,
                "modulation": 0.03,
                **fields,
            },
        }
    )


EDGE_LIT = {
    "wavelength_nm": 532,
    "object": {"kind": "plane", "direction": [0.9, 0, 0.6], "index": 1.5},
    "reference": {"kind": "plane", "direction": [0, 0, 1]},
}
TWO_WAVES = 0.02
"""What two-wave theory leaves out at Q' = 126: the faces, and higher orders."""


def edge_lit(*, folds: bool, swapped: bool = False) -> HologramSpec:
    """A coupler whose order +1 runs to the face of air beyond its critical angle."""
    media = {"back": 1.0, "front": 1.5} if swapped else {"back": 1.5, "front": 1.0}
    return hologram_from(
        {
            "schema": 1,
            "name": "coupler",
            "surface": PLANE,
            "media": media,
            "recording": EDGE_LIT,
            "efficiency": {
                "model": "kogelnik",
                "thickness_um": 8,
                "index": 1.5,
                "modulation": 0.02,
                "total_internal_reflection": folds,
            },
        }
    )


def test_an_order_that_cannot_leave_is_totally_reflected() -> None:
    lost = efficiencies(edge_lit(folds=False), AXIS, 532.0, (1, 0, -1))
    assert lost[0] == pytest.approx([0.0, 0.0], abs=0.0)
    assert lost.sum() < 0.4
    kept = efficiencies(edge_lit(folds=True), AXIS, 532.0, (1, 0, -1))
    assert kept[0, 0] == 0.0
    assert kept[0, 1] == pytest.approx(0.6659, abs=TWO_WAVES)  # rcwa, of the same grating
    assert kept.sum() == pytest.approx(1.0, abs=EXACT)


def test_an_order_that_can_leave_only_beyond_is_transmitted() -> None:
    """Light from air, which the grating sends back to air beyond its critical angle."""
    shares = {}
    for folds in (False, True):
        document = to_document(edge_lit(folds=folds, swapped=True))
        document["recording"]["object"]["direction"] = [0.9, 0.0, -0.6]
        shares[folds] = efficiencies(hologram_from(document), AXIS, 532.0, (1, 0, -1))
    assert (shares[False][0] == 0.0).all()
    assert shares[True][0, 0] > 0.3
    assert shares[True][0, 1] == 0.0
    assert shares[True].sum() == pytest.approx(1.0, abs=EXACT)


def along(angle: float) -> np.ndarray:
    return np.array([np.sin(angle), 0.0, np.cos(angle)])


def middle_of_peak(wavelength_nm: np.ndarray, share: np.ndarray) -> float:
    """Middle between both half maxima, by frequency, in which the peak is symmetric."""
    above = wavelength_nm[share > 0.5 * share.max()]
    return 2.0 / (1.0 / above[0] + 1.0 / above[-1])


@pytest.mark.parametrize("row", REFERENCE["transmission"]["rows"])
@pytest.mark.parametrize("polarization", ["s", "p", "u"])
def test_published_transmission(row: dict[str, float], polarization: str) -> None:
    case = REFERENCE["transmission"]
    lines = {
        "kind": "linear",
        "wavelength_nm": 532,
        "lines_per_mm": 1e3 / case["period_um"],
        "azimuth_deg": 180,
    }
    spec = hologram({"characteristic": lines}, thickness_um=case["thickness_um"])
    direction = along(np.radians(case["bragg_deg"] + row["off_bragg_deg"]))
    found = efficiencies(spec, direction, 532.0, (1, 0, -1), Polarization(polarization))
    expected = {"s": row["te"], "p": row["tm"], "u": 0.5 * (row["te"] + row["tm"])}[polarization]
    assert found[0, 0] == pytest.approx(expected, abs=PRINTED)
    assert found.sum() == pytest.approx(1.0, abs=EXACT)
    assert (found[:, 1] == 0.0).all()


@pytest.mark.parametrize("row", REFERENCE["reflection"]["rows"])
@pytest.mark.parametrize("polarization", Polarization)
def test_published_reflection(row: dict[str, float], polarization: Polarization) -> None:
    thickness_um = REFERENCE["reflection"]["thickness_um"]
    spec = hologram({"recording": MIRROR}, thickness_um=thickness_um)
    found = efficiencies(spec, AXIS, row["wavelength_nm"], (1, 0, -1), polarization)
    assert found[0, 1] == pytest.approx(row["te"], abs=PRINTED)
    assert found[0, 0] == found[2, 1] == 0.0
    assert found.sum() == pytest.approx(1.0, abs=EXACT)


@pytest.mark.parametrize("row", REFERENCE["development"]["rows"])
def test_development_moves_a_reflection_peak(row: dict[str, float]) -> None:
    spec = hologram(
        {"recording": MIRROR},
        modulation=0.0015,
        thickness_um=80,
        shrinkage=row["shrinkage"],
        index_shift=row["index_shift"],
    )
    wavelength_nm = row["peak_nm"] + np.linspace(-6.0, 6.0, 12001)
    share = efficiencies(spec, np.tile(AXIS, (12001, 1)), wavelength_nm, (1,))[:, 0, 1]
    # Two steps of the grid and the rounding of the printed value.
    assert middle_of_peak(wavelength_nm, share) == pytest.approx(row["peak_nm"], abs=0.007)


def test_shrinkage_thins_the_layer_and_tilts_the_fringes() -> None:
    """A slanted transmission grating: the Bragg angle goes with K_z / (1 - s)."""
    pattern = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 800}
    shrinkage, period_um = 0.1, 2.0
    spec = hologram({"characteristic": pattern}, normal_period_um=period_um, shrinkage=shrinkage)
    k = np.array([0.8, 0.0, 1.0 / (period_um * (1.0 - shrinkage))]) * 0.532
    angle = np.linspace(-1.2, 1.2, 200001)
    rho = 1.5 * np.column_stack((np.sin(angle), np.zeros_like(angle), np.cos(angle)))
    closed = np.sum((rho + k) ** 2, axis=1) - 1.5**2
    place = np.flatnonzero(np.diff(np.sign(closed)))
    assert len(place) >= 1
    found = efficiencies(spec, along(float(angle[place[0]])), 532.0, (1,), Polarization.S)[0, 0]
    c_r, c_s = np.cos(angle[place[0]]), (rho + k)[place[0], 2] / 1.5
    depth = 8e-6 * (1.0 - shrinkage)
    assert found == pytest.approx(np.sin(np.pi * 0.03 * depth / 532e-9 / np.sqrt(c_r * c_s)) ** 2)


def points_on(spec: HologramSpec, rng: np.random.Generator, count: int = 200) -> np.ndarray:
    xy = mm_to_m(rng.uniform(-6.0, 6.0, (count, 2)))
    return m_to_mm(np.column_stack((xy, element_shape(spec).sag(xy[:, 0], xy[:, 1]))))


@pytest.mark.parametrize("surface", [PLANE, SPHERE], ids=["plane", "sphere"])
@pytest.mark.parametrize("recording", [THROUGH, BACK], ids=["transmission", "reflection"])
@pytest.mark.parametrize("order", [1, -1])
def test_read_out_is_on_bragg_everywhere(
    recording: dict[str, Any], surface: dict[str, Any], order: int, rng: np.random.Generator
) -> None:
    """Each recording wave gives the other one, with the peak efficiency of the place."""
    spec = hologram({"recording": recording}, surface, outside=1.0)
    points_mm = points_on(spec, rng)
    waves = recording_from(spec.pattern).waves(mm_to_m(points_mm))
    light, other = waves if order == -1 else waves[::-1]
    reflected = recording is BACK
    ways = (Branch(order, reflected=reflected), Branch(0), Branch(order, reflected=not reflected))
    out = fan(spec, points_mm, light, 532.0, ways, polarization=Polarization.S)
    assert (out.status[:, 0] == Status.OK).all()
    np.testing.assert_allclose(out.directions[:, 0], other, atol=1e-12)
    normal = element_shape(spec).normal(mm_to_m(points_mm))
    cosines = [
        np.abs(np.sqrt(1.5**2 - 1.0 + np.sum(wave * normal, axis=1) ** 2)) / 1.5
        for wave in (light, other)
    ]
    across = unit(np.cross(light, normal))
    inside = [_refracted(wave, normal) for wave in (light, other)]
    fringes = unit(np.cross(*inside))
    along_fringes = np.sum(across * fringes, axis=1) ** 2
    factor = np.sum(inside[0] * inside[1], axis=1) / 1.5**2
    nu = np.pi * 0.03 * 8e-6 / 532e-9 / np.sqrt(cosines[0] * cosines[1])
    peak = (lambda x: np.tanh(x) ** 2) if reflected else (lambda x: np.sin(x) ** 2)
    expected = along_fringes * peak(nu) + (1.0 - along_fringes) * peak(nu * factor)
    np.testing.assert_allclose(out.weights[:, 0], expected, rtol=1e-9)
    assert (out.weights[:, 2] == 0.0).all()
    assert along_fringes.min() < 0.98


def _refracted(wave: np.ndarray, normal: np.ndarray) -> np.ndarray:
    cosine = np.sum(wave * normal, axis=1, keepdims=True)
    tangential = wave - cosine * normal
    depth = np.sqrt(1.5**2 - np.sum(tangential**2, axis=1, keepdims=True))
    return tangential + np.sign(cosine) * depth * normal


def test_energy_on_both_sides_at_every_wavelength(rng: np.random.Generator) -> None:
    for recording in (THROUGH, BACK):
        spec = hologram({"recording": recording}, SPHERE, outside=1.0)
        points_mm = points_on(spec, rng, 500)
        direction = unit(rng.normal(size=(500, 3)))
        ways = spec.efficiency.branches((0, 1, -1), 532.0)
        for polarization in Polarization:
            light = fan(
                spec, points_mm, direction, rng.uniform(400.0, 700.0, 500), ways, None, polarization
            )
            total = light.weights.sum(axis=1)
            evanescent = (light.status != Status.OK).any(axis=1)
            np.testing.assert_allclose(total[~evanescent], 1.0, atol=EXACT)
            assert (total <= 1.0 + EXACT).all()


def test_unpolarised_is_the_mean_of_s_and_p(rng: np.random.Generator) -> None:
    spec = hologram({"recording": THROUGH}, outside=1.0, exposures=[_exposure(600)])
    direction = unit(rng.normal(loc=(0.0, 0.0, 2.0), size=(300, 3)))
    s, p, u = (efficiencies(spec, direction, 550.0, (-1, 0, 1), way) for way in Polarization)
    np.testing.assert_allclose(u, 0.5 * (s + p), atol=1e-14)
    assert np.abs(s - p).max() > 0.01


def test_conical_light_is_s_where_it_was_p() -> None:
    """Light along the fringes of an unslanted grating: s lies in the plane of both waves."""
    lines = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 300}
    spec = hologram({"characteristic": lines}, thickness_um=3)
    direction = np.array([0.0, np.sin(0.4), np.cos(0.4)])
    s, p = (efficiencies(spec, direction, 532.0, (1,), Polarization(way))[0, 0] for way in "sp")
    kx = 0.3 * 0.532
    rho = 1.5 * direction
    fringes = unit(np.cross(rho, [kx, 0.0, 0.0]))
    assert fringes @ [1.0, 0.0, 0.0] == pytest.approx(0.0, abs=1e-12)  # s is along x here
    sigma = rho + np.array([kx, 0.0, 0.0])
    factor = rho @ sigma / (1.5 * np.linalg.norm(sigma))
    nu = np.pi * 0.03 * 3e-6 / 532e-9 / np.cos(0.4)
    xi = np.pi * 3e-6 * kx**2 / (2.0 * 1.5 * 532e-9 * np.cos(0.4))

    def alone(strength: float) -> float:
        return np.sin(np.hypot(strength, xi)) ** 2 / (1.0 + (xi / strength) ** 2)

    # Orders +1 and -1 are alike here: both lose half of their product.
    shared = [alone(x) * (1.0 - 0.5 * alone(x)) for x in (nu * factor, nu)]
    assert [s, p] == pytest.approx(shared, abs=1e-12)


def _exposure(wavelength_nm: float, modulation: float = 0.03) -> dict[str, float]:
    return {"wavelength_nm": wavelength_nm, "modulation": modulation}


def test_three_exposures_make_three_mirrors() -> None:
    """Red, green and blue are reflected, yellow and cyan go through; all in the same direction."""
    spec = hologram({"recording": MIRROR}, exposures=[_exposure(633), _exposure(450)])
    wavelength_nm = np.array([450.0, 532.0, 633.0, 491.0, 580.0])
    found = efficiencies(spec, np.tile(AXIS, (5, 1)), wavelength_nm, (1, 0, -1))
    expected = np.tanh(np.pi * 0.03 * 8e-6 / (wavelength_nm[:3] * 1e-9)) ** 2
    np.testing.assert_allclose(found[:3, 0, 1], expected, atol=0.02)
    assert (found[3:, 0, 1] < 0.1).all()
    np.testing.assert_allclose(found.sum(axis=(1, 2)), 1.0, atol=EXACT)


def test_a_ray_follows_the_exposure_that_it_is_on_bragg_with() -> None:
    """Read out with the reference wave at any of its wavelengths, the object wave comes back."""
    spec = hologram({"recording": BACK}, outside=1.0, exposures=[_exposure(633), _exposure(450)])
    source = np.array([-25.0, 5.0, -120.0])
    point = np.array([3.0, -2.0, 0.0])
    back_to = unit(point - [30.0, -12.0, 80.0])
    wavelength_nm = np.array([450.0, 532.0, 633.0])
    rays = RayTable(
        np.tile(source, (3, 1)),
        np.tile(unit(point - source), (3, 1)),
        wavelength_nm,
        np.ones(3, dtype=int),
        np.ones(3, dtype=bool),
    )
    found = trace(spec, rays)
    np.testing.assert_allclose(found.direction, np.tile(back_to, (3, 1)), atol=1e-12)
    assert (found.efficiency > 0.65).all()


def test_thickness_and_modulation_that_vary_over_the_element() -> None:
    spec = hologram(
        {"recording": MIRROR},
        thickness_um={"formula": "8 + 0.1*x"},
        modulation={"formula": "0.03 - 0.001*y"},
    )
    places_mm = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0], [-9.0, 4.0, 0.0]])
    found = fan(spec, places_mm, np.tile(AXIS, (3, 1)), 532.0, (Branch(1, reflected=True),))
    depth = (8.0 + 0.1 * places_mm[:, 0]) * 1e-6
    strength = np.pi * (0.03 - 0.001 * places_mm[:, 1]) * depth / 532e-9
    np.testing.assert_allclose(found.weights[:, 0], np.tanh(strength) ** 2, rtol=1e-12)
