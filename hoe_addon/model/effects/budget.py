# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The promise of a plan as a budget: what may be left out, and what has been."""

from dataclasses import dataclass, field

from ..field_error import FieldError
from .names import WHOLE_SCENE, Decision, Effect
from .overrides import Overrides

_STAYS = "; cannot be left out"
"""Said of what the user leaves out in vain."""


@dataclass(eq=False)
class Budget:
    """Decisions so far, and the error that they may cost.

    Attributes:
        promise: Relative RMS error of luminance that all may cost together.
        overrides: What the user has decided.
        used: Error of all that the plan has left out so far.
        forced: Error of all that the user has left out so far; it takes nothing from the promise.
        decisions: The decisions.
        unmet: Names of the holograms that no light meets: nothing is decided about them.
    """

    promise: float
    overrides: Overrides
    used: float = 0.0
    forced: float = 0.0
    decisions: list[Decision] = field(default_factory=list[Decision])
    unmet: set[str] = field(default_factory=set[str])

    @property
    def total(self) -> float:
        """Error of all that is left out so far, whoever has decided it."""
        return self.used + self.forced

    def allows(
        self, effect: Effect, hologram: str, error: float | None, more: float | None = None
    ) -> bool:
        """Tell whether an effect may be left out, and count it if so.

        Args:
            effect: The effect.
            hologram: Name of the hologram, or `WHOLE_SCENE`.
            error: Predicted error without it; None where it can not be left out.
            more: What it adds to the error of what is left out already; ``error`` if None.

        Returns:
            True if it is left out.
        """
        wanted = self.overrides.of(effect, hologram)
        added = error if more is None else more
        if error is None or added is None or wanted is True:
            return False
        added = max(added, 0.0)
        if wanted is False:
            self.forced += added
            return True
        if added > 0.0 and self.used + added > self.promise:
            return False
        self.used += added
        return True

    def note(
        self,
        effect: Effect,
        hologram: str,
        *,
        off: bool,
        why: str,
        error: float | None,
        cost: float = 1.0,
        part: str = "",
    ) -> None:
        """Write a decision down.

        Args:
            effect: The effect.
            hologram: Name of the hologram, or `WHOLE_SCENE`.
            off: Whether it is left out.
            why: One sentence.
            error: Predicted error without it; None where it can not be left out.
            cost: Predicted time with it over the time without it, at equal error.
            part: Which order it is about.
        """
        wanted = self.overrides.of(effect, hologram)
        decided = wanted is not None and error is not None
        if wanted is False and not off:
            why += _STAYS
        self.decisions.append(Decision(effect, hologram, not off, why, error, cost, decided, part))

    def decide(
        self,
        effect: Effect,
        hologram: str,
        error: float | None,
        why: str,
        cost: float = 1.0,
        part: str = "",
    ) -> bool:
        """Decide and write down.

        Returns:
            True if the effect is left out.
        """
        off = self.allows(effect, hologram, error)
        self.note(effect, hologram, off=off, why=why, error=error, cost=cost, part=part)
        return off

    def absent(self, effect: Effect, why: str, hologram: str = WHOLE_SCENE) -> None:
        """Write down that there is no such effect, so nothing is lost without it."""
        self.decisions.append(Decision(effect, hologram, False, why, 0.0, present=False))

    def check_followed(self) -> None:
        """Refuse what the user leaves out where all of it had to stay.

        Raises:
            FieldError: Nothing of an effect could be left out.
        """
        for (effect, name), on in self.overrides.chosen.items():
            own = [each for each in self.decisions if self._is_about(each, effect, name)]
            if not on and own and all(each.on for each in own):
                why = own[0].why.removesuffix(_STAYS)
                rule = f"must not leave out what no simpler document can do without ({why})"
                text = f"{name}:-{effect}" if name else f"-{effect}"
                raise FieldError("render.effects", rule, text)

    def _is_about(self, decision: Decision, effect: Effect, name: str) -> bool:
        """Whether what the user leaves out, of one hologram or of all, rules a decision."""
        own = decision.effect == effect and name in (decision.hologram, WHOLE_SCENE)
        there = decision.present and decision.hologram not in self.unmet
        return own and there and self.overrides.of(effect, decision.hologram) is False
