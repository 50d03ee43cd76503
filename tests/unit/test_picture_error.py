# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of pictures against a reference: numbers that are known beforehand come out again."""

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.colour import LINEAR_REC709_TO_XYZ, uv_prime
from hoe_addon.core.errors import SpecError
from hoe_addon.core.picture_error import (
    COLUMNS,
    ROWS,
    Reference,
    colour_difference,
    emitter_field,
    lit_regions,
    luminance_error,
    modulation,
    pareto_front,
    reference_of,
    worst_region,
)
from hoe_addon.core.picture_pieces import Pieces, relative_luminance

HEIGHT, WIDTH = 48, 64
EVERYWHERE = np.ones((HEIGHT, WIDTH), dtype=bool)
SIGMAS = 4.5
"""Bound of a deviation in its standard errors: one test in 100,000 fails by chance."""


def scene() -> NDArray[np.float64]:
    """A picture with a bright half and a dim half, mean luminance 1."""
    picture = np.full((HEIGHT, WIDTH, 3), 1.5)
    picture[:, WIDTH // 2 :] = 0.5
    return picture


def rendered(
    rng: np.random.Generator, truth: NDArray[np.float64], samples: int, sigma: float = 1.0
) -> NDArray[np.float64]:
    """A picture whose samples have a relative deviation; grey noise, so luminance has it too."""
    noise = rng.normal(0.0, sigma / samples**0.5, truth.shape[:2])
    return truth * (1.0 + noise[..., None])


def judged_by(rng: np.random.Generator, truth: NDArray[np.float64], samples: int) -> Reference:
    counts = (samples // 4, samples // 4, samples // 4, samples // 4)
    return reference_of(Pieces([rendered(rng, truth, n) for n in counts], counts), EVERYWHERE)


def relative(truth: NDArray[np.float64], sigma: float) -> float:
    """Relative RMSE that noise in proportion to the truth makes."""
    values = relative_luminance(truth)
    return sigma * float(np.sqrt(np.mean(values**2)) / values.mean())


def test_noise_and_bias_add_up_as_squares(rng: np.random.Generator) -> None:
    truth, bias = scene(), 0.1
    found = luminance_error(rendered(rng, truth * (1.0 + bias), 100), judged_by(rng, truth, 10000))
    expected = np.hypot(relative(truth, 0.1 * (1.0 + bias)), relative(truth, bias))
    assert abs(found.value - expected) < SIGMAS * found.standard_error
    assert found.standard_error < 0.02


def test_noise_of_the_reference_is_taken_off(rng: np.random.Generator) -> None:
    """A reference as noisy as the picture would otherwise make its error 1.4 times too large."""
    truth = scene()
    found = luminance_error(rendered(rng, truth, 100), judged_by(rng, truth, 100))
    expected = relative(truth, 0.1)
    assert abs(found.value - expected) < SIGMAS * found.standard_error
    assert expected * 2**0.5 - found.value > SIGMAS * found.standard_error


def test_standard_error_is_honest(rng: np.random.Generator) -> None:
    """Over many pictures, the deviation by its standard error has a variance of about one."""
    truth = scene()
    scores = []
    for _ in range(200):
        found = luminance_error(rendered(rng, truth, 25), judged_by(rng, truth, 1000))
        scores.append((found.value - relative(truth, 0.2)) / found.standard_error)
    # 16 groups give Student's distribution with 15 degrees of freedom: variance 15 / 13.
    assert abs(np.mean(scores)) < 0.35
    assert 0.8 < np.std(scores) < 1.4


def test_own_error_of_the_reference(rng: np.random.Generator) -> None:
    truth = scene()
    assert judged_by(rng, truth, 400).own_error() == pytest.approx(relative(truth, 0.05), rel=0.05)


def test_variance_of_a_sample_from_unequal_pieces(rng: np.random.Generator) -> None:
    counts = (4, 4, 8, 16, 32)
    flat = np.ones((200, 200, 3))
    pieces = Pieces([rendered(rng, flat, n, sigma=0.5) for n in counts], counts)
    assert pieces.sample_variance().mean() == pytest.approx(0.25, rel=0.02)
    assert np.var(relative_luminance(pieces.mean())) == pytest.approx(0.25 / 64, rel=0.05)


def test_single_piece_says_nothing_of_its_noise() -> None:
    assert np.all(np.isinf(Pieces([scene()], [8]).sample_variance()))


def test_worst_region_is_the_one_that_is_off(rng: np.random.Generator) -> None:
    truth = scene()
    reference = judged_by(rng, truth, 1_000_000)
    wrong = truth.copy()
    wrong[:8, :8] *= 1.2
    noise = np.full((HEIGHT, WIDTH), 1e-4)
    found = worst_region(wrong, noise, reference)
    assert found.value == pytest.approx(0.2, abs=1e-3)
    assert found.standard_error == pytest.approx((1e-4 / 64) ** 0.5 / 1.5, rel=0.05)


def test_dark_regions_do_not_count(rng: np.random.Generator) -> None:
    truth = scene()
    truth[:8, :8] = 0.01
    reference = judged_by(rng, truth, 1_000_000)
    wrong = truth.copy()
    wrong[:8, :8] = 0.0
    assert worst_region(wrong, np.zeros((HEIGHT, WIDTH)), reference).value < 0.01
    assert len(lit_regions(reference)) == ROWS * COLUMNS - 1


def test_regions_cover_the_field_once(rng: np.random.Generator) -> None:
    field = np.zeros((HEIGHT, WIDTH), dtype=bool)
    field[5:40, 7:60] = True
    pieces = Pieces([rendered(rng, scene(), 4) for _ in range(2)], (4, 4))
    regions = lit_regions(reference_of(pieces, field))
    assert np.array_equal(np.sum(regions, axis=0), field)


def test_colour_difference_of_a_known_shift(rng: np.random.Generator) -> None:
    truth = scene()
    reference = judged_by(rng, truth, 1_000_000)
    tinted = truth * np.array([1.1, 1.0, 0.9])
    white, tint = (
        uv_prime(LINEAR_REC709_TO_XYZ @ np.array(colour)) for colour in ((1, 1, 1), (1.1, 1.0, 0.9))
    )
    found = colour_difference(tinted, reference.picture, reference)
    assert found.value == pytest.approx(float(np.hypot(*(tint - white))), rel=1e-3)
    assert colour_difference(truth * 2.0, truth, reference).value < 1e-12


@pytest.mark.parametrize("contrast", [0.0, 0.3, 1.0])
def test_modulation_of_a_wave(contrast: float) -> None:
    place = (np.arange(64) + 0.5) / 64
    wave = 2.0 * (1.0 + contrast * np.cos(2.0 * np.pi * 8 * place + 0.7))
    # Neither twice the frequency nor half of it belongs to it.
    others = 0.2 * np.cos(2.0 * np.pi * 16 * place) + 0.3 * np.cos(2.0 * np.pi * 4 * place)
    assert modulation(wave + others, 8) == pytest.approx(contrast, abs=1e-12)


def test_modulation_of_black() -> None:
    assert modulation(np.zeros(64), 8) == 0.0


def test_pareto_front() -> None:
    seconds = [1.0, 2.0, 3.0, 4.0, 2.0]
    errors = [0.5, 0.3, 0.4, 0.1, 0.2]
    assert pareto_front(seconds, errors) == [0, 4, 3]
    assert pareto_front([], []) == []


def test_emitter_field_leaves_faint_light_out() -> None:
    light = np.zeros((20, 20, 3))
    light[:2] = 1.0
    light[2:4] = 0.01
    assert np.array_equal(np.flatnonzero(emitter_field(light).any(axis=1)), [0, 1])
    assert not emitter_field(np.zeros((20, 20, 3))).any()


def test_field_without_pixels_means_the_whole_picture() -> None:
    pieces = Pieces([scene(), scene()], (4, 4))
    assert reference_of(pieces, np.zeros((HEIGHT, WIDTH), dtype=bool)).field.all()


@pytest.mark.parametrize(
    ("pieces", "message"),
    [
        (Pieces([scene()] * 3, (4, 4, 8)), "samples: must come in equal pairs"),
        (Pieces([scene()] * 2, (4, 8)), "samples: must come in equal pairs"),
        (Pieces([0.0 * scene()] * 2, (4, 4)), "reference: must not be black"),
    ],
)
def test_reference_that_cannot_be(pieces: Pieces, message: str) -> None:
    with pytest.raises(SpecError, match=message):
        reference_of(pieces, EVERYWHERE)


def test_pieces_need_samples_each() -> None:
    with pytest.raises(SpecError, match="samples: must be one for each of 1 pictures"):
        Pieces([scene()], (4, 4))
