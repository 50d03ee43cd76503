# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``check``: one element by every efficiency model that applies, and which of them hold."""

import argparse
import json
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ..core.errors import HoeError
from .efficiency import RIGHT_ANGLE_DEG
from .one_hologram import add_hologram_arguments, hologram_of
from .parser import LIST_HELP, numbers, orders

if TYPE_CHECKING:
    from ..model.check import Report
    from ..model.check.assumptions import Finding
    from ..model.check.shares import ModelShares
    from ..model.hologram import HologramSpec

MOST_RAYS = 500
"""Wavelengths times angles times azimuths; the rigorous model takes up to seconds for each."""

_DESCRIPTION = """\
Evaluate the centre of an element by its own efficiency model and by every other one that applies: a
kinoform by rigorous coupled-wave analysis of the same relief, a volume hologram by both two-wave
and rigorous theory. Printed are the shares of the orders side by side, the energy audit with
A = 1 - R - T over all orders that propagate, the largest differences, the spread between s and p
light, and every assumption of the models as a number with the rule that it is held against. In
scalar models A holds the light of orders that do not propagate. Assumptions that fail are told and
are no error. Without --theta the light is the reference wave, or that on Bragg.
"""


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    parser = subparsers.add_parser(
        "check", help="compare efficiency models and test them", description=_DESCRIPTION
    )
    add_hologram_arguments(parser)
    add = parser.add_argument
    add("--wavelengths", metavar="LIST", type=numbers, help=f"nm, {LIST_HELP}, default recorded")
    add("--theta", metavar="LIST", type=numbers, help="degrees, default that of the reference wave")
    add("--phi", metavar="LIST", type=numbers, help="degrees, default 0 where theta is given")
    add("--from", dest="side", choices=("back", "front"), help="side that the light comes from")
    add("--orders", metavar="A:B", type=orders, help="A:B or a,b,c, default traced ones and -1:1")
    add(
        "--table",
        action="store_true",
        help="make the table that the shader looks up, if it does, for its error; may take minutes",
    )
    add("--json", metavar="FILE", help="write everything here too")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Check a hologram and print what is found.

    Args:
        args: Arguments as registered.

    Returns:
        Exit code.
    """
    from ..files import refuse_own_input, write_text
    from ..model.check import check_hologram
    from ..model.reading import naming
    from .progress import progress_bar

    _refuse_bad_numbers(args)
    spec = hologram_of(args)
    if args.json:
        refuse_own_input(args.json, args.document)
    listed = args.orders or sorted({-1, 0, 1, *spec.orders})
    with naming(args.document):
        lit, why = _light(args, spec)
        with progress_bar("check") as progress:
            report = check_hologram(spec, lit, progress)
    for line in _lines(report, listed, why):
        print(line)
    shader = _shader(spec, make_table=args.table)
    print(f"shader: {shader['words']}")
    if args.json:
        document = report.to_dict(listed) | {"shader": shader}
        write_text(args.json, (json.dumps(document, indent=2, allow_nan=False), "\n"))
    return 0


def _refuse_bad_numbers(args: argparse.Namespace) -> None:
    from ..model import fields

    for wavelength_nm in args.wavelengths or ():
        fields.wavelength_value("--wavelengths", wavelength_nm)
    for theta in args.theta or ():
        if abs(theta) >= RIGHT_ANGLE_DEG:
            raise HoeError(f"--theta: must be between -90 and 90, got {theta!r}")
    counts = (len(values or (0.0,)) for values in (args.wavelengths, args.theta, args.phi))
    rays = 1
    for count in counts:
        rays *= count
    if rays > MOST_RAYS:
        raise HoeError(f"--theta: all lists together must be at most {MOST_RAYS} rays, got {rays}")


def _light(args: argparse.Namespace, spec: "HologramSpec") -> tuple[Any, str]:
    """The light that is asked for, and why it is this light."""
    from ..model.check import light_on, usual_light

    wavelengths = args.wavelengths or [spec.pattern.wavelength_nm]
    usual = usual_light(spec)
    if args.theta is None:
        thetas, phis, from_front, why = [usual.theta_deg], [usual.phi_deg], usual.from_front, ""
        why = f" ({usual.words})"
        if args.side is not None and (args.side == "front") != from_front:
            raise HoeError(f"--from: needs --theta, since {usual.words} comes from the other side")
    else:
        thetas, phis, from_front, why = args.theta, [0.0], args.side == "front", ""
    return light_on(spec, wavelengths, thetas, args.phi or phis, from_front=from_front), why


def _shader(spec: "HologramSpec", *, make_table: bool) -> dict[str, Any]:
    """How the shader gets at the shares; a table that nobody asked for is not made for this."""
    from ..shading.efficiency.form import efficiency_form
    from .progress import progress_bar

    if spec.efficiency.uses_table and not make_table:
        words = "a table; --table makes it and tells its error and size"
        return {"form": "table", "error": None, "worst": None, "words": words}
    with progress_bar("table") as progress:
        found = efficiency_form(spec, progress)
    worst = f", worst seen {found.worst:.1e}" if found.worst > found.error else ""
    words = f"{found.form}, error {found.error:.1e}{worst}, {found.cost}"
    return {"form": found.form, "error": found.error, "worst": found.worst, "words": words}


def _lines(report: "Report", listed: Sequence[int], why: str) -> Iterator[str]:
    """Everything as text."""
    for place in range(len(report.lit.wavelength_nm)):
        yield f"light: {report.lit.words(place)}{why}"
        yield from _table(report, listed, place)
        yield ""
    yield "models:"
    for model in report.models:
        own = " (own)" if model.candidate.own else ""
        yield f"  {model.candidate.name}{own}: {model.candidate.words}"
    for candidate in report.left_out:
        yield f"  {candidate.name}: left out, {candidate.words}"
    for each in report.differences():
        yield (
            f"largest difference: {each.model} {each.other:.5f}, own {each.own:.5f} in "
            f"{_way(each.order, each.side == 'R')}, by {each.size:.5f} at {each.light}"
        )
    for model in report.models:
        yield f"s against p: {model.candidate.name} {_spread(model)}"
    yield "assumptions:"
    yield from (_finding(found) for found in report.findings)
    warnings = report.warnings()
    yield from (f"warning: {line}" for line in warnings)
    if not warnings:
        yield "all rules hold"


def _table(report: "Report", listed: Sequence[int], place: int) -> Iterator[str]:
    """Shares of one ray, a column for each model; three where s and p differ."""
    from ..model.check.report import polarised
    from ..model.check.shares import absorbed

    columns: list[tuple[str, ModelShares, str]] = []
    for model in report.models:
        name = model.candidate.name
        both = [model.of(way)[place] for way in model.ways]
        if all(abs(float(pair[0] - pair[1])) < 1e-12 for pair in both):
            columns.append((name, model, "u"))
        else:
            columns += [(f"{name} {letter}", model, letter) for letter in ("u", "s", "p")]
    yield "".join(("order   ", *(f"{title:>12}" for title, _, _ in columns)))
    for way in report.ways(listed):
        values = (polarised(model.of(way)[place])[letter] for _, model, letter in columns)
        yield _row(_way(*way), values)
    for word, reflected in (("T all", False), ("R all", True)):
        totals = (
            polarised(model.total(reflected=reflected)[place])[letter]
            for _, model, letter in columns
        )
        yield _row(word, totals)
    rests = (polarised(absorbed(model)[place])[letter] for _, model, letter in columns)
    yield _row("A", rests)


def _way(order: int, reflected: bool) -> str:
    side = "R" if reflected else "T"
    return f"{side} {order:+d}" if order else f"{side}  0"


def _row(word: str, values: Iterator[float]) -> str:
    # A sum of shares is good to some 1e-15: what is below the last digit is no negative share.
    return "".join((f"{word:8}", *(f"{round(value, 6) + 0.0:12.6f}" for value in values)))


def _spread(model: "ModelShares") -> str:
    import numpy as np

    apart = np.abs(model.shares[..., 0] - model.shares[..., 1])
    return f"at most {apart.max():.2g}, on the mean {apart.mean():.2g}"


def _finding(found: "Finding") -> str:
    verdict = {True: "holds", False: "FAILS", None: ""}[found.holds]
    rule = f" ({found.rule})" if found.rule else ""
    return (
        f"  {verdict:6}{found.model or 'element'}: {found.name} = {found.value + 0.0:.4g}{rule}: "
        + (found.words)
    )
