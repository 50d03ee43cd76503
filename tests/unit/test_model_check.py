# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The check of an element: the same grating in every model, and what each takes for granted."""

import math
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.fresnel import reflectance_unpolarised
from hoe_addon.core.units import UM
from hoe_addon.model.check import Report, check_hologram, light_on, usual_light
from hoe_addon.model.check.assumptions import Finding
from hoe_addon.model.check.light import Lit
from hoe_addon.model.check.relief import outline, pieces_of
from hoe_addon.model.check.shares import propagating
from hoe_addon.model.document import hologram_from
from hoe_addon.model.efficiency import KinoformSpec, KogelnikSpec, RcwaSpec
from hoe_addon.model.efficiency.rcwa_profile import PolygonProfile, VolumeProfile
from hoe_addon.model.evaluate import efficiencies
from hoe_addon.model.hologram import HologramSpec

PRINTED = 2e-5
"""Reference values are printed with five digits; the mean of two of them is good to this."""
LOSSLESS = 1e-10
"""R + T of a lossless grating, the promise of the rigorous model."""
SAME = 1e-12
"""The same number on two ways."""
THICK = 0.02
"""Two-wave theory at Q' of several hundred leaves out less than this."""

KOGELNIK: dict[str, Any] = {
    "model": "kogelnik",
    "thickness_um": 5,
    "index": 1.5,
    "modulation": 0.05,
}
KINOFORM = {"model": "kinoform", "levels": 4, "design_wavelength_nm": 532, "relief": 1.5}


def waves(index: float) -> dict[str, Any]:
    """A slanted reflection hologram, recorded in a medium."""
    return {
        "wavelength_nm": 532,
        "object": {"kind": "plane", "direction": [0.3, 0, -1], "index": index},
        "reference": {"kind": "plane", "direction": [0.1, 0.2, 1], "index": index},
    }


WAVES = waves(1.0)


def hologram(efficiency: dict[str, Any], lines_per_mm: float = 500.0, **parts: Any) -> HologramSpec:
    grating = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": lines_per_mm}
    given = {} if "recording" in parts else {"characteristic": grating}
    return hologram_from(
        {
            "schema": 1,
            "name": "element",
            "surface": {"shape": "plane", "size_mm": [1, 1]},
            "media": {"back": 1.5, "front": 1.5},
            "efficiency": efficiency,
            "orders": [-1, 0, 1],
        }
        | given
        | parts
    )


def usual(spec: HologramSpec) -> Lit:
    angles = usual_light(spec)
    return light_on(
        spec, [532.0], [angles.theta_deg], [angles.phi_deg], from_front=angles.from_front
    )


def report(spec: HologramSpec) -> Report:
    return check_hologram(spec, usual(spec))


@pytest.mark.parametrize("folds", [False, True])
def test_light_that_cannot_leave_is_told(folds: bool) -> None:
    efficiency = {"model": "kogelnik", "thickness_um": 8, "index": 1.5, "modulation": 0.02}
    waves_of_coupler = {
        "wavelength_nm": 532,
        "object": {"kind": "plane", "direction": [0.9, 0, 0.6], "index": 1.5},
        "reference": {"kind": "plane", "direction": [0, 0, 1]},
    }
    found = report(
        hologram(
            efficiency | {"total_internal_reflection": folds},
            media={"back": 1.5, "front": 1.0},
            recording=waves_of_coupler,
        )
    )
    told = [each for each in found.findings if each.name == "R + T"]
    assert [each.holds for each in told] == [folds]
    words = "66.5 % goes into an order that cannot leave; set total_internal_reflection"
    assert (words in told[0].warning) is not folds


def finding(found: Report, name: str, model: str | None = None) -> Finding:
    listed = [f for f in found.findings if f.name == name and model in (None, f.model)]
    assert len(listed) == 1
    return listed[0]


def unpolarised(found: Report, order: int, *, reflected: bool = False) -> list[float]:
    return [float(model.of((order, reflected)).mean()) for model in found.models]


def test_a_thin_volume_grating_is_found_out() -> None:
    """Two-wave theory promises .99 on Bragg where the rigorous answer is .36."""
    found = report(hologram(KOGELNIK))
    assert [model.candidate.name for model in found.models] == ["kogelnik", "rcwa"]
    two_wave, rigorous = unpolarised(found, 1)
    assert two_wave == pytest.approx(0.99, abs=0.005)
    assert rigorous == pytest.approx(0.36, abs=0.005)
    [difference] = found.differences()
    assert (difference.order, difference.side) == (1, "T")
    assert difference.size == pytest.approx(two_wave - rigorous, abs=SAME)
    assert finding(found, "Q'").holds is False
    assert finding(found, "rho").holds is False
    assert any(line.startswith("kogelnik does not hold here: Q' = 2.8 < 10") for line in
               found.warnings())  # fmt: skip


def test_numbers_of_thick_gratings_are_those_of_the_papers() -> None:
    found = report(hologram(KOGELNIK))
    cosine = math.sqrt(1.0 - (0.532 / 2.0 / 2.0 / 1.5) ** 2)
    quality = 2.0 * math.pi * 0.532 * 5.0 / (1.5 * 2.0**2 * cosine)
    assert finding(found, "Q'").value == pytest.approx(quality, rel=SAME)
    assert finding(found, "rho").value == pytest.approx(0.532**2 / (1.5 * 0.05 * 4), rel=SAME)
    strength = math.pi * 0.05 * 5.0 / 0.532 / cosine
    assert finding(found, "nu").value == pytest.approx(strength, rel=1e-9)


def test_published_transmission_grating() -> None:
    """The listed grating of 1 um: two-wave and rigorous values of s and p."""
    thick = KOGELNIK | {"thickness_um": 9, "modulation": 0.03}
    found = report(hologram(thick, 1000.0))
    two_wave, rigorous = (model.of((1, False))[0] for model in found.models)
    assert rigorous == pytest.approx((0.98532, 0.98498), abs=PRINTED)
    # The share of order -1, which two-wave theory leaves out, is taken off order 0.
    assert two_wave == pytest.approx((0.99757, 0.99724), abs=PRINTED)


def test_published_reflection_grating() -> None:
    """Fringes along the surface: all orders of a side are one."""
    flat = KOGELNIK | {"thickness_um": 7.98, "modulation": 0.03, "normal_period_um": 0.1773333}
    found = report(hologram(flat, 0.0))
    assert unpolarised(found, 0, reflected=True) == pytest.approx([0.78904, 0.78881], abs=3e-4)
    assert found.models[0].ways == ((0, False), (0, True))


def test_rigorous_volume_grating_meets_its_two_wave_twin() -> None:
    """From either model the check makes the other one, with the same numbers."""
    profile = {"shape": "volume", "thickness_um": 5, "index": 1.5, "modulation": 0.05}
    forth, back = (
        report(hologram(KOGELNIK)),
        report(hologram({"model": "rcwa", "profile": profile})),
    )
    assert unpolarised(back, 1) == pytest.approx(unpolarised(forth, 1)[::-1], abs=SAME)


@pytest.mark.parametrize("changes", [{}, {"shrinkage": 0.03, "index_shift": 0.02}])
def test_slanted_fringes_of_a_recording(changes: dict[str, float]) -> None:
    """Between media of its own index a thick weak hologram is the same in both theories."""
    document = KOGELNIK | {"thickness_um": 12, "modulation": 0.015} | changes
    spec = hologram(document, recording=waves(1.5))
    angles = usual_light(spec)
    # 3 % of shrinkage and +0.02 of index move the peak from 532 to 523 nm.
    lit = light_on(
        spec, [505.0, 523.0, 532.0], [angles.theta_deg], [angles.phi_deg], from_front=False
    )
    found = check_hologram(spec, lit)
    two_wave, rigorous = (model.of((1, True)).mean(axis=-1) for model in found.models)
    assert int(np.argmax(two_wave)) == (1 if changes else 2)
    assert two_wave.max() > 0.5
    assert two_wave == pytest.approx(rigorous, abs=THICK)


def test_the_usual_light_of_a_recording_is_its_reference() -> None:
    angles = usual_light(hologram(KOGELNIK, recording=WAVES, media={"back": 1.0, "front": 1.0}))
    direction = np.array((0.1, 0.2, 1.0)) / math.sqrt(1.05)
    assert angles.theta_deg == pytest.approx(math.degrees(math.acos(direction[2])), abs=1e-9)
    assert angles.phi_deg == pytest.approx(math.degrees(math.atan2(0.2, 0.1)), abs=1e-9)
    assert not angles.from_front


def test_the_usual_light_without_waves_is_on_bragg() -> None:
    angles = usual_light(hologram(KOGELNIK))
    assert angles.theta_deg == pytest.approx(
        -math.degrees(math.asin(0.532 / 2 / 2 / 1.5)), abs=1e-9
    )
    assert angles.words == "on Bragg"


@pytest.mark.parametrize("on_front", [False, True])
def test_kinoform_as_a_relief(on_front: bool) -> None:
    """The relief stands on the glass, whichever side that is, and turns light toward +Q."""
    media = {"back": 1.0, "front": 1.5} if on_front else {"back": 1.5, "front": 1.0}
    found = report(hologram(KINOFORM, 200.0, media=media))
    scalar, rigorous = unpolarised(found, 1)
    assert scalar == pytest.approx(0.8106, abs=1e-4)
    assert 0.6 < rigorous < scalar
    assert unpolarised(found, -1)[1] < 0.05
    spec = found.models[1].candidate.efficiency
    assert isinstance(spec, RcwaSpec)
    assert isinstance(spec.profile, PolygonProfile)
    heights = [z for _, z in spec.profile.points]
    # Four levels of a relief of 532 nm / 0.5: the top step is three of its quarters high.
    assert max(heights) == pytest.approx(0.75 * 1.064, abs=SAME)
    assert min(heights) == 0.0
    foot = max(heights) if on_front else 0.0
    assert {0.0, 1.0} <= {x for x, z in spec.profile.points if z == foot}
    area = _area(spec.profile.points)
    assert abs(area) == pytest.approx(0.375 * 1.064, abs=SAME)


def _area(points: tuple[tuple[float, float], ...]) -> float:
    x, z = np.asarray(points).T
    return 0.5 * float(np.sum(x * np.roll(z, -1) - z * np.roll(x, -1)))


def test_rigorous_relief_as_a_kinoform() -> None:
    """A deep sawtooth in many periods: both ways give the scalar numbers of the same relief."""
    document = {
        "model": "rcwa",
        "profile": {"shape": "staircase", "depth_um": 1.064, "levels": 4},
        "ridge": 1.5,
        "harmonics": 31,
    }
    media = {"back": 1.5, "front": 1.0}
    found = report(hologram(document, 200.0, media=media))
    own = report(hologram(KINOFORM, 200.0, media=media))
    assert unpolarised(found, 1)[1] == pytest.approx(unpolarised(own, 1)[0], abs=SAME)
    thin = found.models[1].candidate.efficiency
    assert isinstance(thin, KinoformSpec)
    assert (thin.levels, thin.depth_waves) == (4, pytest.approx(1.0, abs=SAME))


@pytest.mark.parametrize(
    "shape",
    [
        {"shape": "binary", "duty": 0.3},
        {"shape": "sinusoid"},
        {"shape": "triangle", "peak": 0.7},
        {"shape": "sampled", "heights": [0.0, 0.5, 1.0, 0.2]},
        {"shape": "sampled", "heights": [0.25, 0.5, 1.0, 0.2], "between": "steps"},
    ],
)
def test_the_outline_has_the_mean_height_of_the_profile(shape: dict[str, Any]) -> None:
    spec = hologram(KINOFORM | {"levels": 0, "profile": shape}).efficiency
    assert isinstance(spec, KinoformSpec)
    pieces = pieces_of(spec.made_profile())
    mean = float(np.sum(pieces.width * pieces.height) - min(pieces.start.min(), pieces.end.min()))
    stands, hangs = (_area(tuple(outline(pieces, 2.0, on_front=side))) for side in (False, True))
    assert abs(stands) == pytest.approx(2.0 * mean, rel=1e-9)
    assert abs(hangs) == pytest.approx(2.0 * mean, rel=1e-9)


def test_faces_that_models_leave_out() -> None:
    spec = hologram(KOGELNIK, media={"back": 1.0, "front": 1.0})
    found = report(spec)
    lit = found.lit.incidence
    sine = float(np.abs(lit.tangential[0, 0]))
    first = float(reflectance_unpolarised(math.sqrt(1.0 - sine**2), 1.0, 1.5))
    second = float(reflectance_unpolarised(math.sqrt(1.0 - (sine / 1.5) ** 2), 1.5, 1.0))
    lost = 1.0 - (1.0 - first) * (1.0 - second)
    assert finding(found, "Fresnel loss").value == pytest.approx(lost, rel=1e-9)
    assert finding(found, "Fresnel loss").holds is False
    # Off the grating's own orders the rigorous model reflects about as much.
    assert float(found.models[1].total(reflected=True).mean()) > 0.5 * lost


def test_energy_audit() -> None:
    found = report(hologram(KINOFORM, 300.0, media={"back": 1.5, "front": 1.0}))
    assert finding(found, "|1 - R - T|", "rcwa").value < LOSSLESS
    assert finding(found, "R + T - 1", "kinoform").value < LOSSLESS
    silver = {"index": {"n": 0.05, "k": 3.4}, "thickness_um": 0.02}
    profile = {"shape": "binary", "depth_um": 0.3}
    absorbing = {"model": "rcwa", "profile": profile, "ridge": 1.5, "under": [silver]}
    lossy = report(hologram(absorbing, 300.0))
    assert finding(lossy, "R + T - 1", "rcwa").value < -1e-3
    assert "rcwa does not keep the energy" not in " ".join(lossy.warnings())


def test_models_that_do_not_apply_tell_why() -> None:
    further = [{"wavelength_nm": 633, "modulation": 0.02}]
    several = report(hologram(KOGELNIK | {"exposures": further}, recording=WAVES))
    assert [each.words for each in several.left_out] == [
        "several gratings in one emulsion have no common period"
    ]
    long = report(hologram(KINOFORM, 5.0))
    assert long.left_out[0].words.endswith("too many for a quick rigorous solution")
    document = {"model": "constant", "table": {"T": {"1": 0.5}}}
    assert [model.candidate.name for model in report(hologram(document)).models] == ["constant"]


@pytest.mark.parametrize("efficiency", [KINOFORM, KOGELNIK])
def test_where_nothing_is_recorded_light_goes_straight(efficiency: dict[str, Any]) -> None:
    rings = {"kind": "radial", "wavelength_nm": 532, "lines_per_mm": 600}
    found = report(hologram(efficiency, characteristic=rings))
    assert unpolarised(found, 0) == [1.0]
    assert found.left_out[0].words == "nothing is recorded at the centre"
    assert found.warnings() == []


def test_sums_of_exposures_are_those_of_the_efficiency_command() -> None:
    further = [{"wavelength_nm": 600, "modulation": 0.02}]
    spec = hologram(
        KOGELNIK | {"exposures": further}, recording=WAVES, media={"back": 1.0, "front": 1.0}
    )
    lit = usual(spec)
    [model] = check_hologram(spec, lit).models
    shares = efficiencies(spec, lit.direction, 532.0, [-1, 0, 1])[0]
    for row, order in zip(shares, (-1, 0, 1), strict=True):
        for side, share in zip((False, True), row, strict=True):
            assert float(model.of((order, side)).mean()) == pytest.approx(float(share), abs=SAME)


def test_orders_that_propagate_are_counted() -> None:
    spec = hologram(KOGELNIK, 500.0, media={"back": 1.5, "front": 1.0})
    lit = light_on(spec, [532.0], [10.0], [30.0], from_front=False)
    beyond, back = propagating(lit.incidence)
    x, y = 1.5 * np.array((np.cos(np.pi / 6), 0.5)) * np.sin(np.radians(10.0))
    orders = np.hypot(x + np.arange(-50, 51) * 0.266, y)
    assert (int(beyond[0]), int(back[0])) == (np.sum(orders < 1.0), np.sum(orders < 1.5))


def test_fringes_after_development_are_those_of_the_rigorous_twin() -> None:
    spec = hologram(KOGELNIK | {"shrinkage": 0.1, "absorption_per_mm": 2.0}, recording=WAVES)
    assert isinstance(spec.efficiency, KogelnikSpec)
    found = report(spec)
    twin = found.models[1].candidate.efficiency
    assert isinstance(twin, RcwaSpec)
    assert isinstance(twin.profile, VolumeProfile)
    assert twin.profile.thickness_um == pytest.approx(4.5, abs=SAME)
    waves = found.lit.incidence.waves
    assert waves is not None
    inside = [
        math.copysign(math.sqrt(1.5**2 - float(np.sum(wave[0, :2] ** 2))), wave[0, 2])
        for wave in (waves.object, waves.reference)
    ]
    recorded_um = 0.532 / (inside[0] - inside[1])
    assert twin.profile.normal_period_um == pytest.approx(0.9 * recorded_um, rel=1e-9)
    assert found.lit.incidence.wavelength[0] / UM == pytest.approx(0.532)


def test_plain_data_has_everything() -> None:
    found = report(hologram(KOGELNIK))
    plain = found.to_dict([0, 1])
    [light] = plain["light"]
    assert light["from"] == "back"
    assert set(light["models"]) == {"kogelnik", "rcwa"}
    rigorous = light["models"]["rcwa"]
    assert [(row["order"], row["side"]) for row in rigorous["orders"]] == [
        (0, "T"),
        (1, "T"),
        (0, "R"),
        (1, "R"),
    ]
    assert rigorous["T"]["u"] + rigorous["R"]["u"] + rigorous["A"]["u"] == pytest.approx(1.0)
    assert plain["warnings"] == found.warnings()
    assert {entry["name"] for entry in plain["assumptions"]} >= {"Q'", "rho", "nu", "error reached"}


@pytest.mark.parametrize(("duty", "holds"), [(0.1, False), (0.9, False), (0.5, True), (0.42, True)])
def test_scalar_theory_needs_wide_ridges_too(duty: float, holds: bool) -> None:
    """15 wavelengths of period: a ridge of 1.5 is off by 20 % in the rigorous solution."""
    profile = {"profile": {"shape": "binary", "duty": duty}, "depth_waves": 0.5}
    spec = hologram(KINOFORM | {"levels": 0} | profile, 1e3 / (15.0 * 0.532))
    found = finding(report(spec), "feature / wavelength", "kinoform")
    assert found.holds is holds
    narrow = 1.0 if holds else min(duty, 1.0 - duty)
    assert found.value == pytest.approx(15.0 * narrow, rel=1e-6)


def test_strength_is_told_for_transmitted_and_reflected_light_apart() -> None:
    """Fringes slanted by 45 degrees turn steep light back and let other light pass."""
    volume = KOGELNIK | {"modulation": 0.2, "normal_period_um": -0.5}
    spec = hologram(volume, 2000.0)
    lit = light_on(spec, [532.0], [-40.0, 60.0], [0.0], from_front=False)
    told = [each for each in check_hologram(spec, lit).findings if each.name == "nu"]
    assert [each.holds for each in told] == [None, False]
