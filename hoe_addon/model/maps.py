# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V for the shader: made once, kept in a cache, made anew when missing or damaged."""

import json
import logging
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np

from ..core.arrays import FloatArray
from ..core.errors import NotMadeError
from ..core.gradient_map import LARGEST, LIMIT, TOLERANCE, GradientMap, Progress, bake
from ..core.ray_fitting import fit_rays
from ..core.units import mm_to_m
from . import map_cache
from .characteristic.convert import characteristic_from
from .contents import digest, with_contents
from .convert import shape_from
from .convert_waves import wave_from
from .map_source import MapSource
from .optical_system import SystemWaveSpec
from .surface import SurfaceSpec
from .waves import WAVES

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class MapRequest:
    """All that a map depends on.

    Attributes:
        source: The terms of the gradient.
        surface: The element.
        wavelength_nm: Vacuum wavelength of the recording in nm.
    """

    source: MapSource
    surface: SurfaceSpec
    wavelength_nm: float

    @property
    def key(self) -> str:
        """SHA-256 of the canonical text of all that it depends on, and of the files named in it."""
        data = {
            "format": map_cache.FORMAT,
            "terms": msgspec.to_builtins(self.source.terms),
            "surface": msgspec.to_builtins(self.surface),
            "wavelength_nm": self.wavelength_nm,
            "tolerance": TOLERANCE,
            "largest": LARGEST,
        }
        return digest(json.dumps(with_contents(data), sort_keys=True).encode())

    def gradient(self, points: FloatArray) -> FloatArray:
        """Evaluate the terms exactly.

        Args:
            points: Points in metres, shape ``(..., 3)``.

        Returns:
            Their sum, shape ``(..., 3)``; NaN where one of them is not recorded.
        """
        return np.sum([sign * term(points) for sign, term in self._terms()], axis=0)

    def _terms(self) -> list[tuple[int, Callable[[FloatArray], FloatArray]]]:
        made: list[tuple[int, Callable[[FloatArray], FloatArray]]] = []
        for sign, term in self.source.terms:
            if isinstance(term, WAVES):
                made.append((sign, wave_from(term, self.wavelength_nm).gradient))
            else:
                made.append((sign, characteristic_from(term).gradient))
        return made


def map_file(
    request: MapRequest,
    folder: Path | None = None,
    progress: Progress | None = None,
    *,
    make: bool = True,
) -> tuple[Path, GradientMap]:
    """Give a map as a file.

    Args:
        request: The map.
        folder: Folder of the cache, unless the environment names one.
        progress: Told the share that is done, where it has to be made; what it raises, such as
            `CancelledError`, stops the work, and no file is left.
        make: Whether to make the map where it is not in the cache.

    Returns:
        The file, and the map in it with the error that was measured.

    Raises:
        NotMadeError: It is not in the cache, and is not to be made.
        OutputError: The file cannot be written.
        SpecError: Nothing is recorded anywhere.
    """
    key = request.key
    path = map_cache.map_path(map_cache.cache_folder(folder), key)
    kept = map_cache.read_map(path, key)
    if kept is not None:
        return path, kept
    if not make:
        raise NotMadeError("recording: needs its map, which takes some seconds; press Bake")
    width, height = (mm_to_m(side) for side in request.surface.size_mm)
    shape = shape_from(request.surface)
    made = bake(request.gradient, shape.sag, (width, height), progress=progress)
    map_cache.write_map(path, key, made)
    if made.error > LIMIT:
        _log.warning("a map of %d texels has the error %.1e", len(made.texels), made.error)
    return path, made


def fit_reports(request: MapRequest, points_along_side: int = 65) -> tuple[str, ...]:
    """Say where the rays of sources behind optics can be fitted, and where not.

    Args:
        request: The map.
        points_along_side: Points of the element that are looked at, along each side.

    Returns:
        One line for each such source.
    """
    half_width, half_height = (0.5 * mm_to_m(side) for side in request.surface.size_mm)
    steps = np.linspace(-1.0, 1.0, points_along_side)
    x, y = np.meshgrid(half_width * steps, half_height * steps)
    points = np.stack((x, y, shape_from(request.surface).sag(x, y)), axis=-1)
    points = points[np.isfinite(points).all(axis=-1)]
    return tuple(
        fit_rays(term.core_system(request.wavelength_nm), points).report()
        for _, term in request.source.terms
        if isinstance(term, SystemWaveSpec)
    )
