# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Chosen rays through any scene in Cycles, one pixel row a ray, and what becomes of them."""

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.blender.temporary import temporary_scene
from hoe_addon.shading.probe import MISSED, direction_world_shader, ray_camera_shader
from hoe_addon.shading.source import ShaderSource

type Floats = NDArray[np.float64]

ROWS = 1023
"""Most rays in one render: the arrays of an OSL shader are literals."""

CROSSINGS = ShaderSource(
    "hoe_test_crossings",
    "shader hoe_test_crossings(output closure color result = 0)"
    ' { int n = 0; getattribute("path:transparent_depth", n); result = (float)n * emission(); }',
)
_PLACE = ShaderSource(
    "hoe_test_place",
    "shader hoe_test_place(vector middle = vector(0.0), output closure color result = 0)"
    " { vector place = vector(P) - middle; result = color(place[0], place[1], place[2])"
    " * emission(); }",
)


@dataclass(frozen=True)
class Answers:
    """What came of the rays.

    Attributes:
        direction: Direction in which each left the scene, shape ``(n, 3)``; NaN if it did not.
        weight: Its weight, shape ``(n,)``; 0 where it was absorbed, NaN where it met nothing.
    """

    direction: Floats
    weight: Floats


class RayScene:
    """A scene whose camera is a list of rays; the world answers with their directions."""

    def __init__(self, scene: bpy.types.Scene) -> None:
        self.scene = scene
        self._worlds: dict[str, bpy.types.World] = {}
        camera = bpy.data.cameras.new("rays")
        camera.type, camera.custom_mode = "CUSTOM", "INTERNAL"
        camera.clip_start, camera.clip_end = 1e-6, 1e7
        self._camera = camera
        scene.camera = bpy.data.objects.new("rays", camera)
        scene.collection.objects.link(scene.camera)

    def add(
        self, mesh: bpy.types.Mesh, *made: bpy.types.Material, at: ArrayLike = (0.0, 0.0, 0.0)
    ) -> bpy.types.Object:
        """Put a mesh into the scene."""
        return meshes.add(self.scene.collection, mesh, *made, location=np.asarray(at).tolist())

    def leave(self, origin: ArrayLike, direction: ArrayLike) -> Answers:
        """Directions and weights with which the rays leave the scene."""
        answer = self._walk(direction_world_shader(), origin, direction)
        answer[answer[:, 0] == MISSED] = np.nan
        weight = np.linalg.norm(answer, axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            return Answers(answer / weight[:, None], weight)

    def crossings(self, origin: ArrayLike, direction: ArrayLike) -> Floats:
        """How many portals each ray went through before it left, times its weight."""
        return self._walk(CROSSINGS, origin, direction)[:, 0]

    def rays(self, origin: ArrayLike, direction: ArrayLike) -> Floats:
        """The picture as it is: one row of three numbers a ray."""
        return self._walk(direction_world_shader(), origin, direction)

    def _walk(self, world: ShaderSource, origin: ArrayLike, direction: ArrayLike) -> Floats:
        start, heading = (
            np.asarray(a, dtype=np.float64).reshape(-1, 3) for a in (origin, direction)
        )
        start, heading = np.broadcast_arrays(start, heading)
        self._use_world(world)
        parts = [
            self._render(start[first : first + ROWS], heading[first : first + ROWS])
            for first in range(0, len(start), ROWS)
        ]
        return np.concatenate(parts)

    def _render(self, start: Floats, heading: Floats) -> Floats:
        # Blender's cameras look along -z; the rays are counted from the bottom row, and no
        # picture has fewer than four.
        rows = np.arange(max(4, len(start))).clip(max=len(start) - 1)
        flip = np.array((1.0, 1.0, -1.0))
        source = ray_camera_shader((start * flip)[rows][::-1], (heading * flip)[rows][::-1])
        self._camera.custom_bytecode = compiled(source)
        self._camera.custom_bytecode_hash = source.digest
        self.scene.render.resolution_x, self.scene.render.resolution_y = 1, len(rows)
        picture = render_layers(self.scene, (COMBINED,))[COMBINED]
        return picture[: len(start), 0, :].astype(np.float64)

    def _use_world(self, source: ShaderSource) -> None:
        if source.name not in self._worlds:
            world = bpy.data.worlds.new(source.name)
            tree = nodes.new_tree(world)
            output = tree.nodes.new("ShaderNodeOutputWorld")
            node = nodes.add_script_node(tree, source, {})
            tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
            world.cycles.sampling_method = "NONE"
            self._worlds[source.name] = world
        self.scene.world = self._worlds[source.name]


@contextlib.contextmanager
def ray_scene(max_bounces: int = 16) -> Iterator[RayScene]:
    """A scene for chosen rays, removed with all that was made for it."""
    with temporary_scene("rays") as scene:
        set_up(scene, samples=1, seed=0, spectral=False, max_bounces=max_bounces)
        scene.cycles.pixel_filter_type = "BOX"
        yield RayScene(scene)


def place_material(middle: Sequence[float] = (0.0, 0.0, 0.0)) -> bpy.types.Material:
    """A surface that answers with the point where a ray ends on it, from a point near it."""
    return nodes.script_material("place", _PLACE, {"middle": tuple(middle)})


def float32(values: ArrayLike) -> Floats:
    """The numbers that Cycles makes of these."""
    return np.asarray(values).astype(np.float32).astype(np.float64)
