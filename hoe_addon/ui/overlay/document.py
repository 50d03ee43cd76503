# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All that is drawn of a document, by kind, in mm in the frame of the device."""

from collections import OrderedDict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum

import msgspec
import numpy as np

from ...core.arrays import FloatArray
from ...model.chief_rays import Orders, chief_rays
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.device_parts import RenderSpec
from ...model.recording import RecordingSpec
from ...model.scene_lens import FACES, LensElement
from ...model.scene_parts import HologramElement
from ...model.scene_view import rotation_of
from ...model.surface import PlaneSurface, SurfaceSpec
from .eye import Label, eyebox_lines, pupil_lines
from .lines import Lines
from .rays import ray_lines
from .sources import source_lines


class Kind(StrEnum):
    """What is drawn; the values are the names of the switches."""

    SOURCES = "sources"
    CHIEF_RAYS = "chief_rays"
    PUPIL = "pupil"
    EYEBOX = "eyebox"


OF_EYE = frozenset({Kind.CHIEF_RAYS, Kind.PUPIL, Kind.EYEBOX})
"""What has no place where there is no eye."""


@dataclass(frozen=True)
class Density:
    """How much is drawn.

    Attributes:
        rays: Rays of each recording source.
        corners: Whether chief rays for the corners of the field are drawn.
        orders: Orders that chief rays take.
    """

    rays: int = 5
    corners: bool = True
    orders: Orders = field(default_factory=Orders)


@dataclass(frozen=True, eq=False)
class Drawing:
    """Lines by kind, and words.

    Attributes:
        lines: Of every kind that has any.
        labels: Words, with those of the pupil alone for now.
    """

    lines: dict[Kind, Lines]
    labels: tuple[Label, ...] = ()


_HALF_TURN = np.diag((-1.0, 1.0, -1.0))
"""Axes of a hologram on the world side: turned by 180 degrees about y."""

_MOST_KEPT = 128
_kept: OrderedDict[object, Lines] = OrderedDict()
"""What was drawn last, in its own frame; it stays when only something else changes or moves."""


def drawing_of(spec: DeviceSpec, density: Density, kinds: frozenset[Kind]) -> Drawing:
    """Draw a document.

    Args:
        spec: The document.
        density: How much is drawn.
        kinds: What is drawn.

    Returns:
        Its lines.
    """
    lines: dict[Kind, Lines] = {}
    labels: tuple[Label, ...] = ()
    if Kind.SOURCES in kinds:
        placed = (
            sources_of(surface, recording, density.rays).moved(matrix)
            for surface, recording, matrix in _recorded(spec)
        )
        lines[Kind.SOURCES] = Lines.joined(list(placed))
    if Kind.CHIEF_RAYS in kinds:
        lines[Kind.CHIEF_RAYS] = _rays_of(spec, density)
    if Kind.PUPIL in kinds:
        lines[Kind.PUPIL], labels = pupil_lines(spec)
    if Kind.EYEBOX in kinds:
        lines[Kind.EYEBOX] = eyebox_lines(spec)
    return Drawing({kind: some for kind, some in lines.items() if len(some.ends)}, labels)


def sources_of(surface: SurfaceSpec, recording: RecordingSpec, rays: int) -> Lines:
    """Draw the sources of a hologram, or give what was drawn of equal ones before.

    Args:
        surface: Its surface.
        recording: Its recording.
        rays: Rays of each source.

    Returns:
        Lines in mm, in the frame of the hologram.
    """
    key = (msgspec.json.encode((surface, recording)), rays)
    return _keep(key, lambda: source_lines(surface, recording, rays))


def _rays_of(spec: DeviceSpec, density: Density) -> Lines:
    key = (msgspec.json.encode(without_render(spec)), density.orders, density.corners)
    return _keep(key, lambda: ray_lines(chief_rays(spec, density.orders, corners=density.corners)))


def without_render(spec: DeviceSpec) -> DeviceSpec:
    """Give a document without what no line depends on.

    Args:
        spec: The document.

    Returns:
        The same with plain settings of the render, and without words.
    """
    return msgspec.structs.replace(spec, render=RenderSpec(), title="-", description="")


def forget_all() -> None:
    """Keep nothing of what was drawn."""
    _kept.clear()


def _keep(key: object, make: Callable[[], Lines]) -> Lines:
    if key not in _kept:
        _kept[key] = make()
        while len(_kept) > _MOST_KEPT:
            _kept.popitem(last=False)
    _kept.move_to_end(key)
    return _kept[key]


def _recorded(spec: DeviceSpec) -> Iterator[tuple[SurfaceSpec, RecordingSpec, FloatArray]]:
    """Holograms that were recorded by waves, each with its place."""
    if isinstance(spec, LightGuideSpec):
        for patch in spec.holograms:
            if patch.recording is not None:
                turn = np.eye(3) if patch.face == "eye" else _HALF_TURN
                origin = np.array((*patch.center_mm, spec.guide.face_z_mm(patch.face)))
                surface = PlaneSurface(size_mm=patch.size_mm)
                yield surface, patch.recording, _matrix(turn, origin)
        return
    for element in spec.elements:
        if isinstance(element, HologramElement):
            own = element.hologram
            if own.recording is not None:
                place = _matrix(rotation_of(element), np.asarray(element.position_mm))
                yield own.surface, own.recording, place
        elif isinstance(element, LensElement):
            yield from _on_lens(element)


def _on_lens(lens: LensElement) -> Iterator[tuple[SurfaceSpec, RecordingSpec, FloatArray]]:
    turn = rotation_of(lens)
    for face in FACES:
        own = lens.face(face).hologram
        if own is not None and own.recording is not None:
            vertex = turn @ np.array((0.0, 0.0, lens.vertex_z_mm(face)))
            place = _matrix(turn, np.asarray(lens.position_mm) + vertex)
            yield lens.face(face).surface(lens.diameter_mm), own.recording, place


def _matrix(turn: FloatArray, origin: FloatArray) -> FloatArray:
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = turn, origin
    return made
