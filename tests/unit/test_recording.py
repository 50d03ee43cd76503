# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves: directions, gradients, far and near sources, bad values."""

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.errors import SpecError
from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.recording import Recording
from hoe_addon.core.waves import PlaneWave, PointSource, Wave

ROUNDING = 1e-15
"""A few roundings of components below 1."""


def propagation_direction(wave: Wave, points: np.ndarray) -> np.ndarray:
    return wave.gradient(points) / wave.index


def exact_direction(source: tuple[float, float, float], point: np.ndarray) -> np.ndarray:
    with mp.workdps(50):
        away = [mpf(float(p)) - mpf(s) for p, s in zip(point, source, strict=True)]
        length = mp.sqrt(sum(value**2 for value in away))
        return np.array([float(value / length) for value in away])


@pytest.mark.parametrize(
    "source",
    [
        (0.01, 0.005, -0.1),
        (3e5, -4e5, -1e6),
        (1e-9, 2e-9, 1e-12),
        (1e-3, 0.0, -1e-7),
        (1e200, 0.0, -1e200),
    ],
    ids=["usual", "far 1e9 mm", "near, nanometres", "grazing", "huge"],
)
def test_directions_of_far_and_near_sources(
    source: tuple[float, float, float], rng: np.random.Generator
) -> None:
    points = np.column_stack([rng.uniform(-0.02, 0.02, (50, 2)), np.zeros(50)])
    answers = propagation_direction(PointSource(source), points)
    expected = np.array([exact_direction(source, point) for point in points])
    np.testing.assert_allclose(answers, expected, rtol=0, atol=ROUNDING)


def test_converging_is_the_opposite_of_diverging(rng: np.random.Generator) -> None:
    points = rng.normal(size=(4, 5, 3))
    diverging = propagation_direction(PointSource((0.1, 0.2, 3.0)), points)
    converging = propagation_direction(PointSource((0.1, 0.2, 3.0), converging=True), points)
    assert np.array_equal(diverging, -converging)


def test_far_source_is_a_plane_wave(rng: np.random.Generator) -> None:
    points = rng.uniform(-0.01, 0.01, (20, 3))
    far = propagation_direction(PointSource((0.0, 6e14, -8e14)), points)
    plane = propagation_direction(PlaneWave((0.0, -3.0, 4.0)), points)
    assert far.shape == plane.shape == points.shape
    np.testing.assert_allclose(far, plane, rtol=0, atol=ROUNDING)


@pytest.mark.parametrize("shape", [(3,), (6, 3), (2, 3, 3)])
def test_gradient_is_the_difference_with_indices(
    shape: tuple[int, ...], rng: np.random.Generator
) -> None:
    points = rng.normal(size=shape)
    wave_o = PointSource((0.1, 0.0, -2.0), converging=True, index=1.5)
    wave_r = PlaneWave((0.6, 0.0, 0.8), index=1.7)
    gradient = Recording(wave_o, wave_r, 532e-9).gradient(points)
    expected = 1.5 * propagation_direction(wave_o, points) - 1.7 * np.array([0.6, 0.0, 0.8])
    np.testing.assert_allclose(gradient, expected, rtol=0, atol=ROUNDING)


def test_gradient_is_that_of_the_optical_paths(rng: np.random.Generator) -> None:
    step, noise = 1e-4, 1e-6  # step^2 for the cut-off, and 1e-16 / step for rounding
    source_o, source_r = np.array([0.1, 0.2, -1.0]), np.array([-0.3, 0.1, -2.0])
    recording = Recording(
        PointSource(tuple(source_o), index=1.2), PointSource(tuple(source_r)), 1.0
    )
    points = rng.normal(size=(30, 3))

    def characteristic(place: np.ndarray) -> np.ndarray:
        path_o = 1.2 * np.linalg.norm(place - source_o, axis=-1)
        return path_o - np.linalg.norm(place - source_r, axis=-1)

    steps = step * np.eye(3)
    numeric = np.stack(
        [(characteristic(points + s) - characteristic(points - s)) / (2 * step) for s in steps], -1
    )
    np.testing.assert_allclose(recording.gradient(points), numeric, atol=noise)


def test_point_on_its_source_has_no_direction_and_the_status_says_so() -> None:
    source = PointSource((1.0, 2.0, 0.0))
    recording = Recording(source, PlaneWave((0.0, 0.0, 1.0)), 532e-9)
    points = np.array([[1.0, 2.0, 0.0], [0.0, 0.0, 0.0]])
    assert np.isnan(propagation_direction(source, points)[0]).all()
    gradient = recording.gradient(points)
    axis = (0.0, 0.0, 1.0)
    _, status = diffract(axis, axis, gradient, 1, 0.5, 1.0, 1.0, False)
    assert status.tolist() == [Status.UNDEFINED, Status.OK]
    _, status = diffract(axis, axis, gradient, 0, 0.5, 1.0, 1.0, False)
    assert status.tolist() == [Status.OK, Status.OK]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: PlaneWave((0.0, 0.0, 0.0)), "direction: must not have zero length"),
        (lambda: PlaneWave((0.0, 0.0, np.nan)), "direction: must be three finite numbers"),
        (lambda: PlaneWave((1.0, 0.0)), "direction: must be three finite numbers"),  # pyright: ignore
        (lambda: PlaneWave((1.0, 0.0, 0.0), 0.5), "index: must be at least 1, got 0.5"),
        (lambda: PointSource((0.0, np.inf, 0.0)), "position: must be three finite numbers"),
        (lambda: PointSource((0.0, 0.0, 1.0), index=np.nan), "index: must be at least 1, got nan"),
        (
            lambda: Recording(PlaneWave((0, 0, 1)), PlaneWave((0, 0, 1)), 0.0),
            "wavelength: must be above 0, got 0.0",
        ),
    ],
)
def test_bad_values_are_named(make, message: str) -> None:
    with pytest.raises(SpecError, match=f"^{message}"):
        make()
