# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where one looks out of the eye, its pupil would be drawn across the picture."""

from types import SimpleNamespace
from typing import Any

import bpy

from hoe_addon.ui.overlay import draw
from hoe_addon.ui.overlay.document import Kind


def kinds(scene: Any, perspective: str, local: Any = None) -> frozenset[Kind]:
    context = SimpleNamespace(
        scene=scene,
        space_data=SimpleNamespace(use_local_camera=local is not None, camera=local),
        region_data=SimpleNamespace(view_perspective=perspective),
    )
    return draw._kinds_here(context)  # pyright: ignore[reportArgumentType]


def camera(scene: Any, name: str) -> Any:
    made = bpy.data.objects.new(name, bpy.data.cameras.new(name))
    scene.collection.objects.link(made)
    return made


def test_pupil_and_eyebox_are_not_drawn_around_who_looks(registered: Any) -> None:
    eye, other = camera(registered, "Eye"), camera(registered, "Other")
    registered.hologram.eye.camera = registered.camera = eye
    around = {Kind.PUPIL, Kind.EYEBOX}
    assert around <= kinds(registered, "PERSP")
    assert not around & kinds(registered, "CAMERA")
    assert Kind.SOURCES in kinds(registered, "CAMERA")
    assert around <= kinds(registered, "CAMERA", local=other)
    registered.camera = other
    assert around <= kinds(registered, "CAMERA")
