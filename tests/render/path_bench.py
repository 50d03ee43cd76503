# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A bench for tests: rays onto a hologram, many single paths of each, and the way they left."""

import bpy
import numpy as np
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import materials, nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.blender.shaders.spectral import spectral_scene
from hoe_addon.core.wavelength_sampling import by_significance
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.shading.probe import direction_world_shader, ray_camera_shader
from hoe_addon.shading.source import ShaderSource, array

_WAVELENGTH_BY_PLACE = (
    "shader hoe_test_wavelength(output float wavelength_nm = 550.0)"
    " {{ float each[{count}] = {numbers};"
    " wavelength_nm = each[(int)clamp(floor(P[0] + 0.5), 0, {count} - 1)]; }}"
)


class PathBench:
    """The element, and a camera with one row of pixels for each ray.

    Ray number i hits the plane z = 0 at x = i mm, y = 0.
    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        spec: HologramSpec,
        direction: NDArray[np.float64],
        wavelength_nm: NDArray[np.float64],
    ) -> None:
        self.scene = scene
        spectral = spectral_scene(by_significance(), (), 550.0)
        material = materials.hologram_material(spec, spectral)
        self._place_wavelengths(material, wavelength_nm)
        element = meshes.rectangle("Element", *spec.surface.size_mm)
        meshes.add(scene.collection, element, material)
        self._rays = len(direction)
        # Blender makes no picture lower than 4 rows.
        rows = np.minimum(np.arange(max(4, self._rays)), self._rays - 1)
        place = rows[:, None] * np.array((1.0, 0.0, 0.0))
        self._camera(place - 0.5 * direction[rows], direction[rows])
        self._world()

    def answers(self, paths: int, seed: int) -> NDArray[np.float64]:
        """Direction times weight of each path, shape ``(rays, paths, 3)``; time differs."""
        set_up(self.scene, samples=1, seed=seed, spectral=True, max_bounces=8)
        self.scene.cycles.pixel_filter_type = "BOX"
        self.scene.render.resolution_x = paths
        return render_layers(self.scene, (COMBINED,))[COMBINED][: self._rays].astype(np.float64)

    def _place_wavelengths(
        self, material: bpy.types.Material, wavelength_nm: NDArray[np.float64]
    ) -> None:
        text = _WAVELENGTH_BY_PLACE.format(count=len(wavelength_nm), numbers=array(wavelength_nm))
        tree = nodes.tree_of(material)
        node = nodes.add_script_node(tree, ShaderSource("hoe_test_wavelength", text), {})
        socket = nodes.input_socket(nodes.script_node(material), "wavelength_nm")
        for link in socket.links:
            tree.links.remove(link)
        tree.links.new(nodes.output_socket(node, "wavelength_nm"), socket)

    def _camera(self, origin: NDArray[np.float64], direction: NDArray[np.float64]) -> None:
        camera = bpy.data.cameras.new("Rays")
        camera.type, camera.custom_mode, camera.clip_start = "CUSTOM", "INTERNAL", 1e-6
        flip = np.array((1.0, 1.0, -1.0))
        source = ray_camera_shader((origin * flip)[::-1], (direction * flip)[::-1])
        camera.custom_bytecode = compiled(source)
        camera.custom_bytecode_hash = source.digest
        self.scene.camera = bpy.data.objects.new("Rays", camera)
        self.scene.collection.objects.link(self.scene.camera)
        self.scene.render.resolution_y = len(direction)

    def _world(self) -> None:
        world = bpy.data.worlds.new("Directions")
        world.cycles.sampling_method = "NONE"
        self.scene.world = world
        tree = nodes.new_tree(world)
        output = tree.nodes.new("ShaderNodeOutputWorld")
        node = nodes.add_script_node(tree, direction_world_shader(), {})
        tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
