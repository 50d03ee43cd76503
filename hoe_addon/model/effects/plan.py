# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of a document, and the document that is left when the plan is followed."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

import msgspec
import numpy as np

from ..contents import digest, with_contents
from ..device import DeviceSpec
from ..efficiency import ConstantSpec, RcwaSpec, ShareTable
from ..hologram import HologramSpec
from . import about_scene, by_hand
from .about_hologram import HologramPlan
from .bodies import Body
from .budget import Budget
from .holograms import holograms_of, with_holograms
from .light import Component, components_of, equal_light
from .names import EffectPlan
from .overrides import Overrides, read_overrides
from .places import bodies_of, hologram_body
from .sight import Sight, half_space_roots, roots_of, sight_of

PROMISE = 1e-3
"""Relative RMS error of luminance that a plan may cost in all."""

_KEPT = 16
"""Plans that are kept, since a document is often planned more than once."""


_LEAST_SHARE = 1e-3
"""Share of an emitter's light by which a ray that meets it is told from one that sees its glow."""


def plan_effects(
    spec: DeviceSpec, promise: float = PROMISE, *, in_full: bool = False
) -> EffectPlan:
    """Decide which effects a document calls for.

    Rays from the eye are walked backward through all holograms, and an effect is left out only if
    the picture without it differs by less than what is left of the promise.

    Args:
        spec: The document; the changes in ``render.effects`` are followed.
        promise: Relative RMS error of luminance that all that is left out may cost together.
        in_full: Whether the effects are looked at even where the document turns everything on;
            otherwise no decision is needed then, and none is given.

    Returns:
        The plan.

    Raises:
        FieldError: ``render.effects`` names what there is not, or leaves out what must stay.
    """
    document = _Document(spec, msgspec.json.encode(spec), _files_of(spec))
    return _plan(document, promise, in_full)


@dataclass(frozen=True)
class _Document:
    """A document that is equal to another of the same text, with the same data in its files."""

    spec: DeviceSpec = field(compare=False)
    text: bytes
    files: str


def _files_of(spec: DeviceSpec) -> str:
    """Hash of the document with what is in its files: the same names may hold other data now."""
    try:
        return digest(json.dumps(with_contents(msgspec.to_builtins(spec))).encode())
    except OSError:
        return ""  # whoever reads the file says what is wrong


@lru_cache(maxsize=_KEPT)
def _plan(document: _Document, promise: float, in_full: bool) -> EffectPlan:
    spec = document.spec
    holograms = holograms_of(spec)
    overrides = read_overrides(spec.render.effects, holograms)
    if overrides.everything and not overrides.chosen and not in_full:
        return EffectPlan((), 0.0)
    budget = Budget(promise, overrides)
    components = components_of(spec)
    bodies = _walkable(bodies_of(spec))
    roots, pixel_angle = roots_of(spec)
    if not components:
        return EffectPlan((), 0.0)
    sight = sight_of(bodies, components, roots, pixel_angle)
    if _misses_light(sight, len(roots.start)):
        # Light that no ray has met may still be seen, and nobody knows what it needs.
        return EffectPlan((), 0.0)
    changes: dict[str, str | float] = {}
    single = about_scene.decide_dispersion(sight, budget, spec, bodies, roots)
    if single is not None:
        changes["render.mode"] = "preview"
        changes["render.preview_wavelength_nm"] = single.wavelength_nm
        sight = single.sight
    most = about_scene.decide_bounces(sight, budget, spec)
    if most != spec.render.max_bounces:
        changes["render.max_bounces"] = most
    if about_scene.decide_pupil(sight, budget, spec):
        changes["eye.pupil_diameter_mm"] = min(by_hand.NO_PUPIL_MM, spec.eye.pupil_diameter_mm)
    about_scene.decide_fresnel(sight, budget, bodies)
    simple = _decide_holograms(sight, budget, holograms)
    budget.check_followed()
    return EffectPlan(tuple(budget.decisions), budget.total, changes, simple)


def _misses_light(sight: Sight, rays: int) -> bool:
    """Tell whether there is light of which no ray has met an emitter, nor one of the same spectrum.

    A ray that meets one brings the mean to its luminance times the ray's share over all rays; the
    glow of matte bodies in its light is far below that.
    """
    met: set[str | tuple[float, float]] = set()
    for component, mean in zip(sight.components, sight.means.tolist(), strict=True):
        if mean > _LEAST_SHARE * component.luminance / rays:
            met |= {component.emitter, _spectrum(component)}
    return any(
        met.isdisjoint((component.emitter, _spectrum(component))) for component in sight.components
    )


def _spectrum(component: Component) -> tuple[float, float]:
    return round(component.mean_nm, 1), round(component.width_nm, 4)


def _decide_holograms(
    sight: Sight, budget: Budget, holograms: dict[str, HologramSpec]
) -> dict[str, HologramSpec]:
    found: dict[str, HologramSpec] = {}
    for name, given in holograms.items():
        simple = HologramPlan(sight, budget, name, given).decide()
        if simple != given:
            found[name] = simple
    return found


def plan_hologram(
    spec: HologramSpec, effects: Sequence[str] = (), promise: float = PROMISE
) -> EffectPlan:
    """Decide which effects a hologram by itself calls for, in light from all directions.

    Args:
        spec: The hologram.
        effects: Changes, as in ``render.effects``.
        promise: Relative RMS error of luminance that all that is left out may cost together.

    Returns:
        The plan, of the hologram's own effects.

    Raises:
        FieldError: ``effects`` names what there is not, or leaves out what must stay.
    """
    name = spec.name
    overrides: Overrides = read_overrides(effects, (name,))
    budget = Budget(promise, overrides)
    bodies = _walkable((hologram_body(name, spec, np.eye(3), np.zeros(3)),))
    roots, pixel_angle = half_space_roots(spec)
    sight = sight_of(bodies, (equal_light(),), roots, pixel_angle)
    simple = _decide_holograms(sight, budget, {name: spec})
    budget.check_followed()
    return EffectPlan(tuple(budget.decisions), budget.total, {}, simple)


def _walkable(bodies: tuple[Body, ...]) -> tuple[Body, ...]:
    """Stand-ins for holograms whose shares take too long: as much light in each way out."""
    return tuple(_stand_in(body) for body in bodies)


def _stand_in(body: Body) -> Body:
    spec = body.hologram
    if spec is None or not isinstance(spec.efficiency, RcwaSpec):
        return body
    ways = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    sides: dict[bool, dict[str, float]] = {False: {}, True: {}}
    for way in ways:
        sides[way.reflected][str(way.order)] = 1.0 / len(ways)
    equal = ConstantSpec(
        table=ShareTable(T=sides[False], R=sides[True]),
        total_internal_reflection=spec.efficiency.total_internal_reflection,
    )
    return replace(body, hologram=msgspec.structs.replace(spec, efficiency=equal))


def planned(spec: DeviceSpec, plan: EffectPlan) -> DeviceSpec:
    """Take what a plan leaves out from a document.

    Args:
        spec: The document.
        plan: Its plan; decisions of one's own are followed too.

    Returns:
        The simpler document; an equal one where nothing is left out.
    """
    simple = with_holograms(spec, by_hand.holograms_by_hand(spec, plan))
    return about_scene.with_changes(simple, by_hand.changes_by_hand(spec, plan))
