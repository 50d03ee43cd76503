# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light guide walked forward from its display, against energy, symmetry and an unfolded plate."""

import json
import math
from typing import Any

import numpy as np
import pytest

from hoe_addon.core import colour
from hoe_addon.core.errors import SpecError
from hoe_addon.core.spectrum import line
from hoe_addon.core.tracer import EnergyBalance
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.device_light import white_light
from hoe_addon.model.device_walk import EyeboxLuminance, eyebox_luminance
from hoe_addon.model.document import device_from
from hoe_addon.resources import preset_paths

RAYS = 20_000
SIGMAS = 5.0
"""Chance of one false alarm in a run: the scatter of 16 parts has a t distribution with wide
tails, 1e-4 beyond five standard errors."""
QUADRATURE = 0.01
"""Relative. Edges of the couplers between the points where the unfolded plate is sampled."""
ROUNDING = 1e-9
COLOUR = 3e-3
"""In u' and v'. Noise of both ways; the eye sees no difference."""
SHARP = 0.05
"""Relative. With a standard error below this, a hit too many or too few would be seen."""

INDEX, PERIOD_NM, GREEN_NM = 1.8, 400.0, 530.0
LUMINANCE = 500.0
THICKNESS, RELIEF, FOCAL, LENS, GAP, PUPIL = 1.2, 15.0, 20.0, 18.0, 1.0, 4.0
IN_X, OUT_X, ETA, E = 22.0, -0.5, 0.8, 0.3
FIELD_MM = (6.4, 3.6)
GREEN = line(GREEN_NM * 1e-9, 0.01e-9)
HOUSING_EDGE = IN_X - LENS / 2.0 - 1.0


def patch(name: str, x: float, size: tuple[float, float], order_1: float) -> dict[str, Any]:
    """An eye-side grating; both couplers have the same period, their vectors are opposite."""
    sine = GREEN_NM / PERIOD_NM / INDEX
    inward = {"kind": "plane", "index": INDEX}
    if name == "in":
        inward["direction"] = [-sine, 0.0, -math.sqrt(1.0 - sine**2)]
        outward = {"kind": "plane", "direction": [0.0, 0.0, -1.0], "index": 1.0}
        waves = {"object": inward, "reference": outward}
    else:
        inward["direction"] = [-sine, 0.0, math.sqrt(1.0 - sine**2)]
        outward = {"kind": "plane", "direction": [0.0, 0.0, 1.0], "index": 1.0}
        waves = {"object": outward, "reference": inward}
    return {
        "name": name,
        "face": "eye",
        "center_mm": [x, 0.0],
        "size_mm": list(size),
        "recording": {"wavelength_nm": GREEN_NM, **waves},
        "efficiency": {
            "model": "constant",
            "table": {"T": {"0": 1.0 - order_1, "1": order_1}},
            "total_internal_reflection": True,
        },
    }


def device(**changes: Any) -> LightGuideSpec:
    """A small guide with numbers of its own; dotted fields replace parts of it."""
    document = json.loads(preset_paths()["two_hologram_ar"].read_text(encoding="utf-8"))
    document["guide"] = {
        "medium": INDEX,
        "thickness_mm": THICKNESS,
        "size_mm": [60.0, 30.0],
        "center_mm": [6.0, 0.0],
        "relief_mm": RELIEF,
    }
    document["holograms"] = [
        patch("in", IN_X, (changes.pop("in_width", 3.0), 16.0), changes.pop("eta", ETA)),
        patch("out", OUT_X, (23.0, 14.0), E),
    ]
    document["source"] = {"patch": "in"}
    document["display"] |= {"size_mm": list(FIELD_MM), "luminance_cd_m2": LUMINANCE}
    document["lens"] = {
        "focal_length_mm": FOCAL,
        "diameter_mm": LENS,
        "distance_mm": GAP,
    }
    document["eye"]["pupil_diameter_mm"] = PUPIL
    for path, value in changes.items():
        part, field = path.split("__")
        document[part][field] = value
    spec = device_from(document)
    assert isinstance(spec, LightGuideSpec)
    return spec


def axial(**changes: Any) -> LightGuideSpec:
    """A device with a display so small that all its light goes along the axis of the lens."""
    tiny = {"display__size_mm": [1e-3, 1e-3], "eye__pupil_diameter_mm": 1.2}
    return device(**(tiny | changes))


def step_mm(wavelength_nm: float) -> float:
    """Distance between two hits of axial light on the eye's face."""
    sine = wavelength_nm / PERIOD_NM / INDEX
    return 2.0 * THICKNESS * sine / math.sqrt(1.0 - sine**2)


def unfolded(slope: Any, wavelength_nm: Any, pupil_mm: Any, in_width: float = 3.0) -> Any:
    """Efficiency of all paths that end in a point of the pupil, by unfolding the plate.

    Going back from the point, the light left the out-coupler and met the eye's face before at
    even steps; at each hit on the in-coupler light of the lens joins.
    """
    along = slope / np.sqrt(1.0 + np.sum(slope**2, axis=-1, keepdims=True))
    kx, ky = np.broadcast_arrays(along[..., 0] - wavelength_nm / PERIOD_NM, along[..., 1])
    trapped = (np.hypot(kx, ky) > 1.0) & (np.hypot(kx, ky) < INDEX)
    kz = np.sqrt(np.where(trapped, INDEX**2 - kx**2 - ky**2, 1.0))
    step = 2.0 * THICKNESS * np.stack([kx, ky], axis=-1) / kz[..., None]

    def on(place: Any, x: float, width: float, height: float) -> Any:
        return (abs(place[..., 0] - x) <= width / 2.0) & (abs(place[..., 1]) <= height / 2.0)

    place = pupil_mm - RELIEF * slope
    weight = np.where(trapped & on(place, OUT_X, 23.0, 14.0), E, 0.0)
    total = np.zeros_like(weight)
    while np.any(weight > 0.0):
        place = place - step
        weight = np.where(on(place, 6.0, 60.0, 30.0), weight, 0.0)
        source = on(place, IN_X, in_width, 16.0)
        lens = place - GAP * slope - np.array([IN_X, 0.0])
        lit = source & (np.hypot(lens[..., 0], lens[..., 1]) <= LENS / 2.0)
        total += np.where(lit, weight * ETA, 0.0)
        weight = weight * np.where(on(place, OUT_X, 23.0, 14.0), 1.0 - E, 1.0)
        weight = weight * np.where(source, 1.0 - ETA, 1.0)
    return total


def disc(count: int) -> Any:
    """Even points of the pupil, shape (count, 2)."""
    radius = PUPIL / 2.0 * np.sqrt((np.arange(count) + 0.5) / count)
    angle = np.arange(count) * np.pi * (3.0 - np.sqrt(5.0))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)


def field(columns: int, rows: int) -> Any:
    """Slopes of the light for the view from left to right and top to bottom."""
    x = (0.5 - (np.arange(columns) + 0.5) / columns) * FIELD_MM[0] / FOCAL
    y = ((np.arange(rows) + 0.5) / rows - 0.5) * FIELD_MM[1] / FOCAL
    return np.stack(np.meshgrid(x, y), axis=-1)


def parts_of(energy: EnergyBalance) -> float:
    return energy.landed + energy.absorbed + energy.escaped + energy.pruned


def near(result: EyeboxLuminance, expected: Any, slack: float = 0.0) -> Any:
    """Which means are as expected within their own standard error."""
    limit = SIGMAS * result.error_cd_m2 + slack * np.abs(expected)
    return np.abs(result.mean_cd_m2 - expected) <= limit


def test_no_light_is_lost_or_made() -> None:
    energy = eyebox_luminance(device(), [[0, 0, 0]], rays=RAYS).energy
    assert parts_of(energy) == pytest.approx(energy.launched, rel=ROUNDING)
    slope = field(64, 36)
    projected = np.mean((1.0 + np.sum(slope**2, axis=-1)) ** -2)
    extent = projected * FIELD_MM[0] * FIELD_MM[1] / FOCAL**2
    # Lumens that enter through the lens; metres here, millimetres there.
    flux = LUMINANCE * extent * np.pi * (LENS / 2.0) ** 2 * 1e-6
    assert energy.launched == pytest.approx(flux, rel=QUADRATURE)
    assert 0.0 < energy.landed < energy.launched
    assert energy.pruned < 1e-4 * energy.landed


def test_each_hit_leaves_the_same_share() -> None:
    width = 2.2
    step = step_mm(GREEN_NM)
    assert width < step
    hits = np.arange(5, 9)
    centres = IN_X - step * hits
    places = [[x, 0.0, 0.0] for x in (*centres, *(centres + step / 2.0))]
    spec = axial(in_width=width, eye__pupil_diameter_mm=0.3)
    dark = eyebox_luminance(spec, places, rays=RAYS, light=GREEN).mean_cd_m2[hits.size :]
    assert np.all(dark == 0.0)
    result = eyebox_luminance(axial(in_width=width), places[: hits.size], rays=RAYS, light=GREEN)
    expected = LUMINANCE * ETA * E * (1.0 - E) ** (hits - hits[0])
    assert np.all(near(result, expected))
    assert np.all(result.error_cd_m2 < SHARP * expected)
    assert np.all(np.diff(result.mean_cd_m2) < 0.0)


@pytest.mark.parametrize(("in_width", "wavelength_nm"), [(3.0, 530.0), (5.0, 470.0)])
def test_one_wavelength_against_the_unfolded_plate(in_width: float, wavelength_nm: float) -> None:
    centres = np.array([[6.0, 0.0], [0.0, 0.0], [-6.0, 0.0], [0.0, 3.0]])
    light = line(wavelength_nm * 1e-9, 0.01e-9)
    places = np.column_stack([centres, np.zeros(len(centres))])
    result = eyebox_luminance(
        device(in_width=in_width), places, rays=2 * RAYS, grid=(1, 3), light=light
    )
    slope = field(48, 24)[:, :, None, :]
    for number, centre in enumerate(centres):
        shares = unfolded(slope, wavelength_nm, centre + disc(97), in_width).mean(axis=2)
        expected = LUMINANCE * shares
        assert near(result, expected.mean(), QUADRATURE)[number]
        thirds = expected.reshape(24, 3, 16).mean(axis=(0, 2))
        assert result.field_cd_m2[number, 0] == pytest.approx(thirds, rel=0.05, abs=0.5)


def test_white_field_against_the_unfolded_plate(rng: np.random.Generator) -> None:
    places = np.array([[5.0, 0.0, 0.0], [0.0, 2.0, 0.0], [-6.0, 0.0, 0.0]])
    spec = device()
    result = eyebox_luminance(spec, places, rays=3 * RAYS)
    light = white_light(spec.display)
    sampling = by_significance(spec.display.spectra(), floor=0.02)
    count = 150_000
    wavelength = sampling.wavelength((np.arange(count) + rng.random(count)) / count)
    xyz = (light(wavelength) / sampling.density(wavelength))[:, None] * colour.xyz_bar(wavelength)
    xyz *= LUMINANCE / xyz[:, 1].sum()
    slope = (rng.random((count, 2)) - 0.5) * np.array(FIELD_MM) / FOCAL
    for number, place in enumerate(places):
        pupil = place[:2] + rng.permutation(disc(count))
        seen = unfolded(slope, wavelength * 1e9, pupil) @ xyz
        assert near(result, seen[1], QUADRATURE)[number]
        assert result.uv_prime[number] == pytest.approx(colour.uv_prime(seen), abs=COLOUR)


def test_standard_error_is_that_of_other_seeds() -> None:
    place = [[0.0, 0.0, 0.0]]
    runs = [eyebox_luminance(device(), place, rays=4_000, seed=seed) for seed in range(10)]
    scatter = np.std([run.mean_cd_m2[0] for run in runs], ddof=1)
    claimed = np.mean([run.error_cd_m2[0] for run in runs])
    assert 0.4 * claimed < scatter < 2.0 * claimed


def test_same_seed_same_numbers_whatever_the_picture() -> None:
    places = [[0.0, 0.0, 0.0]]
    chart = eyebox_luminance(device(display__image="chart"), places, rays=RAYS, seed=3)
    white = eyebox_luminance(device(display__image="white"), places, rays=RAYS, seed=3)
    assert chart.mean_cd_m2 == white.mean_cd_m2


def test_up_is_like_down() -> None:
    places = [[x, y, 0.0] for y in (4.0, -4.0) for x in (-6.0, 6.0)]
    result = eyebox_luminance(device(), places, rays=RAYS)
    upper, lower = result.mean_cd_m2.reshape(2, 2)
    limit = SIGMAS * np.hypot(*result.error_cd_m2.reshape(2, 2))
    assert np.all(abs(upper - lower) <= limit)


def test_pupils_at_several_depths_in_one_walk() -> None:
    places = [[0.0, 0.0, z] for z in (0.0, 5.0)]
    both = eyebox_luminance(device(), places, rays=RAYS, light=GREEN)
    alone = eyebox_luminance(device(), places[1:], rays=RAYS, light=GREEN)
    assert both.mean_cd_m2[1] == alone.mean_cd_m2[0]
    slope = field(48, 24)[:, :, None, :]
    expected = LUMINANCE * unfolded(slope, GREEN_NM, disc(97) - 5.0 * slope).mean()
    assert near(both, expected, QUADRATURE)[1]


def test_the_housing_shades_the_pupil() -> None:
    width = 2.6
    places = [[HOUSING_EDGE + x, 0.0, 0.0] for x in (-0.7, 0.7)]
    spec = axial(in_width=width)
    clear, shaded = eyebox_luminance(spec, places, rays=RAYS, light=GREEN).mean_cd_m2
    assert clear > 0.0
    assert shaded == 0.0


def test_dark_places() -> None:
    assert eyebox_luminance(device(), [[0, 40, 0]], rays=RAYS).mean_cd_m2[0] == 0.0
    closed = eyebox_luminance(device(eta=0.0), [[0, 0, 0]], rays=RAYS)
    assert closed.mean_cd_m2[0] == 0.0
    assert np.all(np.isnan(closed.uv_prime))


def test_a_pupil_behind_the_lens_is_refused() -> None:
    with pytest.raises(SpecError, match=r"positions_mm: z must be .* -14, got -15"):
        eyebox_luminance(device(), [[0, 0, -15]], rays=RAYS)
    with pytest.raises(SpecError, match="rays: must be at least 16, got 3"):
        eyebox_luminance(device(), [[0, 0, 0]], rays=3)


def test_white_light_has_the_white_point() -> None:
    uv = colour.uv_prime(colour.xyz_of(white_light(device().display)))
    assert uv == pytest.approx(colour.uv_prime(colour.white_point("D65")), abs=1e-6)
