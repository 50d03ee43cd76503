# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts of the window pictures share: open a file, lay the window out, take the picture.

A window needs time between its steps, so they are called by a timer; without a window they run
one after the other, and no picture is taken.
"""

import math
import os
import shlex
import subprocess
from collections.abc import Callable, Collection
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from types import ModuleType

import addon_utils
import bpy
from mathutils import Euler, Vector

ADDON = "bl_ext.user_default.hoe_addon"
FOLDER = os.environ.get("HOE_WINDOW", ".")
"""Folder of the .blend files."""
THEME = os.environ.get("HOE_THEME", "dark")
SCALE = os.environ.get("HOE_SCALE", "1")
PICTURE = os.environ.get("HOE_PICTURE", "window.png")
TAKER = os.environ.get("HOE_TAKER", "")
"""Program that takes the picture, with its options; none leaves it to Blender."""

THEMES = {"dark": "Blender_Dark.xml", "light": "Blender_Light.xml"}
PREFIX = "HOE_PT_"
PANELS = {"VIEW_3D": "UI", "PROPERTIES": "WINDOW"}
"""Region of an editor that has the panels."""
WAIT_S = 2.0
"""What a window of software OpenGL takes to draw everything after a step."""

type Step = Callable[[], None]


@dataclass(frozen=True)
class View:
    """Where the 3-D view looks from.

    Attributes:
        center: What it looks at, mm.
        distance: How far from it, mm.
        turn_deg: Angles about x, y and z.
    """

    center: tuple[float, float, float]
    distance: float
    turn_deg: tuple[float, float, float]


@dataclass(frozen=True)
class Picture:
    """One picture of the window.

    Attributes:
        blend: Name of the file that is open in it.
        opened: Panels that are open, without prefix, with their place or in all; others are closed.
        hidden: Panels that are not there.
        view: Where from; None leaves it to the file.
        sidebar: Whether the sidebar is there.
        alone: Whether the 3-D view fills the window.
        prepare: What is changed before the window is drawn.
        later: What can be changed only when it has been drawn once.
    """

    blend: str
    opened: Collection[str] = ()
    hidden: Collection[str] = ("banner",)
    view: View | None = None
    sidebar: bool = True
    alone: bool = False
    prepare: Step = field(default=lambda: None)
    later: Step = field(default=lambda: None)


def take(picture: Picture) -> None:
    """Make a picture, and quit; without a window only lay everything out.

    Args:
        picture: What it shows.
    """
    steps = steps_of(picture)
    if bpy.app.background:
        for step in steps:
            step()
        return
    begin([*steps, write, bpy.ops.wm.quit_blender])


def steps_of(picture: Picture) -> list[Step]:
    """What has to be done for a picture, with time for the window to be drawn in between.

    Args:
        picture: What it shows.
    """
    return [
        lambda: _open(picture),
        lambda: _lay_out(picture),
        _show_tab,
        picture.later,
    ]


def begin(steps: list[Step]) -> None:
    """Go through steps while the window is drawn.

    Args:
        steps: The steps.
    """

    def tick() -> float | None:
        steps.pop(0)()
        _redraw()
        return WAIT_S if steps else None

    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)


def write() -> None:
    """Take the picture."""
    if TAKER:
        subprocess.run([*shlex.split(TAKER), PICTURE], check=True)
        return
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.screen.screenshot(filepath=PICTURE, check_existing=False)


def part(name: str) -> ModuleType:
    """A module of the add-on, installed as an extension or not.

    Args:
        name: Its name within the package, such as ``ui.jobs.job``.
    """
    panel = next(each for each in bpy.types.Panel.__subclasses__() if _is_ours(each))
    return import_module(f"{panel.__module__.partition('.ui.')[0]}.{name}")


def area() -> bpy.types.Area:
    """The 3-D view."""
    areas = bpy.context.window_manager.windows[0].screen.areas
    found = (each for each in areas if each.type == "VIEW_3D")
    return max(found, key=lambda each: each.width * each.height)


def region(kind: str) -> bpy.types.Region:
    """A region of the 3-D view.

    Args:
        kind: ``WINDOW`` or ``UI``.
    """
    return next(each for each in area().regions if each.type == kind)


def scene() -> bpy.types.Scene:
    """The scene that the window shows."""
    return bpy.context.window_manager.windows[0].scene


def hide_room() -> None:
    """Show the device alone."""
    room = scene().hologram.room.collection
    if room is not None:
        scene().view_layers[0].layer_collection.children[room.name].hide_viewport = True


def scroll(kind: str, steps: int) -> None:
    """Scroll panels down, as the mouse wheel does.

    Args:
        kind: ``VIEW_3D`` for those of the sidebar, ``PROPERTIES`` for those of that editor.
        steps: How far, in steps of the wheel.
    """
    if bpy.app.background:
        return
    window = bpy.context.window_manager.windows[0]
    found = next(each for each in window.screen.areas if each.type == kind)
    panels = next(each for each in found.regions if each.type == PANELS[kind])
    with bpy.context.temp_override(window=window, area=found, region=panels):
        for _ in range(steps):
            bpy.ops.view2d.scroll_down()


def show_properties(tab: str) -> None:
    """Choose a tab of the properties editor.

    Args:
        tab: Blender's name of it.
    """
    areas = bpy.context.window_manager.windows[0].screen.areas
    next(each for each in areas if each.type == "PROPERTIES").spaces.active.context = tab


def _open(picture: Picture) -> None:
    if not hasattr(bpy.types.Scene, "hologram"):
        addon_utils.enable(ADDON)
    bpy.ops.wm.open_mainfile(filepath=str(Path(FOLDER).resolve() / f"{picture.blend}.blend"))
    preferences = bpy.context.preferences
    preferences.use_preferences_save = False
    preferences.view.show_splash = False
    preferences.view.ui_scale = float(SCALE)
    _set_theme()
    _lay_panels_out(picture)


def _lay_out(picture: Picture) -> None:
    """Done once the file's own window stands."""
    space = area().spaces.active
    space.show_region_ui = picture.sidebar
    space.overlay.show_extras = space.overlay.show_relationship_lines = False
    if picture.view is not None:
        _look(space, picture.view)
    picture.prepare()
    if picture.alone and not bpy.app.background:
        window = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(window=window, area=area(), region=region("WINDOW")):
            bpy.ops.screen.screen_full_area()


def _set_theme() -> None:
    folders = bpy.utils.preset_paths("interface_theme")
    found = next(path for name in folders if (path := Path(name) / THEMES[THEME]).is_file())
    bpy.ops.script.execute_preset(
        filepath=str(found), menu_idname="USERPREF_MT_interface_theme_presets"
    )


def _is_ours(panel: type[bpy.types.Panel]) -> bool:
    return panel.__name__.startswith(PREFIX) and panel.is_registered


def _lay_panels_out(picture: Picture) -> None:
    """Register the panels anew, open or closed: nothing else decides that before they are drawn."""
    panels = [each for each in bpy.types.Panel.__subclasses__() if _is_ours(each)]
    for panel in reversed(panels):
        bpy.utils.unregister_class(panel)
    for panel in panels:
        own = panel.__name__.removeprefix(PREFIX)
        names = {own, own.rpartition("_")[0]}
        if names & set(picture.hidden):
            panel.poll = classmethod(lambda _panel, _context: False)
        options = set(getattr(panel, "bl_options", ())) - {"DEFAULT_CLOSED"}
        closed = {"DEFAULT_CLOSED"} if not names & set(picture.opened) else set()
        panel.bl_options = options | closed
        bpy.utils.register_class(panel)


def _look(space: bpy.types.SpaceView3D, view: View) -> None:
    shown = space.region_3d
    shown.view_perspective = "PERSP"
    shown.view_location = Vector(view.center)
    shown.view_distance = view.distance
    shown.view_rotation = Euler([math.radians(angle) for angle in view.turn_deg]).to_quaternion()
    space.clip_start, space.clip_end = 0.1, 20000.0


def _show_tab() -> None:
    space = area().spaces.active
    if space.show_region_ui and not bpy.app.background:
        region("UI").active_panel_category = "Hologram"


def _redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for each in window.screen.areas:
            each.tag_redraw()
