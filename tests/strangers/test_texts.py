# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts from strangers: changes of a device, of an effect plan, and formulas in a document."""

import json
import random
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest

from hoe_addon.model.document import load_device, to_document
from hoe_addon.model.effects.holograms import holograms_of
from hoe_addon.model.effects.overrides import read_overrides
from hoe_addon.model.override import override
from hoe_addon.model.reading import naming
from tests.strangers.documents import lens, slots
from tests.strangers.judging import Case, assert_faultless, judge
from tests.strangers.reading import read_document, use_document
from tests.strangers.texts import some_number, some_text
from tests.unit.test_formula_fuzz import some_text as some_formula

PRESETS = ("two_hologram_ar", "holographic_sight", "diffractive_achromat", "point_lens")
FEW, MANY = 200, 3500
WORDS = ("+haze", "-haze", "all", "window:-levels", "-quantisation", "+", "-", ":", "window:", "é")


@cache
def device(name: str) -> dict[str, Any]:
    return to_document(load_device(name))


def some_path(rng: random.Random, document: Any) -> str:
    """A path into a document, or nearly one."""
    steps: list[str] = []
    here = document
    while isinstance(here, dict | list) and here and rng.random() < 0.9:
        key = rng.choice(list(here) if isinstance(here, dict) else range(len(here)))
        steps.append(str(key))
        here = here[key]
    if rng.random() < 0.3:
        odd = rng.choice(("9" * 5000, "-1", "", "0", "__class__", "\u0661", some_text(rng)))
        steps.insert(rng.randrange(len(steps) + 1), odd)
    return ".".join(steps)


def some_value(rng: random.Random, document: Any) -> str:
    kind = rng.randrange(5)
    if kind == 0:
        return some_text(rng)
    if kind == 1:
        return repr(some_number(rng)) if rng.random() < 0.8 else "\udcff"
    if kind == 2:
        words = ("[" * 5000, '{"a": 1, "a": 2}', "NaN", "1e999", '"\\ud800"', '{"error": 0.01}')
        return rng.choice(words)
    holder, key = rng.choice(list(slots(document)))
    return json.dumps(holder[key])


def assignments(seed: int, count: int) -> Iterator[Case]:
    rng = random.Random(seed)
    for _ in range(count):
        name = rng.choice(PRESETS)
        texts = [
            f"{some_path(rng, device(name))}{rng.choice(('=', '=', '=', ' = ', ''))}"
            f"{some_value(rng, device(name))}"
            for _ in range(rng.choice((1, 1, 2)))
        ]

        def read(name: str = name, texts: list[str] = texts) -> object:
            with naming("--set"):
                return use_document(override(device(name), texts))

        yield Case("assignment", read, texts)


def effects(seed: int, count: int) -> Iterator[Case]:
    rng = random.Random(seed)
    spec = load_device("holographic_sight")
    for _ in range(count):
        words = [rng.choice(WORDS) for _ in range(rng.randrange(1, 4))]
        if rng.random() < 0.5:
            words.append(some_text(rng))

        def read(words: list[str] = words) -> object:
            with naming("a.json"):
                return read_overrides(words, holograms_of(spec))

        yield Case("effects", read, words)


def formulas(seed: int, count: int) -> Iterator[Case]:
    """Formulas as characteristic functions, and as numbers that vary over an element."""
    rng = random.Random(seed)
    for _ in range(count):
        document = lens()
        formula = some_formula(rng) if rng.random() < 0.8 else some_text(rng)
        if rng.random() < 0.7:
            constants = {some_text(rng)[:40]: some_number(rng)} if rng.random() < 0.2 else {}
            function = {"kind": "formula", "wavelength_nm": 532, "unit": "waves"}
            document["characteristic"] = function | {"formula": formula, "constants": constants}
            del document["recording"]
        else:
            model = {"model": "kogelnik", "thickness_um": 12, "index": 1.5}
            document["efficiency"] = model | {"modulation": {"formula": formula}}
            document["orders"] = [0, 1]
        text = json.dumps(document)
        yield Case("formula", lambda text=text: read_document(text), formula)


KINDS = {"assignments": assignments, "effects": effects, "formulas": formulas}


@pytest.fixture(scope="module", autouse=True)
def warm() -> None:
    """What is imported or read once for all is there before the interpreter is watched."""
    for name in PRESETS:
        use_document(device(name))
    for case in formulas(0, 40):
        judge([case])


@pytest.mark.parametrize("kind", KINDS)
def test_texts(kind: str) -> None:
    assert_faultless(judge(KINDS[kind](1, FEW)), FEW)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_many_texts(kind: str) -> None:
    assert_faultless(judge(KINDS[kind](2, MANY)), MANY)
