# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects follow the properties of their scene's document, part by part.

Each part keeps a digest of what it was last made of; only what differs is made anew, in place: an
object stays the same datablock with its own place, parents and animation.
"""

import contextlib
import hashlib
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import bpy

from ...core.errors import HoeError
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.document import to_document
from .. import whole_undo
from ..props import changes
from ..units import scale_of
from . import remake
from .held import document_of, has_device

_OWN = ("name", "position_mm", "rotation_deg", "hologram")
"""Fields of an element that its shape does not depend on."""

_LIGHT = "luminance_cd_m2"
_SIZE = "size of the eye"


@dataclass(frozen=True)
class _Part:
    """One part of a scene.

    Attributes:
        name: Its name among those of its owner.
        owner: Property group that keeps its digest in ``made_of``.
        what: All that it is made of, as plain data.
        make: Makes it anew.
    """

    name: str
    owner: bpy.types.PropertyGroup
    what: Any
    make: Callable[[], None]


def settle(scene: bpy.types.Scene) -> tuple[str, ...]:
    """Bring the objects of a scene up to date with its document.

    Args:
        scene: A scene that holds a document.

    Returns:
        Names of the parts that were made anew.

    Raises:
        SpecError: The document is not valid; nothing is changed then.
        HoeError: A part cannot be made; those before it are up to date.
    """
    made: list[str] = []
    _settle(scene, made)
    return tuple(made)


def _settle(scene: bpy.types.Scene, made: list[str]) -> None:
    """As ``settle``; ``made`` grows by what was made anew, also where a later part fails."""
    held = scene.hologram
    try:
        with changes.unmarked():
            for part in _parts(scene, document_of(scene)):
                if _made_of(part).get(part.name) != _digest(part.what):
                    made.append(part.name)
                    part.make()
                    _note(part)
    except HoeError as error:
        _tell(held, str(error))
        raise
    _tell(held, "")


def remember(scene: bpy.types.Scene) -> None:
    """Note that a scene's objects are what its document says, as after building it.

    Args:
        scene: A scene that holds a document.
    """
    for part in _parts(scene, document_of(scene)):
        _note(part)


def settle_changed(changed: frozenset[int]) -> None:
    """Bring scenes up to date of which something has changed; a timer does so in a window.

    What is wrong with one stands in ``Scene.hologram.problem``, and the others go on.

    Args:
        changed: Session ids of datablocks that have changed.
    """
    for scene in bpy.data.scenes:
        if scene.library is None and has_device(scene) and _concerns(scene, changed):
            made: list[str] = []
            with contextlib.suppress(HoeError):
                _settle(scene, made)
            if made:
                whole_undo.note_exchange()
    for block in (*bpy.data.scenes, *bpy.data.objects):
        if block.session_uid in changed:
            changes.forget(block)


def note_size(scene: bpy.types.Scene) -> None:
    """Note a change where the eye was scaled, alone or with its device: its pupil follows.

    Args:
        scene: The scene; handlers call this whenever one of its objects has moved.
    """
    held = scene.hologram
    if scene.library is not None or not has_device(scene) or held.eye.camera is None:
        return
    size = _Part(_SIZE, held, scale_of(held.eye.camera), lambda: None)
    if _made_of(size).get(_SIZE) != _digest(size.what):
        changes.mark_block(scene)


def register() -> None:
    """Let objects follow properties."""
    changes.listen(settle_changed)


def unregister() -> None:
    """Let them follow no more."""
    changes.stop(settle_changed)


def _concerns(scene: bpy.types.Scene, changed: frozenset[int]) -> bool:
    if scene.session_uid in changed:
        return True
    for item in scene.objects:
        if item.session_uid in changed:
            return True
        for slot in item.material_slots:
            if slot.material is not None and slot.material.session_uid in changed:
                return True
    return False


def _parts(scene: bpy.types.Scene, spec: DeviceSpec) -> Iterator[_Part]:
    """All parts of a document, each after those that it depends on."""
    held, document = scene.hologram, to_document(spec)
    render = document["render"]
    unit = render["luminance_per_unit_cd_m2"]

    def part(name: str, what: Any, make: Callable[[bpy.types.Scene, Any], None]) -> _Part:
        return _Part(name, held, what, lambda: make(scene, spec))

    yield part("settings", [render["mode"], render["max_bounces"]], remake.settings)
    if isinstance(spec, LightGuideSpec):
        yield part("guide", _guide_of(document), remake.guide)
        yield part("engine", _engine_of(document), remake.engine)
    else:
        for element in document["elements"]:
            yield _shape_part(scene, spec, element)
    yield part("spectrum", _spectrum_of(document), remake.spectrum)
    yield part("preview", render["preview_wavelength_nm"], remake.preview)
    yield part("eye", [render["mode"], document["eye"]], remake.eye)
    yield part(_SIZE, scale_of(held.eye.camera), remake.pupil)
    size = scale_of(held.root)
    yield part("room", [document["room"], unit, *([size] if size != 1.0 else [])], remake.room)
    if isinstance(spec, LightGuideSpec):
        light = spec.display.luminance_cd_m2 / unit
        yield _light_part(held, held.engine.panel, light)
    else:
        for element in document["elements"]:
            light = element.get("display", element).get(_LIGHT)
            if light is not None:
                item = scene.objects[element["name"]]
                yield _light_part(item.hologram, item, light / unit)


def _shape_part(scene: bpy.types.Scene, spec: DeviceSpec, element: dict[str, Any]) -> _Part:
    """The shape of an element; its light, its place and its recording stand apart."""
    item = scene.objects[element["name"]]
    if element["kind"] == "hologram":
        surface = element["hologram"]["surface"]
        return _Part(
            "shape", item.hologram, surface, lambda: remake.hologram_mesh(scene, spec, item)
        )
    what = {name: value for name, value in element.items() if name not in (*_OWN, _LIGHT)}
    if "display" in what:
        what["display"] = {n: value for n, value in what["display"].items() if n != _LIGHT}
    return _Part("shape", item.hologram, what, lambda: remake.element(scene, spec, item))


def _light_part(owner: bpy.types.PropertyGroup, item: bpy.types.Object, luminance: float) -> _Part:
    """How bright a display or a lamp is, in scene units: one number of its shader."""
    return _Part("light", owner, luminance, lambda: remake.luminance(item, luminance))


def _spectrum_of(document: dict[str, Any]) -> Any:
    render = document["render"]
    lights = [document] if "display" in document else document["elements"]
    colours = [[e.get("spectrum"), e.get("display", {}).get("primaries")] for e in lights]
    return [[render[field] for field in ("mode", "spectrum_floor", "wavelengths")], colours]


def _guide_of(document: dict[str, Any]) -> Any:
    patches = [
        [patch[field] for field in ("name", "face", "center_mm", "size_mm")]
        for patch in document["holograms"]
    ]
    return [document["guide"], patches]


def _engine_of(document: dict[str, Any]) -> Any:
    display, name = document["display"], document["source"]["patch"]
    patch = next(each for each in document["holograms"] if each["name"] == name)
    return [
        document["lens"],
        document["guide"]["relief_mm"],
        patch["center_mm"],
        [display[field] for field in ("size_mm", "image", "white")],
    ]


def _made_of(part: _Part) -> dict[str, str]:
    try:
        found = json.loads(part.owner.made_of or "{}")
    except (ValueError, RecursionError):
        # A file of a stranger may hold any text; all is made anew then.
        return {}
    return found if isinstance(found, dict) else {}


def _note(part: _Part) -> None:
    part.owner.made_of = json.dumps(_made_of(part) | {part.name: _digest(part.what)})


def _tell(held: bpy.types.PropertyGroup, problem: str) -> None:
    if held.problem != problem:
        held.problem = problem


def _digest(what: Any) -> str:
    text = json.dumps(what, sort_keys=True)
    return hashlib.blake2b(text.encode(), digest_size=8).hexdigest()
