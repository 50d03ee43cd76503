# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two faces of a light guide, with all holograms on them, as one step of a walk."""

from dataclasses import replace

import numpy as np

from ...core import tracer
from ...core.arrays import BoolArray, FloatArray, IntArray
from ...core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO
from ...core.ray_law import Status, diffract
from ...core.recording import Recording
from ...core.units import m_to_mm, mm_to_m, nm_to_m
from ...core.waves import PlaneWave
from ..device import LightGuideSpec
from ..device_surfaces import DeviceSurfaces
from ..medium import medium_from
from .front import Front
from .pieces import Growing, Orders

_UP = np.array((0.0, 0.0, 1.0))
_ON_FACE = 1e-9
"""Metres. A ray that starts nearer to a face has just left it."""

_BEYOND_CRITICAL = 1e-9
_MIRROR_IMAGE = np.array((1.0, 1.0, -1.0))
_BARE = -1
_ZEROS = (TRANSMITTED_ZERO, REFLECTED_ZERO)


class Faces:
    """Both faces. All that light meets lies in two planes, so no surface has to be searched for.

    A bare face refracts, or reflects totally; its weak reflection is left out.
    """

    def __init__(
        self,
        spec: LightGuideSpec,
        device: DeviceSurfaces,
        orders: Orders,
        colours_nm: tuple[float, ...],
    ) -> None:
        """Look at a device.

        Args:
            spec: The device.
            device: Its surfaces.
            orders: Diffraction orders that are followed.
            colours_nm: All vacuum wavelengths that rays will have.
        """
        self._spec = spec
        self._colours = np.sort(np.asarray(colours_nm))
        self._indices = tuple(
            np.broadcast_to(medium_from(each).index(nm_to_m(self._colours)), self._colours.shape)
            for each in (spec.guide.medium, spec.guide.outside)
        )
        self._gratings = [part for part in device.parts if isinstance(part, tracer.Grating)]
        self._eye = float(mm_to_m(spec.guide.face_z_mm("eye")))
        self._world = float(mm_to_m(spec.guide.face_z_mm("world")))
        further = [
            way
            for grating in self._gratings
            for way in grating.branches
            if way.order != 0 and way.order in orders
        ]
        self._ways = (*_ZEROS, *dict.fromkeys(further))
        self._constant = [_constant_gradient(each) for each in self._gratings]
        self._allowed = np.array([self._allow(each, orders) for each in self._gratings])

    def _allow(self, grating: tracer.Grating, orders: Orders) -> list[bool]:
        """Which ways are shown at a hologram: order 0 passing, order 0 trapped, and the others."""
        passing = TRANSMITTED_ZERO in grating.branches and 0 in orders
        further = [way in grating.branches for way in self._ways[len(_ZEROS) :]]
        return [passing, grating.total_internal_reflection, *further]

    def through(self, front: Front, growing: Growing) -> tuple[Front, Front]:
        """Take rays to the face that they meet next, and into all ways out.

        Args:
            front: Rays before the eye's side or in the guide, in metres.
            growing: Takes their pieces.

        Returns:
            The rays that go on in the guide, and those that have left it.
        """
        at_eye, points, patch = self._met(front)
        met = patch >= _BARE
        if not met.all():
            front, at_eye, points, patch = front.pick(met), at_eye[met], points[met], patch[met]
        piece = growing.add(front.pieces(points, 1e3))
        if self._all_trapped(front, patch):
            # Half of all steps: the plain law of reflection is many times quicker.
            mirrored = replace(front, start=points, way=front.way * _MIRROR_IMAGE, piece=piece)
            return mirrored, front.pick(slice(0))
        out, goes = self._out(front, points, patch)
        row, column = np.nonzero(goes)
        orders = np.asarray([way.order for way in self._ways], dtype=np.int64)[column]
        left = front.split(row, points, out[row, column], orders, piece)
        inside = (left.way[:, 2] < 0.0) == at_eye[row]
        return left.pick(inside), left.pick(~inside)

    def _all_trapped(self, front: Front, patch: IntArray) -> bool:
        """Tell whether all rays are reflected totally at a bare face, with a digit to spare."""
        if len(patch) == 0 or patch.max() > _BARE:
            return False
        if front.start[:, 2].max() > self._eye + _ON_FACE:
            return False
        inside, outside = self._indices_of(front)
        tangential = inside * np.hypot(front.way[:, 0], front.way[:, 1])
        return bool(np.all(tangential > (1.0 + _BEYOND_CRITICAL) * outside))

    def _indices_of(self, front: Front) -> tuple[FloatArray, FloatArray]:
        """Index of the guide and of what is around it, for each ray."""
        colour = np.searchsorted(self._colours, front.nm)
        inside, outside = self._indices
        return inside[colour], outside[colour]

    def _met(self, front: Front) -> tuple[BoolArray, FloatArray, IntArray]:
        """Whether rays meet the eye's side, where, and the hologram there; -2 beside the guide."""
        guide = self._spec.guide
        above = front.start[:, 2] > self._eye + _ON_FACE
        at_eye: BoolArray = above | (front.way[:, 2] > 0.0)
        z = np.where(at_eye, self._eye, self._world)
        far = (z - front.start[:, 2]) / front.way[:, 2]
        points = front.start + far[:, None] * front.way
        points[:, 2] = z
        place_mm = m_to_mm(points[:, :2])
        patch = np.where(_covers(guide.center_mm, guide.size_mm, place_mm), _BARE, _BARE - 1)
        for number, each in enumerate(self._spec.holograms):
            there = at_eye if each.face == "eye" else ~at_eye
            covered = there & _covers(each.center_mm, each.size_mm, place_mm)
            patch = np.where(covered, number, patch)
        return at_eye, points, patch

    def _out(
        self, front: Front, points: FloatArray, patch: IntArray
    ) -> tuple[FloatArray, BoolArray]:
        """Unit directions, shape ``(n, K, 3)``, and which are shown, shape ``(n, K)``."""
        met = [int(number) for number in np.unique(patch[patch >= 0])]
        ways = self._ways if met else _ZEROS
        gradient, ratio = np.zeros_like(points), np.zeros(len(points))
        for number in met:
            grating, here = self._gratings[number], patch == number
            gradient[here] = self._gradient(number, points[here])
            ratio[here] = nm_to_m(front.nm[here]) / grating.pattern.wavelength
        inside, outside = self._indices_of(front)
        # Only the way from the pupil to the guide runs in the medium outside.
        in_guide = front.start[:, 2] <= self._eye + _ON_FACE
        out, status = diffract(
            front.way[:, None],
            _UP,
            gradient[:, None],
            np.asarray([way.steps for way in ways]),
            ratio[:, None],
            np.where(in_guide, inside, outside)[:, None],
            np.where(in_guide, outside, inside)[:, None],
            np.asarray([way.reflected for way in ways], dtype=np.bool_),
        )
        return out, self._shown(status == Status.OK, patch)

    def _gradient(self, number: int, points: FloatArray) -> FloatArray:
        """What is recorded in a hologram, in the frame of the device."""
        constant = self._constant[number]
        if constant is not None:
            return constant
        grating = self._gratings[number]
        local = grating.frame.point_to_local(points)
        local[:, 2] = 0.0
        return grating.frame.vector_to_world(grating.pattern.gradient(local))

    def _shown(self, goes: BoolArray, patch: IntArray) -> BoolArray:
        """Choose among the ways that rays can go."""
        shown = goes.copy()
        shown[:, 1] &= ~goes[:, 0]
        at = np.flatnonzero(patch >= 0)
        if len(at):
            shown[patch < 0, len(_ZEROS) :] = False
            shown[at] &= self._allowed[patch[at]]
        return shown


def _constant_gradient(grating: tracer.Grating) -> FloatArray | None:
    """What is recorded by two plane waves, the same everywhere, in the frame of the device."""
    pattern = grating.pattern
    if not isinstance(pattern, Recording):
        return None
    waves = (pattern.object, pattern.reference)
    if not all(isinstance(wave, PlaneWave) for wave in waves):
        return None
    return grating.frame.vector_to_world(pattern.gradient(np.zeros(3)))


def _covers(
    centre_mm: tuple[float, float], size_mm: tuple[float, float], place_mm: FloatArray
) -> BoolArray:
    offset = np.abs(place_mm - np.asarray(centre_mm))
    return np.asarray(np.all(offset <= np.asarray(size_mm) / 2.0, axis=1))
