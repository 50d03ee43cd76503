# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Integrals of functions that are smooth between known breaks, such as tabulated spectra."""

from collections.abc import Callable

import numpy as np

from .arrays import FloatArray


def gauss_points(edges: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Two-point Gauss rule on each interval: exact for cubics between the edges.

    Args:
        edges: Ends of the intervals, increasing, shape ``(n + 1,)``.

    Returns:
        Points and weights, each of shape ``(n, 2)``; the integral of f is the sum of
        ``weights * f(points)``.
    """
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    points = middle + half * (np.array([-1.0, 1.0]) / np.sqrt(3.0))
    return points, np.broadcast_to(half, points.shape)


def hat_areas(nodes: FloatArray) -> FloatArray:
    """Area below the hat function of each node: 1 there, 0 at its neighbours, straight between.

    Args:
        nodes: Increasing, shape ``(n,)``.

    Returns:
        Areas in the unit of the nodes, shape ``(n,)``.
    """
    half = 0.5 * np.diff(nodes)
    return np.append(half, 0.0) + np.append(0.0, half)


def hat_integrals(
    function: Callable[[FloatArray], FloatArray], nodes: FloatArray, breaks: FloatArray
) -> FloatArray:
    """Integral of a function times the hat function of each node.

    Args:
        function: Maps points of shape ``(m, 2)`` to values of shape ``(m, 2, channels)``; smooth
            between the breaks. Where it is there a quadratic, the result is exact.
        nodes: Increasing, shape ``(n,)``.
        breaks: Where the function bends, any order; those outside the nodes do no harm.

    Returns:
        Integrals, shape ``(n, channels)``; their sum is the integral over the range of the nodes.
    """
    inside = breaks[(breaks > nodes[0]) & (breaks < nodes[-1])]
    edges = np.union1d(nodes, inside)
    points, weights = gauss_points(edges)
    cell = np.searchsorted(nodes, edges[:-1], side="right") - 1
    share = ((points - nodes[cell, None]) / np.diff(nodes)[cell, None])[..., None]
    values = weights[..., None] * function(points)
    result = np.zeros((nodes.size, values.shape[-1]))
    np.add.at(result, cell, np.sum(values * (1.0 - share), axis=1))
    np.add.at(result, cell + 1, np.sum(values * share, axis=1))
    return result
