# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the .blend files that the window pictures show, with the operators of Add > Hologram.

Runs in the bpy module, which has OSL: the shaders are compiled here.
"""

import argparse
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

PRESETS: tuple[str, ...] = ("two_hologram_ar", "holographic_sight", "point_lens")
HOLOGRAMS: dict[str, str] = {"point_lens": "lens"}
"""The hologram that is the active object, where there is one to choose."""
BEGINNING: str = "beginning"
"""Blender's own first scene."""


def make(preset: str, folder: Path) -> Path:
    """Add a preset as a scene of its own and save it.

    Args:
        preset: Its name.
        folder: Folder of the file.

    Returns:
        The file.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    first = bpy.context.scene
    bpy.ops.hologram.add_preset(preset=preset, place="SCENE")
    scene = next(each for each in bpy.data.scenes if each != first)
    for window in bpy.context.window_manager.windows:
        window.scene = scene
    bpy.data.scenes.remove(first)
    active = next((item for item in scene.objects if is_chosen(item, preset)), None)
    if active is not None:
        scene.view_layers[0].objects.active = active
        active.select_set(True)
    return save(folder / f"{preset}.blend")


def is_chosen(item: bpy.types.Object, preset: str) -> bool:
    """Whether an object is the hologram whose panels a picture shows.

    Args:
        item: The object.
        preset: The preset that it is in.
    """
    material = item.active_material
    return material is not None and material.hologram.enabled and preset in HOLOGRAMS


def save(path: Path) -> Path:
    """Save what is open.

    Args:
        path: The file.

    Returns:
        The same path.
    """
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True, check_existing=False)
    return path


def main(arguments: list[str] | None = None) -> None:
    """Make the files.

    Args:
        arguments: Command line without the program; None takes that of the process.
    """
    import hoe_addon

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True, help="folder for the files")
    parser.add_argument("presets", nargs="*", default=list(PRESETS), help="which (all)")
    chosen = parser.parse_args(arguments)
    chosen.out.mkdir(parents=True, exist_ok=True)
    hoe_addon.register()
    for preset in chosen.presets:
        make(preset, chosen.out.resolve())
    bpy.ops.wm.read_factory_settings()
    save(chosen.out.resolve() / f"{BEGINNING}.blend")


if __name__ == "__main__":
    main()
