# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Requests for an error or a time: what is refused, what names mean, what a document keeps."""

import itertools

import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.quality import LONGEST_S, QUALITIES, QualitySpec, requested

PRESET = "grating_rainbow"


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({}, "render.quality.error: must be given, or seconds, or both"),
        ({"error": 0}, "render.quality.error: must be at least 0.0001, got 0"),
        ({"error": -0.1}, "render.quality.error: must be at least 0.0001, got -0.1"),
        ({"error": 11}, "render.quality.error: must be at most 10, got 11"),
        ({"seconds": 0}, "render.quality.seconds: must be at least 0.1, got 0"),
        ({"seconds": 1e7}, "render.quality.seconds: must be at most 1e+06, got 10000000"),
        ({"eror": 0.1}, "render.quality.eror: is not a field here (known: error, seconds)"),
        ("best", "render.quality: must be one of draft, preview, final, reference"),
        (3, "render.quality: must be"),
    ],
)
def test_bad_request_is_named(value: object, message: str) -> None:
    document = to_document(load_device(PRESET))
    document["render"]["quality"] = value
    with pytest.raises(SpecError) as caught:
        device_from(document)
    assert message in str(caught.value)


@pytest.mark.parametrize(
    "value", [None, "draft", {"error": 0.05}, {"seconds": 9}, {"error": 0.05, "seconds": 9}]
)
def test_document_keeps_a_request(value: object) -> None:
    document = to_document(load_device(PRESET))
    document["render"]["quality"] = value
    spec = device_from(document)
    assert device_from(to_document(spec)) == spec


def test_a_document_asks_for_samples_unless_it_says_otherwise() -> None:
    assert load_device(PRESET).render.quality is None


def test_names_are_ever_smaller_errors() -> None:
    assert list(QUALITIES) == ["draft", "preview", "final", "reference"]
    errors = [quality.error for quality in QUALITIES.values()]
    assert all(first is not None for first in errors)
    assert all(first > second for first, second in itertools.pairwise(errors))
    assert requested("final") is QUALITIES["final"]


def test_an_error_alone_ends_after_an_hour() -> None:
    assert QualitySpec(error=0.1).time_limit == LONGEST_S == 3600.0
    assert QualitySpec(error=0.1, seconds=5000.0).time_limit == 5000.0
    assert requested(None) is None
