# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact rays through a lens of a scene, in numpy, and the focal length that they tell."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, as_float
from ..core.ray_law import diffract
from ..core.units import m_to_mm, mm_to_m, nm_to_m
from .evaluate import trace
from .medium import medium_from
from .rays import RayTable
from .scene_lens import FACES, Face, LensElement

type Orders = Mapping[Face, int]
"""Order to follow at the hologram of a face; 0 where none is named."""

_NEAR_AXIS = 1e-3
"""Height of a ray near the axis, as a share of the diameter: what departs with its square is then
far below a millionth of the focal length."""


def through_lens(
    lens: LensElement,
    start_mm: ArrayLike,
    direction: ArrayLike,
    wavelength_nm: ArrayLike,
    orders: Orders | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Send rays through a lens.

    Args:
        lens: The lens.
        start_mm: Where the rays start, in the frame of the lens, mm, shape ``(n, 3)``.
        direction: Unit directions of travel, all toward -z or all toward +z, shape ``(n, 3)``.
        wavelength_nm: Vacuum wavelengths, nm, broadcastable to ``(n,)``.
        orders: Orders to follow.

    Returns:
        Where they leave the lens, and unit directions behind it, each of shape ``(n, 3)``; NaN
        for a ray that misses a face or does not go on there.
    """
    place, heading = as_float(start_mm), as_float(direction)
    wavelength = np.broadcast_to(as_float(wavelength_nm), place.shape[:1])
    followed = orders or {}
    ahead = bool(np.all(heading[:, 2] > 0.0))
    for face in reversed(FACES) if ahead else FACES:
        vertex = np.array((0.0, 0.0, lens.vertex_z_mm(face)))
        local = place - vertex
        if lens.hologram(face) is None:
            place, heading = _refracted(lens, face, local, heading, wavelength)
        else:
            order = followed.get(face, 0)
            place, heading = _diffracted(lens, face, local, heading, wavelength, order)
        place = place + vertex
    return place, heading


def focal_length_mm(
    lens: LensElement, wavelength_nm: ArrayLike, orders: Orders | None = None
) -> FloatArray:
    """Find the focal length by exact rays that run near and parallel to the axis toward -z.

    Args:
        lens: The lens.
        wavelength_nm: Vacuum wavelengths, nm, shape ``(n,)``.
        orders: Orders to follow.

    Returns:
        Focal lengths, mm, above 0 for a lens that collects light, shape ``(n,)``.
    """
    wavelength = np.atleast_1d(as_float(wavelength_nm))
    height = _NEAR_AXIS * lens.diameter_mm
    start = np.tile((height, 0.0, lens.diameter_mm + lens.thickness_mm), (len(wavelength), 1))
    heading = np.tile((0.0, 0.0, -1.0), (len(wavelength), 1))
    _, left = through_lens(lens, start, heading, wavelength, orders)
    return height * left[:, 2] / left[:, 0]


def _diffracted(
    lens: LensElement,
    face: Face,
    start: FloatArray,
    heading: FloatArray,
    wavelength: FloatArray,
    order: int,
) -> tuple[FloatArray, FloatArray]:
    hologram = lens.hologram(face)
    assert hologram is not None, "asked for a face with a hologram"
    count = len(wavelength)
    rays = RayTable(
        start, heading, wavelength, np.full(count, order), np.zeros(count, dtype=np.bool_)
    )
    found = trace(hologram, rays)
    return found.hit_mm, found.direction


def _refracted(
    lens: LensElement, face: Face, start: FloatArray, heading: FloatArray, wavelength: FloatArray
) -> tuple[FloatArray, FloatArray]:
    surface = lens.face(face).surface(lens.diameter_mm)
    shape = surface.core_shape()
    distance = m_to_mm(shape.intersect(mm_to_m(start), heading))
    hit = start + distance[:, None] * heading
    hit = np.where(surface.covers(hit)[:, None], hit, np.nan)
    inside = medium_from(lens.medium).index(nm_to_m(wavelength))
    outside = medium_from(lens.outside).index(nm_to_m(wavelength))
    entering = (heading[:, 2] > 0.0) == (face == "back")
    left, _ = diffract(
        heading,
        shape.normal(mm_to_m(hit)),
        np.zeros(3),
        0,
        1.0,
        np.where(entering, outside, inside),
        np.where(entering, inside, outside),
        False,
    )
    return hit, left
