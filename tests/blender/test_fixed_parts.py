# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a light guide stand where its numbers put them: nothing else is rendered unsaid."""

from collections.abc import Callable
from typing import Any

import pytest

from hoe_addon.blender.add.presets import add_device
from hoe_addon.blender.document.held import device_of
from hoe_addon.blender.document.live import settle, settle_changed
from hoe_addon.blender.document.size import set_size
from hoe_addon.blender.props import changes
from hoe_addon.core.errors import SpecError


@pytest.fixture
def scene(registered: Any) -> Any:
    """A light guide in a scene, away from its origin, turned, and twice its size."""
    root = add_device(registered, "two_hologram_ar", (300.0, 20.0, -70.0)).root
    root.rotation_euler.z += 0.7
    registered.view_layers[0].update()
    set_size(registered, 2.0)
    return registered


def shift(item: Any) -> None:
    item.location.z += 3.0


def turn(item: Any) -> None:
    item.rotation_euler.y += 0.1


def stretch(item: Any) -> None:
    item.scale.x = 1.3


@pytest.mark.parametrize("move", [shift, turn, stretch])
@pytest.mark.parametrize(
    ("part", "name"), [("plate", "guide"), ("mount", "light engine"), ("panel", "display")]
)
def test_moved_part_is_told(scene: Any, part: str, name: str, move: Callable[[Any], None]) -> None:
    owner = scene.hologram.guide if part == "plate" else scene.hologram.engine
    item = getattr(owner, part)
    before = item.matrix_basis.copy()
    changes.forget(scene)
    move(item)
    scene.view_layers[0].update()
    assert changes.is_changed(scene), "a handler has seen it"
    settle_changed(frozenset((scene.session_uid,)))
    words = f"{name}: must stand where its numbers put it; undo the move"
    assert scene.hologram.problem.startswith(words)
    with pytest.raises(SpecError, match=words):
        device_of(scene)
    item.matrix_basis = before
    scene.view_layers[0].update()
    settle_changed(frozenset((scene.session_uid,)))
    assert scene.hologram.problem == ""
    device_of(scene)


def test_numbers_move_the_engine(scene: Any) -> None:
    scene.hologram.engine.distance_mm += 2.0
    assert "engine" in settle(scene)
    device_of(scene)


def test_the_device_moves_as_a_whole(scene: Any) -> None:
    changes.forget(scene)
    scene.hologram.root.location.x += 1e4
    scene.view_layers[0].update()
    assert not changes.is_changed(scene)
    device_of(scene)


def test_parts_are_locked(scene: Any) -> None:
    held = scene.hologram
    for item in (held.guide.plate, held.engine.mount, *held.engine.mount.children):
        assert all((*item.lock_location, *item.lock_rotation, *item.lock_scale)), item.name
    assert not any(held.root.lock_location)
