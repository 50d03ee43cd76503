# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of shares: interpolation, edges, the stochastic form, reciprocity, and their rules."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency import Incidence
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch

ROUNDING = 1e-13
BRANCHES = (Branch(0), Branch(1), Branch(1, reflected=True))
FREQUENCY = 3e5
WAVELENGTH = np.array([400e-9, 500e-9, 700e-9])
ALONG = np.array([-0.6, -0.1, 0.0, 0.8])
ACROSS = np.array([-0.5, 0.4])
X = np.array([-1e-2, 0.0, 3e-2])
Y = np.array([-2e-2, 2e-2])
FEW_SIGMA = 4.5
"""Passed by chance in all but 1 of 100,000 seeds; the seed is fixed."""


def light(
    rng: np.random.Generator, count: int, widen: float = 1.0, index: float = 1.5
) -> Incidence:
    """Random light on both sides, from glass at the back."""
    cosines = rng.uniform(-0.5, 0.4, (count, 2)) * widen
    from_front = rng.random(count) < 0.5
    back, front = np.full(count, index), np.ones(count)
    return Incidence(
        wavelength=rng.uniform(400e-9, 700e-9, count),
        tangential=np.where(from_front, front, back)[:, None] * cosines,
        from_front=from_front,
        index_back=back,
        index_front=front,
        frequency=np.full(count, FREQUENCY),
        place=rng.uniform(-1e-2, 2e-2, (count, 2)),
    )


def linear(wavelength: Any, along: Any, across: Any, x: Any, y: Any, front: Any) -> Any:
    """Linear in each of its arguments, but not in all together; three shares of at most 1."""
    first = 0.2 + 0.1 * along + 4e4 * (wavelength - 550e-9) * across * (1.0 + front)
    second = 0.3 + 2.0 * x * along + 3.0 * y * across
    return np.stack(np.broadcast_arrays(first, second, 0.1 + 0.02 * along * across), axis=-1)


def table(**changes: Any) -> EfficiencyTable:
    front = np.array([0.0, 1.0])
    mesh = np.meshgrid(front, WAVELENGTH, ALONG, ACROSS, X, Y, indexing="ij")
    values = linear(*mesh[1:], mesh[0])
    made = EfficiencyTable(BRANCHES, WAVELENGTH, ALONG, ACROSS, X, Y, ("back", "front"), values)
    return replace(made, **changes)


def expected(rays: Incidence) -> Any:
    cosines = rays.tangential / rays.index_in[:, None]
    parts = (cosines[:, 0], cosines[:, 1], rays.place[:, 0], rays.place[:, 1])
    return linear(rays.wavelength, *parts, rays.from_front)


def test_multilinear_data_are_met_exactly(rng: np.random.Generator) -> None:
    rays = light(rng, 500)
    assert table().shares(BRANCHES, rays) == pytest.approx(expected(rays), abs=ROUNDING)


def test_branches_in_any_order_and_unknown_ones(rng: np.random.Generator) -> None:
    rays = light(rng, 50)
    found = table().shares((BRANCHES[2], Branch(5), BRANCHES[0]), rays)
    assert found[:, 0] == pytest.approx(expected(rays)[:, 2], abs=ROUNDING)
    assert not found[:, 1].any()
    assert found[:, 2] == pytest.approx(expected(rays)[:, 0], abs=ROUNDING)


def test_any_shape_of_rays(rng: np.random.Generator) -> None:
    rays = light(rng, 6)
    names = ("wavelength", "from_front", "index_back", "index_front", "frequency")
    parts = {name: getattr(rays, name).reshape(2, 3) for name in names}
    shaped = Incidence(
        tangential=rays.tangential.reshape(2, 3, 2), place=rays.place.reshape(2, 3, 2), **parts
    )
    found = table().shares(BRANCHES, shaped)
    assert found.shape == (2, 3, 3)
    assert np.array_equal(found.reshape(6, 3), table().shares(BRANCHES, rays))
    draws = rng.random((2, 3, 6))
    assert table().stochastic(shaped, draws).shape == (2, 3)


def test_beyond_the_nodes(rng: np.random.Generator) -> None:
    rays = light(rng, 400, widen=2.0)
    cosines = rays.tangential / rays.index_in[:, None]
    low, high = (np.array([ALONG[end], ACROSS[end]]) for end in (0, -1))
    moved = np.clip(cosines, low, high)
    nearest = replace(rays, tangential=moved * rays.index_in[:, None])
    clamped = table().shares(BRANCHES, rays)
    assert clamped == pytest.approx(expected(nearest), abs=ROUNDING)
    cut = table(beyond="zero").shares(BRANCHES, rays)
    far = np.any(moved != cosines, axis=-1)
    assert 0 < far.sum() < len(far)
    assert not cut[far].any()
    assert np.array_equal(cut[~far], clamped[~far])


def test_ends_are_inside_and_places_are_clamped(rng: np.random.Generator) -> None:
    rays = light(rng, 4)
    edge = np.array([[ALONG[0], ACROSS[0]], [ALONG[-1], ACROSS[-1]]] * 2)
    at_edge = replace(
        rays,
        wavelength=np.array([400e-9, 700e-9] * 2) * (1.0 + 1e-15),
        tangential=edge * rays.index_in[:, None] * (1.0 + 1e-15),
        place=np.full((4, 2), 1.0),
    )
    inside = replace(at_edge, place=np.tile([X[-1], Y[-1]], (4, 1)))
    cut = table(beyond="zero")
    assert (cut.shares(BRANCHES, at_edge)[:, 0] > 0.0).all()
    assert np.array_equal(cut.shares(BRANCHES, at_edge), cut.shares(BRANCHES, inside))


def test_a_collapsed_dimension_is_any_value(rng: np.random.Generator) -> None:
    values = np.full((1, 1, 1, 1, 1, 1, 1), 0.3)
    one = np.zeros(1)
    flat = EfficiencyTable(
        (Branch(1),), np.array([5e-7]), one, one, one, one, ("back",), values, "zero"
    )
    rays = replace(light(rng, 50, widen=2.0), from_front=np.zeros(50, dtype=bool))
    assert np.array_equal(flat.shares((Branch(1),), rays), np.full((50, 1), 0.3))


def test_a_missing_side_follows_by_reciprocity(rng: np.random.Generator) -> None:
    both = table()
    back_only = EfficiencyTable(BRANCHES, *both.axes, ("back",), both.values[:1])
    rays = light(rng, 300)
    found = back_only.shares(BRANCHES, rays)
    front = rays.from_front
    assert np.array_equal(found[~front], both.shares(BRANCHES, rays)[~front])
    for column, way in enumerate(BRANCHES):
        if way.reflected:
            assert not found[front, column].any()
            continue
        other = rays.reversed(way.steps, reflected=False)
        mirrored = both.shares((way,), other)[:, 0]
        assert found[front, column] == pytest.approx(mirrored[front], abs=ROUNDING)
    # The reversed ray of the order 0 comes the same way; that of the order 1 does not.
    straight = both.shares(BRANCHES, replace(rays, from_front=~front))
    assert not np.allclose(found[front], straight[front])


@pytest.mark.parametrize("sides", [("back", "front"), ("back",)])
def test_the_stochastic_form_has_the_same_means(
    rng: np.random.Generator, sides: tuple[str, ...]
) -> None:
    both = table()
    tried = replace(both, sides=sides, values=both.values[: len(sides)])
    one = light(rng, 8)
    count = 40_000
    chi_square = 0.0
    for row in range(8):
        names = ("wavelength", "tangential", "from_front", "index_back", "index_front")
        same = {name: np.repeat(getattr(one, name)[row : row + 1], count, axis=0) for name in names}
        rest = {
            name: np.repeat(getattr(one, name)[row : row + 1], count, axis=0)
            for name in ("frequency", "place")
        }
        rays = Incidence(**same, **rest)
        mean = tried.shares(BRANCHES, rays)[0]
        chosen = tried.stochastic(rays, rng.random((count, 6)))
        outcome = np.array([*mean, 1.0 - mean.sum()]) * count
        seen = np.bincount(np.where(chosen < 0, len(BRANCHES), chosen), minlength=4)
        live = outcome > 0.0
        assert not seen[~live].any()
        chi_square += float(np.sum((seen[live] - outcome[live]) ** 2 / outcome[live]))
    freedom = 8 * 3
    assert chi_square < freedom + FEW_SIGMA * np.sqrt(2.0 * freedom)


def test_the_stochastic_form_draws_nodes_only(rng: np.random.Generator) -> None:
    """At a node whose light is all in one order, no other order is ever chosen."""
    values = np.zeros((1, 2, 1, 1, 1, 1, 2))
    values[0, 0, ..., 0] = 1.0
    values[0, 1, ..., 1] = 1.0
    one = np.zeros(1)
    two = EfficiencyTable(
        BRANCHES[:2], np.array([400e-9, 700e-9]), one, one, one, one, ("back",), values
    )
    rays = replace(light(rng, 5000), from_front=np.zeros(5000, dtype=bool))
    draws = rng.random((5000, 6))
    chosen = two.stochastic(rays, draws)
    upper = draws[:, 0] < (rays.wavelength - 400e-9) / 300e-9
    assert np.array_equal(chosen, upper.astype(int))


def broken(name: str, change: Any) -> dict[str, Any]:
    array = getattr(table(), name).copy()
    change(array)
    return {name: array}


def set_at(place: Any, value: float) -> Any:
    def change(array: Any) -> None:
        array[place] = value

    return change


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (broken("values", set_at((1, 2, 0, 1, 0, 0, 1), np.nan)),
         "efficiency: must have a number at every node, got nan at incidence front, "
         "wavelength 700 nm, along -0.6, across 0.4, x -10 mm, y -20 mm, order 1 T"),
        (broken("values", set_at((0, 0, 1, 0, 0, 1, 2), -0.1)),
         "efficiency: must be at least 0, got -0.1 at incidence back, wavelength 400 nm, "
         "along -0.1, across -0.5, x -10 mm, y 20 mm, order 1 R"),
        (broken("values", set_at((0, 0, 0, 0, 0, 0, 0), 40.0)),
         r"efficiency: must be at most 1 \(shares, no percent\), got 40 at"),
        (broken("values", set_at((0, 0, 0, 0, 0, 0, 0), 0.9)),
         "efficiency: shares of one direction must sum to at most 1, got 1"),
        (broken("along", set_at(1, 0.5)), "along: must increase from row to row, got along 0"),
        (broken("along", set_at(1, -0.6)), "along: must increase"),
        (broken("along", set_at(3, 1.5)), "along: must be a cosine in .-1, 1., got 1.5 in row 4"),
        (broken("x", set_at(2, np.inf)), "x: must be finite, got inf in row 3"),
        (broken("wavelength", set_at(0, -1e-9)), "wavelength: must be above 0, got -1 nm in row 1"),
        ({"values": np.zeros((2, 3))}, "efficiency: must have the shape"),
        ({"beyond": "wrap"}, "beyond: must be clamp or zero, got 'wrap'"),
        ({"sides": ("back", "top")}, "incidence: must be back, front or both"),
        ({"branches": (Branch(0), Branch(0), Branch(1))}, "order: must be listed once each"),
        ({"y": np.zeros(0)}, "y: must be a list of at least one node"),
    ],
)  # fmt: skip
def test_rules(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError, match=message):
        table(**changes)


def test_rounding_of_sums_is_no_mistake() -> None:
    values = table().values.copy()
    values[0, 0, 0, 0, 0, 0] = (0.5, 0.5, 5e-7)
    assert table(values=values).size == values.size
