# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How wrong a picture is that is a little sharper, or moved, by a share of a pixel.

Every pixel counts as if a sharp edge of full contrast crossed it at any place. A shift by d pixels
changes its light by d. A blur of the standard deviation d changes it only where the edge is near to
the pixel's rim: by d G(x / d) at the distance x, with G(t) the mean of s - t over the normal
distribution beyond t, and so by ``d^1.5 sqrt(2 int G^2) = 0.35 d^1.5`` in the mean square. Coarser
blurs count as d^2, which is more.
"""

import numpy as np

from ...core.arrays import FloatArray

_EDGE = 0.4
"""Above 0.35 / 0.86: the mean of a normal deviation to the power 1.5 is 0.86."""


def blur_error(pixels: FloatArray) -> FloatArray:
    """Give the relative error of light that is not moved as it should.

    Args:
        pixels: How far each ray is moved from its mean place, shape ``(...)``.

    Returns:
        Its part of the error, at most 1, shape ``(...)``.
    """
    moved = np.abs(pixels)
    return np.minimum(_EDGE * moved**1.5 + moved**2, 1.0)


def shift_error(pixels: FloatArray) -> FloatArray:
    """Give the relative error of light that is moved.

    Args:
        pixels: How far, shape ``(...)``.

    Returns:
        The error, at most 1, shape ``(...)``.
    """
    return np.minimum(np.abs(pixels), 1.0)
