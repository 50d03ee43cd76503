# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether one wavelength will do: what the picture at one wavelength gets wrong."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from .bodies import Body
from .light import Component
from .sharpness import blur_error, shift_error
from .sight import Roots, Sight, sight_of

_NEAR = 0.999
"""Light of a wavelength within this ratio counts as that of the single wavelength."""

_LEAST_MM = 1.0

_NONE = 1e-9
"""Steps below this, 1/nm, do not turn a ray."""


@dataclass(frozen=True, eq=False)
class OneWavelength:
    """A picture at one wavelength, held against that of all.

    Attributes:
        wavelength_nm: The wavelength.
        sight: Its rays.
        error: Relative RMS error of luminance.
        turned: Share of the light that comes on ways that depend on the wavelength.
        worst: Name of the light that it is most wrong for.
        spread_pixels: How far that light is drawn out, standard deviation in pixels.
    """

    wavelength_nm: float
    sight: Sight
    error: float
    turned: float
    worst: str
    spread_pixels: float


def at_one_wavelength(
    sight: Sight,
    bodies: tuple[Body, ...],
    roots: Roots,
    preview_nm: float,
) -> OneWavelength:
    """Hold a picture at the best single wavelength against that of all wavelengths.

    Light whose luminance differs counts in full, at every wavelength by itself, since its colour
    would be wrong too. Light whose way depends on the wavelength counts by how far it is moved; see
    `sharpness`.

    Args:
        sight: The rays of the picture with all wavelengths.
        bodies: What is in the document.
        roots: The rays from the eye.
        preview_nm: The wavelength where nothing depends on it.

    Returns:
        The result.
    """
    weights = _turned_light(sight)
    best = int(np.argmax(weights)) if len(weights) else 0
    found = preview_nm
    if len(weights) and weights[best] > 0.0:
        found = sight.components[best].mean_nm
    single = sight_of(bodies, sight.components, roots, sight.pixel_angle, found)
    change = sight.spread(np.abs(sight.back[0] - single.back[0]))
    change += _moved(sight, found)
    unseen = _unseen(sight, found)
    means = sight.means
    total = float(means.sum())
    by_light = np.sqrt(np.mean(change**2, axis=1)) / np.maximum(means, 0.01 * max(total, 1e-300))
    worst = int(np.argmax(by_light)) if len(by_light) else 0
    return OneWavelength(
        wavelength_nm=found,
        sight=single,
        error=sight.error(change) + unseen,
        turned=float(weights.sum()) / total if total > 0.0 else 0.0,
        worst=sight.components[worst].name if sight.components else "",
        spread_pixels=_spread(sight, worst) if sight.components else 0.0,
    )


def _across(sight: Sight, level: int) -> FloatArray:
    """How fast what each ray shows moves with the wavelength, seen from the eye, rad/nm.

    A turn of the last direction counts as if all were far away. Where the turns of several
    holograms cancel, the drift between them is left.
    """
    known = sight.walk.levels[level]
    rays = known.rays
    far = rays.far + np.linalg.norm(known.points - rays.start, axis=1)
    drift = np.linalg.norm(rays.drift, axis=1) / np.maximum(far, _LEAST_MM)
    return np.maximum(np.linalg.norm(rays.turning, axis=1), drift)


def _turned_light(sight: Sight) -> FloatArray:
    """Mean luminance by component of what comes on ways that depend on the wavelength."""

    def turned(level: int) -> FloatArray:
        return (_across(sight, level) > _NONE).astype(np.float64)

    return _sum(sight, sight.ends, turned).mean(axis=1)


def _spread(sight: Sight, component: int) -> float:
    rates = [float(np.max(_across(sight, level), initial=0.0)) for level in range(len(sight.ends))]
    return max(rates) * sight.components[component].width_nm / sight.pixel_angle


def _moved(sight: Sight, wavelength_nm: float) -> FloatArray:
    """Luminance at ends times how far the light there is moved, by component and place."""
    centre = np.array([_off_centre(each, wavelength_nm) for each in sight.components])

    def wrong(level: int) -> FloatArray:
        rays = sight.walk.levels[level].rays
        pixels = _across(sight, level) / sight.pixel_angle
        shift = pixels * centre[sight.component[rays.root]]
        blur = blur_error(pixels * (rays.nm - wavelength_nm))
        return np.minimum(shift_error(shift) + blur, 1.0)

    return _sum(sight, sight.bright_ends, wrong)


def _unseen(sight: Sight, wavelength_nm: float) -> float:
    """Bound what other emitters may show in orders whose rays did not happen to meet them."""
    others = [
        each.luminance
        for each in sight.components
        if each.emitter and not _NEAR * wavelength_nm < each.mean_nm < wavelength_nm / _NEAR
    ]
    mean = float(sight.means.sum())
    if not others or not mean > 0.0:
        return 0.0
    share, count = 0.0, 0
    for hits in sight.walk.hits:
        turned = np.array([way.steps != 0.0 for way in hits.ways])
        share = max(share, float(np.max(hits.shares[:, turned], initial=0.0)))
        count += len(hits.rays)
    return share * max(others) / mean / float(np.sqrt(max(count, 1)))


def _off_centre(component: Component, wavelength_nm: float) -> float:
    return abs(component.mean_nm - wavelength_nm)


def _sum(
    sight: Sight, luminance: list[FloatArray], factor: Callable[[int], FloatArray]
) -> FloatArray:
    values = np.zeros(len(sight.component))
    for level, ends in enumerate(luminance):
        rays = sight.walk.levels[level].rays
        np.add.at(values, rays.root, rays.weight * ends * factor(level))
    return sight.spread(values)
