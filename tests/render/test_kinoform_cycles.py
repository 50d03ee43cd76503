# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin reliefs in Cycles: the OSL functions against 50 digits and numpy, and oblique rays."""

from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.efficiency.profiles import Binary, Profile, Sawtooth, Sinusoid
from hoe_addon.core.efficiency.segments import Segments, Steps, joined_samples, triangle
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.rays import RayTable
from hoe_addon.shading.efficiency.relief import segments_function, steps_function
from tests.hard_cases.osl_values import values_of

pytestmark = pytest.mark.render

RELATIVE = 2e-6
"""Some 30 roundings of float32 (6e-8): two sines are divided and squared. Promised is 2e-5."""

ABSOLUTE = 2e-6
"""Of a share: alpha h of up to 20 waves is rounded by 1e-6 in single pieces of the sum."""

LEVELS = (0, 2, 3, 4, 5, 7, 8, 16, 63, 256, 1024)
OFFSETS = (0.0, *(sign * 10.0**-k for k in range(3, 13) for sign in (1, -1)))
DEEPEST = 20.0


def exact(order: int, alpha: float, levels: int) -> mpf:
    x = mpf(alpha) - order

    def sinc(value: mpf) -> mpf:
        return mpf(1) if value == 0 else mp.sinpi(value) / (mp.pi * value)

    if levels == 0:
        return sinc(x) ** 2
    below = levels * mp.sinpi(x / levels)
    kernel = mpf(1) if below == 0 else mp.sinpi(x) / below
    return (sinc(mpf(order) / levels) * kernel) ** 2


def singular_rows() -> list[tuple[float, ...]]:
    """Order, alpha in float32, levels: near every removable singularity, and at random."""
    draw = np.random.default_rng(5)
    rows: list[tuple[float, ...]] = []
    for levels in LEVELS:
        period = levels or 4
        orders = {0, 1, -1, 2, -3, period, -period, 2 * period, period + 1, 1 - period}
        for order in sorted(orders):
            alphas = [
                order + turns * period + offset for turns in (0, 1, -1, 2) for offset in OFFSETS
            ]
            alphas += [whole + offset for whole in (0, 1, 8, 20) for offset in OFFSETS[::3]]
            alphas += draw.uniform(0.0, DEEPEST, 8).tolist()
            near = {float(np.float32(alpha)) for alpha in alphas if abs(alpha) <= DEEPEST}
            rows += [(order, alpha, levels) for alpha in sorted(near)]
    return rows


def test_singular_points_against_fifty_digits(clean_scene: Any) -> None:
    rows = singular_rows()
    found = values_of(clean_scene, "hoe_kinoform_efficiency((int)a[0], a[1], a[2])", rows)
    worst = 0.0
    with mp.workdps(50):
        for (order, alpha, levels), answer in zip(rows, found, strict=True):
            expected = exact(int(order), alpha, int(levels))
            if expected == 0:
                assert answer == 0.0, (order, alpha, levels)
            elif expected > 1e-36:
                worst = max(worst, float(abs(mpf(answer) / expected - 1)))
    assert worst < RELATIVE


SAMPLES = np.random.default_rng(8).uniform(-0.3, 1.0, 64)
PROFILES: dict[str, tuple[str, Profile]] = {
    "walled continuous": (
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 0, 0.07)",
        Sawtooth(0, 0.07),
    ),
    "walled two": ("hoe_walled_kinoform_efficiency((int)a[0], a[1], 2, 0.2)", Sawtooth(2, 0.2)),
    "walled five": ("hoe_walled_kinoform_efficiency((int)a[0], a[1], 5, 0.1)", Sawtooth(5, 0.1)),
    "walled eight": (
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 8, 0.125)",
        Sawtooth(8, 0.125),
    ),
    "walled many": (
        "hoe_walled_kinoform_efficiency((int)a[0], a[1], 1024, 0.0005)",
        Sawtooth(1024, 0.0005),
    ),
    "sinusoid": ("hoe_sinusoid_efficiency((int)a[0], a[1])", Sinusoid()),
    "binary": ("hoe_binary_efficiency((int)a[0], a[1], 0.37)", Binary(0.37)),
    "triangle": ("hoe_profile_efficiency((int)a[0], a[1])", triangle(0.3)),
    "samples": ("hoe_profile_efficiency((int)a[0], a[1])", joined_samples(SAMPLES)),
    "steps": ("hoe_profile_efficiency((int)a[0], a[1])", Steps(SAMPLES)),
}


@pytest.mark.parametrize("name", PROFILES)
def test_profiles_against_numpy(clean_scene: Any, rng: np.random.Generator, name: str) -> None:
    call, profile = PROFILES[name]
    functions = ""
    if isinstance(profile, Segments):
        functions = segments_function(profile)
    elif isinstance(profile, Steps):
        functions = steps_function(profile)
    orders = np.concatenate((rng.integers(-20, 21, 1500), rng.integers(-100, 101, 500)))
    alphas = np.concatenate(
        (rng.uniform(0, 3, 1000), rng.uniform(0, DEEPEST, 900), np.arange(100) / 5)
    )
    alphas = alphas.astype(np.float32).astype(np.float64)
    found = values_of(clean_scene, call, list(zip(orders, alphas, strict=True)), functions)
    expected = profile.efficiency(orders, alphas)
    worst = float(np.max(np.abs(found - expected)))
    assert worst < ABSOLUTE
    assert np.max(expected) > 0.05


GRAZING = 3e-7
"""Error of the tangential part of n s in float32; near the limit of air or of the relief, where
n cos theta is a small root, the phase depth has an error of that over n cos theta."""

FLOAT32 = 1.1e-5
"""Cycles leaves out closures below a weight of 1e-5; above, float32 keeps 1e-6."""

SLOPE = 8.0
"""The depth has 2.7 waves per unit of n cos theta at most, t is up to 1.7, and a share moves by at
most 1.7 per wave."""

EFFICIENCIES = {
    "eight levels": {"levels": 8},
    "depth error and walls": {"levels": 0, "errors": {"depth_error": 0.07, "edge_width": 0.05}},
    "masks": {"levels": 8, "errors": {"etch_errors": [0.05, -0.1, 0.2], "duty_error": 0.02}},
    "binary": {"levels": 0, "profile": {"shape": "binary", "duty": 0.4}, "depth_waves": 0.5},
    "sinusoid": {"levels": 0, "profile": {"shape": "sinusoid"}, "depth_waves": 0.586},
    "triangle": {"levels": 0, "profile": {"shape": "triangle", "peak": 0.25}},
    "steps": {
        "levels": 0,
        "profile": {"shape": "sampled", "heights": [0, 0.7, 0.2, 1], "between": "steps"},
    },
    "straight": {"levels": 8, "angle_dependent": False},
}


@pytest.mark.slow
@pytest.mark.parametrize("name", EFFICIENCIES)
@pytest.mark.parametrize("back", [1.0, 1.7])
def test_oblique_rays_against_numpy(rng: np.random.Generator, name: str, back: float) -> None:
    """From both sides, beyond the critical angle of air too, at random wavelengths."""
    efficiency = {"model": "kinoform", "design_wavelength_nm": 532, "relief": 1.5}
    spec = hologram_from(
        {
            "schema": 1,
            "name": "relief",
            "surface": {"shape": "plane", "size_mm": [40, 40]},
            "media": {"back": back, "front": "N-BK7"},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.2, 0.1, 1]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": efficiency | EFFICIENCIES[name],
            "orders": [-1, 0, 1, 2],
        }
    )
    count = 1500
    cos, phi = rng.uniform(0.05, 1.0, count), rng.uniform(0.0, 2.0 * np.pi, count)
    sin, side = np.sqrt(1.0 - cos**2), rng.choice([-1.0, 1.0], count)
    direction = np.stack((sin * np.cos(phi), sin * np.sin(phi), side * cos), axis=1)
    rays = RayTable(
        -5.0 * direction,
        direction,
        rng.uniform(400.0, 750.0, count),
        rng.integers(-2, 3, count),
        np.zeros(count, dtype=bool),
    )
    found, expected = trace_cycles(spec, rays), trace(spec, rays)
    both = (found.status == Status.OK) & (expected.status == Status.OK)
    assert both.mean() > 0.5
    index = np.where(side > 0.0, back, 1.515)
    squared = (index * sin) ** 2
    roots = [np.sqrt(np.abs(limit - squared)) for limit in (1.0, 1.5**2)]
    allowed = FLOAT32 + SLOPE * GRAZING / np.maximum(np.minimum(*roots), 1e-4)
    error = np.abs(found.efficiency - expected.efficiency)
    assert np.all(error[both] <= allowed[both]), np.max((error / allowed)[both])
    assert np.median(expected.efficiency[both]) > 1e-4
