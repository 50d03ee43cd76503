# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Chief rays of a scene: backward from the middle of the pupil through every hologram.

At each hologram they split into the chosen orders that get light, until they meet something that
passes no light, or leave the scene.
"""

from dataclasses import replace
from typing import Protocol

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray, dot, unit
from ...core.efficiency import meet
from ...core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from ...core.ray_law import diffract
from ...core.units import mm_to_m, nm_to_m
from ..convert import pattern_from
from ..effects.bodies import Body, nearest
from ..effects.places import bodies_of
from ..efficiency import ConstantSpec, RcwaSpec
from ..element import element_shape
from ..evaluate import centre_mm
from ..hologram import HologramSpec
from ..medium import medium_from
from ..scene import SceneSpec
from ..scene_lens import LensElement
from ..scene_parts import HologramElement
from ..scene_view import rotation_of
from .front import Front, start
from .pieces import NO_PARENT, Growing, Orders, Pieces
from .wavelengths import chief_wavelengths_nm

_MOST_LEVELS = 16
_MOST_RAYS = 2_000
"""On one level; rays beyond that are dropped."""

_LEAST_SHARE = 1e-3
"""An order with less of the light is not shown."""

_OFF_AXIS = 0.7
"""Where rays for the corners of the field meet an element, over half its size."""

_OPEN_SHARE = 0.4
"""Length of a piece that goes on into the open, over the longest way of a ray before."""


def scene_chief_rays(spec: SceneSpec, orders: Orders, *, corners: bool = False) -> Pieces:
    """Find the chief rays of a scene.

    Args:
        spec: The scene.
        orders: Diffraction orders that are followed.
        corners: Whether rays toward the outer parts of every hologram are added to that toward
            its middle.

    Returns:
        Their pieces, in the frame of the scene.
    """
    bodies = bodies_of(spec)
    splitters = [_splitter(body, orders) for body in bodies]
    front = _start(spec, corners=corners)
    growing = Growing()
    farthest = 0.0
    opened: list[Front] = []
    for _ in range(_MOST_LEVELS):
        which, far = nearest(bodies, front.start, front.way, front.left)
        met = np.isfinite(far)
        opened.append(front.pick(~met))
        front, which, far = front.pick(met), which[met], far[met]
        if len(far) == 0:
            break
        farthest = max(farthest, float(np.max(far)))
        points = front.start + far[:, None] * front.way
        numbers = growing.add(front.pieces(points))
        front = _split(bodies, splitters, front, which, points, numbers)
        front = front.pick(slice(_MOST_RAYS))
    length = _OPEN_SHARE * (farthest or 1.0)
    for some in opened:
        # What meets nothing at all has passed no hologram.
        gone = some.pick(some.piece != NO_PARENT)
        growing.add(gone.pieces(gone.start + length * gone.way, is_open=True))
    return growing.all()


def _start(spec: SceneSpec, *, corners: bool) -> Front:
    """The rays at the pupil, toward every hologram."""
    pupil = np.asarray(spec.eye.position_mm, dtype=np.float64)
    aims = np.concatenate(
        [
            aimed
            for element in spec.elements
            if (aimed := _aims(element, corners=corners)) is not None
        ]
        or [np.zeros((0, 3))]
    )
    colours = np.asarray(chief_wavelengths_nm(spec))
    aims, nm = np.repeat(aims, len(colours), axis=0), np.tile(colours, len(aims))
    return start(np.broadcast_to(pupil, aims.shape), unit(aims - pupil), nm)


def _aims(element: object, *, corners: bool) -> FloatArray | None:
    """Places of an element that rays from the eye go to, mm, in the frame of the scene."""
    if isinstance(element, HologramElement):
        middle = centre_mm(element.hologram)
        size = element.hologram.surface.size_mm
    elif isinstance(element, LensElement):
        middle = np.array((0.0, 0.0, element.vertex_z_mm("front")))
        size = (element.diameter_mm, element.diameter_mm)
    else:
        return None
    sides = [(0, 0), *([(-1, 0), (1, 0), (0, -1), (0, 1)] if corners else [])]
    offsets = np.asarray([(x * size[0], y * size[1], 0.0) for x, y in sides])
    local = middle + 0.5 * _OFF_AXIS * offsets
    return local @ rotation_of(element).T + np.asarray(element.position_mm)


def _split(
    bodies: tuple[Body, ...],
    splitters: "list[_Splitter | None]",
    front: Front,
    which: IntArray,
    points: FloatArray,
    numbers: IntArray,
) -> Front:
    """Send rays that have met something into their ways out."""
    parts = [front.pick(np.zeros(len(which), dtype=np.bool_))]
    for number in map(int, np.unique(which)):
        body, splitter = bodies[number], splitters[number]
        if splitter is None:
            continue
        chosen = np.flatnonzero(which == number)
        local_points, way = body.local(points[chosen], front.way[chosen])
        out, goes = splitter.out(local_points, way, front.nm[chosen])
        row, column = np.nonzero(goes)
        order = np.asarray([branch.order for branch in splitter.ways], dtype=np.int64)[column]
        turned = out[row, column] @ body.turn.T
        left = front.split(chosen[row], points, turned, order, numbers)
        parts.append(replace(left, left=np.full(len(row), number)))
    return Front.joined(parts)


def _splitter(body: Body, orders: Orders) -> "_Splitter | None":
    if body.hologram is not None:
        return _AtHologram(body.hologram, orders)
    return _AtFace(body) if body.face is not None else None


class _Splitter(Protocol):
    """The ways out of a body."""

    @property
    def ways(self) -> tuple[Branch, ...]:
        """Order and side of each of the K ways."""
        ...

    def out(
        self, points: FloatArray, way: FloatArray, nm: FloatArray
    ) -> tuple[FloatArray, BoolArray]:
        """Give unit directions, shape ``(n, K, 3)``, and which are shown, shape ``(n, K)``."""
        ...


class _AtFace:
    """A bare face refracts, or reflects totally; the weak reflection is left out."""

    ways = (TRANSMITTED_ZERO, REFLECTED_ZERO)

    def __init__(self, body: Body) -> None:
        assert body.face is not None, "asked for a face"
        self._face = body.face

    def out(
        self, points: FloatArray, way: FloatArray, nm: FloatArray
    ) -> tuple[FloatArray, BoolArray]:
        face, normal = self._face, self._face.normal(points)
        ahead = dot(way, normal) > 0.0
        back, front = (medium.index(nm_to_m(nm)) for medium in (face.back, face.front))
        before, behind = np.where(ahead, back, front), np.where(ahead, front, back)
        both = [
            diffract(way, normal, np.zeros(3), 0, 1.0, before, behind, side)[0]
            for side in (False, True)
        ]
        passed = np.isfinite(both[0]).all(axis=-1)
        return np.stack(both, axis=1), np.stack((passed, ~passed), axis=1)


class _AtHologram:
    """A hologram sends rays into the chosen orders that get light."""

    def __init__(self, spec: HologramSpec, orders: Orders) -> None:
        listed = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
        chosen = tuple(way for way in listed if way.order in orders)
        folds = spec.efficiency.total_internal_reflection and TRANSMITTED_ZERO in listed
        self._folds = folds and REFLECTED_ZERO not in chosen and TRANSMITTED_ZERO in chosen
        self.ways = (*chosen, *((REFLECTED_ZERO,) if self._folds else ()))
        self._spec = spec
        self._pattern, self._shape = pattern_from(spec.pattern), element_shape(spec)
        self._media = (medium_from(spec.media.back), medium_from(spec.media.front))
        # A constant table gives every listed order light; a rigorous one would take too long here.
        constant = isinstance(spec.efficiency, ConstantSpec | RcwaSpec)
        self._model = None if constant else spec.efficiency.model()

    def out(
        self, points: FloatArray, way: FloatArray, nm: FloatArray
    ) -> tuple[FloatArray, BoolArray]:
        places = mm_to_m(points)
        normal = np.broadcast_to(self._shape.normal(places), places.shape)
        gradient = np.broadcast_to(self._pattern.gradient(places), places.shape)
        back, front = (
            np.broadcast_to(medium.index(nm_to_m(nm)), nm.shape) for medium in self._media
        )
        ahead = dot(way, normal) > 0.0
        before, behind = np.where(ahead, back, front), np.where(ahead, front, back)
        out, _status = diffract(
            way[:, None],
            normal[:, None],
            gradient[:, None],
            np.asarray([branch.steps for branch in self.ways]),
            (nm / self._spec.pattern.wavelength_nm)[:, None],
            before[:, None],
            behind[:, None],
            np.asarray([branch.reflected for branch in self.ways], dtype=np.bool_),
        )
        goes = np.isfinite(out).all(axis=-1)
        if self._folds:
            goes[:, -1] &= ~goes[:, self.ways.index(TRANSMITTED_ZERO)]
        if self._model is not None:
            goes &= self._lit(places, normal, out, nm, (back, front))
        return out, goes

    def _lit(
        self,
        places: FloatArray,
        normal: FloatArray,
        out: FloatArray,
        nm: FloatArray,
        indices: tuple[FloatArray, FloatArray],
    ) -> BoolArray:
        """Tell which orders have light, for light that comes in against the walk."""
        assert self._model is not None, "asked for a model that is quick"
        count = len(self.ways)
        _, light = meet(
            self._pattern,
            places[:, None],
            None,
            normal[:, None],
            -out,
            nm_to_m(nm)[:, None],
            (indices[0][:, None], indices[1][:, None]),
        )
        shares = np.broadcast_to(self._model.shares(self.ways, light), (len(nm), count, count))
        own = np.diagonal(shares, axis1=1, axis2=2)
        return np.asarray(np.nan_to_num(own) > _LEAST_SHARE)
