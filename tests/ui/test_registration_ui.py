# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every class of the window is registered and tested, and goes without leaving anything."""

import ast
import gc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest

import hoe_addon
from hoe_addon.ui.ids import Menu, Op
from hoe_addon.ui.overlay import draw as overlay_drawing
from hoe_addon.ui.overlay import state as overlay_state
from tests.package.blender_state import drawn_too
from tests.ui.layouts import draw, own_panels
from tests.ui.window import Window, drawn_menu

TESTS = Path(__file__).parents[1]
CYCLES = 50

WITHOUT_A_WINDOW = {
    Op.JOB_ENDED: "Blender gives its events only to a window; its work is in test_jobs.py",
    Op.CANCEL: "there is a job only beside a window; its function is called in test_jobs_start.py",
}
"""Operators that no test calls by name, and where their work is tested."""


def own_classes() -> list[type]:
    """All classes for Blender that the window defines, also those that are made in a loop."""
    kinds = ("Operator", "Panel", "Menu", "UIList")
    return [
        item
        for kind in kinds
        for item in getattr(bpy.types, kind).__subclasses__()
        if "hoe_addon" in item.__module__.split(".")
    ]


def called_in(path: Path) -> set[str]:
    """Operators that a test calls: by ``Op.NAME``, or as an attribute of ``bpy.ops.hologram``."""
    names = {name.value.removeprefix("hologram."): name for name in Op}
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Attribute):
            continue
        owner = ast.unparse(node.value)
        if owner == "Op" and node.attr in Op.__members__:
            found.add(Op[node.attr])
        elif owner in ("bpy.ops.hologram", "OPS") and node.attr in names:
            found.add(names[node.attr])
    return found


def test_every_class_is_registered(registered: Any) -> None:
    assert [item for item in own_classes() if not item.is_registered] == []
    assert {getattr(item, "bl_idname", None) for item in own_classes()} >= {*Op, *Menu}
    names = [item.__name__ for item in own_classes()]
    assert len(names) == len(set(names)) > 80


def test_every_operator_is_in_some_test() -> None:
    """Whatever is new here shows up until a test drives it."""
    own = Path(__file__).name
    tests = [path for path in sorted(TESTS.rglob("test_*.py")) if path.name != own]
    called: dict[str, list[str]] = {}
    for path in tests:
        for name in called_in(path):
            called.setdefault(name, []).append(path.name)
    assert set(Op) - called.keys() == WITHOUT_A_WINDOW.keys() - called.keys()
    assert "test_device_operators.py" in called[Op.ADD_PATCH]


@pytest.fixture
def window(
    registered: Any, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Window:
    """A window that nobody sees."""
    return Window(monkeypatch, lambda: "".join(capfd.readouterr()))


def grating() -> None:
    """A hologram whose efficiencies are worked out with coupled waves."""
    bpy.context.object.active_material.hologram.efficiency.model = "rcwa"


def troubled() -> None:
    bpy.context.scene.render.engine = "BLENDER_EEVEE"


def mapped() -> None:
    bpy.context.object.active_material.hologram.pattern = "characteristic"


STATES: tuple[Callable[[], object], ...] = (
    lambda: bpy.ops.mesh.primitive_cube_add(),
    lambda: bpy.ops.hologram.add_hologram(),
    lambda: bpy.ops.hologram.plan(),
    grating,
    mapped,
    lambda: bpy.ops.hologram.add_display(),
    troubled,
    lambda: bpy.ops.hologram.add_preset(preset="two_hologram_ar", place="SCENE"),
)
"""What a user does, one after the other."""


def test_every_panel_is_drawn_in_some_state(window: Window) -> None:
    left = {panel.__name__: panel for panel in own_panels()}
    assert len(left) > 40
    for change in STATES:
        change()
        window.settle()
        for name in [name for name, panel in left.items() if draw(panel) is not None]:
            del left[name]
    assert sorted(left) == []


def test_every_menu_is_drawn(registered: Any) -> None:
    for menu in Menu:
        assert drawn_menu(getattr(bpy.types, menu))


def counts() -> dict[str, Any]:
    """All that might grow; by name, or counted."""
    rna = [item for name in dir(bpy.types) if isinstance(item := getattr(bpy.types, name), type)]
    manager = bpy.context.window_manager
    return {
        "types": set(dir(bpy.types)),
        "operators": set(dir(bpy.ops.hologram)),
        "handlers": {
            name: len(found)
            for name in dir(bpy.app.handlers)
            if isinstance(found := getattr(bpy.app.handlers, name), list)
        },
        "drawn in menus": {
            item.__name__: len(also)
            for item in rna
            if (also := getattr(getattr(item, "draw", None), "_draw_funcs", ()))
        },
        "drawn too": sum(len(drawn_too(item)) for item in rna),
        "properties": {
            item.__name__: set(item.bl_rna.properties.keys())
            for item in rna
            if issubclass(item, bpy.types.ID)
        },
        "keys": sum(
            len(keymap.keymap_items) for config in manager.keyconfigs for keymap in config.keymaps
        ),
        "previews": sum(
            type(item) is bpy.utils.previews.ImagePreviewCollection for item in gc.get_objects()
        ),
        "batches": len(overlay_drawing._drawing.batches),
        "drawings": len(overlay_drawing._drawing.handlers),
        "lines": len(overlay_state._shown),
    }


@pytest.mark.slow
def test_enabled_and_disabled_many_times(clean_scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """With timers that wait, facts that are known, and a scene that holds a device."""
    said: list[str] = []
    window: Window | None = None

    def cycle() -> None:
        nonlocal window
        hoe_addon.register()
        window = window or Window(monkeypatch, lambda: "".join(said))
        if not bpy.context.scene.hologram.root:
            bpy.ops.hologram.add_hologram()
        bpy.context.object.active_material.hologram.recording.wavelength_nm += 1.0
        window.settle()
        bpy.context.object.active_material.hologram.recording.wavelength_nm -= 1.0
        assert window.timers.waiting
        hoe_addon.unregister()
        assert not window.timers.waiting

    for _ in range(3):
        cycle()
    gc.collect()
    before, objects = counts(), len(gc.get_objects())
    for _ in range(CYCLES):
        cycle()
    gc.collect()
    assert counts() == before
    # Blender itself may keep a few once; a leak would be some objects in every cycle.
    assert len(gc.get_objects()) - objects < CYCLES
