# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The two waves that made a hologram, drawn as what they are, with their beams to the element.

All directions are those of the core's waves at the element. Lengths are in mm, in the frame of
the hologram.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import FloatArray, as_float, dot, unit
from ...core.units import m_to_mm, mm_to_m
from ...core.waves import ExtendedSource
from ...model.convert_waves import wave_from
from ...model.optical_system import SystemPointSource, SystemWaveSpec
from ...model.recording import RecordingSpec
from ...model.surface import SurfaceSpec
from ...model.waves import (
    AstigmaticSpec,
    ExtendedSourceSpec,
    PlaneWaveSpec,
    PointSourceSpec,
    WaveSpec,
    WindowSourceSpec,
)
from . import colours, foci, optics
from .aims import Aims, aims_of
from .lines import Lines, arrow_heads, between, path, star

_OPACITY = 0.7
_MARK_OPACITY = 1.0
_BAR_OPACITY = 0.3
_LENGTH = 0.9
"""Length of a beam that comes from far away, over the size of the element."""

_FAR = 12.0
"""A source farther away than this, over the size of the element, is drawn as one at infinity."""

_STAR, _HEAD, _DASH = 0.10, 0.06, 0.07
"""Sizes of stars, of heads of arrows and of dashes, over the size of the element."""

_MIDDLE_DRAW = 0.5
"""What the core takes for a source's middle where nothing is drawn."""

_BARS = (0.33, 0.67)
"""Where wavefronts are drawn along the beam of a plane wave."""


@dataclass(frozen=True, eq=False)
class _Beam:
    """What a wave does at the element.

    Attributes:
        aims: Places of the element.
        way: Unit directions of travel at the places, shape ``(n, 3)``; NaN where there is none.
        length: Length of a beam that comes from far away.
    """

    aims: Aims
    way: FloatArray
    length: float

    @property
    def points(self) -> FloatArray:
        """The places, shape ``(n, 3)``."""
        return self.aims.points


@dataclass
class _Sketch:
    """Pieces of one wave: beams, which may be dashed, and marks, which never are."""

    beams: list[Lines] = field(default_factory=list[Lines])
    marks: list[Lines] = field(default_factory=list[Lines])

    def beam(self, ends: FloatArray, rgb: colours.Rgb, opacity: ArrayLike = _OPACITY) -> None:
        self.beams.append(Lines.of(ends, rgb, opacity))

    def mark(self, ends: FloatArray, rgb: colours.Rgb, opacity: float = _MARK_OPACITY) -> None:
        self.marks.append(Lines.of(ends, rgb, opacity))


def source_lines(surface: SurfaceSpec, recording: RecordingSpec, rays: int) -> Lines:
    """Draw the object wave in full lines, the reference wave dashed.

    Args:
        surface: Surface of the hologram.
        recording: Its recording.
        rays: Number of rays of each wave.

    Returns:
        Lines in the frame of the hologram.
    """
    aims = aims_of(surface, rays)
    rgb = colours.of_wavelength(recording.wavelength_nm)
    drawn: list[Lines] = []
    for wave, is_dashed in ((recording.object, False), (recording.reference, True)):
        sketch = _sketch(wave, recording.wavelength_nm, aims, rgb)
        beams = Lines.joined(sketch.beams)
        drawn += [beams.dashed(_DASH * aims.size) if is_dashed else beams, *sketch.marks]
    return Lines.joined(drawn)


def _sketch(wave: WaveSpec, wavelength_nm: float, aims: Aims, rgb: colours.Rgb) -> _Sketch:
    gradient = wave_from(wave, wavelength_nm).gradient(mm_to_m(aims.points))
    way = np.broadcast_to(unit(gradient), aims.points.shape)
    beam, sketch = _Beam(aims, way, _LENGTH * aims.size), _Sketch()
    _DRAWN[type(wave)](wave, wavelength_nm, beam, rgb, sketch)
    return sketch


def _plane(
    wave: PlaneWaveSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """Parallel arrows with the outline of the beam at some wavefronts."""
    del wavelength_nm
    way = unit(wave.direction)
    ahead = dot(beam.aims.outline - beam.aims.middle, way)
    # Wavefronts lie before the whole element, however slanted it is.
    first = max(0.0, -float(ahead.min()))
    reach = first + dot(beam.points - beam.aims.middle, way) + beam.length
    _arrows(beam, reach, rgb, sketch)
    for share in _BARS:
        offset = first + ahead + share * beam.length
        front = path(beam.aims.outline - offset[:, None] * way, closed=True)
        sketch.mark(front, rgb, _BAR_OPACITY)


def _arrows(beam: _Beam, reach: ArrayLike, rgb: colours.Rgb, sketch: _Sketch) -> None:
    """Rays that come from far away, fading with the distance, with heads at the element."""
    starts = beam.points - np.broadcast_to(as_float(reach), (len(beam.points),))[:, None] * beam.way
    sketch.beam(between(starts, beam.points), rgb, (0.0, _OPACITY))
    sketch.mark(arrow_heads(beam.points, beam.way, _HEAD * beam.aims.size), rgb, _OPACITY)


def _to_point(
    beam: _Beam, point: FloatArray, converging: bool, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """Rays of a point, or toward one; one that is far away is left out."""
    far = float(np.linalg.norm(point - beam.aims.middle)) > _FAR * beam.aims.size
    if far or converging:
        _arrows(beam, beam.length, rgb, sketch)
    if far:
        return
    sketch.mark(star(point, _STAR * beam.aims.size), rgb)
    sketch.beam(between(beam.points, point) if converging else between(point, beam.points), rgb)


def _point(
    wave: PointSourceSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    del wavelength_nm
    _to_point(beam, as_float(wave.position_mm), wave.beam == "converging", rgb, sketch)


def _extended(
    wave: ExtendedSourceSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """The outline of the source, the rays of its middle, and what its edge adds to the blur."""
    edges = wave.edges_mm()
    # Of closed shapes the second half are spokes; a line is both its halves.
    is_line = wave.shape.__struct_config__.tag == "line"
    outline = edges if is_line else edges[: len(edges) // 2]
    sketch.mark(outline, rgb)
    source = wave_from(wave, wavelength_nm)
    assert isinstance(source, ExtendedSource), "a spec makes the wave of its kind"
    middle = m_to_mm(source.shape.place(np.full(source.draws, _MIDDLE_DRAW)))
    _to_point(beam, middle, wave.beam == "converging", rgb, sketch)
    if float(np.linalg.norm(middle - beam.aims.middle)) <= _FAR * beam.aims.size:
        rim = outline.reshape(-1, 3)[:: max(1, len(outline) // 4)]
        sketch.beam(between(rim, beam.aims.middle), rgb, 0.5 * _OPACITY)


def _astigmatic(
    wave: AstigmaticSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """Its two focal lines, as long as the beam is wide there, and rays through both."""
    del wavelength_nm
    crossed = foci.crossings_mm(wave, beam.points)
    for pieces in foci.lines_mm(wave, crossed):
        sketch.mark(pieces, rgb)
    # Along each ray: from before the first of focus and element to behind the last of them.
    along = np.stack([dot(each - beam.points, beam.way) for each in crossed])
    along = np.clip(along, -_FAR * beam.aims.size, _FAR * beam.aims.size)
    first, last = (np.minimum(along.min(axis=0), 0.0), np.maximum(along.max(axis=0), 0.0))
    before = between(beam.points + first[:, None] * beam.way, beam.points)
    behind = between(beam.points, beam.points + last[:, None] * beam.way)
    sketch.beam(np.concatenate((before, behind)), rgb)
    if np.nanmin(first) > -beam.length:
        _arrows(beam, beam.length, rgb, sketch)


def _window(
    wave: WindowSourceSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """The point, the plate, and rays that it refracts."""
    del wavelength_nm
    system = optics.window_system(wave)
    way = -beam.way if wave.beam == "converging" else beam.way
    back = optics.traced_back(system, beam.points, way)
    converging = wave.beam == "converging"
    ends = optics.source_ends_mm(system, back, beam.length)
    _through(ends, back, converging, rgb, sketch)
    sketch.mark(star(wave.position_mm, _STAR * beam.aims.size), rgb)
    half = 1.2 * np.nanmax(np.linalg.norm(back.places[1:] - back.places[1:, :1], axis=-1))
    for surface, hits in zip(system.surfaces, back.places[:0:-1], strict=True):
        axes = surface.frame.rotation
        corners = [x * axes[:, 0] + y * axes[:, 1] for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        sketch.mark(path(hits[0] + half * np.asarray(corners), closed=True), rgb, _BAR_OPACITY)
    if converging:
        _arrows(beam, beam.length, rgb, sketch)


def _system(
    wave: SystemWaveSpec, wavelength_nm: float, beam: _Beam, rgb: colours.Rgb, sketch: _Sketch
) -> None:
    """The outlines of the optics, the source, and rays from it to the element."""
    system = wave.core_system(wavelength_nm)
    back = optics.traced_back(system, beam.points, beam.way)
    ends = optics.source_ends_mm(system, back, beam.length)
    _through(ends, back, False, rgb, sketch)
    sketch.mark(optics.surfaces_mm(system), colours.MEASURE, 0.7)
    if isinstance(wave.source, SystemPointSource):
        sketch.mark(star(wave.source.position_mm, _STAR * beam.aims.size), rgb)
    sketch.mark(arrow_heads(beam.points, beam.way, _HEAD * beam.aims.size), rgb, _OPACITY)


def _through(
    ends: FloatArray,
    back: optics.TracedBack,
    converging: bool,
    rgb: colours.Rgb,
    sketch: _Sketch,
) -> None:
    """Rays from the source through the optics to the element, or the other way."""
    places = np.concatenate((back.places, ends[None]))
    first, last = (places[:-1], places[1:]) if converging else (places[1:], places[:-1])
    sketch.beam(between(first.reshape(-1, 3), last.reshape(-1, 3)), rgb)


_DRAWN: dict[type, Callable[[Any, float, _Beam, colours.Rgb, _Sketch], None]] = {
    PlaneWaveSpec: _plane,
    PointSourceSpec: _point,
    WindowSourceSpec: _window,
    AstigmaticSpec: _astigmatic,
    ExtendedSourceSpec: _extended,
    SystemWaveSpec: _system,
}
