# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user decides about effects: ``+haze``, ``-levels``, ``window:-levels``, ``all``."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ..field_error import FieldError
from .names import WHOLE_SCENE, Effect

ALL = "all"
"""Turns everything on."""

_ALIASES = {"quantisation": Effect.LEVELS, "quantization": Effect.LEVELS}


@dataclass(frozen=True)
class Overrides:
    """Changes of a plan.

    Attributes:
        everything: Whether all effects are on, whatever the plan finds.
        chosen: Whether an effect is on, by the effect and the name of a hologram; the name
            `WHOLE_SCENE` holds for all that are not named.
    """

    everything: bool
    chosen: dict[tuple[Effect, str], bool]

    def of(self, effect: Effect, hologram: str) -> bool | None:
        """Tell what the user has decided.

        Args:
            effect: The effect.
            hologram: Name of the hologram.

        Returns:
            Whether it is on; None where the plan decides.
        """
        for name in (hologram, WHOLE_SCENE):
            if (effect, name) in self.chosen:
                return self.chosen[effect, name]
        return True if self.everything else None


def read_overrides(texts: Sequence[str], holograms: Iterable[str]) -> Overrides:
    """Read the changes of a document.

    Args:
        texts: As in ``render.effects``; a later one wins.
        holograms: Names of the document's holograms.

    Returns:
        The changes.

    Raises:
        FieldError: A text names no effect, or no hologram.
    """
    names = tuple(holograms)
    everything = False
    chosen: dict[tuple[Effect, str], bool] = {}
    for place, text in enumerate(texts):
        field = f"render.effects[{place}]"
        if text == ALL:
            everything = True
            continue
        name, _, word = text.rpartition(":")
        if name and name not in names:
            rule = f"must name a hologram before the colon ({', '.join(names)})"
            raise FieldError(field, rule, text)
        if word[:1] not in ("+", "-"):
            raise FieldError(field, f"must be {ALL}, or begin with + or -", text)
        chosen[_effect(word[1:], field, text), name] = word[0] == "+"
    return Overrides(everything, chosen)


def _effect(word: str, field: str, text: str) -> Effect:
    if word in _ALIASES:
        return _ALIASES[word]
    if word not in tuple(Effect):
        raise FieldError(field, f"must name an effect ({', '.join(Effect)})", text)
    return Effect(word)
