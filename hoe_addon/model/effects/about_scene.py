# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decisions about the whole scene: dispersion, bounces, the pupil, bare faces."""

import numpy as np
from msgspec.structs import replace

from ...core.arrays import FloatArray
from ...core.units import nm_to_m
from ..device import DeviceSpec, LightGuideSpec
from .bodies import Body
from .budget import Budget
from .costs import COSTS, SPECTRAL_TIME
from .dispersion import OneWavelength, at_one_wavelength
from .light import ROOM
from .names import WHOLE_SCENE, Effect
from .sharpness import blur_error
from .sight import Roots, Sight
from .walk import MOST_LEVELS
from .words import percent

_SPARE_BOUNCES = 16
"""Surfaces that a path may pass beyond those seen: the filter, and rays that were not looked at."""

_NEAREST_ROOM_MM = 400.0
_LEAST_BOUNCE_SHARE = 0.1
"""Of what is left of the promise; paths that were not looked at may be longer."""


def decide_dispersion(
    sight: Sight, budget: Budget, spec: DeviceSpec, bodies: tuple[Body, ...], roots: Roots
) -> OneWavelength | None:
    """Decide whether one wavelength will do.

    Args:
        sight: The rays of the picture with all wavelengths.
        budget: The decisions so far.
        spec: The document.
        bodies: What is in it.
        roots: The rays from the eye.

    Returns:
        The picture at one wavelength, or None where dispersion is simulated, or the document asks
        for one wavelength itself.
    """
    if spec.render.mode == "preview":
        nm = spec.render.preview_wavelength_nm
        budget.absent(Effect.DISPERSION, f"the document asks for one wavelength, {nm:.4g} nm")
        return None
    single = at_one_wavelength(sight, bodies, roots, spec.render.preview_wavelength_nm)
    if single.turned == 0.0:
        why = (
            f"no light comes on a way that depends on the wavelength; {single.worst} is wrong most"
        )
    else:
        why = (
            f"{percent(single.turned)} of the light is diffracted or dispersed;"
            f" {single.worst} is drawn out by {single.spread_pixels:.2g} pixels"
        )
    cost = _spectral_cost(sight, spec)
    off = budget.decide(Effect.DISPERSION, WHOLE_SCENE, single.error, why, cost)
    return single if off else None


def _spectral_cost(sight: Sight, spec: DeviceSpec) -> float:
    """Time of a picture with all wavelengths over that with one, at equal error."""
    means = sight.means
    total = float(means.sum())
    emitters = sum(1 for each in sight.components if each.emitter)
    floor = spec.render.spectrum_floor if emitters else 1.0
    noise = [
        max(emitters, 1) / max(1.0 - floor, 0.1) if each.emitter else 1.0 / floor
        for each in sight.components
    ]
    return SPECTRAL_TIME * float(np.dot(means, noise)) / total if total > 0.0 else 1.0


def decide_bounces(sight: Sight, budget: Budget, spec: DeviceSpec) -> int:
    """Decide how many surfaces a path may pass.

    Args:
        sight: The rays of the picture.
        budget: The decisions so far.
        spec: The document.

    Returns:
        The number for the render settings.
    """
    given = spec.render.max_bounces
    allowed = _LEAST_BOUNCE_SHARE * max(budget.promise - budget.used, 0.0)
    for passed in range(1, len(sight.back)):
        error = sight.error(_beyond(sight, passed))
        most = 2 * passed + _SPARE_BOUNCES
        if error <= allowed and passed < MOST_LEVELS - 1 and most < given:
            why = f"beyond {passed} surfaces there is {percent(error)} of the light"
            if budget.decide(Effect.BOUNCES, WHOLE_SCENE, error, f"{why}; {most} are allowed"):
                return most
            return given
    deepest = len(sight.back) - 1
    why = f"paths pass {deepest} surfaces or more, {given} are allowed"
    budget.decide(Effect.BOUNCES, WHOLE_SCENE, None, why)
    return given


def _beyond(sight: Sight, passed: int) -> FloatArray:
    """Light that has passed more surfaces, by component and place, cd/m^2."""
    level = sight.walk.levels[passed]
    on_its_way = ~level.end
    values = np.zeros(len(sight.component))
    rays = level.rays
    gains = np.maximum(level.gain, 1e-300)
    np.add.at(
        values, rays.root, np.where(on_its_way, rays.weight * sight.back[passed] / gains, 0.0)
    )
    return sight.spread(values)


def decide_pupil(sight: Sight, budget: Budget, spec: DeviceSpec) -> bool:
    """Decide whether the pupil may be a point.

    Args:
        sight: The rays of the picture.
        budget: The decisions so far.
        spec: The document.

    Returns:
        True if it may.
    """
    eye = spec.eye
    focus = 0.0 if eye.focus_mm is None else 1.0 / eye.focus_mm
    spread = eye.pupil_diameter_mm / 4.0 / sight.pixel_angle
    values = np.zeros(len(sight.component))
    worst = 0.0
    for level, ends in zip(sight.walk.levels, sight.ends, strict=True):
        rays = level.rays
        last = np.linalg.norm(level.points - rays.start, axis=1)
        far = rays.far + np.where(level.body == ROOM, _NEAREST_ROOM_MM, last)
        blur = spread * np.maximum(
            np.abs(1.0 / np.maximum(far, 1.0) - focus), focus * (level.body == ROOM)
        )
        lit = level.end & (rays.weight * ends > 0.0)
        worst = max(worst, float(np.max(blur[lit], initial=0.0)))
        np.add.at(values, rays.root, rays.weight * ends * blur_error(blur))
    change = sight.spread(values) + _edges(sight, spec)
    why = f"a pupil of {eye.pupil_diameter_mm:.3g} mm blurs by up to {worst:.2g} pixels"
    return budget.decide(Effect.PUPIL, WHOLE_SCENE, sight.error(change), why, COSTS[Effect.PUPIL])


def _edges(sight: Sight, spec: DeviceSpec) -> FloatArray:
    """Of a light guide: the pupil averages over the places where light leaves it."""
    share = 0.0
    if isinstance(spec, LightGuideSpec):
        share = min(spec.eye.pupil_diameter_mm / (2.0 * spec.guide.thickness_mm), 1.0)
    return share * sight.spread(sight.back[0])


def decide_fresnel(sight: Sight, budget: Budget, bodies: tuple[Body, ...]) -> None:
    """Tell what bare faces reflect; no document can do without.

    Args:
        sight: The rays of the picture.
        budget: The decisions so far.
        bodies: What is in the document.
    """
    faces = [body for body in bodies if body.face is not None]
    if not faces:
        budget.absent(Effect.FRESNEL, "there is no bare face of a dielectric")
        return
    face = faces[0].face
    assert face is not None, "faces have one"
    middle = nm_to_m(np.array([each.mean_nm for each in sight.components] or [550.0]).mean())
    back, front = (float(medium.index(middle)) for medium in (face.back, face.front))
    share = ((back - front) / (back + front)) ** 2
    why = f"{len(faces)} bare faces, {percent(share)} reflected at each"
    budget.decide(Effect.FRESNEL, WHOLE_SCENE, None, why)


def with_changes(spec: DeviceSpec, changes: dict[str, str | float]) -> DeviceSpec:
    """Set fields of the render settings and of the eye.

    Args:
        spec: The document.
        changes: Values by path, such as ``render.mode``.

    Returns:
        The document with them.
    """
    parts = {
        part: {
            path.split(".")[1]: value for path, value in changes.items() if path.startswith(part)
        }
        for part in ("render", "eye")
    }
    changed = {
        part: replace(getattr(spec, part), **fields) for part, fields in parts.items() if fields
    }
    return replace(spec, **changed) if changed else spec
