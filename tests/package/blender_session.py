# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Blender without this repository does with the zip: one story per run, told as JSON.

Run as a script, ``blender_session.py STORY ZIP``, with BLENDER_USER_RESOURCES naming an empty
folder. Libraries that Blender lacks come from the wheels, or not at all.
"""

import gc
import importlib
import json
import os
import pkgutil
import sys
from collections.abc import Callable
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from typing import Any

FROM_WHEELS = {"msgspec", "threadpoolctl"}
NOT_IN_BLENDER = {"hoe_addon", "matplotlib", "tqdm", "pytest", "colour", "mpmath", "jsonschema"}

USER = Path(os.environ["BLENDER_USER_RESOURCES"])
FOLDER = USER / "extensions" / "user_default" / "hoe_addon"

BEHIND_A_LENS: dict[str, Any] = {
    "schema": 1,
    "name": "behind a lens",
    "surface": {"shape": "plane", "size_mm": [8, 6]},
    "media": {"back": 1.0, "front": "N-BK7"},
    "recording": {
        "wavelength_nm": 532,
        "object": {
            "kind": "system",
            "source": {"kind": "point", "position_mm": [0, 0, -60]},
            "surfaces": [
                {
                    "shape": "sphere",
                    "vertex_mm": [0, 0, -20],
                    "radius_mm": 60,
                    "semi_diameter_mm": 40,
                    "medium": "N-BK7",
                }
            ],
        },
        "reference": {"kind": "plane", "direction": [0, 0, 1], "index": 1.0},
    },
    "efficiency": {"model": "kinoform", "levels": 8, "design_wavelength_nm": 532, "relief": 1.5},
    "orders": [-1, 0, 1, 2],
}
"""A document whose pattern has no formula, and so needs a map."""


class OnlyWhatBlenderHas:
    """Finds the declared wheels where Blender puts them, and hides what Blender has not."""

    @staticmethod
    def find_spec(name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        if name in NOT_IN_BLENDER:
            raise ModuleNotFoundError(f"Blender has no {name}", name=name)
        if name in FROM_WHEELS:
            places = [str(place) for place in USER.glob("extensions/.local/lib/*/site-packages")]
            found = PathFinder.find_spec(name, places)
            if found is None:
                raise ModuleNotFoundError(f"{name} came with no wheel", name=name)
            return found
        return None


sys.meta_path.insert(0, OnlyWhatBlenderHas())  # type: ignore[arg-type]

import bpy  # noqa: E402
from blender_state import (  # noqa: E402
    EXTENSION,
    hashes,
    hashes_in,
    own_classes,
    resident_mb,
    state,
)

PACKAGE = f"{EXTENSION}.hoe_addon"


def install(zip_path: str) -> None:
    done = bpy.ops.extensions.package_install_files(
        filepath=zip_path, repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"}


def enable() -> None:
    assert bpy.ops.preferences.addon_enable(module=EXTENSION) == {"FINISHED"}


def disable() -> None:
    assert bpy.ops.preferences.addon_disable(module=EXTENSION) == {"FINISHED"}


def uninstall() -> None:
    names = [repo.module for repo in bpy.context.preferences.extensions.repos]
    done = bpy.ops.extensions.package_uninstall(
        repo_index=names.index("user_default"), pkg_id="hoe_addon"
    )
    assert done == {"FINISHED"}


def script(name: str) -> Any:
    """A module of the installed package."""
    return importlib.import_module(f"{PACKAGE}.{name}")


def shown() -> dict[str, bool]:
    """What someone sees of the add-on."""
    return {
        "enabled": EXTENSION in bpy.context.preferences.addons,
        "material": hasattr(bpy.types.Material, "hologram"),
    }


def life(zip_path: str) -> dict[str, Any]:
    """Installed, disabled, enabled, through file load and undo, and gone."""
    told: dict[str, Any] = {"before": state()}
    install(zip_path)
    told["installed"] = shown()
    full = state()
    disable()
    told["disabled"] = shown()
    told["after disabling"] = state()
    enable()
    told["enabled"] = shown()
    told["same when enabled again"] = state() == full
    told["files"] = through_files()
    told["undo"] = through_undo()
    # What has changed waits for its timer, which a Blender without a window never calls.
    told["same after files and undo"] = {**state(), "timers": []} == full
    uninstall()
    gc.collect()
    told["uninstalled"] = shown()
    told["after"] = state()
    told["modules"] = sorted(name for name in sys.modules if name.startswith(EXTENSION))
    told["folder"] = FOLDER.exists()
    return told


def recording(name: str) -> Any:
    """What a hologram was recorded with, as the file that is open knows it."""
    material: Any = bpy.data.materials[name]
    return material.hologram.recording


def through_files() -> dict[str, Any]:
    path = str(USER / "kept.blend")
    bpy.data.materials.new("kept").use_fake_user = True
    recording("kept").wavelength_nm = 600.0
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    home = shown()
    bpy.ops.wm.open_mainfile(filepath=path)
    return {"home": home, "opened": shown(), "wavelength_nm": recording("kept").wavelength_nm}


def through_undo() -> dict[str, Any]:
    bpy.ops.ed.undo_push(message="before")
    recording("kept").wavelength_nm = 500.0
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    undone = recording("kept").wavelength_nm
    bpy.ops.ed.redo()
    return {"undone": undone, "redone": recording("kept").wavelength_nm, **shown()}


def cycles(zip_path: str) -> dict[str, Any]:
    """Disabled and enabled 50 times; what is counted at the second, half way and at the last."""
    install(zip_path)
    told: dict[str, Any] = {}
    for cycle in range(1, 51):
        disable()
        enable()
        if cycle in (2, 26, 50):
            # Before the count: to look at each type makes Blender wrap it. As one text, since
            # what is kept here is counted too.
            found = json.dumps(state())
            gc.collect()
            told[str(cycle)] = {
                "classes": own_classes(),
                "modules": len(sys.modules),
                "objects": len(gc.get_objects()),
                "resident_mb": resident_mb(),
                "state": found,
            }
    return told


def writes(zip_path: str) -> dict[str, Any]:
    """A preset as a scene and a hologram with a map: which files that makes, and where."""
    # Where a folder cannot be written Python keeps no compiled files, and goes on.
    sys.dont_write_bytecode = True
    os.environ.pop("HOE_CACHE_DIR", None)
    os.environ["XDG_CACHE_HOME"] = str(USER / "xdg")
    install(zip_path)
    for path in FOLDER.rglob("*"):
        path.chmod(0o555 if path.is_dir() else 0o444)
    api = script("blender.api")
    bpy.ops.wm.read_homefile(use_empty=True)
    spec = api.load_device("two_hologram_ar")
    built = api.build_device(bpy.context.scene, spec, script("resources").PRESETS_DIR)
    made = api.prepare_map(api.hologram_from(BEHIND_A_LENS))
    return {
        "objects": len(bpy.data.objects),
        "built": type(built).__name__,
        "map": str(made.path.relative_to(USER)),
        "own files": sorted(
            str(path.relative_to(USER)) for path in USER.glob("extensions/.user/**/*.*")
        ),
        "same as in the zip": hashes(FOLDER) == hashes_in(zip_path),
        "elsewhere": (USER / "xdg").exists(),
    }


def libraries(zip_path: str) -> dict[str, Any]:
    """Each module of the package, with nothing but what Blender has and the wheels."""
    install(zip_path)
    package = importlib.import_module(PACKAGE)
    names = [
        item.name
        for item in pkgutil.walk_packages(package.__path__, f"{PACKAGE}.")
        if not item.name.endswith("__main__")
    ]
    for name in names:
        importlib.import_module(name)
    return {
        "modules": len(names),
        "wheels": {
            name: str(Path(str(sys.modules[name].__file__)).relative_to(USER))
            for name in sorted(FROM_WHEELS)
        },
        "from the repository": sorted(
            name
            for name, module in sys.modules.items()
            if name.startswith(EXTENSION)
            and not str(getattr(module, "__file__", None) or FOLDER).startswith(str(FOLDER))
        ),
    }


STORIES: dict[str, Callable[[str], dict[str, Any]]] = {
    story.__name__: story for story in (life, cycles, writes, libraries)
}

if __name__ == "__main__":
    result = STORIES[sys.argv[1]](sys.argv[2])
    sys.stdout.write("\n" + json.dumps(result) + "\n")
