# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Extended sources: points drawn evenly by length and area, and the waves of these points."""

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.waves import Disc, ExtendedSource, Line, PointSource, Rectangle, TriangleMesh
from hoe_addon.core.waves.source_shapes import choose, cumulative

DRAWS = 40_000
ROUNDING = 1e-15
CHI_SQUARE_SIGMA = 4.5
"""A fixed seed; an even draw stays within 4.5 standard deviations in all but 1e-5 of seeds."""

DISC = Disc((0.01, 0.02, -0.1), (0.003, 0.0, 0.0), (0.0, 0.0, 0.002))
RECTANGLE = Rectangle((0.0, 0.0, -0.1), (0.003, 0.001, 0.0), (-0.001, 0.003, 0.0))
LINE = Line((0.01, 0.0, -0.1), (0.001, 0.002, 0.0))
MESH = TriangleMesh(
    np.array(
        [
            [[0, 0, 0], [4, 0, 0], [0, 3, 0]],
            [[0, 0, 0], [0, 0, 0], [1, 1, 1]],
            [[4, 0, 0], [4, 4, 2], [0, 3, 0]],
        ],
        dtype=float,
    )
)


def assert_even(counts: np.ndarray, expected: np.ndarray) -> None:
    """Pearson's chi-square over cells that have a chance, by its normal approximation."""
    used = expected > 0.0
    assert counts[~used].sum() == 0
    freedom = used.sum() - 1
    chi_square = np.sum((counts[used] - expected[used]) ** 2 / expected[used])
    assert abs(chi_square - freedom) < CHI_SQUARE_SIGMA * np.sqrt(2.0 * freedom)


def test_disc_is_even_by_area(rng: np.random.Generator) -> None:
    points = DISC.place(rng.random((DRAWS, 2))) - np.array(DISC.centre)
    assert np.abs(points[:, 1]).max() == 0.0
    a, b = points[:, 0] / 0.003, points[:, 2] / 0.002
    squared, azimuth = a**2 + b**2, np.arctan2(b, a)
    assert squared.max() < 1.0
    counts, *_ = np.histogram2d(squared, azimuth, bins=10, range=[[0, 1], [-np.pi, np.pi]])
    assert_even(counts.ravel(), np.full(100, DRAWS / 100))


def test_rectangle_is_even_by_area(rng: np.random.Generator) -> None:
    points = RECTANGLE.place(rng.random((DRAWS, 2))) - np.array(RECTANGLE.centre)
    a, b = (points @ np.array(axis) / 1e-5 for axis in (RECTANGLE.x, RECTANGLE.y))
    assert max(np.abs(a).max(), np.abs(b).max()) < 1.0
    counts, *_ = np.histogram2d(a, b, bins=10, range=[[-1, 1], [-1, 1]])
    assert_even(counts.ravel(), np.full(100, DRAWS / 100))


def test_line_is_even_by_length(rng: np.random.Generator) -> None:
    points = LINE.place(rng.random((DRAWS, 1))) - np.array(LINE.centre)
    along = points @ np.array(LINE.x) / 5e-6
    np.testing.assert_allclose(np.cross(points, LINE.x), 0.0, atol=1e-18)
    counts, _ = np.histogram(along, bins=50, range=(-1, 1))
    assert_even(counts, np.full(50, DRAWS / 50))


def test_mesh_is_even_by_area(rng: np.random.Generator) -> None:
    points = MESH.place(rng.random((DRAWS, 3)))
    areas = MESH.areas / MESH.areas.sum()
    assert areas[1] == 0.0
    counts = []
    for corners, area in zip(MESH.triangles, areas, strict=True):
        if area == 0.0:
            continue
        edges = np.stack((corners[1] - corners[0], corners[2] - corners[0]), axis=1)
        inside, *_ = np.linalg.lstsq(edges, (points - corners[0]).T, rcond=None)
        off = np.linalg.norm(edges @ inside - (points - corners[0]).T, axis=0)
        a, b = inside[:, (off < 1e-9) & (inside.min(axis=0) >= 0) & (inside.sum(axis=0) < 1.0)]
        # Nine triangles of equal area: cells of a 3 x 3 grid, halved by their diagonals.
        upper = (3 * a) % 1.0 + (3 * b) % 1.0 > 1.0
        cell = (3 * a).astype(int) * 6 + (3 * b).astype(int) * 2 + upper
        found, number = np.unique(cell, return_counts=True)
        assert len(found) == 9
        counts.append((number, area))
    assert sum(number.sum() for number, _ in counts) == DRAWS
    assert_even(
        np.concatenate([number for number, _ in counts]),
        np.concatenate([np.full(9, DRAWS * area / 9) for _, area in counts]),
    )


def test_triangles_are_chosen_by_their_share() -> None:
    shares = cumulative([0.0, 3.0, 0.0, 1.0, 0.0])
    np.testing.assert_array_equal(shares, [0.0, 0.75, 0.75, 1.0, 1.0])
    draws = [0.0, 0.7499, 0.75, 0.9999999]
    assert choose(shares, draws).tolist() == [1, 1, 3, 3]


@pytest.mark.parametrize("shape", [DISC, RECTANGLE, LINE])
def test_half_of_each_number_is_the_middle(shape: Disc | Rectangle | Line) -> None:
    point = (0.02, -0.01, 0.0)
    np.testing.assert_allclose(
        ExtendedSource(shape).gradient(point), PointSource(shape.centre).gradient(point), atol=1e-15
    )


@pytest.mark.parametrize("converging", [False, True])
@pytest.mark.parametrize("shape", [DISC, RECTANGLE, LINE, MESH])
def test_each_ray_meets_the_wave_of_its_own_point(
    shape: Disc | Rectangle | Line | TriangleMesh, converging: bool, rng: np.random.Generator
) -> None:
    wave = ExtendedSource(shape, converging, 1.4)
    points, draws = rng.normal(size=(2, 5, 3)), rng.random((2, 5, wave.draws))
    for at in np.ndindex(2, 5):
        source = PointSource(tuple(shape.place(draws[at])), converging, 1.4)
        np.testing.assert_allclose(
            wave.gradient(points, draws)[at], source.gradient(points[at]), atol=ROUNDING
        )
        np.testing.assert_allclose(
            wave.eikonal(points, draws)[at], source.eikonal(points[at]), atol=1e-14
        )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Disc((0, 0, np.nan), (1, 0, 0), (0, 1, 0)), "centre: must be three finite"),
        (lambda: Rectangle((0, 0, 0), (1, 0), (0, 1, 0)), "x: must be three finite"),
        (lambda: Line((0, 0, 0), (np.inf, 0, 0)), "x: must be three finite"),
        (lambda: TriangleMesh(np.zeros((2, 3, 3))), "triangles: must have an area above 0"),
        (lambda: TriangleMesh(np.zeros((0, 3, 3))), "triangles: must have an area above 0"),
        (lambda: TriangleMesh(np.zeros((2, 3))), "triangles: must be finite, shape"),
        (lambda: TriangleMesh(np.full((2, 3, 3), np.nan)), "triangles: must be finite"),
        (lambda: ExtendedSource(DISC, index=0.0), "index: must be at least 1, got 0.0"),
    ],
)
def test_bad_values_are_named(make, message: str) -> None:
    with pytest.raises(SpecError, match=f"^{message}"):
        make()
