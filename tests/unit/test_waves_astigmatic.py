# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The toric wave of two line foci: rays through both, its fronts, far foci, bad values."""

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.errors import SpecError
from hoe_addon.core.waves import AstigmaticSource

ROUNDING = 1e-14
"""Lengths below 1 m and unit vectors, through some ten operations."""

PARAXIAL = 1e-5
"""Relative: the curvature is taken over 1e-6 of the distance, where rounding leaves 1e-9 and the
next term of the front 1e-6."""

ARRANGEMENTS = {
    "both before": ((0.003, 0.004, -0.05), (0.004, 0.005, -0.09), False),
    "arc nearer": ((0.004, 0.005, -0.09), (0.003, 0.004, -0.05), False),
    "both beyond": ((-0.003, 0.004, 0.12), (-0.002, 0.003, 0.07), True),
    "line before, arc beyond": ((0.002, 0.001, -0.06), (-0.002, 0.003, 0.09), True),
    "arc before, line beyond": ((0.002, 0.001, 0.075), (-0.002, 0.003, -0.065), False),
}
LINE = (1.0, -0.4, 0.1)


def frame(wave: AstigmaticSource) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors along the chief ray and the straight line."""
    chief = np.subtract(wave.second, wave.first)
    chief /= np.linalg.norm(chief)
    line = np.array(wave.line_direction) - chief * np.dot(wave.line_direction, chief)
    return chief, line / np.linalg.norm(line)


@pytest.mark.parametrize("name", ARRANGEMENTS)
def test_all_rays_pass_through_both_foci(name: str, rng: np.random.Generator) -> None:
    first, second, converging = ARRANGEMENTS[name]
    wave = AstigmaticSource(first, second, LINE, converging, 1.3)
    points = np.column_stack([rng.uniform(-0.01, 0.01, (200, 2)), np.zeros(200)])
    gradient = wave.gradient(points)
    directions = gradient / 1.3
    np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0, atol=ROUNDING)
    # The straight line: a ray crosses it where the two and their joint lie in one plane.
    _, line = frame(wave)
    joint = points - np.array(first)
    across = np.cross(directions, line)
    gap = np.sum(joint * across, axis=1) / np.linalg.norm(across, axis=1)
    np.testing.assert_allclose(gap, 0.0, atol=ROUNDING)
    # The arc: the eikonal is the distance to it along the ray.
    at_arc = points - directions * (wave.eikonal(points) / 1.3)[:, None]
    radius = np.linalg.norm(np.subtract(second, first))
    height = (at_arc - np.array(first)) @ line
    np.testing.assert_allclose(height, 0.0, atol=ROUNDING)
    np.testing.assert_allclose(np.linalg.norm(at_arc - first, axis=1), radius, atol=ROUNDING)
    # On the second focus's side of the circle, not on the other one.
    assert np.linalg.norm(at_arc - np.array(second), axis=1).max() < radius


@pytest.mark.parametrize("name", ARRANGEMENTS)
def test_which_way_the_wave_runs(name: str) -> None:
    """All these waves travel toward +z at the hologram."""
    first, second, converging = ARRANGEMENTS[name]
    wave = AstigmaticSource(first, second, LINE, converging)
    assert wave.gradient((0.0, 0.0, 0.0))[2] > 0.9


@pytest.mark.parametrize("name", ARRANGEMENTS)
def test_curvatures_on_the_chief_ray_are_those_of_the_two_distances(name: str) -> None:
    """The textbook beam: radius of curvature = distance to the focus, in each plane."""
    first, second, converging = ARRANGEMENTS[name]
    wave = AstigmaticSource(first, second, LINE, converging)
    chief, line = frame(wave)
    # The point of the chief ray in the hologram's plane.
    foot = np.array(first) - chief * (first[2] / chief[2])
    travel = wave.gradient(foot)
    for across, focus in ((line, second), (np.cross(chief, line), first)):
        step = 1e-6 * np.linalg.norm(foot - focus)
        change = wave.gradient(foot + step * across) - wave.gradient(foot - step * across)
        curvature = np.dot(change, across) / (2.0 * step)
        # Positive while the wave runs away from the focus.
        distance = np.dot(foot - focus, travel)
        assert curvature == pytest.approx(1.0 / distance, rel=PARAXIAL)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ((0.0, 3e8, -4e8), (0.001, 0.002, -0.1)),
        ((0.001, 0.002, -0.1), (0.0, 3e8, -4e8)),
        ((0.0, 3e8, 4e8), (0.001, 0.002, -0.1)),
        ((0.0, 3e8, -4e8), (0.0, 6e8, -9e8)),
    ],
    ids=["line far", "arc far", "line far beyond", "both far"],
)
def test_far_foci_against_fifty_digits(
    first: tuple[float, float, float], second: tuple[float, float, float], rng: np.random.Generator
) -> None:
    wave = AstigmaticSource(first, second, LINE)
    points = np.column_stack([rng.uniform(-0.01, 0.01, (20, 2)), np.zeros(20)])
    expected = np.array([exact_direction(wave, point) for point in points])
    np.testing.assert_allclose(wave.gradient(points), expected, atol=1e-12)


def exact_direction(wave: AstigmaticSource, point: np.ndarray) -> list[float]:
    """Away from the nearest point of the circle in the plane of point and axis."""
    with mp.workdps(50):
        first, second, line = (
            mp.matrix([mpf(value) for value in vector])
            for vector in (wave.first, wave.second, wave.line_direction)
        )
        place = mp.matrix([mpf(float(value)) for value in point])

        def dot(a: mp.matrix, b: mp.matrix) -> mpf:
            return (a.T * b)[0]

        chief = second - first
        line = line - chief * (dot(line, chief) / dot(chief, chief))
        line /= mp.norm(line)
        lateral = place - first
        lateral -= line * dot(lateral, line)
        toward = lateral / mp.norm(lateral) * (1 if dot(lateral, chief) > 0 else -1)
        away = place - (first + toward * mp.norm(chief))
        return [float(value) for value in away / mp.norm(away)]


def test_no_direction_on_the_foci() -> None:
    wave = AstigmaticSource((0, 0, -1.0), (0, 0, -2.0), (1, 0, 0))
    gradient = wave.gradient([[0.3, 0, -1.0], [0, 0, -2.0], [0, 0, 0]])
    assert np.isnan(gradient).any(axis=-1).tolist() == [True, True, False]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"first": (0, 0)}, "first: must be three finite numbers"),
        ({"second": (0, np.inf, 0)}, "second: must be three finite numbers"),
        ({"second": (0, 0, -1.0)}, "second: must not be the same place as first"),
        ({"line_direction": (0, 0, 0)}, "line_direction: must not have zero length"),
        ({"line_direction": (0, 0, -3.0)}, "line_direction: must not run along the chief ray"),
        ({"index": 0.5}, "index: must be at least 1, got 0.5"),
    ],
)
def test_bad_values_are_named(change: dict, message: str) -> None:
    good = {"first": (0, 0, -1.0), "second": (0, 0, -2.0), "line_direction": (1, 0, 0)}
    with pytest.raises(SpecError, match=f"^{message}"):
        AstigmaticSource(**(good | change))
