# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The bodies of a document: of a scene's elements, or of a light guide with its engine."""

import numpy as np

from ...core.arrays import BoolArray, FloatArray
from ...core.colour import LUMINANCE_WEIGHTS
from ...core.units import m_to_mm, mm_to_m
from ..device import DeviceSpec, LightGuideSpec
from ..device_surfaces import HOUSING_MARGIN_MM
from ..element import first_hit
from ..hologram import HologramSpec
from ..medium import medium_from
from ..scene import SceneSpec
from ..scene_lens import FACES, LensElement
from ..scene_lens import Face as LensFace
from ..scene_parts import (
    BlockElement,
    CardElement,
    DisplayElement,
    ElementSpec,
    HolderElement,
    HologramElement,
    LampElement,
)
from ..scene_view import rotation_of
from . import bodies as shapes
from .bodies import Body, Covers, Distance, Face

_HALF_TURN = np.diag((-1.0, 1.0, -1.0))
"""Axes of a hologram on the world side: turned by 180 degrees about y."""


def bodies_of(spec: DeviceSpec) -> tuple[Body, ...]:
    """List all that a ray can meet.

    Args:
        spec: The document.

    Returns:
        The bodies; what is beyond all of them is the room.
    """
    if isinstance(spec, LightGuideSpec):
        return tuple(_guide(spec))
    return tuple(_scene(spec))


def hologram_body(name: str, spec: HologramSpec, turn: FloatArray, origin: FloatArray) -> Body:
    """Make the body of a hologram.

    Args:
        name: Its name in the document.
        spec: The hologram.
        turn: Rotation from its frame, shape ``(3, 3)``.
        origin: Where its frame is, mm, shape ``(3,)``.

    Returns:
        The body.
    """

    def distance(start: FloatArray, way: FloatArray) -> FloatArray:
        far, _ = first_hit(spec, start, way)
        return np.where(np.isfinite(far), far, np.inf)

    flat = spec.surface.__struct_config__.tag == "plane"
    return Body(name, turn, origin, distance, flat, hologram=spec)


def _scene(spec: SceneSpec) -> list[Body]:
    found: list[Body] = []
    for element in spec.elements:
        turn, origin = rotation_of(element), np.asarray(element.position_mm, dtype=np.float64)
        if isinstance(element, HologramElement):
            found.append(hologram_body(element.name, element.hologram, turn, origin))
        elif isinstance(element, LensElement):
            found += _lens(element, turn, origin)
        else:
            found.append(_thing(element, turn, origin))
    return found


def _thing(element: ElementSpec, turn: FloatArray, origin: FloatArray) -> Body:
    match element:
        case DisplayElement():
            flat = shapes.on_plane(shapes.rectangle(*element.display.size_mm))
            return Body(element.name, turn, origin, flat, emits=_from_front)
        case LampElement():
            one_sided = element.shape in ("disc", "rectangle")
            emits = _from_front if one_sided else _always
            return Body(element.name, turn, origin, _lamp(element), flat=one_sided, emits=emits)
        case CardElement():
            flat = shapes.on_plane(shapes.rectangle(*element.size_mm))
            return Body(element.name, turn, origin, flat, reflectance=element.reflectance)
        case BlockElement():
            make = shapes.box if element.shape == "box" else shapes.cylinder
            grey = float(np.dot(element.color, LUMINANCE_WEIGHTS))
            return Body(
                element.name, turn, origin, make(element.size_mm), flat=False, reflectance=grey
            )
        case HolderElement():
            grey = float(np.dot(element.color, LUMINANCE_WEIGHTS))
            flat = shapes.on_plane(_frame(element))
            return Body(element.name, turn, origin, flat, reflectance=grey)
        case _:
            raise TypeError(f"no body is known for {type(element).__name__}")


def _lamp(element: LampElement) -> Distance:
    width, height = element.size_mm
    match element.shape:
        case "disc":
            return shapes.on_plane(shapes.ellipse(width, height))
        case "rectangle":
            return shapes.on_plane(shapes.rectangle(width, height))
        case "sphere":
            return shapes.ellipsoid((width, width, height))
        case "line":
            return shapes.cylinder((width, height, width), axis=1)


def _frame(element: HolderElement) -> Covers:
    """The front of a holder; its rod is left out."""
    make = shapes.rectangle if element.outline == "rectangle" else shapes.ellipse
    inner = make(*element.opening_mm)
    wide, high = (side + 2.0 * element.rim_mm for side in element.opening_mm)
    outer = make(wide, high)
    return lambda p: outer(p) & ~inner(p)


def _from_front(points: FloatArray, ways: FloatArray) -> BoolArray:
    del points
    return ways[:, 2] < 0.0


def _always(points: FloatArray, ways: FloatArray) -> BoolArray:
    del points
    return np.ones(len(ways), dtype=np.bool_)


def _lens(lens: LensElement, turn: FloatArray, origin: FloatArray) -> list[Body]:
    """The two faces; light that would meet the rim counts as going on."""
    found: list[Body] = []
    for side in FACES:
        place = origin + turn @ np.array((0.0, 0.0, lens.vertex_z_mm(side)))
        own = lens.hologram(side)
        if own is not None:
            found.append(hologram_body(own.name, own, turn, place))
        else:
            found.append(_lens_face(lens, side, turn, place))
    return found


def _lens_face(lens: LensElement, side: LensFace, turn: FloatArray, place: FloatArray) -> Body:
    surface = lens.face(side).surface(lens.diameter_mm)
    shape = surface.core_shape()

    def distance(start: FloatArray, way: FloatArray) -> FloatArray:
        far = m_to_mm(shape.intersect(mm_to_m(start), way))
        met = start + np.where(np.isfinite(far), far, 0.0)[:, None] * way
        return np.where(np.isfinite(far) & surface.covers(met), far, np.inf)

    inside, outside = medium_from(lens.medium), medium_from(lens.outside)
    media = (inside, outside) if side == "front" else (outside, inside)
    face = Face(lambda points: shape.normal(mm_to_m(points)), *media)
    flat = surface.__struct_config__.tag == "plane"
    return Body(f"{lens.name} {side}", turn, place, distance, flat, face=face)


def _guide(spec: LightGuideSpec) -> list[Body]:
    guide = spec.guide
    found: list[Body] = []
    for patch in spec.holograms:
        turn = np.eye(3) if patch.face == "eye" else _HALF_TURN
        place = np.array((*patch.center_mm, guide.face_z_mm(patch.face)))
        found.append(hologram_body(patch.name, patch.hologram(guide), turn, place))
    inside, outside = medium_from(guide.medium), medium_from(guide.outside)
    for side in ("eye", "world"):
        turn = np.eye(3) if side == "eye" else _HALF_TURN
        place = np.array((*guide.center_mm, guide.face_z_mm(side)))
        flat = shapes.on_plane(_bare(spec, side))
        face = Face(_up, inside, outside)
        found.append(Body(f"{side} side", turn, place, flat, face=face))
    found += _rim(spec)
    found += _engine(spec)
    return found


def _bare(spec: LightGuideSpec, side: str) -> Covers:
    guide = spec.guide
    whole = shapes.rectangle(*guide.size_mm)
    sign = 1.0 if side == "eye" else -1.0
    patches = [
        (np.subtract(patch.center_mm, guide.center_mm) * (sign, 1.0), patch.size_mm)
        for patch in spec.holograms
        if patch.face == side
    ]

    def covers(points: FloatArray) -> BoolArray:
        found = whole(points)
        for (x, y), (width, height) in patches:
            beside = np.abs(points[:, 0] - x) > width / 2
            found &= beside | (np.abs(points[:, 1] - y) > height / 2)
        return found

    return covers


def _up(points: FloatArray) -> FloatArray:
    return np.broadcast_to((0.0, 0.0, 1.0), points.shape)


def _rim(spec: LightGuideSpec) -> list[Body]:
    """The four black sides of the plate."""
    guide = spec.guide
    middle = 0.5 * (guide.face_z_mm("eye") + guide.face_z_mm("world"))
    found: list[Body] = []
    for axis, turn in ((0, np.eye(3)[:, [1, 2, 0]]), (1, np.eye(3)[:, [2, 0, 1]])):
        other = guide.size_mm[1 - axis]
        extent = (other, guide.thickness_mm) if axis == 0 else (guide.thickness_mm, other)
        for sign in (-1.0, 1.0):
            place = np.array((*guide.center_mm, middle))
            place[axis] += sign * guide.size_mm[axis] / 2.0
            flat = shapes.on_plane(shapes.rectangle(*extent))
            found.append(Body("rim", turn, place, flat))
    return found


def _engine(spec: LightGuideSpec) -> list[Body]:
    """Lens and display as one disc that gives light, and the can around them."""
    lens, size = spec.lens, np.asarray(spec.display.size_mm)
    x, y = spec.patch(spec.source.patch).center_mm
    front = spec.guide.face_z_mm("eye") + lens.distance_mm
    widest = max(lens.diameter_mm, float(np.hypot(*size))) + 2.0 * HOUSING_MARGIN_MM
    long = lens.focal_length_mm + HOUSING_MARGIN_MM
    limit = size / (2.0 * lens.focal_length_mm)

    def emits(points: FloatArray, ways: FloatArray) -> BoolArray:
        slope = np.abs(ways[:, :2] / np.where(ways[:, 2:] > 0.0, ways[:, 2:], np.nan))
        inside = np.hypot(points[:, 0], points[:, 1]) <= lens.diameter_mm / 2.0
        return inside & (slope <= limit).all(axis=1)

    disc = shapes.on_plane(shapes.ellipse(widest, widest))
    can = shapes.cylinder((widest, widest, long))
    middle = np.array((x, y, front + 0.5 * long + 1e-3))
    return [
        Body("display", np.eye(3), np.array((x, y, front)), disc, emits=emits),
        Body("housing", np.eye(3), middle, can, flat=False),
    ]
