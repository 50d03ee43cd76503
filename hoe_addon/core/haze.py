# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scattering haze: how much of an order a rough surface scatters, and where that light goes.

The lobe is Gaussian in the direction cosines in the tangent plane, the same around every direction.
The offset is symmetric, so between two directions that both can be left in, light is scattered as
much one way as the other. Light whose new direction would be evanescent keeps that of its order: no
energy is lost.
"""

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float, dot, unit


def rough_share(
    roughness: ArrayLike,
    wavelength: ArrayLike,
    normal_in: ArrayLike,
    normal_out: ArrayLike,
    *,
    reflected: bool,
) -> FloatArray:
    """Return the share of an order that a rough surface scatters (total integrated scatter).

    ``1 - exp(-(2 pi sigma g / lambda)^2)``, where g is the change of n cos along the normal:
    ``n cos - n' cos'`` transmitted, and ``n (cos + cos')`` reflected, which at the specular
    direction is the well-known ``(4 pi sigma n cos / lambda)^2``. It is the same for a ray and its
    reverse.

    Args:
        roughness: Root mean square sigma of the heights, metres, broadcastable.
        wavelength: Vacuum wavelength, metres, broadcastable.
        normal_in: n cos of the incident light, at least 0, broadcastable.
        normal_out: n' cos' of the order, at least 0, broadcastable.
        reflected: Whether the order goes back.

    Returns:
        Shares in [0, 1], broadcast shape.

    References:
        Bennett and Porteus (1961), Relation between surface roughness and specular reflectance at
        normal incidence, J. Opt. Soc. Am. 51, 123.
        Harvey, Choi, Krywonos, Marcen (2010), Scattering from moderately rough interfaces between
        two arbitrary media, Proc. SPIE 7794.
    """
    before, after = as_float(normal_in), as_float(normal_out)
    change = before + after if reflected else before - after
    phase = 2.0 * np.pi * as_float(roughness) * change / as_float(wavelength)
    return -np.expm1(-(phase**2))


def scattered(
    direction: ArrayLike,
    normal: ArrayLike,
    sine: ArrayLike,
    share: ArrayLike,
    draws: ArrayLike,
) -> FloatArray:
    """Scatter a share of the rays of an order.

    Args:
        direction: Unit directions of the order, shape ``(..., 3)``.
        normal: Unit normals, to either side, broadcastable to ``(..., 3)``.
        sine: Standard deviation of each direction cosine, broadcastable to ``(...)``.
        share: Share that is scattered, 0 to 1, broadcastable to ``(...)``.
        draws: Uniform numbers in [0, 1): whether, how far and where, shape ``(..., 3)``.

    Returns:
        Unit directions, on the same side of the surface, shape ``(..., 3)``.

    References:
        Box and Muller (1958), A note on the generation of random normal deviates, Ann. Math.
        Statist. 29, 610.
    """
    heading, numbers = as_float(direction), as_float(draws)
    upward = np.broadcast_to(as_float(normal), heading.shape)
    cosine = dot(heading, upward)
    radius = as_float(sine) * np.sqrt(-2.0 * np.log1p(-numbers[..., 1]))
    turn = 2.0 * np.pi * numbers[..., 2]
    x, y = _tangents(upward)
    offset = (radius * np.cos(turn))[..., None] * x + (radius * np.sin(turn))[..., None] * y
    squared = cosine**2 - dot(offset, 2.0 * heading + offset)
    moved = (numbers[..., 0] < as_float(share)) & (squared > 0.0)
    lift = np.copysign(np.sqrt(np.where(moved, squared, 0.0)), cosine) - cosine
    return np.where(moved[..., None], heading + offset + lift[..., None] * upward, heading)


def _tangents(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit tangents at right angles; the lobe is round, so any two will do."""
    steep = np.abs(normal[..., :1]) > np.sqrt(0.5)
    start = np.where(steep, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    x = unit(start - dot(start, normal)[..., None] * normal)
    return x, np.cross(normal, x)
