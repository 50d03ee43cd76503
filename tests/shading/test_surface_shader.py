# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface's part of the shader: which texts there are, and which numbers are sockets."""

import pytest

from hoe_addon.model.surface import (
    AsphereSurface,
    ConicSurface,
    CylinderSurface,
    PlaneSurface,
    SphereSurface,
)
from hoe_addon.shading.surface import hit_part, surface_part

SIZE = (40.0, 30.0)
SPHERE = SphereSurface(SIZE, 50.0)


def test_plane_adds_nothing() -> None:
    part = surface_part(PlaneSurface(SIZE), 1.0)
    assert (part.functions, part.parameters, part.code, part.sockets) == ("", "", "", {})


@pytest.mark.parametrize(
    "other",
    [
        SphereSurface(SIZE, -70.0),
        ConicSurface(SIZE, 50.0, -2.0),
        CylinderSurface(SIZE, 50.0, "x"),
    ],
)
def test_surfaces_of_second_degree_share_one_text(other: object) -> None:
    """A slider that bends an element compiles nothing."""
    first, second = surface_part(SPHERE, 1.0), surface_part(other, 1.0)  # type: ignore[arg-type]
    assert first.code == second.code
    assert first.parameters == second.parameters
    assert first.sockets != second.sockets


def test_lengths_are_in_scene_units() -> None:
    assert surface_part(SPHERE, 0.1).sockets["surface_curvature"] == pytest.approx(1.0 / 5.0)
    asphere = AsphereSurface((6.0, 8.0), 50.0, 0.0, (1e-4, 1e-6))
    small, large = (surface_part(asphere, units).sockets for units in (0.1, 1.0))
    assert large["surface_reach"] == pytest.approx(5.0)
    assert small["surface_reach"] == pytest.approx(0.5)
    # What the powers add is given at the reach, over the reach: no unit is left.
    assert large["surface_a4"] == small["surface_a4"] == pytest.approx(1e-4 * 125.0)
    assert large["surface_a6"] == small["surface_a6"] == pytest.approx(1e-6 * 3125.0)


def test_text_of_an_asphere_depends_on_the_count_of_coefficients_alone() -> None:
    one, other = (
        surface_part(AsphereSurface(SIZE, radius, 0.0, (value,)), 1.0)
        for radius, value in ((60.0, 1e-6), (-90.0, 2e-6))
    )
    assert (one.functions, one.code) == (other.functions, other.code)
    more = surface_part(AsphereSurface(SIZE, 60.0, 0.0, (1e-6, 1e-9)), 1.0)
    assert more.functions != one.functions


def test_only_a_formula_moves_the_hit() -> None:
    assert hit_part(SPHERE) == surface_part(SPHERE, 1.0)
    assert hit_part(PlaneSurface(SIZE)).code == ""
