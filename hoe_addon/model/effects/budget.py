# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The promise of a plan as a budget: what may be left out, and what has been."""

from dataclasses import dataclass, field

from ..field_error import FieldError
from .names import WHOLE_SCENE, Decision, Effect
from .overrides import Overrides


@dataclass(eq=False)
class Budget:
    """Decisions so far, and the error that they may cost.

    Attributes:
        promise: Relative RMS error of luminance that all may cost together.
        overrides: What the user has decided.
        used: Error of all that is left out so far.
        decisions: The decisions.
    """

    promise: float
    overrides: Overrides
    used: float = 0.0
    decisions: list[Decision] = field(default_factory=list[Decision])

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

        Raises:
            FieldError: The user leaves out what can not be left out.
        """
        wanted = self.overrides.of(effect, hologram)
        added = error if more is None else more
        if error is None or added is None:
            if wanted is False and (effect, hologram) in self.overrides.chosen:
                rule = "must not leave out what no simpler document can do without"
                raise FieldError("render.effects", rule, f"-{effect}")
            return False
        if wanted is True or (wanted is None and self.used + added > self.promise):
            return False
        self.used += max(added, 0.0)
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
        decided = self.overrides.of(effect, hologram) is not None and error is not None
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
