# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small inputs that ask for much work or memory: refused, or done, within a second."""

import copy
import io
import json
import struct
import zipfile
import zlib
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.json_text import parse_json
from tests.strangers.documents import lens, seeds
from tests.strangers.judging import Case, judge
from tests.strangers.reading import read_document
from tests.strangers.samples import SAMPLES

READERS = {sample.name: sample for sample in SAMPLES}


@pytest.fixture(scope="module", autouse=True)
def warm(tmp_path_factory: pytest.TempPathFactory) -> None:
    """What is imported or read once for all is there before the interpreter is watched."""
    for document in seeds():
        read_document(json.dumps(document))
    folder = tmp_path_factory.mktemp("good")
    for number, sample in enumerate(SAMPLES):
        path = folder / f"{number}{sample.suffix}"
        sample.make(path)
        sample.read(path)


def named(name: str) -> dict[str, Any]:
    return copy.deepcopy(next(document for document in seeds() if document["name"] == name))


def many_holograms() -> str:
    document = named("two_hologram_ar")
    first = document["holograms"][0]
    document["holograms"] = [{**first, "name": f"n{number}"} for number in range(1500)]
    return json.dumps(document)


def many_elements() -> str:
    document = named("holographic_sight")
    block = document["elements"][-1]
    document["elements"] = [{**block, "name": f"n{number}"} for number in range(5000)]
    return json.dumps(document)


def with_field(path: str, value: Any) -> str:
    document = lens()
    *parents, last = path.split(".")
    here = document
    for parent in parents:
        here = here[parent]
    here[last] = value
    return json.dumps(document)


def many_names() -> str:
    names = ",".join(f'"a{number}":0' for number in range(60_000))
    return f'{{{names},"z":1,"z":2}}'


def many_shares() -> str:
    table = {"T": {str(number): 0 for number in range(60_000)}}
    return with_field("efficiency", {"model": "constant", "table": table})


DOCUMENTS: dict[str, Callable[[], str]] = {
    "many names, one doubled": many_names,
    "a list of numbers": lambda: f"[{','.join('0' * 400_000)}]",
    "a list of lists": lambda: f"[{','.join(['[0,1]'] * 100_000)}]",
    "one number that is none at the end": lambda: f"[{','.join(['[0,1]'] * 80_000)},[NaN]]",
    "a deep list": lambda: "[" * 200_000 + "]" * 200_000,
    "deep objects": lambda: '{"a":' * 100_000 + "0" + "}" * 100_000,
    "a number of many digits": lambda: with_field("media.back", 1).replace("1", "1" * 100_000, 1),
    "a long text": lambda: with_field("name", "a" * 2_000_000) + " ",
    "many unknown fields": lambda: json.dumps({f"x{n}": 0 for n in range(60_000)} | lens()),
    "many orders": lambda: with_field("orders", list(range(200_000))),
    "many shares": many_shares,
    "many holograms": many_holograms,
    "many elements": many_elements,
}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_documents(name: str) -> None:
    text = DOCUMENTS[name]()
    assert not judge([Case(name, lambda: read_document(text), text[:100])]).faults


def packed(data: bytes, method: int = zipfile.ZIP_DEFLATED, name: str = "efficiency.npy") -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as archive:
        archive.writestr(name, data)
    return stream.getvalue()


def array(header: str, data: bytes = b"") -> bytes:
    text = header.encode("latin-1")
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text + data


def header(shape: str, kind: str = "<f8") -> str:
    return f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n"


def zeros(count: int) -> bytes:
    stream = io.BytesIO()
    np.save(stream, np.zeros(count))
    return stream.getvalue()


def png(width: int, height: int, data: bytes = b"") -> bytes:
    def chunk(name: bytes, content: bytes) -> bytes:
        check = struct.pack(">I", zlib.crc32(name + content))
        return struct.pack(">I", len(content)) + name + content + check

    start = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
    body = chunk(b"IDAT", zlib.compress(data))
    return b"\x89PNG\r\n\x1a\n" + start + body + chunk(b"IEND", b"")


def text_table() -> bytes:
    lists = "".join(f"{name}  3000000\n1 2 3\n" for name in ("Wavelength", "Order"))
    return lists.encode()


def wide_table() -> bytes:
    rows = [f"{400 + 0.001 * n},{0.001 * n},0,T,0.1" for n in range(3000)]
    return "\n".join(["wavelength_nm,along_deg,order,side,efficiency", *rows]).encode()


FILES: dict[str, tuple[str, Callable[[], bytes]]] = {
    "an archive of zeros": ("table npz", lambda: packed(zeros(4_100_000))),
    "an archive of too many zeros": ("table npz", lambda: packed(zeros(6_000_000))),
    "an archive packed otherwise": ("table npz", lambda: packed(zeros(9), zipfile.ZIP_LZMA)),
    "an archive of archives": ("table npz", lambda: packed(packed(zeros(9)))),
    "a member above the folder": ("table npz", lambda: packed(zeros(9), name="../../x.npy")),
    "a shape beyond memory": ("grid npy", lambda: array(header("(9999999, 9999999)"))),
    "a shape below zero": ("grid npy", lambda: array(header("(-4, -4)"))),
    "a shape that is code": ("grid npy", lambda: array(header("(__import__('os'),)"))),
    "a kind of objects": ("grid npy", lambda: array(header("(4, 4)", "|O"), bytes(128))),
    "a kind that is a structure": (
        "grid npy",
        lambda: array(header("(4, 4)").replace("'<f8'", "[('a', '<f8')]")),
    ),
    "a header of blanks": ("grid npy", lambda: array("{'descr': '<f8' " + " " * 9000)),
    "a header of commas": ("grid npy", lambda: array(header(f"({',' * 9000})"))),
    "a header of brackets": ("heights npy", lambda: array("(" * 9000)),
    "a picture beyond memory": ("picture png", lambda: png(60_000, 60_000)),
    "a large picture of nothing": ("picture png", lambda: png(5000, 5000)),
    "a picture of zeros": ("picture png", lambda: png(1500, 1500, bytes(1500 * 6001))),
    "lists that are not there": ("table text", text_table),
    "a grid with gaps": ("table csv", wide_table),
    "a header of many columns": ("table csv", lambda: b"order," * 300_000 + b"\n1"),
    "a line of many columns": ("grid csv", lambda: b"1," * 500_000),
    "many short lines": ("grid csv", lambda: b"1\n" * 500_000),
    "a cell that does not end": ("rays", lambda: b'x_mm,"' + b"a" * 900_000),
    "many empty lines": ("rays", lambda: b"\n" * 900_000),
    "triangles that are not there": ("mesh stl", lambda: bytes(80) + b"\xff" * 4),
    "a face of many corners": (
        "mesh obj",
        lambda: b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1 2 3" * 100_000,
    ),
    "a number of many digits": ("mesh obj", lambda: b"v 0 0 " + b"9" * 900_000),
    "a corner of many digits": ("mesh obj", lambda: b"v 0 0 0\nf " + b"9" * 900_000 + b" 1 1"),
    "heights without end": ("heights text", lambda: b"0\n" * 400_000),
}


@pytest.mark.parametrize("name", FILES)
def test_files(name: str, tmp_path: Path) -> None:
    kind, make = FILES[name]
    sample = READERS[kind]
    path = tmp_path / f"bomb{sample.suffix}"
    path.write_bytes(make())
    assert not judge([Case(name, partial(sample.read, path), path.read_bytes()[:100])]).faults
    assert [entry.name for entry in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ('{"a": [1, {"b": NaN}]}', "a[1].b: must be a finite number"),
        ('{"a": [[0], [1, 1e999]]}', "a[1][1]: must be a finite number"),
        (f'{{"a": [0, {10**400}]}}', "a[1]: must be a finite number"),
        ('{"a": {"b": ["x", "\\ud800"]}}', "a.b[1]: must be valid Unicode"),
        ('{"a": {"\\udfff": 0}}', "a: must be valid Unicode"),
        ('{"a": [{"b": 1, "b": 2}]}', "a[0].b: stands twice, got 2"),
        ("[" * 65 + "]" * 65, "is nested deeper than 64 levels"),
    ],
)
def test_the_place_of_what_is_no_plain_data(text: str, place: str) -> None:
    with pytest.raises(SpecError) as caught:
        parse_json(text)
    assert str(caught.value).startswith(place)


def test_the_deepest_document_is_read() -> None:
    assert parse_json("[" * 64 + "]" * 64) is not None
