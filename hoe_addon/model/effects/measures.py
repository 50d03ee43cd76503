# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a hologram and of the rays that meet it, for the sentences of a plan."""

import numpy as np

from ...core.arrays import FloatArray, dot
from ...core.units import mm_to_m
from ..convert import pattern_from
from ..element import element_shape
from ..hologram import HologramSpec
from .errors import hits_of
from .sight import Sight
from .walk import Hits

_DRAW_SEED = 20260816


def largest_move(sight: Sight, name: str, given: HologramSpec, simple: HologramSpec) -> float:
    """Tell how far the picture is moved by a simpler pattern.

    Args:
        sight: The rays of the picture.
        name: Name of the hologram in the document.
        given: The hologram.
        simple: The simpler hologram.

    Returns:
        The largest change of direction in order 1, in pixels.
    """
    most = 0.0
    full, plain = pattern_from(given.pattern), pattern_from(simple.pattern)
    rng = np.random.default_rng(_DRAW_SEED)
    for hits in hits_of(sight, name):
        points = mm_to_m(hits.points_mm)
        draws = rng.random((len(points), full.draws)) if full.draws else None
        apart = np.nan_to_num(plain.gradient(points) - full.gradient(points, draws))
        nm = sight.walk.levels[hits.level].rays.nm[hits.rays]
        moved = np.linalg.norm(apart, axis=-1) * nm / given.pattern.wavelength_nm
        most = max(most, float(np.max(moved, initial=0.0)) / sight.pixel_angle)
    return most


def lines_per_mm(spec: HologramSpec) -> float:
    """Tell the grating frequency at the centre of a hologram, 1/mm."""
    gradient = np.asarray(pattern_from(spec.pattern).gradient(np.zeros(3))).reshape(3)
    return float(np.hypot(gradient[0], gradient[1])) / spec.pattern.wavelength_nm * 1e6


def incidence_deg(spec: HologramSpec, hits: Hits) -> FloatArray:
    """Tell the angles to the normal of the rays of some hits, degrees, shape ``(n,)``."""
    normal = element_shape(spec).normal(mm_to_m(hits.points_mm))
    return np.degrees(np.arccos(np.clip(np.abs(dot(hits.way, normal)), 0.0, 1.0)))
