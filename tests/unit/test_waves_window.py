# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wave of a point behind a flat window, against Snell's law solved with 40 digits."""

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.errors import SpecError
from hoe_addon.core.waves import FlatWindow, PointSource, WindowSource
from hoe_addon.core.waves.window import layer_tangents

DIRECTION = 1e-12
"""Asked for; the layers' sums lose a few digits of 1e-16 toward grazing."""

PATH = 1e-13
"""Of the path itself: some hundred roundings."""

SUM = 1e-14
"""Relative: the sum of three layers, some ten roundings each."""

BISECTIONS = 140
"""Halvings of the interval of the invariant: 2^-140 is below 40 digits."""


def exact(wave: WindowSource, point: np.ndarray) -> tuple[np.ndarray, float]:
    """Direction behind a window at z = 0 and optical path, by bisection of the invariant."""
    with mp.workdps(60):
        source = [mpf(value) for value in wave.position]
        place = [mpf(float(value)) for value in point]
        face = mpf(wave.window.position[2])
        thicknesses = [
            face - source[2],
            mpf(wave.window.thickness),
            place[2] - face - mpf(wave.window.thickness),
        ]
        indices = [mpf(wave.source_index), mpf(wave.window.index), mpf(wave.index)]
        layers = [(t, n) for t, n in zip(thicknesses, indices, strict=True) if t > 0]
        dx, dy = place[0] - source[0], place[1] - source[1]
        rho = mp.sqrt(dx**2 + dy**2)
        # From the side of grazing, so that its small cosine keeps its digits.
        low, high = mpf(0), min(n for _, n in layers)
        for _ in range(BISECTIONS):
            p = (low + high) / 2
            reached = sum(t * p / mp.sqrt(n**2 - p**2) for t, n in layers)
            low, high = (p, high) if reached < rho else (low, p)
        n = indices[2]
        direction = [p * dx / rho / n, p * dy / rho / n, mp.sqrt(n**2 - p**2) / n]
        path = p * rho + sum(t * mp.sqrt(n**2 - p**2) for t, n in layers)
        return np.array([float(value) for value in direction]), float(path)


CASES = {
    "usual": WindowSource((0.004, -0.003, -0.05), FlatWindow((0, 0, -0.02), (0, 0, 1), 3e-3, 1.5)),
    "thin window": WindowSource(
        (0.0, 0.0, -0.05), FlatWindow((0, 0, -0.02), (0, 0, 3), 1e-9, 1.5), index=1.33
    ),
    "boundary": WindowSource(
        (0.0, 0.01, -0.03), FlatWindow((0, 0, -0.01), (0, 0, 1)), source_index=1.6, index=1.4
    ),
    "thin gap of low index": WindowSource(
        (0.3, 0.0, -0.05),
        FlatWindow((0, 0, -0.02), (0, 0, 1), 1e-6, 1.0),
        source_index=1.5,
        index=1.5,
    ),
    "grazing behind": WindowSource(
        (1.5, 0.0, -0.05), FlatWindow((0, 0, -1e-4), (0, 0, 1)), source_index=1.7, index=1.0
    ),
    "far": WindowSource(
        (3e5, -4e5, -1e6), FlatWindow((0, 0, -0.02), (0, 0, 1), 5e-3, 1.6), index=1.2
    ),
    "near the axis": WindowSource(
        (1e-9, 0.0, -1.0), FlatWindow((0, 0, -0.5), (0, 0, 1), 0.1, 1.8), source_index=1.3
    ),
    "close to the face": WindowSource(
        (0.0, 0.0, -0.02 - 1e-9), FlatWindow((0, 0, -0.02), (0, 0, 1), 0.01, 1.4), index=1.7
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_direction_and_path_against_forty_digits(name: str, rng: np.random.Generator) -> None:
    wave = CASES[name]
    width = 1e-8 if name == "near the axis" else 0.01
    points = np.column_stack([rng.uniform(-width, width, (20, 2)), np.zeros(20)])
    answers = [exact(wave, point) for point in points]
    directions = np.array([direction for direction, _ in answers])
    paths = np.array([path for _, path in answers])
    np.testing.assert_allclose(
        wave.gradient(points) / wave.index, directions, rtol=0, atol=DIRECTION
    )
    np.testing.assert_allclose(wave.eikonal(points), paths, rtol=PATH)


def test_the_layers_add_up_to_the_lateral_distance(rng: np.random.Generator) -> None:
    """Thicknesses over nine powers of ten, and distances that only a thin low layer makes up."""
    count = 2000
    indices = np.array([1.3, 1.0, 1.6])
    thicknesses = 10.0 ** rng.uniform(-9, 0, (count, 3))
    excess = indices[[0, 2]] ** 2 - 1.0
    most = np.sum(thicknesses[:, [0, 2]] / np.sqrt(excess), axis=1)
    rho = most * (1.0 + rng.choice([-1.0, 1.0], count) * 10.0 ** rng.uniform(-12, 0, count))
    tangents = layer_tangents(rho, thicknesses, indices)
    assert tangents.max() > 1e4
    np.testing.assert_allclose(np.sum(thicknesses * tangents, axis=1), rho, rtol=SUM)
    sines = tangents / np.hypot(1.0, tangents)
    np.testing.assert_allclose(
        sines * indices, np.broadcast_to(sines[:, 1:2], (count, 3)), atol=SUM
    )


def test_equal_indices_are_a_point_source(rng: np.random.Generator) -> None:
    points = rng.uniform(-0.02, 0.02, (40, 3)) + np.array([0.0, 0.0, 0.03])
    window = FlatWindow((0.0, 0.01, 0.0), (0.1, 0.2, 1.0), 2e-3, 1.4)
    wave = WindowSource((0.01, 0.0, -0.1), window, source_index=1.4, index=1.4)
    point = PointSource((0.01, 0.0, -0.1), index=1.4)
    np.testing.assert_allclose(wave.gradient(points), point.gradient(points), atol=1e-14)
    np.testing.assert_allclose(wave.eikonal(points), point.eikonal(points), rtol=1e-14)


def test_on_the_axis_the_wave_goes_straight() -> None:
    wave = WindowSource((0, 0, -1.0), FlatWindow((0, 0, -0.5), (0, 0, 1), 0.1, 1.5), index=1.2)
    np.testing.assert_array_equal(wave.gradient((0.0, 0.0, 0.0)), (0.0, 0.0, 1.2))
    assert wave.eikonal((0.0, 0.0, 0.0)) == pytest.approx(0.5 + 0.15 + 0.48, abs=1e-15)


def test_converging_is_the_reverse(rng: np.random.Generator) -> None:
    points = rng.uniform(-0.02, 0.02, (10, 3)) + np.array([0.0, 0.0, 0.05])
    window = FlatWindow((0, 0, 0), (0, 0, 1), 2e-3, 1.5)
    away, toward = (WindowSource((0, 0, -0.1), window, beam) for beam in (False, True))
    assert np.array_equal(away.gradient(points), -toward.gradient(points))
    assert np.array_equal(away.eikonal(points), -toward.eikonal(points))


def test_no_light_before_the_window_or_inside_it() -> None:
    wave = WindowSource((0, 0, -0.1), FlatWindow((0, 0, 0), (0, 0, 1), 2e-3, 1.5))
    points = np.array([[0, 0, -0.2], [0, 0, -0.05], [0.01, 0, 1e-3], [0.01, 0, 2e-3], [0, 0, 1.0]])
    assert np.isnan(wave.gradient(points)).any(axis=-1).tolist() == [True] * 3 + [False] * 2
    assert np.isnan(wave.eikonal(points)).tolist() == [True] * 3 + [False] * 2


def test_total_reflection_on_the_far_face() -> None:
    """Place on the face itself: from glass to air only rays below the critical angle come out."""
    wave = WindowSource((0, 0, -1.0), FlatWindow((0, 0, 0), (0, 0, 1)), source_index=1.5)
    critical = 1.0 / np.sqrt(1.5**2 - 1.0)
    points = np.array([[critical * 0.999, 0, 0], [critical * 1.001, 0, 0]])
    gradient = wave.gradient(points)
    assert gradient[0, 0] == pytest.approx(0.999, abs=1e-3)
    assert np.isnan(gradient[1]).all()
    assert np.isnan(wave.eikonal(points)).tolist() == [False, True]


def test_a_film_without_thickness_is_no_film(rng: np.random.Generator) -> None:
    points = rng.uniform(-0.02, 0.02, (10, 3)) + np.array([0.0, 0.0, 0.05])
    waves = [
        WindowSource((0.3, 0, -0.01), FlatWindow((0, 0, 0), (0, 0, 1), 0.0, film), False, 1.5, 1.6)
        for film in (1.0, 1.55, 3.0)
    ]
    for wave in waves[1:]:
        assert np.array_equal(waves[0].gradient(points), wave.gradient(points))
        assert np.array_equal(waves[0].eikonal(points), wave.eikonal(points))
    assert np.isfinite(waves[0].eikonal(points)).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"position": (0, 0, np.nan)}, "position: must be three finite numbers"),
        ({"position": (0, 0, 1.0)}, "position: must lie before the window"),
        ({"position": (0, 0, 0.0)}, "position: must lie before the window"),
        ({"index": 0.9}, "index: must be at least 1, got 0.9"),
        ({"source_index": np.inf}, "source_index: must be at least 1, got inf"),
    ],
)
def test_bad_values_are_named(change: dict, message: str) -> None:
    good = {"position": (0, 0, -1.0), "window": FlatWindow((0, 0, 0), (0, 0, 1))}
    with pytest.raises(SpecError, match=f"^{message}"):
        WindowSource(**(good | change))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"position": (0, 0)}, "window.position: must be three finite numbers"),
        ({"normal": (0, 0, 0)}, "window.normal: must not have zero length"),
        ({"thickness": -1e-3}, "window.thickness: must be at least 0, got -0.001"),
        ({"thickness": np.nan}, "window.thickness: must be at least 0, got nan"),
        ({"index": 0.0}, "window.index: must be at least 1, got 0.0"),
    ],
)
def test_bad_windows_are_named(change: dict, message: str) -> None:
    with pytest.raises(SpecError, match=f"^{message}"):
        FlatWindow(**({"position": (0, 0, 0), "normal": (0, 0, 1)} | change))
