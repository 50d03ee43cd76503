# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of orders: evanescent ones are exactly 0, and the fold of total internal reflection."""

import numpy as np
import pytest

from hoe_addon.core.arrays import unit
from hoe_addon.core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch, order_weights
from hoe_addon.core.ray_law import Status

AXIS = np.array([0.0, 0.0, 1.0])
STEEP = unit([np.sin(np.radians(60.0)), 0.0, np.cos(np.radians(60.0))])
FLAT = unit([np.sin(np.radians(10.0)), 0.0, np.cos(np.radians(10.0))])
PLUS_ONE = Branch(1)


@pytest.mark.parametrize("fold", [False, True])
def test_evanescent_orders_carry_exactly_nothing(fold: bool) -> None:
    branches = (Branch(-1), PLUS_ONE, TRANSMITTED_ZERO, REFLECTED_ZERO)
    fan = order_weights(
        branches,
        [0.2, 0.3, 0.4, 0.05],
        STEEP,
        AXIS,
        (-1.3, 0.0, 0.0),
        1.0,
        1.5,
        1.0,
        total_internal_reflection=fold,
    )
    assert fan.branches == branches
    assert fan.status.tolist() == [
        Status.EVANESCENT,
        Status.OK,
        Status.EVANESCENT,
        Status.OK,
    ]
    assert fan.weights.tolist() == [0.0, 0.3, 0.0, 0.4 + 0.05 if fold else 0.05]
    assert np.isnan(fan.directions[[0, 2]]).all()
    np.testing.assert_allclose(fan.directions[3], STEEP * [1, 1, -1], atol=1e-15)


def test_fold_adds_the_reflected_order_and_leaves_other_rays_alone() -> None:
    fan = order_weights(
        (PLUS_ONE, TRANSMITTED_ZERO),
        [0.3, 0.7],
        np.stack([STEEP, FLAT]),
        AXIS,
        (-1.3, 0.0, 0.0),
        1.0,
        1.5,
        1.0,
        total_internal_reflection=True,
    )
    assert fan.branches == (PLUS_ONE, TRANSMITTED_ZERO, REFLECTED_ZERO)
    assert fan.weights.tolist() == [[0.3, 0.0, 0.7], [0.0, 0.7, 0.0]]


def test_fold_is_reciprocal(rng: np.random.Generator) -> None:
    directions = unit(rng.normal(loc=(0.0, 0.0, 1.5), size=(300, 3)))

    def shares(incident: np.ndarray) -> np.ndarray:
        return order_weights(
            (TRANSMITTED_ZERO,),
            [0.6],
            incident,
            AXIS,
            (0.2, 0.1, 0.0),
            1.0,
            1.5,
            1.0,
            total_internal_reflection=True,
        ).weights

    there = shares(directions)
    back = shares(directions * [-1.0, -1.0, 1.0])  # the reverse of the mirror image
    assert (there[:, 1] > 0.0).any()
    np.testing.assert_array_equal(there, back)


NOT_RECORDED = np.full(3, np.nan)


def test_all_light_goes_straight_on_where_nothing_is_recorded() -> None:
    fan = order_weights(
        (PLUS_ONE, TRANSMITTED_ZERO, REFLECTED_ZERO),
        [0.5, 0.25, 0.125],
        FLAT,
        AXIS,
        np.stack((NOT_RECORDED, np.zeros(3))),
        1.0,
        1.0,
        1.5,
        total_internal_reflection=False,
    )
    absent = Status.UNDEFINED
    assert fan.status.tolist() == [[absent, Status.OK, absent], [Status.OK] * 3]
    assert fan.weights.tolist() == [[0.0, 1.0, 0.0], [0.5, 0.25, 0.125]]
    assert np.isnan(fan.directions[0, [0, 2]]).all()
    # Order 0 is plain refraction.
    np.testing.assert_allclose(fan.directions[0, 1, 0], FLAT[0] / 1.5, rtol=1e-14)


def test_order_zero_is_added_where_nothing_is_recorded_and_it_is_not_listed() -> None:
    gradients = np.stack((NOT_RECORDED, np.zeros(3)))
    args = ([0.5], FLAT, AXIS, gradients, 1.0, 1.0, 1.5)
    fan = order_weights((PLUS_ONE,), *args, total_internal_reflection=False)
    assert fan.branches == (PLUS_ONE, TRANSMITTED_ZERO)
    assert fan.weights.tolist() == [[0.0, 1.0], [0.5, 0.0]]


@pytest.mark.parametrize("fold", [False, True])
def test_trapped_light_is_reflected_where_nothing_is_recorded(fold: bool) -> None:
    args = ([0.5], STEEP, AXIS, NOT_RECORDED, 1.0, 1.5, 1.0)
    fan = order_weights((PLUS_ONE,), *args, total_internal_reflection=fold)
    assert fan.weights.sum() == (1.0 if fold else 0.0)
    if fold:
        assert fan.branches == (PLUS_ONE, TRANSMITTED_ZERO, REFLECTED_ZERO)
        assert fan.status.tolist() == [Status.UNDEFINED, Status.EVANESCENT, Status.OK]


def test_nothing_changes_where_everything_is_recorded(rng: np.random.Generator) -> None:
    gradient = rng.uniform(-1.0, 1.0, (50, 3))
    branches = (PLUS_ONE, TRANSMITTED_ZERO)
    args = (AXIS, gradient, 1.0, 1.5, 1.0)
    alone = order_weights(branches, [0.3, 0.7], STEEP, *args, total_internal_reflection=True)
    gradient = np.concatenate((gradient, NOT_RECORDED[None]))
    args = (AXIS, gradient, 1.0, 1.5, 1.0)
    beside = order_weights(branches, [0.3, 0.7], STEEP, *args, total_internal_reflection=True)
    assert beside.branches == alone.branches
    np.testing.assert_array_equal(beside.weights[:-1], alone.weights)
    np.testing.assert_array_equal(beside.directions[:-1], alone.directions)
    np.testing.assert_array_equal(beside.status[:-1], alone.status)
