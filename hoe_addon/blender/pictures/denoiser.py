# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoise a finished picture with Blender's own denoiser (Open Image Denoise)."""

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import RenderError
from ...files import scratch_folder
from ..quiet import captured_output
from . import exr
from .render_settings import write_float_exr


def denoise(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Take the noise out of a scene-linear picture.

    The picture is all that the denoiser sees: through a hologram, the normal and the colour of
    the first surface would tell it nothing.

    Args:
        pixels: Shape ``(height, width, 3)``, top row first.

    Returns:
        The same picture with less noise; its mean is nearly, not exactly, kept.

    Raises:
        RenderError: Blender gave no picture.
    """
    height, width, _ = pixels.shape
    scene = bpy.data.scenes.new("Denoise")
    with scratch_folder() as folder:
        noisy, clean = folder / "noisy.exr", folder / "clean.exr"
        exr.write(noisy, pixels)
        image = bpy.data.images.load(str(noisy))
        tree = _tree(image)
        try:
            # Cycles renders nothing here; other engines would start the graphics driver.
            scene.render.engine = "CYCLES"
            scene.compositing_node_group = tree
            scene.render.use_compositing = True
            scene.render.use_sequencer = False
            scene.render.resolution_x, scene.render.resolution_y = width, height
            scene.render.resolution_percentage = 100
            write_float_exr(scene, clean)
            with captured_output() as said:
                bpy.ops.render.render(write_still=True, scene=scene.name)
            if not clean.exists():
                raise RenderError(f"Blender's denoiser wrote no picture: {' '.join(said[-3:])}")
            return exr.read(clean)
        finally:
            bpy.data.scenes.remove(scene)
            bpy.data.node_groups.remove(tree)
            bpy.data.images.remove(image)


def _tree(image: bpy.types.Image) -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new("Denoise", "CompositorNodeTree")
    tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    source = tree.nodes.new("CompositorNodeImage")
    source.image = image
    cleaner = tree.nodes.new("CompositorNodeDenoise")
    output = tree.nodes.new("NodeGroupOutput")
    tree.links.new(source.outputs["Image"], cleaner.inputs["Image"])
    tree.links.new(cleaner.outputs["Image"], output.inputs[0])
    return tree
