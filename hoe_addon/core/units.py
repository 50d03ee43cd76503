# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths: SI inside `core`, nanometres and millimetres only at the edges."""

import numpy as np
from numpy.typing import NDArray

NM = 1e-9
UM = 1e-6
MM = 1e-3

# The functions divide by or multiply with whole numbers, which doubles hold exactly: so
# nm_to_m(532.0) is the very double 532e-9, which 532.0 * NM need not be.
_NM_PER_M = 1e9
_MM_PER_M = 1e3


def nm_to_m[T: (float, NDArray[np.float64])](value: T) -> T:
    """Convert nanometres to metres.

    Args:
        value: Length in nm, any shape.

    Returns:
        Length in m, same shape.
    """
    return value / _NM_PER_M


def m_to_nm[T: (float, NDArray[np.float64])](value: T) -> T:
    """Convert metres to nanometres.

    Args:
        value: Length in m, any shape.

    Returns:
        Length in nm, same shape.
    """
    return value * _NM_PER_M


def mm_to_m[T: (float, NDArray[np.float64])](value: T) -> T:
    """Convert millimetres to metres.

    Args:
        value: Length in mm, any shape.

    Returns:
        Length in m, same shape.
    """
    return value / _MM_PER_M


def m_to_mm[T: (float, NDArray[np.float64])](value: T) -> T:
    """Convert metres to millimetres.

    Args:
        value: Length in m, any shape.

    Returns:
        Length in mm, same shape.
    """
    return value * _MM_PER_M
