# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Phase depth of a relief at critical angles and at its design wavelength, in numpy and Cycles."""

from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.efficiency import kinoform
from hoe_addon.core.media import constant
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.rays import RayTable
from tests.hard_cases.osl_values import float32, values_of
from tests.hard_cases.test_kinoform import DIGITS, RELATIVE, upright

INDEX = 1.5
EDGES = tuple(
    float(np.float32(edge + sign * 10.0**-k)) if k else edge
    for edge in (0.0, 1.0, INDEX)
    for sign in (1, -1)
    for k in (0, 1, 2, 3, 4, 5, 6, 7)
)
"""Tangential parts along the normal, at the critical angle of air and at that of the relief."""

SQUARE = 2e-16
"""Rounding of t^2 in double precision, and below in float32: the cosines are roots of what is left
of it, and have lost half of their digits where that is nothing."""

SQUARE_OSL = 1.5e-7


def exact_depth(along: float, across: float) -> tuple[mpf, mpf]:
    """n cos theta - cos theta_air over n - 1, and the smaller of the two cosines' parts."""
    squared = mpf(along) ** 2 + mpf(across) ** 2
    roots = [mp.sqrt(max(limit - squared, mpf(0))) for limit in (mpf(INDEX) ** 2, mpf(1))]
    nearest = min(abs(mpf(INDEX) ** 2 - squared), abs(1 - squared))
    return (roots[0] - roots[1]) / (mpf(INDEX) - 1), mp.sqrt(nearest)


def check_depths(rows: list[tuple[float, float]], found: NDArray[np.float64], ulp: float) -> None:
    with mp.workdps(DIGITS):
        for row, answer in zip(rows, found.tolist(), strict=True):
            expected_depth, nearest = exact_depth(*row)
            allowed = 4.0 * ulp + 4.0 * ulp / max(nearest, mp.sqrt(ulp))
            assert abs(answer - expected_depth) <= allowed, (row, answer)


def depth_rows() -> list[tuple[float, float]]:
    turned = [(0.6 * t, 0.8 * t) for t in EDGES]
    return [*((t, 0.0) for t in EDGES), *((0.0, -t) for t in EDGES), *turned]


def test_phase_depth_at_the_critical_angles() -> None:
    rows = depth_rows()
    found = kinoform.phase_depth(532e-9, 532e-9, constant(INDEX), np.array(rows))
    check_depths(rows, found, SQUARE)
    assert found[rows.index((0.0, 0.0))] == 1.0


@pytest.mark.render
def test_phase_depth_at_the_critical_angles_in_cycles(clean_scene: Any) -> None:
    rows = [(float(x), float(y)) for x, y in float32(depth_rows())]
    straight = f"hoe_straight_depth(1.0, {INDEX}, {INDEX}, 532.0, 532.0)"
    found = values_of(clean_scene, f"hoe_oblique_depth({straight}, {INDEX}, a[0], a[1])", rows)
    check_depths(rows, found, SQUARE_OSL)
    assert found[rows.index((0.0, 0.0))] == 1.0


WEIGHT = 1.1e-5
"""Cycles leaves out closures below a weight of 1e-5."""

DEPTH_SLOPE = 1.7 * 4e-7
"""A share moves by at most 1.7 a wave; a wave of depth carries four roundings of 1e-7."""


@pytest.mark.render
@pytest.mark.parametrize(("levels", "waves"), [(0, 1), (2, 20), (8, 1), (1024, 20)])
def test_design_wavelength_through_the_real_shader(levels: int, waves: int) -> None:
    """A relief of whole waves lit at its design wavelength has the one order, and no other."""
    orders = tuple(range(waves - 2, waves + 3))
    spec = hologram_from(
        {
            "schema": 1,
            "name": "whole waves",
            "surface": {"shape": "plane", "size_mm": [10, 10]},
            "media": {"back": 1.0, "front": 1.0},
            "characteristic": {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 5},
            "efficiency": {
                "model": "kinoform",
                "design_wavelength_nm": 532,
                "relief": "N-BK7",
                "levels": levels,
                "depth_waves": waves,
            },
            "orders": list(orders),
        }
    )
    count = len(orders)
    down = np.tile((0.0, 0.0, 1.0), (count, 1))
    rays = RayTable(
        -5.0 * down, down, np.full(count, 532.0), np.array(orders), np.zeros(count, dtype=bool)
    )
    with mp.workdps(DIGITS):
        exact = np.array([float(upright(m, float(waves), levels)) for m in orders])
    found = trace_cycles(spec, rays).efficiency
    assert np.all(np.abs(found - exact) <= WEIGHT + DEPTH_SLOPE * waves)
    assert np.all(np.abs(trace(spec, rays).efficiency - exact) <= RELATIVE)
    if levels in (0, 1024):
        assert np.max(found) > 0.99
