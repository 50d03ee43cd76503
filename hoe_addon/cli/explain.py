# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``explain``: which effects a scene calls for, why, and what leaving one out would cost."""

import argparse
import json
import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from ..core.errors import HoeError
from .one_hologram import DOCUMENT_NAME, add_hologram_option, hologram_of, names_device
from .picture_options import add_effects_option, effects_assignment

if TYPE_CHECKING:
    from ..model.effects import Decision, EffectPlan

_WIDTH = 100
_LABELS = ("effect", "hologram", "is", "error", "cost", "why")
_LEAST_WHY = 30

_DESCRIPTION = """\
Tell which effects are simulated in a scene, and why. Rays are walked from the eye backward through
all holograms; an effect is left out where the picture without it differs by less than the promise,
a relative RMS error of luminance that holds for all that is left out together. A hologram by itself
is looked at in daylight from all directions.
Columns: "none" is an effect that the document does not have; error is what leaving the effect out
would cost ("-": it cannot be left out); cost is the predicted time with it over the time without
it; an "!" marks what the user has decided.
"""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "explain",
        help="which effects a scene calls for, and why",
        description=_DESCRIPTION,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add = parser.add_argument
    add("document", metavar=DOCUMENT_NAME, help="a preset, a device, or a hologram")
    add_hologram_option(parser, "default the whole device")
    add("--json", action="store_true", help="print JSON instead of a table")
    add_effects_option(parser)
    add("--promise", metavar="ERROR", type=float, default=None, help="default 0.001")
    add(
        "--set",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        dest="assignments",
        help="change a field of the device first (not of a hologram by itself); may be given more"
        " than once",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Plan a document and print the plan.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..model.effects.plan import PROMISE

    promise = PROMISE if args.promise is None else args.promise
    if not 0.0 <= promise < 1.0:
        raise HoeError(f"--promise: must be at least 0 and below 1, got {promise!r}")
    name, plan = _plan(args, promise)
    if args.json:
        print(json.dumps(_document(name, plan, promise), indent=2, allow_nan=False))
        return 0
    for line in _lines(plan, promise):
        print(line)
    return 0


def _plan(args: argparse.Namespace, promise: float) -> tuple[str, "EffectPlan"]:
    from ..model.document import load_device
    from ..model.effects import plan_effects, plan_hologram
    from ..model.reading import naming

    if args.hologram is not None or not names_device(args.document):
        hologram = hologram_of(args, args.assignments)
        with naming(args.document):
            return hologram.name, plan_hologram(hologram, args.effects or (), promise)
    spec = load_device(args.document, [*args.assignments, *effects_assignment(args)])
    with naming(args.document):
        return spec.name, plan_effects(spec, promise, in_full=True)


def _document(name: str, plan: "EffectPlan", promise: float) -> dict[str, Any]:
    return {
        "document": name,
        "allowed_relative_error": promise,
        "promised_relative_error": plan.promise,
        "decisions": [
            {
                "effect": str(each.effect),
                "hologram": each.hologram,
                "part": each.part,
                "on": each.on,
                "present": each.present,
                "why": each.why,
                "relative_error_without": each.error_without,
                "cost": each.cost,
                "overridden": each.overridden,
            }
            for each in plan.decisions
        ],
    }


def _lines(plan: "EffectPlan", promise: float) -> Iterator[str]:
    """The plan as a table."""
    rows = [_row(each) for each in plan.decisions]
    widths = [max(map(len, column)) for column in zip(_LABELS, *rows, strict=True)]
    indent = sum(widths[:-1]) + 2 * (len(widths) - 1)
    room = max(_WIDTH - indent, _LEAST_WHY)
    for row in (_LABELS, *rows):
        first = "  ".join(text.ljust(width) for text, width in zip(row[:-1], widths, strict=False))
        for number, words in enumerate(textwrap.wrap(row[-1], room) or [""]):
            yield f"{first if number == 0 else ' ' * (indent - 2)}  {words}".rstrip()
    if not any(each.present for each in plan.left_out):
        yield "everything is simulated"
    forced = any(each.overridden and each.present for each in plan.left_out)
    of_plan = " of what is not marked" if forced else ""
    costs = f"all that is left out costs {plan.promise:.2g}"
    yield f"promise: {costs}, at most {promise:g}{of_plan} is allowed"


def _row(each: "Decision") -> tuple[str, ...]:
    error = "-" if each.error_without is None else f"{each.error_without:.1e}"
    if each.error_without == 0.0:
        error = "0"
    state = "on" if each.on else "off" if each.present else "none"
    return (
        f"{each.effect} {each.part}".rstrip(),
        each.hologram or "(scene)",
        f"{state}{'!' if each.overridden else ''}",
        error,
        f"{each.cost:.2f}",
        each.why,
    )
