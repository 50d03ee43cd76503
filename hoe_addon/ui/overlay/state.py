# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn of each scene, kept up to date with it.

Everything is kept by session ids, never by Blender's own objects, which an undo replaces.
"""

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import bpy
import msgspec
import numpy as np

from ...blender.add.elements import has_eye
from ...blender.document.elements import element_objects
from ...blender.document.held import document_of, has_device
from ...blender.props.sync import read_frame, read_spec
from ...blender.props.values import number
from ...core.arrays import FloatArray
from ...core.errors import HoeError
from ...model.chief_rays import Orders
from ...model.device import DeviceSpec
from ...model.hologram import HologramSpec
from . import document
from .document import OF_EYE, Density, Drawing, Kind, drawing_of, sources_of, without_render
from .eye import Label
from .lines import Lines

_MOST_LONE = 32
"""Holograms outside the document whose sources are drawn."""

type _Lone = list[tuple[HologramSpec, FloatArray]]


@dataclass(frozen=True, eq=False)
class Shown:
    """What is drawn of a scene.

    Attributes:
        drawing: Lines and words in the coordinates of the scene.
        is_stale: Whether the scene has become invalid since; the lines are what it was before.
        problem: Why it is invalid, or empty.
        key: What it was made of.
        number: Another one whenever the lines are others, in any scene.
    """

    drawing: Drawing
    is_stale: bool = False
    problem: str = ""
    key: object = None
    number: int = 0


_NOTHING = Shown(Drawing({}))
_shown: dict[int, Shown] = {}
_numbers = itertools.count(1)


def shown(scene: bpy.types.Scene) -> Shown:
    """Give what is drawn of a scene.

    Args:
        scene: The scene.

    Returns:
        What `refresh` has made last.
    """
    return _shown.get(scene.session_uid, _NOTHING)


def forget_others(scenes: Iterable[bpy.types.Scene]) -> None:
    """Keep nothing of scenes that are gone.

    Args:
        scenes: Those that are there.
    """
    here = {scene.session_uid for scene in scenes}
    for gone in _shown.keys() - here:
        del _shown[gone]


def is_kept(session_uid: int) -> bool:
    """Whether anything is kept of the scene with this session id."""
    return session_uid in _shown


def forget_all() -> None:
    """Keep nothing of any scene."""
    _shown.clear()
    document.forget_all()


def kinds_of(scene: bpy.types.Scene) -> frozenset[Kind]:
    """Which kinds are switched on in a scene; without an eye nothing that begins there."""
    switches = scene.hologram.overlay
    if not switches.show:
        return frozenset()
    kinds = frozenset(kind for kind in Kind if getattr(switches, kind.value))
    return kinds if has_eye(scene) else kinds - OF_EYE


def refresh(scene: bpy.types.Scene) -> bool:
    """Bring what is drawn of a scene up to date.

    Args:
        scene: The scene.

    Returns:
        Whether it changed.
    """
    before = shown(scene)
    try:
        made = _made(scene, before)
    except HoeError as error:
        made = replace(before, is_stale=True, problem=str(error))
    if made == before or (made.number, made.problem) == (before.number, before.problem):
        return False
    _shown[scene.session_uid] = made
    return True


def _made(scene: bpy.types.Scene, before: Shown) -> Shown:
    switches, kinds = scene.hologram.overlay, kinds_of(scene)
    if not kinds:
        return _NOTHING
    orders = Orders(switches.lowest_order, switches.highest_order)
    density = Density(switches.rays, switches.corners, orders)
    spec = document_of(scene) if has_device(scene) else None
    root = np.eye(4) if spec is None else np.array(scene.hologram.root.matrix_world)
    lone = _lone_holograms(scene) if Kind.SOURCES in kinds else []
    key = (
        b"" if spec is None else msgspec.json.encode(without_render(spec)),
        root.tobytes(),
        tuple((msgspec.json.encode(own.recording), place.tobytes()) for own, place in lone),
        density,
        kinds,
    )
    if key == before.key:
        return replace(before, is_stale=False, problem="")
    drawing = _drawing(spec, root, lone, density, kinds)
    return Shown(drawing, key=key, number=next(_numbers))


def _drawing(
    spec: DeviceSpec | None,
    root: FloatArray,
    lone: _Lone,
    density: Density,
    kinds: frozenset[Kind],
) -> Drawing:
    lines: dict[Kind, list[Lines]] = {kind: [] for kind in Kind}
    labels: tuple[Label, ...] = ()
    if spec is not None:
        drawing = drawing_of(spec, density, kinds)
        for kind, some in drawing.lines.items():
            lines[kind].append(some.moved(root))
        labels = tuple(label.moved(root) for label in drawing.labels)
    for own, place in lone:
        assert own.recording is not None, "only recorded holograms are drawn"
        drawn = sources_of(own.surface, own.recording, density.rays)
        lines[Kind.SOURCES].append(drawn.moved(place))
    return Drawing({kind: Lines.joined(some) for kind, some in lines.items() if some}, labels)


def _lone_holograms(scene: bpy.types.Scene) -> _Lone:
    """Recorded holograms that are no part of the document, with their places in the scene."""
    found: _Lone = []
    known = _known_objects(scene)
    for item in scene.objects:
        if item.session_uid in known or item.type != "MESH" or not item.visible_get():
            continue
        for slot in item.material_slots:
            if slot.material is not None and slot.material.hologram.enabled:
                own = read_spec(slot.material, item)
                if own.recording is not None and len(found) < _MOST_LONE:
                    found.append((own, _place(item, slot.material)))
    return found


def _known_objects(scene: bpy.types.Scene) -> frozenset[int]:
    """Session ids of the objects that the document is made into."""
    if not has_device(scene):
        return frozenset()
    return frozenset(_ids_of(scene))


def _ids_of(scene: bpy.types.Scene) -> Iterator[int]:
    plate = scene.hologram.guide.plate
    if plate is not None:
        yield plate.session_uid
    for item in element_objects(scene):
        yield item.session_uid
        yield from (child.session_uid for child in item.children_recursive)


def _place(item: bpy.types.Object, material: bpy.types.Material) -> FloatArray:
    """From the hologram's frame in mm to the scene."""
    units = number(material.hologram, "units_per_mm")
    scale = np.diag((units, units, units, 1.0))
    return np.array(item.matrix_world) @ read_frame(material).matrix() @ scale
