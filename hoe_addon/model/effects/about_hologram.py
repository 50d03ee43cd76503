# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decisions about one hologram: its orders, its pattern, its shares, its haze."""

import numpy as np

from ...core.orders import Branch
from ..efficiency import ConstantSpec, KinoformSpec, KogelnikSpec, RcwaSpec, TableSpec
from ..hologram import HologramSpec
from ..medium import medium_from
from . import errors, measures
from .budget import Budget
from .costs import COSTS
from .names import Effect
from .orders import decide_orders
from .sight import Sight
from .simpler import TABLE_DIMENSIONS, constant_effects, has_constant_vector, without
from .words import percent

_ONE_WAVELENGTH_NM = 0.02


class HologramPlan:
    """The decisions about one hologram, one after the other.

    Attributes:
        name: Its name in the document.
        given: It as the document has it.
        simple: What is left of it so far.
    """

    def __init__(self, sight: Sight, budget: Budget, name: str, given: HologramSpec) -> None:
        """Look at the rays that meet the hologram."""
        self.sight, self.budget, self.name = sight, budget, name
        self.given = self.simple = given
        self.hits = errors.hits_of(sight, name)
        self._shares_cost = 0.0
        self._shares_forced = False
        self._nm = self._wavelengths()
        self._mean = self._mean_shares()

    def decide(self) -> HologramSpec:
        """Decide about every effect.

        Returns:
            The hologram that is left.
        """
        if not self.hits:
            why = "no light on its way to the eye meets the hologram"
            self.budget.unmet.add(self.name)
            self.budget.note(Effect.ORDERS, self.name, off=False, why=why, error=None)
            return self.given
        self.simple = decide_orders(self.sight, self.budget, self.name, self.given)
        self._pattern()
        self._relief()
        self._shares()
        self._total_reflection()
        self._haze()
        return self.simple

    def _wavelengths(self) -> tuple[float, float, float]:
        """Shortest, mean and longest wavelength that meet it, nm."""
        parts = [self.sight.walk.levels[each.level].rays.nm[each.rays] for each in self.hits]
        nm = np.concatenate(parts) if parts else np.array([self.given.pattern.wavelength_nm])
        return float(nm.min()), float(nm.mean()), float(nm.max())

    def _mean_shares(self) -> dict[Branch, float]:
        found: dict[Branch, float] = {}
        total = 0.0
        for each in self.hits:
            weight = self.sight.walk.levels[each.level].rays.weight[each.rays]
            total += float(weight.sum())
            for place, way in enumerate(each.ways):
                share = float(weight @ each.shares[:, place])
                found[way] = found.get(way, 0.0) + share
        return {way: share / total for way, share in found.items()} if total > 0.0 else {}

    def _spread(self) -> float:
        """Largest difference of a share from its mean over the rays that occur."""
        most = 0.0
        for each in self.hits:
            for place, way in enumerate(each.ways):
                there = each.shares[:, place][each.reach[:, place] <= 1.0]
                if there.size and way in self._mean:
                    most = max(most, float(np.max(np.abs(there - self._mean[way]))))
        return most

    def _without(self, effect: Effect, spec: HologramSpec) -> HologramSpec | None:
        return without(spec, effect, self._mean, self._nm[1])

    def _pattern(self) -> None:
        """Extended sources, then whether the grating changes over the hologram."""
        for effect, what in (
            (Effect.EXTENDED_SOURCE, "the source is drawn out by up to {:.3g} pixels"),
            (Effect.POSITION, "the grating changes over the hologram: {:.3g} pixels"),
        ):
            simple = self._without(effect, self.simple)
            if simple is None:
                self._no_pattern_effect(effect)
                continue
            change = errors.turned_change(self.sight, self.name, self.simple, simple)
            change = change + np.abs(errors.share_change(self.sight, self.name, simple))
            error = self.sight.error(change)
            moved = measures.largest_move(self.sight, self.name, self.simple, simple)
            if self.budget.decide(effect, self.name, error, what.format(moved), COSTS[effect]):
                self.simple = simple

    def _no_pattern_effect(self, effect: Effect) -> None:
        if effect == Effect.POSITION and has_constant_vector(self.given):
            lines = measures.lines_per_mm(self.given)
            why = f"the grating vector is the same everywhere, {lines:.4g} lines/mm"
            self.budget.absent(effect, why, self.name)
        elif effect == Effect.POSITION:
            why = "the pattern changes over the hologram and has no plain form"
            self.budget.decide(effect, self.name, None, why, COSTS[effect])
        else:
            self.budget.absent(effect, "no recording source is extended", self.name)

    def _relief(self) -> None:
        """Errors of making, then levels, then the angle."""
        model = self.given.efficiency
        if not isinstance(model, KinoformSpec):
            return
        made = model.errors is not None
        what = "the relief is made with errors" if made else "the relief is made without errors"
        self._by_shares(Effect.MAKING_ERRORS, what, there=made)
        what = (
            f"the relief has {model.levels} levels" if model.levels else "the relief is continuous"
        )
        self._by_shares(Effect.LEVELS, what, there=model.levels > 0)
        if self.budget.overrides.of(Effect.WAVELENGTH, self.name) is not False:
            words = ("follows", "the direction of the light")
            if not model.angle_dependent:
                words = ("is", "that along the normal for all directions")
            what = f"the phase depth {words[0]} {words[1]}"
            self._by_shares(Effect.ANGLE, what, there=model.angle_dependent)

    def _by_shares(self, effect: Effect, what: str, *, there: bool) -> None:
        """Decide about an effect that changes shares alone."""
        if not there:
            self.budget.absent(effect, what, self.name)
            return
        simple = self._without(effect, self.simple)
        if simple is None:
            why = f"{what}, and something else that is on needs it"
            self.budget.decide(effect, self.name, None, why, COSTS[effect])
            return
        after = self._error(simple)
        alone = self._without(effect, self.given)
        error = after if alone is None else self._error(alone)
        off = self.budget.allows(effect, self.name, error, self._added(error, after))
        why = f"{what}: without it the picture is off by {percent(error)}"
        self.budget.note(effect, self.name, off=off, why=why, error=error, cost=COSTS[effect])
        if off:
            self._take(effect, simple, after)

    def _added(self, alone: float, after: float) -> float:
        """What leaving an effect out adds to the error of what is left out already."""
        added = after - self._shares_cost
        # Beside a large error of the user's choice a small one of the plan's would not show.
        return max(added, alone) if self._shares_forced else added

    def _take(self, effect: Effect, simple: HologramSpec, cost: float) -> None:
        self.simple, self._shares_cost = simple, cost
        self._shares_forced |= self.budget.overrides.of(effect, self.name) is False

    def _error(self, simple: HologramSpec) -> float:
        return self.sight.error(errors.share_change(self.sight, self.name, simple))

    def _shares(self) -> None:
        model = self.given.efficiency
        if isinstance(model, ConstantSpec):
            for effect in (Effect.ANGLE, Effect.WAVELENGTH, Effect.LEVELS):
                self.budget.absent(effect, "the shares are given as constants", self.name)
            return
        if isinstance(model, KogelnikSpec):
            absorbs = model.absorption_per_mm > 0.0
            what = "the layer absorbs" if absorbs else "the layer is clear"
            self._by_shares(Effect.ABSORPTION, what, there=absorbs)
        if model.uses_table and not isinstance(model, TableSpec):
            self._made_table()
            return
        self._constant()

    def _constant(self) -> None:
        """Constant shares in place of all that depends on direction, wavelength and place."""
        group = constant_effects(self.simple)
        wanted = {self.budget.overrides.of(effect, self.name): effect for effect in group}
        main = wanted.get(False, next(iter(group), None))
        if main is None:
            return
        simple = without(self.simple, main, self._mean, self._nm[1])
        error = None if simple is None else self._error(simple)
        low, _, high = self._nm
        why = (
            f"shares change by up to {self._spread():.2g} over {low:.0f} to {high:.0f} nm"
            f" and {self._angles()} degrees"
        )
        # Of a kinoform the angle has been decided by itself.
        noted = tuple(each for each in group if not self._angle_decided(each))
        blocked = len(noted) < len(group) and False not in wanted
        off = False
        if error is not None and True not in wanted and not blocked:
            off = self.budget.allows(main, self.name, error, self._added(error, error))
        for effect in noted:
            self.budget.note(effect, self.name, off=off, why=why, error=error, cost=COSTS[effect])
        if off and simple is not None and error is not None:
            self._take(main, simple, error)

    def _angle_decided(self, effect: Effect) -> bool:
        own = (effect, self.name)
        return effect == Effect.ANGLE and any(
            (each.effect, each.hologram) == own for each in self.budget.decisions
        )

    def _angles(self) -> str:
        """Angles to the normal under which the hologram is seen, degrees."""
        found = [measures.incidence_deg(self.given, each) for each in self.hits]
        every = np.concatenate(found)
        return f"{every.min():.0f} to {every.max():.0f}"

    def _made_table(self) -> None:
        """A table that is made of the model: one wavelength needs no dimension for it."""
        low, mean, high = self._nm
        why = "the shares are looked up in a table that is made of the model"
        for effect in (Effect.TABLE, *TABLE_DIMENSIONS[1:]):
            self.budget.decide(effect, self.name, None, why, COSTS[effect])
        effect = Effect.TABLE_WAVELENGTH
        single = high - low < _ONE_WAVELENGTH_NM
        error = 0.0 if single else self._at_mean_wavelength()
        why = f"light of {low:.4g} to {high:.4g} nm meets it"
        if self.budget.decide(effect, self.name, error, why, COSTS[effect]):
            found = without(self.simple, effect, self._mean, mean)
            self.simple = found or self.simple

    def _at_mean_wavelength(self) -> float | None:
        if isinstance(self.given.efficiency, RcwaSpec):
            return None
        change = errors.wavelength_change(self.sight, self.name, self.given, self._nm[1])
        return self.sight.error(change)

    def _total_reflection(self) -> None:
        if not self.given.efficiency.total_internal_reflection:
            return
        media = (self.given.media.back, self.given.media.front)
        indices = [float(medium_from(each).index(self._nm[1] * 1e-9)) for each in media]
        what = f"indices of {indices[0]:.4g} and {indices[1]:.4g} on the two sides"
        self._by_shares(Effect.TOTAL_REFLECTION, what, there=True)

    def _haze(self) -> None:
        haze = self.given.efficiency.haze
        if haze is None:
            self.budget.absent(Effect.HAZE, "the hologram does not scatter", self.name)
            return
        share = errors.largest_scatter(self.sight, self.name, self.given, haze)
        error = self.sight.error(errors.haze_change(self.sight, self.name, self.given, haze))
        # The lobe may reach an emitter that no ray looks at, in the place of the mean.
        error = max(error, (self.sight.brightest - 1.0) * share)
        why = f"up to {percent(share)} of an order is scattered by {haze.width_deg:.3g} degrees"
        if self.budget.decide(Effect.HAZE, self.name, error, why, COSTS[Effect.HAZE]):
            found = without(self.simple, Effect.HAZE, self._mean, self._nm[1])
            self.simple = found or self.simple
