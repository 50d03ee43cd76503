# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A light-guide device as the surfaces of the reference tracer, in metres.

The frame is that of the document: x right, y up, z toward the viewer, the eye at the origin.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..core import tracer
from ..core.arrays import BoolArray, FloatArray
from ..core.units import mm_to_m
from .convert import pattern_from
from .device import GuideSpec, LightGuideSpec, PatchSpec
from .medium import medium_from
from .pattern import pattern_of

HOUSING_MARGIN_MM = 1.0
"""How far the black housing stands out beyond lens and display, to the sides and to the back."""

_NORMAL = {"eye": (0.0, 0.0, 1.0), "world": (0.0, 0.0, -1.0)}
_X_AXIS = {"eye": (1.0, 0.0, 0.0), "world": (-1.0, 0.0, 0.0)}
_WIDE = tracer.Rectangle(math.inf, math.inf)


@dataclass(frozen=True)
class Housing:
    """The black can around display and lens; its front is open inside the lens.

    Attributes:
        centre: Axis, x and y, metres.
        radius: Metres.
        front: z of the lens, metres.
        length: From the lens to the closed back, metres.
    """

    centre: tuple[float, float]
    radius: float
    front: float
    length: float

    def shades(self, points: FloatArray, slopes: FloatArray, to_z: float) -> BoolArray:
        """Tell which rays the can stops on their way from the plane of the lens to the viewer.

        Args:
            points: Points in the plane of the lens, x and y, metres, shape ``(R, 2)``.
            slopes: Change of x and y per length along z, shape ``(R, 2)``.
            to_z: Where the way ends, metres, at or in front of the lens.

        Returns:
            Mask, shape ``(R,)``.
        """
        way = slopes * min(to_z - self.front, self.length)
        start = points - np.asarray(self.centre)
        # The nearest point to the axis on the part of the way beside the can.
        square = np.sum(way * way, axis=1)
        part = -np.sum(start * way, axis=1) / np.where(square > 0.0, square, 1.0)
        nearest = start + np.clip(part, 0.0, 1.0)[:, None] * way
        return np.hypot(nearest[:, 0], nearest[:, 1]) < self.radius


@dataclass(frozen=True, eq=False)
class DeviceSurfaces:
    """The surfaces of a device.

    Attributes:
        lens: The collimating lens, its axis along z.
        parts: All that light can meet after the lens, without the receiver. The back of the
            light engine is black: what goes back through the lens ends at the display.
        receiver: The plane of the lens outside the housing. Light that lands there has left the
            guide for good and flies straight to the eye, unless the housing shades it.
        housing: The can around display and lens.
    """

    lens: tracer.IdealLens
    parts: tuple[tracer.PlanarSurface, ...]
    receiver: tracer.Receiver
    housing: Housing


def surfaces_of(spec: LightGuideSpec) -> DeviceSurfaces:
    """Build the surfaces of a device for the reference tracer.

    Args:
        spec: The device.

    Returns:
        Its surfaces, in the frame of the document, in metres.
    """
    housing = _housing(spec)
    frame = tracer.Frame.at((*housing.centre, housing.front))
    disc = tracer.Circle(2.0 * housing.radius)
    lens = tracer.IdealLens(
        frame=frame,
        aperture=tracer.Aperture(tracer.Circle(float(mm_to_m(spec.lens.diameter_mm)))),
        focal_length=float(mm_to_m(spec.lens.focal_length_mm)),
    )
    parts = (
        *(_bare_face(spec, face) for face in ("eye", "world")),
        *(_grating(spec.guide, patch) for patch in spec.holograms),
        *_rim(spec.guide),
        tracer.Absorber(frame=frame, aperture=tracer.Aperture(disc)),
    )
    receiver = tracer.Receiver(frame=frame, aperture=tracer.Aperture(_WIDE, holes=(disc,)))
    return DeviceSurfaces(lens, parts, receiver, housing)


def _housing(spec: LightGuideSpec) -> Housing:
    x, y = spec.patch(spec.source.patch).center_mm
    widest_mm = max(spec.lens.diameter_mm, math.hypot(*spec.display.size_mm))
    return Housing(
        centre=(float(mm_to_m(x)), float(mm_to_m(y))),
        radius=float(mm_to_m(widest_mm / 2.0 + HOUSING_MARGIN_MM)),
        front=float(mm_to_m(spec.guide.face_z_mm("eye") + spec.lens.distance_mm)),
        length=float(mm_to_m(spec.lens.focal_length_mm + HOUSING_MARGIN_MM)),
    )


def _face_frame(guide: GuideSpec, face: str, center_mm: tuple[float, float]) -> tracer.Frame:
    """Return a frame on a face of the guide: z along the outward normal, y up."""
    origin = mm_to_m(np.array([*center_mm, guide.face_z_mm(face)]))
    return tracer.Frame.at(origin, _NORMAL[face], _X_AXIS[face])


def _rectangle(
    size_mm: tuple[float, float], center_mm: tuple[float, float] = (0.0, 0.0)
) -> tracer.Rectangle:
    width, height, x, y = (float(mm_to_m(value)) for value in (*size_mm, *center_mm))
    return tracer.Rectangle(width, height, (x, y))


def _bare_face(spec: LightGuideSpec, face: str) -> tracer.Dielectric:
    """Return a face of the guide with holes where its patches are."""
    guide = spec.guide
    along = _X_AXIS[face][0]
    holes = tuple(
        _rectangle(
            patch.size_mm,
            (
                along * (patch.center_mm[0] - guide.center_mm[0]),
                patch.center_mm[1] - guide.center_mm[1],
            ),
        )
        for patch in spec.holograms
        if patch.face == face
    )
    return tracer.Dielectric(
        frame=_face_frame(guide, face, guide.center_mm),
        aperture=tracer.Aperture(_rectangle(guide.size_mm), holes),
        index_back=medium_from(guide.medium),
        index_front=medium_from(guide.outside),
    )


def _grating(guide: GuideSpec, patch: PatchSpec) -> tracer.Grating:
    return tracer.Grating(
        frame=_face_frame(guide, patch.face, patch.center_mm),
        aperture=tracer.Aperture(_rectangle(patch.size_mm)),
        pattern=pattern_from(pattern_of(patch)),
        index_back=medium_from(guide.medium),
        index_front=medium_from(guide.outside),
        branches=patch.efficiency.branches(patch.orders, pattern_of(patch).wavelength_nm),
        efficiency=patch.efficiency.model(),
        total_internal_reflection=patch.efficiency.total_internal_reflection,
    )


def _rim(guide: GuideSpec) -> tuple[tracer.Absorber, ...]:
    """Return the four black sides of the plate."""
    middle_mm = (guide.face_z_mm("eye") + guide.face_z_mm("world")) / 2.0
    sides: list[tracer.Absorber] = []
    for axis in (0, 1):
        for sign in (-1.0, 1.0):
            origin_mm = np.array([*guide.center_mm, middle_mm])
            origin_mm[axis] += sign * guide.size_mm[axis] / 2.0
            normal = np.zeros(3)
            normal[axis] = sign
            frame = tracer.Frame.at(mm_to_m(origin_mm), normal, (0.0, 0.0, 1.0))
            size_mm = (guide.thickness_mm, guide.size_mm[1 - axis])
            sides.append(
                tracer.Absorber(frame=frame, aperture=tracer.Aperture(_rectangle(size_mm)))
            )
    return tuple(sides)
