# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ray law: invariants, exactness near grazing and near the evanescent limit."""

from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.core.arrays import unit
from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.recording import Recording
from hoe_addon.core.waves import PlaneWave, PointSource, Wave

AXIS = np.array([0.0, 0.0, 1.0])
COUNT = 500
EPS = float(np.finfo(np.float64).eps)
UNIT_LENGTH = 8 * EPS
"""A handful of roundings; the length is not restored by a division."""
RETURN = 1e-12
"""Two passes, with up to 1 / cos = 1e3 times the rounding in the normal part."""
BACKWARD_ERROR = 32 * EPS
"""Error of (n' cos')^2: a dozen roundings of terms of up to (2 n)^2 = 13."""


def propagation_direction(wave: Wave, points: np.ndarray) -> np.ndarray:
    return wave.gradient(points) / wave.index


def random_rays(rng: np.random.Generator, count: int = COUNT) -> np.ndarray:
    return unit(rng.normal(size=(count, 3)))


def random_case(rng: np.random.Generator) -> dict[str, Any]:
    return {
        "direction": random_rays(rng),
        "normal": random_rays(rng),
        "gradient": 0.6 * rng.normal(size=(COUNT, 3)),
        "order": rng.integers(-3, 4, COUNT),
        "wavelength_ratio": rng.uniform(0.7, 1.4, COUNT),
        "index_in": rng.choice([1.0, 1.33, 1.5, 1.9], COUNT),
        "index_out": rng.choice([1.0, 1.33, 1.5, 1.9], COUNT),
        "reflected": rng.random(COUNT) < 0.5,
    }


def exact(case: dict[str, Any], row: int) -> tuple[mpf, list[mpf]]:
    """Return (n' cos')^2 and the direction (NaN if evanescent) with 50 digits."""

    def vector(values: np.ndarray) -> list[mpf]:
        return [mpf(float(value)) for value in values]

    def normalised(values: list[mpf]) -> list[mpf]:
        length = mp.sqrt(sum(value**2 for value in values))
        return [value / length for value in values]

    def tangent(values: list[mpf]) -> list[mpf]:
        along = sum(v * n for v, n in zip(values, normal, strict=True))
        return [v - along * n for v, n in zip(values, normal, strict=True)]

    normal = normalised(vector(case["normal"][row]))
    ray = normalised(vector(case["direction"][row]))
    n_in = mpf(float(case["index_in"][row]))
    back = bool(case["reflected"][row])
    n_out = n_in if back else mpf(float(case["index_out"][row]))
    scale = int(case["order"][row]) * mpf(float(case["wavelength_ratio"][row]))
    parts = zip(tangent(ray), tangent(vector(case["gradient"][row])), strict=True)
    along = [n_in * s + scale * g for s, g in parts]
    squared = n_out**2 - sum(value**2 for value in along)
    if squared < 0:
        return squared, [mp.nan] * 3
    cos_in = sum(s * n for s, n in zip(ray, normal, strict=True))
    sign = (1 if cos_in >= 0 else -1) * (-1 if back else 1)
    root = sign * mp.sqrt(squared)
    return squared, [(t + root * n) / n_out for t, n in zip(along, normal, strict=True)]


def check_against_exact(case: dict[str, Any]) -> None:
    directions, status = diffract(**case)
    with mp.workdps(50):
        for row in range(len(directions)):
            squared, expected = exact(case, row)
            if abs(squared) < BACKWARD_ERROR:
                continue
            assert status[row] == (Status.OK if squared > 0 else Status.EVANESCENT)
            if squared > 0:
                error = max(
                    abs(float(d) - e) for d, e in zip(directions[row], expected, strict=True)
                )
                assert error < BACKWARD_ERROR / mp.sqrt(min(squared, 1))
            else:
                assert np.isnan(directions[row]).all()


def test_random_cases_meet_50_digits(rng: np.random.Generator) -> None:
    check_against_exact(random_case(rng))


def test_near_the_evanescent_limit_meets_50_digits(rng: np.random.Generator) -> None:
    case = random_case(rng)
    count = 200
    case = {key: value[:count] for key, value in case.items()}
    case["normal"] = np.broadcast_to(AXIS, (count, 3))
    case["order"] = rng.choice([-2, -1, 1, 2], count)
    n_out = np.where(case["reflected"], case["index_in"], case["index_out"])
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    excess = 10.0 ** rng.uniform(-14, -3, count) * rng.choice([-1.0, 1.0], count)
    wanted = (n_out * (1.0 + excess))[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    step = wanted - case["index_in"][:, None] * case["direction"][:, :2]
    scale = (case["order"] * case["wavelength_ratio"])[:, None]
    case["gradient"] = np.column_stack([step / scale, rng.normal(size=count)])
    check_against_exact(case)


def test_near_grazing_incidence_meets_50_digits(rng: np.random.Generator) -> None:
    case = random_case(rng)
    cosine = 10.0 ** rng.uniform(-12, -2, COUNT) * rng.choice([-1.0, 1.0], COUNT)
    angle = rng.uniform(0.0, 2.0 * np.pi, COUNT)
    sine = np.sqrt((1.0 - cosine) * (1.0 + cosine))
    case["direction"] = np.column_stack([sine * np.cos(angle), sine * np.sin(angle), cosine])
    case["normal"] = np.broadcast_to(AXIS, (COUNT, 3))
    check_against_exact(case)
    case |= {"order": 0, "index_out": case["index_in"]}
    directions, status = diffract(**case)
    assert (status == Status.OK).all()
    sign = np.where(case["reflected"], -1.0, 1.0)
    # Order 0 between equal media keeps each digit of the small cosine.
    np.testing.assert_allclose(directions[:, 2], sign * cosine, rtol=4 * EPS)


def test_evanescent_exactly_at_the_limit() -> None:
    kicks = np.array([np.nextafter(1.0, 0.0), 1.0, np.nextafter(1.0, 2.0)])
    gradient = np.column_stack([kicks, np.zeros(3), np.zeros(3)])
    directions, status = diffract(AXIS, AXIS, gradient, 1, 1.0, 1.0, 1.0, False)
    assert status.tolist() == [Status.OK, Status.OK, Status.EVANESCENT]
    np.testing.assert_array_equal(directions[1], [1.0, 0.0, 0.0])
    assert np.isnan(directions[2]).all()


def test_output_is_unit_and_goes_to_the_right_side(rng: np.random.Generator) -> None:
    case = random_case(rng)
    directions, status = diffract(**case)
    fine = status == Status.OK
    assert 100 < fine.sum() < COUNT
    np.testing.assert_allclose(np.linalg.norm(directions[fine], axis=1), 1.0, atol=UNIT_LENGTH)
    before = np.sum(case["direction"] * case["normal"], axis=1)
    after = np.sum(directions * case["normal"], axis=1)
    assert np.array_equal((before * after < 0.0)[fine], case["reflected"][fine])


def test_the_side_of_the_normal_does_not_matter(rng: np.random.Generator) -> None:
    case = random_case(rng)
    directions, status = diffract(**case)
    turned, turned_status = diffract(**(case | {"normal": -case["normal"]}))
    assert np.array_equal(status, turned_status)
    assert np.array_equal(directions, turned, equal_nan=True)


def test_reversed_ray_returns_with_the_same_order(rng: np.random.Generator) -> None:
    case = random_case(rng)
    directions, status = diffract(**case)
    cosine = np.abs(np.sum(case["direction"] * case["normal"], axis=1))
    fine = (status == Status.OK) & (cosine > 1e-3)
    n_out = np.where(case["reflected"], case["index_in"], case["index_out"])
    back = case | {"direction": -directions, "index_in": n_out, "index_out": case["index_in"]}
    returned, status = diffract(**back)
    assert (status[fine] == Status.OK).all()
    np.testing.assert_allclose(-returned[fine], case["direction"][fine], atol=RETURN)


@pytest.mark.parametrize("order", [1, -1])
def test_read_out_with_one_wave_gives_the_other(order: int, rng: np.random.Generator) -> None:
    points = np.column_stack([rng.uniform(-0.02, 0.02, (COUNT, 2)), np.zeros(COUNT)])
    recording = Recording(
        PointSource((0.01, 0.005, -0.1), index=1.5),
        PointSource((-0.03, 0.01, 0.2), converging=True, index=1.2),
        532e-9,
    )
    waves = (recording.reference, recording.object)
    read, wanted = waves if order == 1 else waves[::-1]
    directions, status = diffract(
        propagation_direction(read, points),
        AXIS,
        recording.gradient(points),
        order,
        1.0,
        read.index,
        wanted.index,
        False,
    )
    assert (status == Status.OK).all()
    np.testing.assert_allclose(directions, propagation_direction(wanted, points), atol=4 * EPS)


def test_reflection_hologram_gives_its_object_wave(rng: np.random.Generator) -> None:
    points = np.column_stack([rng.uniform(-0.02, 0.02, (COUNT, 2)), np.zeros(COUNT)])
    wave = PointSource((0.0, 0.01, 0.05), converging=False)  # travels back, toward -z
    recording = Recording(wave, PlaneWave((0.1, 0.0, 1.0)), 532e-9)
    gradient = recording.gradient(points)
    read = propagation_direction(recording.reference, points)
    directions, _ = diffract(read, AXIS, gradient, 1, 1.0, 1.0, 1.5, True)
    np.testing.assert_allclose(directions, propagation_direction(wave, points), atol=4 * EPS)


def test_two_gratings_of_opposite_vector_cancel(rng: np.random.Generator) -> None:
    directions = random_rays(rng)
    ratio = rng.uniform(0.7, 1.4, COUNT)
    gradient = 0.4 * rng.normal(size=(COUNT, 3))
    first, status = diffract(directions, AXIS, gradient, 1, ratio, 1.0, 1.5, False)
    second, _ = diffract(first, AXIS, -gradient, 1, ratio, 1.5, 1.0, False)
    fine = (status == Status.OK) & (np.abs(directions[:, 2]) > 1e-3)
    assert fine.sum() > 100
    np.testing.assert_allclose(second[fine], directions[fine], atol=RETURN)


def test_the_normal_part_of_the_gradient_does_not_act(rng: np.random.Generator) -> None:
    case = random_case(rng) | {"normal": np.broadcast_to(AXIS, (COUNT, 3))}
    directions, _ = diffract(**case)
    shifted, _ = diffract(**(case | {"gradient": case["gradient"] + 5.0 * AXIS}))
    assert np.array_equal(directions, shifted, equal_nan=True)


def test_arguments_broadcast() -> None:
    directions, status = diffract(
        np.full((4, 1, 3), [0.0, 0.0, 1.0]), AXIS, (0.3, 0, 0), [-1, 0, 1], 1.0, 1.0, 1.5, False
    )
    assert directions.shape == (4, 3, 3)
    assert status.shape == (4, 3)
    single, status = diffract(AXIS, AXIS, (0.3, 0.0, 0.0), 1, 1.0, 1.0, 1.5, False)
    assert single.shape == (3,)
    assert status.shape == ()
    np.testing.assert_array_equal(single, directions[0, 2])


def test_nan_is_undefined() -> None:
    directions, status = diffract([np.nan, 0, 1], AXIS, (0.3, 0, 0), 1, 1.0, 1.0, 1.5, False)
    assert status == Status.UNDEFINED
    assert np.isnan(directions).all()
