# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects follow the properties of their scene's document, part by part.

Each part keeps a digest of what it was last made of; only what differs is made anew, in place: an
object stays the same datablock with its own place, parents and animation.
"""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import bpy

from ...core.errors import HoeError
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.document import to_document
from .. import whole_undo
from ..props import changes
from ..units import scale_of
from . import notes, remake
from .elements import elements_by_name
from .held import document_of, has_device
from .notes import Part
from .places import check_fixed, is_stretched

_OWN = ("name", "position_mm", "rotation_deg", "hologram")
"""Fields of an element that its shape does not depend on."""

_LIGHT = "luminance_cd_m2"

_PUPIL = "pupil"

_invalid: set[int] = set()
"""Session ids of scenes whose document was not valid when they were last settled."""


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
            spec = document_of(scene)
            for part in _parts(scene, spec):
                if not notes.is_made(part):
                    made.append(part.name)
                    # Half made it is like nothing: it is made anew whatever it is then to be.
                    notes.forget(part)
                    part.make()
                    notes.note(part)
            if isinstance(spec, LightGuideSpec):
                for layer in scene.view_layers if made else ():
                    layer.update()  # parts that were made anew may stand elsewhere
                check_fixed(scene, spec)
            notes.note(_fixed(scene))
    except HoeError as error:
        _invalid.add(scene.session_uid)
        _tell(held, str(error))
        raise
    _invalid.discard(scene.session_uid)
    _tell(held, "")


def remember(scene: bpy.types.Scene) -> None:
    """Note that a scene's objects are what its document says, as after building it.

    Args:
        scene: A scene that holds a document.
    """
    for part in _parts(scene, document_of(scene)):
        notes.note(part)
    notes.note(_fixed(scene))


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


def note_moves(scene: bpy.types.Scene) -> None:
    """Note a change where a move asks for one.

    It does where the eye was scaled, alone or with its device, for its pupil follows; where a part
    was moved whose place follows from numbers; and anywhere in a scene whose document was not
    valid, for the move may have mended it.

    Args:
        scene: The scene; handlers call this whenever one of its objects has moved.
    """
    if scene.library is not None or not has_device(scene):
        return
    eye = scene.hologram.eye.camera
    if (
        scene.session_uid in _invalid
        or (eye is not None and (is_stretched(eye) or not notes.is_made(_pupil(scene))))
        or not notes.is_made(_fixed(scene))
    ):
        changes.mark_block(scene)


def register() -> None:
    """Let objects follow properties."""
    changes.listen(settle_changed)


def unregister() -> None:
    """Let them follow no more."""
    changes.stop(settle_changed)
    _invalid.clear()


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


def _parts(scene: bpy.types.Scene, spec: DeviceSpec) -> Iterator[Part]:
    """All parts of a document, each after those that it depends on."""
    held, document = scene.hologram, to_document(spec)
    render = document["render"]
    unit = render["luminance_per_unit_cd_m2"]

    def part(name: str, what: Any, make: Callable[[bpy.types.Scene, Any], None]) -> Part:
        return Part(name, held, what, lambda: make(scene, spec))

    yield _pupil(scene, lambda: remake.pupil(scene, spec))
    yield part("settings", [render["mode"], render["max_bounces"]], remake.settings)
    if isinstance(spec, LightGuideSpec):
        yield part("guide", _guide_of(document), remake.guide)
        yield part("engine", _engine_of(document), remake.engine)
    else:
        items = elements_by_name(scene)
        for element in document["elements"]:
            yield _shape_part(scene, spec, element, items[element["name"]])
    yield part("spectrum", _spectrum_of(document), remake.spectrum)
    yield part("preview", render["preview_wavelength_nm"], remake.preview)
    yield part("eye", [render["mode"], document["eye"]], remake.eye)
    room = part("room", [document["room"], unit], remake.room)
    yield replace(room, size=scale_of(held.root))
    if isinstance(spec, LightGuideSpec):
        light = spec.display.luminance_cd_m2 / unit
        yield _light_part(held, held.engine.panel, light)
    else:
        for element in document["elements"]:
            light = element.get("display", element).get(_LIGHT)
            if light is not None:
                item = items[element["name"]]
                yield _light_part(item.hologram, item, light / unit)


def _pupil(scene: bpy.types.Scene, make: Callable[[], None] = lambda: None) -> Part:
    """The pupil of the eye at its size in the scene; it depends on no other part."""
    held = scene.hologram
    return Part(_PUPIL, held, None, make, scale_of(held.eye.camera))


def _fixed(scene: bpy.types.Scene) -> Part:
    """Places of parts that nobody moves on their own; they are checked, and never made."""
    held = scene.hologram
    items = (held.guide.plate, held.engine.mount, held.engine.panel)
    what = [[list(row) for row in item.matrix_basis] for item in items if item is not None]
    return Part("places", held, what, lambda: None)


def _shape_part(
    scene: bpy.types.Scene, spec: DeviceSpec, element: dict[str, Any], item: bpy.types.Object
) -> Part:
    """The shape of an element; its light, its place and its recording stand apart."""
    if element["kind"] == "hologram":
        surface = element["hologram"]["surface"]
        return Part(
            "shape", item.hologram, surface, lambda: remake.hologram_mesh(scene, spec, item)
        )
    what = {name: value for name, value in element.items() if name not in (*_OWN, _LIGHT)}
    if "display" in what:
        what["display"] = {n: value for n, value in what["display"].items() if n != _LIGHT}
    return Part("shape", item.hologram, what, lambda: remake.element(scene, spec, item))


def _light_part(owner: bpy.types.PropertyGroup, item: bpy.types.Object, luminance: float) -> Part:
    """How bright a display or a lamp is, in scene units: one number of its shader."""
    return Part("light", owner, luminance, lambda: remake.luminance(item, luminance))


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


def _tell(held: bpy.types.PropertyGroup, problem: str) -> None:
    if held.problem != problem:
        held.problem = problem
