# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files as strangers may send them."""

from pathlib import Path

import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import device_from, find_device, hologram_from, load_hologram
from hoe_addon.model.reading import parse_json, read_text

SMALL = 64


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"a": [1, {"b": NaN}]}', "a[1].b: must be a finite number, got NaN"),
        ('{"a": -Infinity}', "a: must be a finite number, got -Infinity"),
        ('{"a": {"b": 1e999}}', "a.b: must be a finite number, got Infinity"),
        ('{"a": 1' + "0" * 400 + "}", "a: must be a finite number, got 1000"),
        ('{"a": 1' + "0" * 5000 + "}", "holds a number that is not valid"),
        ('{"a": {"b": 1, "c": 2, "b": 3}}', "a.b: stands twice, got 3"),
        ('{"a": "\\ud800"}', 'a: must be valid Unicode, got "\\ud800"'),
        ('{"a": 1', "line 1 column 8: is not valid JSON"),
        ("", "line 1 column 1: is not valid JSON"),
        ("[" * 65 + "]" * 65, "is nested deeper than 64 levels"),
        ("[" * 100_000, "is nested deeper than 64 levels"),
    ],
)
def test_bad_json_is_named(text: str, message: str) -> None:
    with pytest.raises(SpecError) as caught:
        parse_json(text)
    assert str(caught.value).startswith(message)


def test_size_is_limited(tmp_path: Path) -> None:
    path = tmp_path / "big.json"
    path.write_bytes(b" " * (SMALL + 1))
    with pytest.raises(SpecError, match="larger than"):
        read_text(path, SMALL)
    path.write_bytes(b" " * SMALL)
    assert len(read_text(path, SMALL)) == SMALL


def test_a_byte_order_mark_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / "mark.json"
    path.write_bytes(b"\xef\xbb\xbf{}")
    assert read_text(path) == "{}"


def test_other_encodings_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "wide.json"
    path.write_bytes('{"a": 1}'.encode("utf-16"))
    with pytest.raises(SpecError, match="cannot be read: not UTF-8 text at byte 0"):
        read_text(path)


def test_file_is_named_first(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    with pytest.raises(SpecError) as caught:
        load_hologram(path)
    assert str(caught.value) == f"{path}: cannot be read: No such file or directory"
    path.write_text("[]", encoding="utf-8")
    with pytest.raises(SpecError) as caught:
        load_hologram(path)
    assert str(caught.value) == f"{path}: document: must be an object, got []"


@pytest.mark.parametrize("document", [None, 3, "a", [], True])
def test_a_document_is_an_object(document: object) -> None:
    for reader in (hologram_from, device_from):
        with pytest.raises(SpecError, match=r"^document: must be an object"):
            reader(document)


def test_unknown_preset_lists_those_that_exist() -> None:
    with pytest.raises(SpecError, match=r"^nothing: is neither a preset \(.*two_hologram_ar"):
        find_device("nothing")
