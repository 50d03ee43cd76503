# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of rays of a backward walk at a hologram or at a bare face of a dielectric."""

from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray, dot
from ...core.fresnel import reflectance_unpolarised
from ...core.media import Medium
from ...core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch, OrderFan
from ...core.ray_law import diffract
from ...core.units import mm_to_m, nm_to_m
from ..convert import pattern_from
from ..efficiency import ConstantSpec
from ..element import element_shape
from ..evaluate import fan
from ..hologram import HologramSpec
from ..medium import medium_from
from .bodies import Body

_LEAST_COSINE = 0.05


@dataclass(frozen=True, eq=False)
class Scattered:
    """The K ways out of n rays, in the frame of the body.

    Attributes:
        ways: Order and side of each.
        out: Unit directions, shape ``(n, K, 3)``, NaN where there is none.
        shares: Of the light that comes in the other direction, shape ``(n, K)``.
        reach: Tangential part of n s over n, above 1 for an evanescent order, shape ``(n, K)``.
        kick: What a change of the wavelength adds to n s here, 1/nm, shape ``(n, K, 3)``.
        normal: Unit normals, shape ``(n, 3)``.
    """

    ways: tuple[Branch, ...]
    out: FloatArray
    shares: FloatArray
    reach: FloatArray
    kick: FloatArray
    normal: FloatArray


def scatter(body: Body, points: FloatArray, way: FloatArray, nm: FloatArray) -> Scattered:
    """Send rays into every way out of a body.

    Args:
        body: A hologram or a bare face.
        points: Where they meet it, in its frame, mm, shape ``(n, 3)``.
        way: Unit directions of the walk, shape ``(n, 3)``.
        nm: Vacuum wavelengths, shape ``(n,)``.

    Returns:
        The ways out.
    """
    if body.hologram is not None:
        return _at_hologram(body.hologram, points, way, nm)
    face = body.face
    assert face is not None, "only what passes light comes here"
    normal = face.normal(points)
    ahead = dot(way, normal) > 0.0
    back, front = (medium.index(nm_to_m(nm)) for medium in (face.back, face.front))
    before, behind = np.where(ahead, back, front), np.where(ahead, front, back)
    reflected = reflectance_unpolarised(np.abs(dot(way, normal)), before, behind)
    both = [
        diffract(way, normal, np.zeros(3), 0, 1.0, before, behind, side)[0]
        for side in (False, True)
    ]
    out = np.stack(both, axis=1)
    tangential = before * np.sqrt(np.maximum(1.0 - dot(way, normal) ** 2, 0.0))
    return Scattered(
        ways=(TRANSMITTED_ZERO, REFLECTED_ZERO),
        out=out,
        shares=np.stack((1.0 - reflected, reflected), axis=1),
        reach=np.stack((tangential / behind, tangential / before), axis=1),
        kick=_entering(out, normal, nm, (face.back, face.front)),
        normal=normal,
    )


def _at_hologram(
    spec: HologramSpec, points: FloatArray, way: FloatArray, nm: FloatArray
) -> Scattered:
    listed = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    spread = fan(spec, points, way, nm, listed)
    normal = np.broadcast_to(element_shape(spec).normal(mm_to_m(points)), points.shape)
    gradient = np.nan_to_num(pattern_from(spec.pattern).gradient(mm_to_m(points)))
    gradient = np.broadcast_to(gradient, points.shape)
    tangential = gradient - dot(gradient, normal)[..., None] * normal
    steps = np.array([branch.steps for branch in spread.branches])
    kick = steps[:, None] * tangential[:, None, :] / spec.pattern.wavelength_nm
    media = (medium_from(spec.media.back), medium_from(spec.media.front))
    back, front = (np.broadcast_to(medium.index(nm_to_m(nm)), nm.shape) for medium in media)
    cosine = dot(way, normal)
    ahead = cosine > 0.0
    before, behind = np.where(ahead, back, front), np.where(ahead, front, back)
    along = before[:, None] * (way - cosine[:, None] * normal)
    size = np.linalg.norm(along[:, None, :] + nm[:, None, None] * kick, axis=-1)
    goes_back = np.array([branch.reflected for branch in spread.branches])
    index = np.where(goes_back, before[:, None], behind[:, None])
    return Scattered(
        ways=spread.branches,
        out=spread.directions,
        shares=_shares(spec, points, spread, nm),
        reach=size / index,
        kick=kick + _entering(spread.directions, normal, nm, media),
        normal=normal,
    )


def _shares(spec: HologramSpec, points: FloatArray, spread: OrderFan, nm: FloatArray) -> FloatArray:
    if isinstance(spec.efficiency, ConstantSpec):
        # A ray and its reverse have the same share where no share depends on the ray.
        return spread.weights
    return shares_of(spec, points, spread.directions, nm, spread.branches)


def _entering(
    out: FloatArray, normal: FloatArray, nm: FloatArray, media: tuple[Medium, Medium]
) -> FloatArray:
    """What the dispersion of the medium that a ray goes on in adds along the normal, 1/nm."""
    rates = [
        np.broadcast_to(medium.index(nm_to_m(nm + 0.5)) - medium.index(nm_to_m(nm - 0.5)), nm.shape)
        for medium in media
    ]
    cosine = np.nan_to_num(dot(out, normal[:, None, :]))
    rate = np.where(cosine > 0.0, rates[1][:, None], rates[0][:, None])
    size = rate * np.sign(cosine) / np.maximum(np.abs(cosine), _LEAST_COSINE)
    return size[..., None] * normal[:, None, :]


def shares_of(
    spec: HologramSpec,
    points_mm: FloatArray,
    out: FloatArray,
    nm: FloatArray,
    ways: tuple[Branch, ...],
) -> FloatArray:
    """Give the shares of light that comes in against the directions of a backward walk.

    Args:
        spec: The hologram.
        points_mm: Where it meets it, in its frame, shape ``(n, 3)``.
        out: Directions of the walk, shape ``(n, K, 3)``; NaN where there is none.
        nm: Vacuum wavelengths, shape ``(n,)``.
        ways: The K ways out.

    Returns:
        Shares, shape ``(n, K)``; 0 where there is no direction.
    """
    found = np.zeros(out.shape[:-1])
    for place, branch in enumerate(ways):
        light = -out[:, place]
        there = np.isfinite(light).all(axis=-1)
        if there.any():
            spread = fan(spec, points_mm[there], light[there], nm[there], (branch,))
            found[there, place] = spread.weights[:, spread.branches.index(branch)]
    return found
