# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles set up for holograms: OSL, wavelength on ray time, long portal paths, no clamping."""

from pathlib import Path

import bpy

from ..shaders.osl import require_osl

_SHUTTER_FRAMES = 1e-3
"""So short that nothing moves in it; ray time still runs over its whole range."""


def set_up(
    scene: bpy.types.Scene, *, samples: int, seed: int, spectral: bool, max_bounces: int
) -> None:
    """Set all render settings that a hologram needs, whatever they were before.

    Args:
        scene: The scene.
        samples: Samples per pixel.
        seed: Seed of all random numbers: same seed, same picture.
        spectral: Whether ray time carries the wavelength; else one wavelength is previewed.
        max_bounces: Most portals and transparent surfaces on a path, up to 1024.

    Raises:
        MissingOslError: This build, or the scene's device, has no OSL.
    """
    scene.render.engine = "CYCLES"
    require_osl(scene)
    settings = scene.cycles
    settings.shading_system = True
    settings.samples = samples
    settings.seed = seed
    settings.use_animated_seed = False
    settings.use_adaptive_sampling = False
    settings.time_limit = 0.0
    settings.use_denoising = False
    settings.sample_clamp_direct = 0.0
    settings.sample_clamp_indirect = 0.0
    settings.blur_glossy = 0.0
    settings.light_sampling_threshold = 0.0
    settings.use_light_tree = True
    set_path_lengths(scene, max_bounces)
    settings.rolling_shutter_type = "NONE"
    scene.render.use_motion_blur = spectral
    scene.render.motion_blur_shutter = _SHUTTER_FRAMES
    scene.render.motion_blur_position = "CENTER"
    scene.render.use_border = False
    scene.render.use_compositing = False
    scene.render.use_sequencer = False
    scene.render.use_multiview = False
    scene.render.resolution_percentage = 100
    scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1.0
    settings.film_exposure = 1.0
    flatten_shutter_curve(scene)


def set_path_lengths(scene: bpy.types.Scene, max_bounces: int) -> None:
    """Set the most portals and transparent surfaces on a path, up to 1024."""
    scene.cycles.transparent_max_bounces = min(max_bounces, 1024)
    # Measured on the preset: Russian roulette after 8 portals costs 40 % more variance in the
    # display's light and saves at most a fifth of the time.
    scene.cycles.min_transparent_bounces = min(max_bounces, 1024)


def picture_size(scene: bpy.types.Scene) -> tuple[int, int]:
    """Width and height in pixels that Blender renders: the percentage counts, rounded down."""
    render = scene.render
    share = render.resolution_percentage
    return render.resolution_x * share // 100, render.resolution_y * share // 100


def size_settings(width: int, height: int) -> dict[str, int]:
    """What ``Scene.render`` must have for a picture of just so many pixels, by name."""
    return {"resolution_x": width, "resolution_y": height, "resolution_percentage": 100}


def set_picture(scene: bpy.types.Scene, size: tuple[int, int], samples: int) -> None:
    """Set width and height in pixels, and samples per pixel."""
    for name, value in size_settings(*size).items():
        setattr(scene.render, name, value)
    scene.cycles.samples = samples


def carry_time_on_rows(scene: bpy.types.Scene) -> None:
    """Make ray time exact and chosen: (row + 1) / rows, counted from the top row 0.

    A rolling shutter of no duration exposes each row at one instant. Probes use it to give every
    ray its own wavelength.
    """
    scene.cycles.rolling_shutter_type = "TOP"
    scene.cycles.rolling_shutter_duration = 0.0


def write_float_exr(scene: bpy.types.Scene, path: Path, *, layers: bool = False) -> None:
    """Let the next render go to a 32-bit float OpenEXR.

    Args:
        scene: The scene.
        path: File to write.
        layers: Whether to write all passes, as a multi-layer file.
    """
    picture = scene.render.image_settings
    picture.media_type = "MULTI_LAYER_IMAGE" if layers else "IMAGE"
    picture.file_format = "OPEN_EXR_MULTILAYER" if layers else "OPEN_EXR"
    picture.color_mode = "RGB" if not layers else "RGBA"
    picture.color_depth = "32"
    picture.exr_codec = "ZIP"
    scene.render.use_file_extension = False
    scene.render.filepath = str(path)


def flatten_shutter_curve(scene: bpy.types.Scene) -> None:
    """Expose all instants alike, so that all wavelengths are drawn as often as they should be."""
    mapping = scene.render.motion_blur_shutter_curve
    for point in mapping.curves[0].points:
        point.location[1] = 1.0
    mapping.update()
