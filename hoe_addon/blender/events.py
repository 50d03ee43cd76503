# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What follows an undo, an opened file, a link, a new frame: shaders agree with properties again.

Handlers run for every file and every frame, so each looks first, cheaply, whether there is
anything to do.
"""

import contextlib

import bpy
from bpy.app.handlers import persistent

from ..core.errors import HoeError
from .document import live, versions
from .props.sync import catch_up, refresh_frame
from .shaders import stand_in
from .shaders.animated import animated_holograms


def register() -> None:
    """Listen to Blender."""
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).append(handler)


def unregister() -> None:
    """Listen no more."""
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).remove(handler)


@persistent
def _after_undo(scene: bpy.types.Scene, *_arguments: object) -> None:
    # In a window the shader is made after the undo step of its property: a redo brings the
    # property alone.
    if versions.file_is_newer():
        return
    catch_up()
    live.settle_changed(frozenset(each.session_uid for each in bpy.data.scenes))
    # Materials may come from a step when the setting was another one.
    stand_in.settle(scene)


@persistent
def _after_load(*_arguments: object) -> None:
    versions.migrate_file()
    if not versions.file_is_newer():
        catch_up()
    stand_in.settle(bpy.context.scene)


@persistent
def _after_import(*_arguments: object) -> None:
    if versions.file_is_newer():
        return
    for scene in bpy.data.scenes:
        if scene.library is None:
            versions.give_roles(scene)
    catch_up()
    stand_in.settle(bpy.context.scene)


@persistent
def _after_frame(_scene: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    for material in animated_holograms():
        # What is wrong stands in the property, where a panel shows it.
        with contextlib.suppress(HoeError):
            refresh_frame(material, graph)


@persistent
def _after_update(scene: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    stand_in.settle_if_changed(scene)
    if graph.id_type_updated("OBJECT"):
        live.note_moves(scene)
    if graph.id_type_updated("MATERIAL"):
        updated = {update.id.original for update in graph.updates}
        for material in animated_holograms():
            if material in updated:
                with contextlib.suppress(HoeError):
                    refresh_frame(material, graph)


@persistent
def _before_render(scene: bpy.types.Scene, *_arguments: object) -> None:
    stand_in.settle_if_changed(scene)


_HANDLERS = {
    "undo_post": _after_undo,
    "redo_post": _after_undo,
    "load_post": _after_load,
    "blend_import_post": _after_import,
    "frame_change_post": _after_frame,
    "depsgraph_update_post": _after_update,
    "render_init": _before_render,
}
