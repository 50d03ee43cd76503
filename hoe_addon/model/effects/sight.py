# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rays from the eye that stand for a picture, and the luminance that comes back along them."""

import math
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray, IntArray, unit
from ..device import DeviceSpec, LightGuideSpec
from ..hologram import HologramSpec
from ..scene_view import gaze_direction
from .bodies import Body
from .light import ROOM, ROOM_ALBEDO, Component
from .radiance import radiance
from .walk import Rays, Walk, walk

_GRID, _GUIDE_GRID = (18, 14), (10, 8)
"""Places across and down; of a light guide, whose paths are long, fewer."""

_HALF_SPACE = 300
"""Places of the picture, or directions of a hologram alone."""

_SEED = 20260813
_ROOM_PEAK = 20.0
"""Luminance of windows and lamps of a room over that of white in it, at most 17: what an order
shows of a room may be these."""

_EYE_PIXEL = 3e-4
"""Radians: what the eye tells apart, for a hologram without a picture."""


@dataclass(frozen=True, eq=False)
class Sight:
    """The rays of a picture, walked.

    Attributes:
        walk: The walk.
        components: The light.
        component: Number of the component whose wavelength each root has, shape ``(n,)``.
        pixel: Number of the place in the picture of each root, shape ``(n,)``.
        share: Of the component's light in that place that each root stands for, shape ``(n,)``.
        pixels: Number of places.
        pixel_angle: Angle between neighbouring pixels of the real picture, radians.
        back: What comes back along each ray, cd/m^2, by level.
        ends: What is met at the ends, cd/m^2, by level.
        bright_back: The same as ``back`` where the room has its lights all over.
        bright_ends: The same as ``ends`` where the room has its lights all over.
    """

    walk: Walk
    components: tuple[Component, ...]
    component: IntArray
    pixel: IntArray
    share: FloatArray
    pixels: int
    pixel_angle: float
    back: list[FloatArray]
    ends: list[FloatArray]
    bright_back: list[FloatArray]
    bright_ends: list[FloatArray]

    @property
    def brightest(self) -> float:
        """Luminance of the brightest emitter over the mean of the picture, at least 1."""
        mean = float(self.means.sum())
        most = max((each.luminance for each in self.components if each.emitter), default=0.0)
        return max(most / mean, 1.0) if mean > 0.0 else 1.0

    @property
    def means(self) -> FloatArray:
        """Mean luminance of each component's light in the picture, shape ``(C,)``."""
        return self.spread(self.back[0]).mean(axis=1)

    def spread(self, of_root: FloatArray) -> FloatArray:
        """Add up values of roots by component and place.

        Args:
            of_root: Values, shape ``(n,)``.

        Returns:
            Means over the wavelengths, shape ``(C, P)``.
        """
        found = np.zeros((len(self.components), self.pixels))
        np.add.at(found, (self.component, self.pixel), self.share * of_root)
        return found

    def error(self, change: FloatArray) -> float:
        """Turn changes of luminance into the relative error that a plan promises to keep.

        Args:
            change: For each component and place, cd/m^2, shape ``(C, P)``.

        Returns:
            The largest over the components of the RMS over the picture, over the mean luminance
            of that light; of light that gives less than a hundredth of the picture, over that.
        """
        means = self.means
        floor = np.maximum(means, 0.01 * float(means.sum()))
        rms = np.sqrt(np.mean(change**2, axis=1))
        lit = floor > 0.0
        return float(np.max(rms[lit] / floor[lit], initial=0.0))


def sight_of(
    bodies: tuple[Body, ...],
    components: tuple[Component, ...],
    roots: "Roots",
    pixel_angle: float,
    wavelength_nm: float | None = None,
) -> Sight:
    """Walk the rays of a picture.

    Args:
        bodies: What is in the document.
        components: Its light.
        roots: The rays from the eye.
        pixel_angle: Angle between neighbouring pixels, radians.
        wavelength_nm: One wavelength for all rays in place of their own.

    Returns:
        The rays, walked.
    """
    starts: list[Rays] = []
    labels: list[tuple[int, float]] = []
    places = np.arange(len(roots.way), dtype=np.int64)
    for number, component in enumerate(components):
        for nm in component.wavelengths_nm:
            count = len(component.wavelengths_nm)
            starts.append(_rays(roots, float(nm) if wavelength_nm is None else wavelength_nm))
            labels.append((number, 1.0 / count))
    names = ("start", "way", "nm", "weight", "left", "step", "drift", "far")
    joined = {name: np.concatenate([getattr(each, name) for each in starts]) for name in names}
    total = len(joined["nm"])
    walked = walk(bodies, Rays(root=np.arange(total), **joined))
    component = np.repeat([label[0] for label in labels], len(places))
    ends = [radiance(walked, level, components, component) for level in walked.levels]
    bright = [
        np.where(level.end & (level.body == ROOM), _ROOM_PEAK / ROOM_ALBEDO * own, own)
        for level, own in zip(walked.levels, ends, strict=True)
    ]
    return Sight(
        walk=walked,
        components=components,
        component=component,
        pixel=np.tile(places, len(labels)),
        share=np.repeat([label[1] for label in labels], len(places)),
        pixels=len(places),
        pixel_angle=pixel_angle,
        back=walked.comes_back(ends),
        ends=ends,
        bright_back=walked.comes_back(bright),
        bright_ends=bright,
    )


@dataclass(frozen=True, eq=False)
class Roots:
    """Rays that leave the eye: starts in mm and unit directions, each of shape ``(P, 3)``."""

    start: FloatArray
    way: FloatArray


def _rays(roots: Roots, nm: float) -> Rays:
    count = len(roots.way)
    return Rays(
        start=roots.start,
        way=roots.way,
        nm=np.full(count, nm),
        root=np.arange(count),
        weight=np.ones(count),
        left=np.full(count, -1),
        step=np.zeros((count, 3)),
        drift=np.zeros((count, 3)),
        far=np.zeros(count),
    )


def roots_of(spec: DeviceSpec) -> tuple[Roots, float]:
    """Choose rays all over pupil and picture.

    Args:
        spec: The document.

    Returns:
        One ray for each of some places of the picture, and the angle of one pixel in radians. Of a
        light guide every other ray is one of another place in the eyebox.
    """
    rng = np.random.default_rng(_SEED)
    eye, (width, height) = spec.eye, spec.render.size
    half = math.tan(math.radians(eye.field_deg) / 2.0)
    columns, rows = _GUIDE_GRID if isinstance(spec, LightGuideSpec) else _GRID
    column, row = (each.ravel() for each in np.meshgrid(np.arange(columns), np.arange(rows)))
    jitter = rng.random((2, len(column)))
    x = (2.0 * (column + jitter[0]) / columns - 1.0) * half
    y = (2.0 * (row + jitter[1]) / rows - 1.0) * half * height / width
    gaze = (0.0, 0.0) if isinstance(spec, LightGuideSpec) else spec.gaze_deg
    ahead = gaze_direction(gaze)
    right = gaze_direction((gaze[0] + 90.0, 0.0))
    up = np.cross(right, ahead)
    radius = 0.5 * eye.pupil_diameter_mm * np.sqrt(rng.random(len(x)))
    turn = 2.0 * np.pi * rng.random(len(x))
    aside = np.cos(turn)[:, None] * right + np.sin(turn)[:, None] * up
    start = np.asarray(eye.position_mm) + radius[:, None] * aside
    if isinstance(spec, LightGuideSpec):
        start = start + _in_eyebox(spec, len(x), rng)
    return Roots(start, unit(ahead + x[:, None] * right + y[:, None] * up)), 2.0 * half / width


def _in_eyebox(spec: LightGuideSpec, count: int, rng: np.random.Generator) -> FloatArray:
    """Places of the eye: its own for every other ray, else anywhere in the eyebox; mm."""
    reach = 0.5 * (np.asarray(spec.eyebox.grid) - 1) * spec.eyebox.pitch_mm
    found = np.zeros((count, 3))
    found[1::2, :2] = (2.0 * rng.random((len(found[1::2]), 2)) - 1.0) * reach
    return found


def half_space_roots(spec: HologramSpec) -> tuple[Roots, float]:
    """Choose rays from all directions onto a hologram by itself.

    Args:
        spec: The hologram.

    Returns:
        Rays that start just before it, and the angle that an eye tells apart, radians.
    """
    rng = np.random.default_rng(_SEED)
    width, height = spec.surface.size_mm
    spot = (rng.random((_HALF_SPACE, 2)) - 0.5) * 0.7 * (width, height)
    sine, turn = np.sqrt(rng.random(_HALF_SPACE)), 2.0 * np.pi * rng.random(_HALF_SPACE)
    side = np.where(rng.random(_HALF_SPACE) < 0.5, -1.0, 1.0)
    rise = side * np.sqrt(1.0 - sine**2)
    way = np.stack((sine * np.cos(turn), sine * np.sin(turn), rise), axis=-1)
    x, y = spot.T
    height_mm = 1e3 * spec.surface.core_shape().sag(x * 1e-3, y * 1e-3)
    on = np.column_stack((spot, np.nan_to_num(height_mm)))
    return Roots(on - 1e-3 * way, way), _EYE_PIXEL
