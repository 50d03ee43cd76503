# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Following decisions that were not made by the plan: the simpler document without its rays."""

from ...core.orders import Branch
from ..device import DeviceSpec
from ..efficiency import RcwaSpec
from ..evaluate import efficiencies, incident_direction
from ..hologram import HologramSpec
from .holograms import holograms_of
from .light import components_of
from .names import WHOLE_SCENE, Effect, EffectPlan
from .orders import branch_groups, less
from .simpler import constant_effects, without
from .words import named

NO_PUPIL_MM = 1e-4
"""A pupil that blurs nothing."""


def changes_by_hand(spec: DeviceSpec, plan: EffectPlan) -> dict[str, str | float]:
    """Find the fields that decisions about the whole scene set, beside those of the plan.

    Args:
        spec: The document.
        plan: The plan, perhaps with decisions of someone's own.

    Returns:
        Values by path.
    """
    found: dict[str, str | float] = dict(plan.changes)
    if not plan.is_on(Effect.DISPERSION) and spec.render.mode == "spectral":
        found.setdefault("render.mode", "preview")
        found.setdefault("render.preview_wavelength_nm", main_wavelength(spec))
    if not plan.is_on(Effect.PUPIL):
        found.setdefault("eye.pupil_diameter_mm", min(NO_PUPIL_MM, spec.eye.pupil_diameter_mm))
    return found


def main_wavelength(spec: DeviceSpec) -> float:
    """Find the wavelength of a document's narrowest light.

    Args:
        spec: The document.

    Returns:
        Its mean vacuum wavelength, nm; that of the preview where nothing gives light.
    """
    emitters = [each for each in components_of(spec) if each.emitter]
    if not emitters:
        return spec.render.preview_wavelength_nm
    return min(emitters, key=lambda each: each.width_nm).mean_nm


def holograms_by_hand(spec: DeviceSpec, plan: EffectPlan) -> dict[str, HologramSpec]:
    """Find the simpler holograms that decisions leave, beside those of the plan.

    Args:
        spec: The document.
        plan: The plan, perhaps with decisions of someone's own.

    Returns:
        Holograms by name.
    """
    found = dict(plan.holograms)
    for name, given in holograms_of(spec).items():
        if name not in found:
            simple = _followed(given, name, plan, main_wavelength(spec))
            if simple != given:
                found[name] = simple
    return found


def _followed(
    given: HologramSpec, name: str, plan: EffectPlan, wavelength_nm: float
) -> HologramSpec:
    simple = given
    for each in plan.left_out:
        if each.hologram != name or each.hologram == WHOLE_SCENE:
            continue
        if each.effect in (Effect.ORDERS, Effect.REFLECTED_ORDERS):
            simple = less(simple, _dropped(given, each.effect, each.part))
            continue
        mean = _at_centre(simple, wavelength_nm) if each.effect in constant_effects(simple) else {}
        simple = without(simple, each.effect, mean, wavelength_nm) or simple
    return simple


def _dropped(spec: HologramSpec, effect: Effect, part: str) -> list[Branch]:
    """The branches that a decision is about: of the whole effect, all but order 0, or the first."""
    groups = branch_groups(spec)
    if part:
        return [way for group in groups for way in group if " ".join(map(named, group)) == part]
    reflected = effect == Effect.REFLECTED_ORDERS
    own = [group for group in groups if all(way.reflected for way in group) == reflected]
    kept = next((group for group in own if group[0].order == 0), own[0] if own else ())
    if len(own) < len(groups) and reflected:
        kept = ()
    return [way for group in own for way in group if group != kept]


def _at_centre(spec: HologramSpec, wavelength_nm: float) -> dict[Branch, float]:
    """Shares of light along the normal at the centre."""
    if isinstance(spec.efficiency, RcwaSpec):
        return {}
    orders = tuple(dict.fromkeys(spec.orders))
    light = incident_direction(0.0, 0.0, from_front=False)
    shares = efficiencies(spec, light, wavelength_nm, orders)
    return {
        Branch(order, reflected=bool(side)): float(shares[place, side])
        for place, order in enumerate(orders)
        for side in (0, 1)
    }
