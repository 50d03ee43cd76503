# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The curved hologram of the head-up display in Cycles."""

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import load_device
from hoe_addon.model.evaluate import trace
from hoe_addon.model.rays import RayTable
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_view import rotation_of

pytestmark = pytest.mark.render

RAYS = 600
GREEN_NM = 532.0
EYEBOX_MM = (60.0, 30.0)

DIRECTION = 2e-6
"""Radians: what float32 keeps. The shader works on the true surface, so facets add nothing."""

AT_DISPLAY_MM = 2e-3
"""Some 0.6 m away with this error, and as much for the place of the hit."""


def test_every_ray_of_the_eyebox_toward_the_picture_comes_from_the_display(
    rng: np.random.Generator,
) -> None:
    """The middle of the picture is sharp in Cycles, from all of the curved surface."""
    scene = load_device("hud_combiner")
    assert isinstance(scene, SceneSpec)
    combiner, display = scene.hologram("combiner"), scene.element("display")
    recording = combiner.hologram.recording
    assert recording is not None
    turn, origin = rotation_of(combiner), np.asarray(combiner.position_mm)
    half = 0.5 * np.asarray(EYEBOX_MM)
    pupils = np.column_stack((rng.uniform(-half, half, (RAYS, 2)), np.zeros(RAYS)))
    start = (pupils - origin) @ turn
    toward = np.asarray(recording.object.position_mm) - start
    toward /= np.linalg.norm(toward, axis=1, keepdims=True)
    rays = RayTable(
        start,
        toward,
        np.full(RAYS, GREEN_NM),
        np.ones(RAYS, dtype=np.int64),
        np.ones(RAYS, dtype=np.bool_),
    )
    found, wanted = trace_cycles(combiner.hologram, rays), trace(combiner.hologram, rays)
    assert np.all(found.status == Status.OK)
    assert np.max(np.linalg.norm(found.direction - wanted.direction, axis=1)) < DIRECTION
    to_display = (np.asarray(display.position_mm) - origin) @ turn - found.hit_mm
    beside = np.linalg.norm(np.cross(to_display, found.direction), axis=1)
    assert np.max(beside) < AT_DISPLAY_MM
