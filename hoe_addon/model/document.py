# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading whole documents: holograms and devices, with the version of their format."""

import contextlib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, cast

from ..core.errors import SpecError
from ..resources import preset_paths
from .device import DeviceSpec, LightGuideSpec
from .device_parts import BUILT_IN_IMAGES
from .field_error import FieldError, show
from .hologram import HologramSpec
from .override import override
from .reading import naming, parse_json, read_text, to_spec
from .scene import SceneSpec
from .writing import dump as dump
from .writing import to_document as to_document

SCHEMA = 1
"""Version of the format that this program writes."""

type Document = dict[str, Any]
type Migration = Callable[[Document], Document]

_MIGRATIONS: Mapping[int, Migration] = {}
"""For each older version, the step to the next one; every format change adds one."""

_DEVICES: Mapping[str, type[DeviceSpec]] = {"light_guide": LightGuideSpec, "scene": SceneSpec}


def hologram_from(document: object) -> HologramSpec:
    """Make a hologram from plain data.

    Args:
        document: Objects, lists and numbers, as JSON gives them.

    Returns:
        The valid hologram.

    Raises:
        SpecError: With the path of the field, the rule, and the value.
    """
    current = _current(document)
    surface = current.get("surface")
    if isinstance(surface, dict) and "shape" not in surface:
        raise SpecError("surface.shape: is missing")
    return to_spec(current, HologramSpec)


def device_from(document: object) -> DeviceSpec:
    """Make a device from plain data.

    Args:
        document: Objects, lists and numbers, as JSON gives them.

    Returns:
        The valid device.

    Raises:
        SpecError: With the path of the field, the rule, and the value.
    """
    current = _current(document)
    if "kind" not in current:
        what = "; this is a hologram, not a device" if "surface" in current else ""
        raise SpecError(f"kind: is missing (known: {', '.join(_DEVICES)}){what}")
    kind = current["kind"]
    if not isinstance(kind, str) or kind not in _DEVICES:
        raise FieldError("kind", f"must be one of {', '.join(_DEVICES)}", kind)
    return to_spec(current, _DEVICES[kind])


def _current(document: object) -> Document:
    """Bring a document to the current version of the format."""
    if not isinstance(document, dict):
        raise FieldError("document", "must be an object", document)
    current = cast("Document", document)
    if "schema" not in current:
        raise SpecError("schema: is missing")
    version = current["schema"]
    while isinstance(version, int) and version in _MIGRATIONS:
        current = _MIGRATIONS[version](current)
        version = current["schema"]
    if isinstance(version, int) and version > SCHEMA:
        rule = f"must be at most {SCHEMA}, the newest that this add-on knows (update it)"
        raise FieldError("schema", rule, version)
    if isinstance(version, bool) or version != SCHEMA:
        raise FieldError("schema", f"must be {SCHEMA}, the version of this program", version)
    return {**current, "schema": SCHEMA}


def load_hologram(path: str | Path) -> HologramSpec:
    """Read a hologram from a JSON file.

    Args:
        path: The file.

    Returns:
        The valid hologram.

    Raises:
        SpecError: ``FILE: FIELD: what is wrong, and the value``.
    """
    with naming(path):
        return hologram_from(with_placed_files(parse_json(read_text(path)), Path(path).parent))


def with_placed_files(document: object, folder: Path) -> object:
    """Make the files that a document names by a relative path those beside the document.

    Args:
        document: Plain data; a text at the name ``file``, at any depth, is a path.
        folder: Folder of the document.

    Returns:
        The same data with absolute paths.
    """
    if isinstance(document, list):
        if not {dict, list} & set(map(type, cast("list[object]", document))):
            return cast("list[object]", document)
        return [with_placed_files(item, folder) for item in cast("list[object]", document)]
    if not isinstance(document, dict):
        return document
    placed: Document = {}
    for name, item in cast("Document", document).items():
        if name == "file" and isinstance(item, str) and item.strip():
            placed[name] = str(folder.absolute() / item)
        else:
            placed[name] = with_placed_files(item, folder)
    return placed


def find_device(name: str | Path) -> Path:
    """Find the file of a device.

    Args:
        name: Name of a shipped preset, or a path to a JSON file.

    Returns:
        Path of the file.

    Raises:
        SpecError: If it looks like a preset's name, and there is no such preset.
    """
    presets = preset_paths()
    if str(name) in presets:
        return presets[str(name)]
    path = Path(name)
    with contextlib.suppress(OSError):  # such as a name that is too long
        if path.suffix == ".json" or path.exists() or len(path.parts) > 1:
            return path
    raise SpecError(f"{name}: is neither a preset ({', '.join(presets)}) nor a file")


def load_device(name: str | Path, assignments: Iterable[str] = ()) -> DeviceSpec:
    """Read a device from a preset or a JSON file.

    Args:
        name: Name of a shipped preset, or a path to a JSON file.
        assignments: Changes, each ``path.to.field=value``; see `override.override`.

    Returns:
        The valid device.

    Raises:
        SpecError: ``FILE: FIELD: what is wrong, and the value``.
    """
    path = find_device(name)
    with naming(name):
        document = with_placed_files(parse_json(read_text(path)), path.parent)
        spec = device_from(document)
        changes = list(assignments)
        if changes:
            changed = override(to_document(spec), changes)
            spec = device_from(with_placed_files(changed, path.parent))
        picture_paths(spec, path.parent)
    return spec


def picture_paths(spec: DeviceSpec, folder: Path) -> dict[str, Path]:
    """Find all pictures of a device that are files.

    Args:
        spec: The device.
        folder: Folder of the document, which a relative path starts from.

    Returns:
        Path by the field that names the file.

    Raises:
        SpecError: If a file does not exist.
    """
    return {field: _picture_path(field, image, folder) for field, image in spec.picture_files}


def _picture_path(field: str, image: str, folder: Path) -> Path:
    path = folder / image
    exists = False
    with contextlib.suppress(OSError):  # such as a name that is too long
        exists = path.is_file()
    if not exists:
        rule = f"must be {', '.join(BUILT_IN_IMAGES)} or a file that exists"
        raise FieldError(field, rule, image)
    return path


def preset_titles() -> dict[str, str]:
    """Name and title of every shipped preset.

    Returns:
        Title by name, in order of name.

    Raises:
        SpecError: If a shipped file has no title; our own mistake.
    """
    titles: dict[str, str] = {}
    for name, path in preset_paths().items():
        with naming(path):
            document = parse_json(read_text(path))
            title = cast("Document", document).get("title") if isinstance(document, dict) else None
            if not isinstance(title, str):
                raise SpecError(f"title: must be a text, got {show(title)}")
            titles[name] = title
    return titles
