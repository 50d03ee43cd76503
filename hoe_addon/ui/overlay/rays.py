# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Chief rays as lines."""

import numpy as np

from ...core.arrays import BoolArray
from ...model.chief_rays import Pieces
from . import colours
from .lines import Lines

_OPACITY = 0.9
_ROUND_MM = 6
"""Decimals to which pieces of several wavelengths are compared."""


def ray_lines(pieces: Pieces) -> Lines:
    """Draw rays in the colour of their wavelength; before they split they are white.

    Args:
        pieces: The rays.

    Returns:
        Lines in mm, in the frame of the pieces; what goes on into the open fades away.
    """
    rgb = np.array([colours.of_wavelength(float(nm)) for nm in pieces.nm]).reshape(-1, 3)
    shown = np.ones(len(pieces.nm), dtype=np.bool_)
    if len(np.unique(pieces.nm)) > 1:
        together, shown = _together(pieces)
        rgb[together] = colours.MIXED
    opacity = np.full((len(rgb), 2), _OPACITY)
    opacity[pieces.is_open, 1] = 0.0
    return Lines.of(pieces.ends_mm[shown], rgb[shown], opacity[shown])


def _together(pieces: Pieces) -> tuple[BoolArray, BoolArray]:
    """Which pieces several wavelengths share, and which are drawn: of equal ones the first."""
    # Adding 0 makes one of the two zeros.
    keys = np.round(pieces.ends_mm.reshape(-1, 6), _ROUND_MM) + 0.0
    _, first, back, count = np.unique(
        keys, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    shown = np.zeros(len(keys), dtype=np.bool_)
    shown[first] = True
    return count[back.ravel()] > 1, shown
