# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From recording waves of documents (mm) to those of the core (SI)."""

from numpy.typing import ArrayLike

from ..core import waves
from ..core.arrays import as_float
from ..core.units import mm_to_m
from ..core.waves.system import SystemWave
from .optical_system import SystemWaveSpec
from .source_shapes import DiscShape, LineShape, MeshShape, RectangleShape
from .waves import (
    AstigmaticSpec,
    ExtendedSourceSpec,
    PlaneWaveSpec,
    PointSourceSpec,
    WaveSpec,
    WindowSourceSpec,
)


def wave_from(wave: WaveSpec, wavelength_nm: float = 550.0) -> waves.Wave:
    """Make a recording wave of the core.

    Args:
        wave: The wave of a document.
        wavelength_nm: Vacuum wavelength of the recording, for the media of optics.

    Returns:
        The same wave, lengths in metres.
    """
    match wave:
        case PlaneWaveSpec():
            return waves.PlaneWave(direction=wave.direction, index=wave.index)
        case PointSourceSpec():
            return waves.PointSource(
                _metres(wave.position_mm), converging=_converging(wave), index=wave.index
            )
        case WindowSourceSpec():
            return _window(wave)
        case AstigmaticSpec():
            return waves.AstigmaticSource(
                first=_metres(wave.first_mm),
                second=_metres(wave.second_mm),
                line_direction=wave.line_direction,
                converging=_converging(wave),
                index=wave.index,
            )
        case ExtendedSourceSpec():
            return waves.ExtendedSource(
                _shape(wave), converging=_converging(wave), index=wave.index
            )
        case SystemWaveSpec():
            return SystemWave(wave.core_system(wavelength_nm))


def _window(wave: WindowSourceSpec) -> waves.WindowSource:
    window = waves.FlatWindow(
        position=_metres(wave.window.position_mm),
        normal=wave.window.normal,
        thickness=float(mm_to_m(wave.window.thickness_mm)),
        index=wave.window.index,
    )
    return waves.WindowSource(
        position=_metres(wave.position_mm),
        window=window,
        converging=_converging(wave),
        source_index=wave.source_index,
        index=wave.index,
    )


def _shape(wave: ExtendedSourceSpec) -> waves.SourceShape:
    """Put the shape of a source where it stands."""
    centre, axes = _metres(wave.position_mm), wave.axes()
    match wave.shape:
        case DiscShape(diameter_mm=size):
            return waves.Disc(centre, _metres(axes[0] * size / 2), _metres(axes[1] * size / 2))
        case RectangleShape(size_mm=(width, height)):
            half_x, half_y = axes[0] * width / 2, axes[1] * height / 2
            return waves.Rectangle(centre, _metres(half_x), _metres(half_y))
        case LineShape(length_mm=length):
            return waves.Line(centre, _metres(axes[0] * length / 2))
        case MeshShape():
            corners_mm = wave.shape.triangles_mm() @ axes + as_float(wave.position_mm)
            return waves.TriangleMesh(mm_to_m(corners_mm))


def _converging(
    wave: PointSourceSpec | WindowSourceSpec | AstigmaticSpec | ExtendedSourceSpec,
) -> bool:
    return wave.beam == "converging"


def _metres(vector_mm: ArrayLike) -> tuple[float, float, float]:
    # Component by component: nothing but the division may round.
    x, y, z = (float(value) for value in mm_to_m(as_float(vector_mm)))
    return (x, y, z)
