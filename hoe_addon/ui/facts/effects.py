# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan of a scene as lines of text.

A plan takes 0.1 to 2 seconds, so it is made when asked for, beside the window, and kept with the
digest of the document that it holds for. It is told from the digest when it is out of date.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from ...core.errors import HoeError
from ...model.device import DeviceSpec
from ...model.effects import EffectPlan, plan_effects
from ...model.effects.names import WHOLE_SCENE, Decision, Effect
from .device import plan_digest
from .effect_words import LABELS, error_words

WHOLE = "Whole Scene"
"""Heading of the effects that are of no single hologram."""


@dataclass(frozen=True)
class EffectLine:
    """One effect that is there.

    Attributes:
        effect: Its name in documents.
        hologram: Name of the hologram; empty for the whole scene.
        label: Its name for people.
        on: Whether it is simulated.
        overridden: Whether the user has decided, and not the plan.
        error: Relative error of the picture without it, in words.
        can_change: Whether it can be turned on or off by hand.
        why: Sentences, each with its numbers.
    """

    effect: str
    hologram: str
    label: str
    on: bool
    overridden: bool
    error: str
    can_change: bool
    why: tuple[str, ...]


@dataclass(frozen=True)
class PlanFacts:
    """A plan, ready to be shown.

    Attributes:
        digest: Of the document that it holds for.
        lines: The effects that are there, those of the whole scene first.
        summary: What is left out and what it may cost.
        problem: Why there is no plan; empty where there is one.
    """

    digest: str
    lines: tuple[EffectLine, ...] = ()
    summary: str = ""
    problem: str = ""


def plan_facts(spec: DeviceSpec) -> PlanFacts:
    """Plan a document and put the plan into words; needs no Blender.

    Args:
        spec: The document.

    Returns:
        The plan, or why there is none.
    """
    found = plan_digest(spec)
    try:
        plan = plan_effects(spec, in_full=True)
    except HoeError as error:
        return PlanFacts(found, problem=str(error))
    return PlanFacts(found, tuple(_lines(plan)), summary_of(plan))


def _lines(plan: EffectPlan) -> list[EffectLine]:
    present = [each for each in plan.decisions if each.present]
    grouped = groupby(present, key=lambda each: (each.hologram, each.effect))
    found: dict[tuple[str, Effect], list[Decision]] = {}
    for key, some in grouped:
        found.setdefault(key, []).extend(some)
    lines = [_line(decisions) for decisions in found.values()]
    return sorted(lines, key=lambda each: each.hologram != WHOLE_SCENE)


def _line(decisions: Sequence[Decision]) -> EffectLine:
    first = decisions[0]
    errors = [each.error_without for each in decisions if each.error_without is not None]
    off = [each for each in decisions if not each.on]
    on = len(off) < len(decisions)
    return EffectLine(
        effect=str(first.effect),
        hologram=first.hologram,
        label=LABELS[first.effect][0],
        on=on,
        overridden=any(each.overridden for each in decisions),
        error=error_words(max(errors)) if errors else "needed",
        can_change=bool(errors),
        why=tuple(map(_sentence, decisions)),
    )


def _sentence(decision: Decision) -> str:
    """Why, begun with the order that it is about."""
    if not decision.part:
        return decision.why[:1].upper() + decision.why[1:]
    left_out = "" if decision.on else ", left out"
    return f"{decision.part}{left_out}: {decision.why}"


def summary_of(plan: EffectPlan) -> str:
    """Say in one sentence what a plan leaves out, and what that costs.

    Args:
        plan: The plan.

    Returns:
        One sentence.
    """
    out = [each for each in plan.left_out if each.present]
    if not plan.decisions:
        return "Everything is simulated"
    if not out:
        return "Everything that is there is simulated"
    names = dict.fromkeys(LABELS[each.effect][0].lower() for each in out)
    return f"Left out: {', '.join(names)}; predicted error {error_words(plan.promise)}"
