# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the shipped files are; free of bpy.

Shaders, presets and the manifest lie beside the package, in a clone as in an installed extension.
They are read only: an update replaces the folder.
"""

import tomllib
from functools import cache
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[1]

OSL_DIR = _ROOT / "osl"
"""Hand-written OSL shaders and headers."""

PRESETS_DIR = _ROOT / "presets"
"""One JSON file per preset."""

MANIFEST = _ROOT / "blender_manifest.toml"
"""The extension's manifest, the only place of the version."""


def osl_path(name: str) -> Path:
    """Path of a shipped shader or header.

    Args:
        name: File name with its suffix, such as ``"hologram.osl"``.

    Returns:
        The path of the file.

    Raises:
        FileNotFoundError: No such file is shipped; our own mistake, not the user's.
    """
    path = OSL_DIR / name
    if not path.is_file():
        raise FileNotFoundError(f"no shipped shader {name!r} in {OSL_DIR}")
    return path


def preset_paths() -> dict[str, Path]:
    """Shipped presets.

    Returns:
        Path by preset name (the file's stem), in order of name.
    """
    return {path.stem: path for path in sorted(PRESETS_DIR.glob("*.json"))}


@cache
def version() -> str:
    """Version of the add-on, as the manifest states it."""
    with MANIFEST.open("rb") as file:
        return str(tomllib.load(file)["version"])
