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


def test_order_zero_passes_where_the_gradient_is_not_defined() -> None:
    fan = order_weights(
        (TRANSMITTED_ZERO, PLUS_ONE),
        [0.5, 0.5],
        AXIS,
        AXIS,
        np.full(3, np.nan),
        1.0,
        1.0,
        1.5,
        total_internal_reflection=False,
    )
    assert fan.status.tolist() == [Status.OK, Status.UNDEFINED]
    assert fan.weights.tolist() == [0.5, 0.0]
