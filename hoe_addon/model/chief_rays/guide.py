# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Chief rays of a light guide: from points of the display to the middle of the pupil.

They are walked backward: from the pupil in the direction in which a point of the display is seen,
through the out-coupler, by total reflections and the orders of all holograms, out toward the lens.
Of all ways that end in the point, that of the fewest reflections is shown.
"""

import numpy as np

from ...core import tracer
from ...core.arrays import FloatArray, IntArray, unit
from ...core.units import m_to_mm, mm_to_m, nm_to_m
from ..device import LightGuideSpec
from ..device_surfaces import surfaces_of
from .faces import Faces
from .front import Front, start
from .pieces import Growing, Orders, Pieces
from .wavelengths import chief_wavelengths_nm

_MOST_LEVELS = 200
_MOST_RAYS = 2_000
"""On one level; rays beyond that are dropped."""

_ROUNDS = 4
_CLOSE_MM = 1e-6
"""How near to the wanted point of the display a ray has to end, or it is aimed anew."""

_SLACK = 1e-9
"""Relative. Rounding must not drop rays that end at the very edge of the display."""

_OPEN_SHARE = 0.6
"""Length of a piece that goes on into the open, over its distance from the eye."""


def guide_chief_rays(spec: LightGuideSpec, orders: Orders, *, corners: bool = False) -> Pieces:
    """Find the chief rays of a light guide.

    Args:
        spec: The device.
        orders: Diffraction orders that are followed; total reflection always is.
        corners: Whether the corners of the display are added to its middle.

    Returns:
        The pieces of the rays that come from the display, and with order 0 of those that come
        straight through the guide, in the frame of the device.
    """
    places = [(0, 0), *([(-1, -1), (1, -1), (1, 1), (-1, 1)] if corners else [])]
    points_mm = np.asarray(places) * np.asarray(spec.display.size_mm) / 2.0
    colours = np.asarray(chief_wavelengths_nm(spec))
    wanted_mm = np.repeat(points_mm, len(colours), axis=0)
    nm = np.tile(colours, len(points_mm))
    walk, aim_mm = _Walk(spec, orders), wanted_mm.copy()
    found, ends_mm = walk.walked(aim_mm, nm)
    for _ in range(_ROUNDS):
        # Holograms that do not undo each other's dispersion turn the picture.
        missed = wanted_mm - ends_mm
        if not np.nanmax(np.abs(missed), initial=0.0) > _CLOSE_MM:
            break
        aim_mm += np.nan_to_num(missed)
        found, ends_mm = walk.walked(aim_mm, nm)
    return found


class _Walk:
    """The backward walk through one device."""

    def __init__(self, spec: LightGuideSpec, orders: Orders) -> None:
        device = surfaces_of(spec)
        self._spec, self._housing = spec, device.housing
        self._engine = _engine(spec, device.lens)
        self._faces = Faces(spec, device, orders, chief_wavelengths_nm(spec))

    def walked(self, aim_mm: FloatArray, nm: FloatArray) -> tuple[Pieces, FloatArray]:
        """Walk one ray for each direction of sight.

        Args:
            aim_mm: Points of the display that would be seen there, were the device perfect,
                shape ``(R, 2)``.
            nm: Vacuum wavelengths, shape ``(R,)``.

        Returns:
            The pieces of all that is shown, and where on the display each ray ends, mm, shape
            ``(R, 2)``; NaN for one that does not get there.
        """
        heading = np.column_stack([aim_mm, np.full(len(nm), -self._spec.lens.focal_length_mm)])
        pupil = mm_to_m(np.asarray(self._spec.eye.position_mm, dtype=np.float64))
        front = start(np.broadcast_to(pupil, heading.shape), unit(heading), nm)
        growing, last = Growing(), [np.zeros(0, dtype=np.int64)]
        ends_mm = np.full((len(nm), 2), np.nan)
        for _ in range(_MOST_LEVELS):
            front, left = self._faces.through(front, growing)
            last.append(self._arrive(left, growing, ends_mm))
            last.append(_leave(left, growing))
            front = front.pick(np.isnan(ends_mm[front.root, 0])).pick(slice(_MOST_RAYS))
            if len(front.nm) == 0:
                break
        pieces = growing.all()
        shown = np.zeros(len(pieces.nm), dtype=np.bool_)
        shown[np.concatenate(last)] = True
        return pieces.with_ancestors(shown), ends_mm

    def _arrive(self, left: Front, growing: Growing, ends_mm: FloatArray) -> IntArray:
        """Add the last pieces of rays that get to the display, and note where they end."""
        middle = np.asarray(self._housing.centre)
        aside = np.hypot(*(left.start[:, :2] - middle).T)
        near = (left.way[:, 2] > 0.0) & (left.order != 0) & (aside < self._housing.radius)
        if not near.any():
            return np.zeros(0, dtype=np.int64)
        left = left.pick(near)
        hits = self._at_display(left)
        reached = np.isfinite(hits[1]).all(axis=1)
        left, hits = left.pick(reached), hits[:, reached]
        _, first = np.unique(left.root, return_index=True)
        chosen, hits = left.pick(first), hits[:, first]
        ends_mm[chosen.root] = m_to_mm(hits[1, :, :2] - middle)
        at_lens = growing.add(chosen.pieces(hits[0], 1e3))
        return growing.add(chosen.moved(hits[0], at_lens).pieces(hits[1], 1e3))

    def _at_display(self, left: Front) -> FloatArray:
        """Places on the lens and on the display, NaN for rays that miss, shape ``(2, n, 3)``."""
        rays = tracer.Rays(left.start, left.way, nm_to_m(left.nm), np.ones(len(left.nm)))
        return tracer.walk_sequence(rays, self._engine).hits


def _engine(spec: LightGuideSpec, lens: tracer.IdealLens) -> tuple[tracer.Step, ...]:
    """Lens and display, as light meets them that runs backward."""
    width, height = ((1.0 + _SLACK) * float(mm_to_m(side)) for side in spec.display.size_mm)
    behind = lens.frame.origin + np.array((0.0, 0.0, lens.focal_length))
    panel = tracer.Absorber(
        frame=tracer.Frame.at(behind),
        aperture=tracer.Aperture(tracer.Rectangle(width, height)),
    )
    return (tracer.Step(lens), tracer.Step(panel))


def _leave(left: Front, growing: Growing) -> IntArray:
    """Add the last pieces of rays that go straight through the guide, into the open."""
    straight = left.pick((left.way[:, 2] < 0.0) & (left.order == 0))
    if len(straight.nm) == 0:
        return np.zeros(0, dtype=np.int64)
    length = _OPEN_SHARE * np.abs(straight.start[:, 2:])
    return growing.add(straight.pieces(straight.start + length * straight.way, 1e3, is_open=True))
