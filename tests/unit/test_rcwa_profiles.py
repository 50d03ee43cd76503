# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reliefs as layers: what is cut must be what was drawn."""

from collections.abc import Sequence

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.rcwa import Lamellar, Layer, Polygon, Uniform, polygon_layers, volume_layers
from hoe_addon.core.rcwa.crossing import check_simple
from hoe_addon.core.rcwa.reliefs import binary, sampled, sinusoid, staircase, trapezoid, triangle

EXACT = 1e-12


def material_at(layers: Sequence[Layer], x: float, z: float) -> int:
    """Material at a point, by walking up the layers."""
    for layer in layers:
        if z < layer.thickness:
            pattern = layer.pattern
            if isinstance(pattern, Uniform):
                return pattern.material
            assert isinstance(pattern, Lamellar)
            place = (x - layer.shift - pattern.walls[0]) % 1.0 + pattern.walls[0]
            return pattern.materials[int(np.searchsorted(pattern.walls, place, "right")) - 1]
        z -= layer.thickness
    raise AssertionError(z)


def height_of(layers: Sequence[Layer]) -> float:
    return sum(layer.thickness for layer in layers)


def inside(points: np.ndarray, x: float, z: float) -> bool:
    """Whether a point or one of its repetitions is in a polygon: ray casting, corner by corner."""
    found = False
    for k in range(-3, 4):
        crossings = 0
        for (x1, z1), (x2, z2) in zip(points, np.roll(points, -1, axis=0), strict=True):
            if (z1 > z) != (z2 > z) and x + k < x1 + (z - z1) * (x2 - x1) / (z2 - z1):
                crossings += 1
        found = found or crossings % 2 == 1
    return found


OUTLINES = {
    "overhanging": [[0.0, 0.0], [0.4, 0.0], [1.1, 0.4], [0.9, 0.6], [0.5, 0.3]],
    "hook": [[0.1, 0.0], [0.3, 0.0], [0.3, 0.8], [0.8, 0.8], [0.8, 0.5], [0.9, 0.5], [0.9, 1.0],
             [0.1, 1.0]],
    "wider than a period": [[-0.2, 0.0], [1.3, 0.9], [1.4, 0.9], [0.3, 0.0]],
    "rightward, below zero": [[0.7, -0.4], [0.1, -0.3], [0.2, 0.2]],
}  # fmt: skip


@pytest.mark.parametrize("name", OUTLINES)
def test_layers_hold_what_the_polygon_does(name: str, rng: np.random.Generator) -> None:
    points = np.array(OUTLINES[name])
    slices = 400
    layers = polygon_layers([Polygon(points, 5)], 7, slices)
    low, high = points[:, 1].min(), points[:, 1].max()
    assert height_of(layers) == pytest.approx(high - low, abs=EXACT)
    wrong = 0
    for x, share in rng.random((400, 2)):
        z = low + share * (high - low)
        expected = 5 if inside(points, x, z) else 7
        wrong += material_at(layers, x, z - low) != expected
    # A point within a slice's height of a slanted wall may fall on either side.
    assert wrong <= 8


def test_later_polygons_are_painted_over_earlier_ones() -> None:
    shell = Polygon(np.array([[0.1, 0.0], [0.9, 0.0], [0.9, 1.0], [0.1, 1.0]]), 3)
    core = Polygon(np.array([[0.3, 0.0], [0.7, 0.0], [0.7, 0.6], [0.3, 0.6]]), 4)
    layers = polygon_layers([shell, core], 1, 10)
    assert [layer.thickness for layer in layers] == pytest.approx([0.6, 0.4], abs=EXACT)
    assert [material_at(layers, x, 0.3) for x in (0.0, 0.2, 0.5, 0.8)] == [1, 3, 4, 3]
    assert [material_at(layers, x, 0.8) for x in (0.0, 0.2, 0.5, 0.8)] == [1, 3, 3, 3]


def test_upright_walls_make_one_layer_and_parallel_ones_copies() -> None:
    assert len(trapezoid(1.0, (0.2, 0.6), (0.2, 0.6), 50)) == 1
    slanted = trapezoid(1.0, (0.0, 0.4), (0.5, 0.9), 20)
    assert len(slanted) == 20
    assert len({layer.pattern for layer in slanted}) == 1
    shifts = np.diff([layer.shift for layer in slanted]) % 1.0
    np.testing.assert_allclose(shifts, 0.5 / 20, atol=EXACT)


def test_full_and_empty_slices_are_uniform() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5]])
    (layer,) = polygon_layers([Polygon(points, 2)], 1, 5)
    assert isinstance(layer.pattern, Uniform)
    assert layer.pattern.material == 2


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[0, 0], [0.5, 1], [0.5, 0], [0, 1]],
         r"points: edges must not cross, got edge 0 \(0, 0\)-\(0.5, 1\) across"
         r" edge 2 \(0.5, 0\)-\(0, 1\)$"),
        ([[0, 0], [0.3, 0], [0.3, 0.7], [1.2, 0.7], [1.2, 1], [0, 1]],
         r"edge 2 \(0.3, 0.7\)-\(1.2, 0.7\) across edge 5 \(0, 1\)-\(0, 0\) of the repetition 1"),
        ([[0, 0], [1, 0]], r"points: must be 3 or more pairs x, z, got \(2, 2\)"),
        ([[0, 0], [1, 0], [0.5, float("nan")]], "points: must be finite"),
        ([[0, 0], [0.5, 0], [0.2, 0]], "points: the relief must have a height above 0"),
    ],
)  # fmt: skip
def test_impossible_outlines(points: list[list[float]], message: str) -> None:
    with pytest.raises(SpecError, match=message):
        polygon_layers([Polygon(np.array(points, dtype=np.float64), 2)], 1, 10)


def test_edges_may_touch_their_repetition() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.2], [0.5, 1.0], [0.0, 0.2]])
    assert height_of(polygon_layers([Polygon(points, 2)], 1, 10)) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("layers", "height"),
    [
        (binary(2.0, 0.3), lambda x: 2.0 * (min(x, 1.0 - x) < 0.15)),
        (sinusoid(2.0, 500), lambda x: 1.0 + np.cos(2.0 * np.pi * x)),
        (triangle(2.0, 500, apex=1.0), lambda x: 2.0 * x),
        (triangle(2.0, 500, apex=0.25), lambda x: min(8.0 * x, 2.0 - 8.0 / 3.0 * (x - 0.25))),
        (staircase(2.0, 4), lambda x: 0.5 * np.floor(4.0 * x)),
        (sampled(2.0, 0.5 + 0.5 * np.sin(2.0 * np.pi * np.arange(256) / 256), 500),
         lambda x: 1.0 + np.sin(2.0 * np.pi * x)),
    ],
    ids=["binary", "sinusoid", "sawtooth", "triangle", "staircase", "sampled"],
)  # fmt: skip
def test_usual_reliefs(layers: Sequence[Layer], height: object, rng: np.random.Generator) -> None:
    assert callable(height)
    for x, share in rng.random((200, 2)):
        z = share * height_of(layers)
        if abs(z - height(x)) > 0.01:
            assert material_at(layers, x, z) == (0 if z < height(x) else 1), (x, z)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: binary(0.0), "depth: must be above 0, got 0.0"),
        (lambda: binary(1.0, 1.0), "duty: must be above 0 and below 1, got 1.0"),
        (lambda: staircase(1.0, 1), "levels: must be at least 2, got 1"),
        (lambda: triangle(1.0, 0), "slices: must be at least 1, got 0"),
        (lambda: sampled(1.0, [0.0, 1.2], 5), r"heights\[1\]: must be from 0 to 1, got 1.2"),
        (lambda: sampled(1.0, [0.3, float("nan")], 5), r"heights\[1\]: must .* got nan"),
        (lambda: sampled(1.0, [0.3, 0.3], 5), "heights: must not all be equal"),
        (lambda: volume_layers(-1.0, 0.0, mean=2, wave=3), "thickness: must be above 0, got -1.0"),
        (lambda: volume_layers(1.0, np.inf, mean=2, wave=3), "frequency_z: must be finite"),
        (lambda: Layer(Uniform(0), -1.0), "thickness: must be at least 0, got -1.0"),
        (lambda: Lamellar(np.array([0.5, 0.2]), (0, 1)), "walls: must ascend within one period"),
        (lambda: Lamellar(np.array([0.5]), (0,)), "walls: must be one for each of 2 or more"),
    ],
)  # fmt: skip
def test_bad_numbers(make: object, message: str) -> None:
    assert callable(make)
    with pytest.raises(SpecError, match=message):
        make()


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0, 0), (0.3, 0.25), (0.6, 0.5), (0.6, 0), (0, 0.5)], "edges must not cross"),
        ([(0, 0), (1.5, 0), (1.5, 0.5), (0, 0.5)], "must not overlap their own repetition"),
    ],
)
def test_crossings_through_a_corner_and_overlaps_are_refused(
    points: list[tuple[float, float]], message: str
) -> None:
    with pytest.raises(SpecError, match=message):
        check_simple(np.array(points, dtype=float))


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (1, 0), (1, 0.5), (0, 0.5)],
        [(0, 0), (0.5, 0), (2.5, 1), (2.0, 1)],
        [(0, 0), (0.5, 0.5), (1, 0), (1, 1), (0.5, 0.5), (0, 1)],
        [(0, 0), (0, 0.5), (0.5, 0.5), (0.5, 0)],
        [(0, 0), (0.8, 0), (0.8, 1), (0.6, 1), (0.6, 0.3), (0.3, 0.3), (0.3, 1), (0, 1)],
    ],
)
def test_outlines_that_touch_or_lean_far_are_fine(points: list[tuple[float, float]]) -> None:
    check_simple(np.array(points, dtype=float))
