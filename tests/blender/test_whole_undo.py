# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Undo after a timer has exchanged datablocks that no undo step knows."""

import subprocess
import sys
from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender import whole_undo

ROOT = Path(__file__).parents[2]

STEPS = """
import bpy, hoe_addon
from hoe_addon.blender.props import changes

def step(message):
    bpy.ops.ed.undo_push(message=message)
    changes._tell()
    bpy.context.view_layer.update()

def size():
    (screen,) = (item for item in bpy.data.objects if item.hologram.role == "filter")
    return round(screen.dimensions.x)

bpy.ops.wm.read_factory_settings(use_empty=True)
hoe_addon.register()
bpy.ops.hologram.add_eye()
step("add")
step("again")
for diameter in (20.0, 40.0):
    bpy.context.scene.hologram.eye.pupil_diameter_mm = diameter
    step("diameter")
found = [size()]
for way in "uuurrruuurrr":
    (bpy.ops.ed.undo if way == "u" else bpy.ops.ed.redo)()
    bpy.context.view_layer.update()
    found.append(size())
hoe_addon.unregister()
print("sizes", *found)
"""
"""As in a window: the step of a slider is kept, then a timer makes the mesh anew."""


def test_objects_follow_undo_and_redo() -> None:
    """In a process of its own, for a mistake here ends Blender."""
    done = subprocess.run(
        [sys.executable, "-c", STEPS], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    sizes = done.stdout.partition("sizes ")[2].split()
    assert " ".join(sizes) == "41 21 5 5 5 21 41 21 5 5 5 21 41"


@pytest.fixture
def seen(registered: Any) -> list[bool]:
    """Whether each undo reads the whole step, as the preferences say while it does."""
    found: list[bool] = []

    def look(*_arguments: object) -> None:
        found.append(bpy.context.preferences.experimental.use_undo_legacy)

    bpy.app.handlers.undo_pre.append(look)
    yield found
    bpy.app.handlers.undo_pre.remove(look)


def test_from_an_exchange_on(seen: list[bool]) -> None:
    for message in "abcd":
        bpy.ops.ed.undo_push(message=message)
    preferences = bpy.context.preferences
    before = preferences.is_dirty, preferences.view.show_developer_ui
    bpy.ops.ed.undo()
    whole_undo.note_exchange()
    bpy.ops.ed.undo()
    assert not preferences.experimental.use_undo_legacy
    assert (preferences.is_dirty, preferences.view.show_developer_ui) == before
    bpy.ops.ed.undo()
    assert seen == [False, True, True]
