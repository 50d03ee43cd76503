# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents from strangers: a valid spec, or one line that names the field."""

import json
import random
from collections.abc import Iterator

import pytest

from tests.strangers.documents import mutated, seeds, varied, written
from tests.strangers.judging import Case, assert_faultless, judge
from tests.strangers.reading import read_document

GROSS, FINE = 800, 700
MANY = 4000


def gross_cases(seed: int, count: int) -> Iterator[Case]:
    """Documents that were changed in any way, also as texts."""
    rng = random.Random(seed)
    for _ in range(count):
        name, document = mutated(rng)
        text = written(rng, document)
        yield Case(f"{name}: document", lambda text=text: read_document(text), text)


def fine_cases(seed: int, count: int) -> Iterator[Case]:
    """Documents with other numbers and other kinds of parts, of which many are valid."""
    rng = random.Random(seed)
    for _ in range(count):
        name, document = varied(rng)
        text = json.dumps(document)
        yield Case(f"{name}: document", lambda text=text: read_document(text), text)


@pytest.fixture(scope="module", autouse=True)
def warm() -> None:
    """What is imported or read once for all is there before the interpreter is watched."""
    for document in seeds():
        read_document(json.dumps(document))


def test_changed_documents() -> None:
    assert_faultless(judge(gross_cases(1, GROSS)), GROSS)
    assert_faultless(judge(fine_cases(1, FINE)), FINE, 0.1)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 12, 13])
def test_many_changed_documents(seed: int) -> None:
    assert_faultless(judge(gross_cases(seed, MANY)), MANY)
    assert_faultless(judge(fine_cases(seed, MANY)), MANY, 0.1)
