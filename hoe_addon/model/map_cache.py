# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps kept in files, named by what they were made from: float EXR, checked when read."""

import getpass
import hashlib
import json
import logging
import os
import tempfile
from pathlib import Path
from typing import Any, cast

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
from numpy.typing import NDArray

from ..core.errors import SpecError
from ..core.gradient_map import LARGEST, GradientMap
from ..files import OutputError, replacing, writable_folder
from .image_file import read_exr_pixels

FORMAT = 1
"""Version of the files and of what is in them; part of their names."""

FOLDER_VARIABLE = "HOE_CACHE_DIR"
"""Environment variable that names the folder of the cache."""

_HEADER = "hoe_map"
_log = logging.getLogger(__name__)


def cache_folder(default: Path | None = None) -> Path:
    """Find the folder for maps.

    Args:
        default: Folder that the surroundings give, such as that of an extension.

    Returns:
        What the environment says, else the default, else a folder of the user's cache; where that
        one cannot be written, a folder for temporary files takes its place.

    Raises:
        OutputError: The folder that the environment names cannot be written.
    """
    named = os.environ.get(FOLDER_VARIABLE)
    if named:
        return writable_folder(named)
    try:
        return writable_folder(default or _users_cache())
    except OutputError as error:
        fallback = Path(tempfile.gettempdir()) / f"hoe_addon-{getpass.getuser()}"
        _log.warning("%s; maps are kept in %s", error, fallback)
        return writable_folder(fallback)


def _users_cache() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (Path(cache) if cache else Path.home() / ".cache") / "hoe_addon"


def map_path(folder: Path, key: str) -> Path:
    """Name the file of a map.

    Args:
        folder: Folder of the cache.
        key: Hash of what the map is made from.

    Returns:
        The file, which need not exist.
    """
    return folder / f"map-{FORMAT}-{key}.exr"


def read_map(path: Path, key: str) -> GradientMap | None:
    """Read a map.

    Args:
        path: The file.
        key: Hash of what the map should be made from.

    Returns:
        The map, in float32 precision; None where the file is missing, damaged, or another map's.
    """
    if not path.is_file():
        return None
    try:
        texels, text = read_exr_pixels(path, _check_size, _HEADER)
    except SpecError:
        return None
    header = _header(text)
    if header is None or header.get("key") != key:
        return None
    if header.get("sha256") != _digest(texels):
        return None
    try:
        origin, pitch = _pair(header["origin"]), _pair(header["pitch"])
        return GradientMap(texels[::-1].astype(np.float64), origin, pitch, float(header["error"]))
    except (KeyError, TypeError, ValueError):
        return None


def write_map(path: Path, key: str, made: GradientMap) -> None:
    """Write a map; the file appears whole or not at all.

    Args:
        path: The file; its folder exists.
        key: Hash of what the map is made from.
        made: The map.

    Raises:
        OutputError: The file cannot be written.
    """
    # Pictures begin at the top, maps at the lowest y.
    texels = np.ascontiguousarray(made.texels[::-1], dtype=np.float32)
    header = {
        "key": key,
        "origin": made.origin,
        "pitch": made.pitch,
        "error": made.error,
        "sha256": _digest(texels),
    }
    height, width, channels = texels.shape
    spec = oiio.ImageSpec(width, height, channels, oiio.FLOAT)
    # Digits of floats hardly shrink, and unpacking them would take longer than all the rest.
    spec.attribute("compression", "none")
    spec.attribute("oiio:ColorSpace", "data")
    spec.attribute(_HEADER, json.dumps(header))
    with replacing(path) as part:
        output = cast("Any", oiio.ImageOutput.create(str(part)))
        if output is None or not output.open(str(part), spec):
            raise OutputError(f"{path}: cannot be written: {oiio.geterror()}")
        done = output.write_image(texels)
        if not (output.close() and done):
            raise OutputError(f"{path}: cannot be written: {output.geterror()}")


def _check_size(spec: "oiio.ImageSpec") -> None:
    if spec.nchannels != 4 or not 4 <= spec.width == spec.height <= LARGEST:
        raise SpecError(f"must be a square of 4 channels, got {spec.width} x {spec.height}")


def _header(text: object) -> dict[str, Any] | None:
    if not isinstance(text, str):
        return None
    try:
        found: object = json.loads(text)
    except (ValueError, RecursionError):
        return None
    return cast("dict[str, Any]", found) if isinstance(found, dict) else None


def _pair(numbers: list[float]) -> tuple[float, float]:
    first, second = (float(number) for number in numbers)
    return first, second


def _digest(texels: NDArray[np.float32]) -> str:
    return hashlib.sha256(np.ascontiguousarray(texels).tobytes()).hexdigest()
