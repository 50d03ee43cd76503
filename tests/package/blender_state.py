# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an add-on can leave behind in Blender, for `blender_session`: named, counted or summed."""

import gc
import hashlib
import os
import types
import zipfile
from pathlib import Path
from typing import Any

import bpy

EXTENSION = "bl_ext.user_default.hoe_addon"


def ours(owner: object) -> bool:
    return str(getattr(owner, "__module__", "")).startswith(EXTENSION)


def state() -> dict[str, Any]:
    """All that the add-on may add to Blender, counted or by name."""
    rna = [item for name in dir(bpy.types) if isinstance(item := getattr(bpy.types, name), type)]
    configs = bpy.context.window_manager.keyconfigs
    return {
        "types": sorted(dir(bpy.types)),
        "operators": sorted(
            f"{group}.{name}" for group in dir(bpy.ops) for name in dir(getattr(bpy.ops, group))
        ),
        "handlers": {
            name: len(found)
            for name in dir(bpy.app.handlers)
            if isinstance(found := getattr(bpy.app.handlers, name), list)
        },
        "drawn": {item.__name__: len(also) for item in rna if (also := drawn_too(item))},
        "properties": {
            item.__name__: sorted(item.bl_rna.properties.keys())
            for item in rna
            if issubclass(item, bpy.types.ID | bpy.types.Bone)
        },
        "keys": {
            f"{config.name} {keymap.name}": len(keymap.keymap_items)
            for config in configs
            for keymap in config.keymaps
            # Add-ons share a keymap, so an empty one stays.
            if len(keymap.keymap_items)
        },
        "addons": sorted(addon.module for addon in bpy.context.preferences.addons),
        "timers": sorted(
            f"{item.__module__}.{item.__qualname__}"
            for item in gc.get_objects()
            if isinstance(item, types.FunctionType)
            and ours(item)
            and bpy.app.timers.is_registered(item)
        ),
    }


def drawn_too(item: Any) -> tuple[Any, ...]:
    """What add-ons have put before or behind its own drawing of a menu, a panel or a header."""
    functions = getattr(getattr(item, "draw", None), "_draw_funcs", ())
    return tuple(function for function in functions if ours(function))


def own_classes() -> list[str]:
    """Every class of ours that lives, registered or not: one that is made anew shows twice."""
    kinds = ("PropertyGroup", "Operator", "Panel", "Menu", "UIList", "AddonPreferences")
    found = (item for kind in kinds for item in getattr(bpy.types, kind).__subclasses__())
    return sorted(item.__qualname__ for item in found if ours(item))


def hashes(folder: Path) -> dict[str, str]:
    """A sum for each file."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def hashes_in(zip_path: str) -> dict[str, str]:
    """The same of the files in a zip."""
    with zipfile.ZipFile(zip_path) as archive:
        return {name: hashlib.sha256(archive.read(name)).hexdigest() for name in archive.namelist()}


def resident_mb() -> float:
    """Memory of the process, from Linux's own books; 0 where there are none."""
    books = Path("/proc/self/statm")
    pages = int(books.read_text().split()[1]) if books.exists() else 0
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6 if pages else 0.0
