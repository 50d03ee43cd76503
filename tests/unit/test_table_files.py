# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of tables: what is written reads back, and what is wrong is named."""

import json
import os
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
import pytest

from hoe_addon.cli import main
from hoe_addon.core.efficiency.table import EfficiencyTable
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from, load_hologram, to_document
from hoe_addon.model.tables.exr_file import WIDTH
from hoe_addon.model.tables.file import SUFFIXES, read_table, write_table

DOCUMENTS = Path(__file__).parents[1] / "documents"
UNITS = 1e-15
"""Lengths go through nm and mm: one rounding each way."""
ANGLES = 1e-14
"""Cosines go through degrees."""
FLOAT32 = 1e-7
LONGEST_S = 1.0
BRANCHES = (Branch(0), Branch(-2), Branch(1, reflected=True))


def sample(rng: np.random.Generator, **changes: Any) -> EfficiencyTable:
    parts: dict[str, Any] = {
        "branches": BRANCHES,
        "wavelength": np.array([400e-9, 532.1e-9, 700e-9]),
        "along": np.array([-0.6, -0.1, 0.0, 0.8]),
        "across": np.array([-0.5, 0.4]),
        "x": np.zeros(1),
        "y": np.array([-1e-3, 2e-3]),
        "sides": ("back", "front"),
        "beyond": "clamp",
    }
    parts |= changes
    axes = ("wavelength", "along", "across", "x", "y")
    shape = (len(parts["sides"]), *(len(parts[name]) for name in axes), len(parts["branches"]))
    return EfficiencyTable(values=rng.random(shape) / shape[-1], **parts)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"sides": ("front",), "x": np.array([-1e-3, 0.0, 5e-3])},
        {"branches": (*BRANCHES, Branch(1, frequency=1.25))},
        {"along": np.zeros(1), "across": np.zeros(1), "y": np.zeros(1)},
    ],
    ids=["both", "front", "multiplexed", "classical"],
)
def test_round_trip(
    tmp_path: Path, rng: np.random.Generator, suffix: str, changes: dict[str, Any]
) -> None:
    table = sample(rng, **changes)
    path = tmp_path / f"table{suffix}"
    write_table(path, table)
    read = read_table(str(path))
    assert read.branches == table.branches
    assert read.sides == table.sides
    for found, given, slack in zip(
        read.axes, table.axes, (UNITS, ANGLES, ANGLES, UNITS, UNITS), strict=True
    ):
        assert found == pytest.approx(given, rel=slack, abs=slack)
    assert read.values == pytest.approx(table.values, abs=FLOAT32 if suffix == ".exr" else 0.0)
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("suffix", [".npz", ".txt", ".exr"])
def test_the_rule_beyond_the_nodes_is_kept(
    tmp_path: Path, rng: np.random.Generator, suffix: str
) -> None:
    path = tmp_path / f"table{suffix}"
    write_table(path, sample(rng, beyond="zero"))
    assert read_table(str(path)).beyond == "zero"


def test_layout_of_the_exr(tmp_path: Path, rng: np.random.Generator) -> None:
    table = sample(rng, y=np.linspace(-1e-3, 1e-3, 40))
    path = tmp_path / "table.exr"
    write_table(path, table)
    picture = oiio.ImageBuf(str(path))
    assert (picture.spec().width, picture.spec().nchannels) == (WIDTH, 3)
    texels = np.asarray(picture.get_pixels(oiio.FLOAT)).reshape(-1)
    flat = table.values.ravel()
    assert texels[: flat.size] == pytest.approx(flat, abs=FLOAT32)
    assert (texels[: flat.size] <= flat).all()
    assert not texels[flat.size :].any()


def write_csv(path: Path, rows: list[str], header: str | None = None) -> str:
    head = header or "wavelength_nm,along_deg,incidence,order,side,efficiency"
    path.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    return str(path)


GOOD = [
    f"{wavelength},{angle},{incidence},{order},T,0.{1 + order}"
    for wavelength in (450, 550)
    for angle in (-20, 0, 30)
    for incidence in ("back", "front")
    for order in (0, 1)
]


def test_csv_in_any_order_of_rows_and_columns(tmp_path: Path) -> None:
    first = read_table(write_csv(tmp_path / "a.csv", GOOD))
    assert first.values.shape == (2, 2, 3, 1, 1, 1, 2)
    assert first.along == pytest.approx(np.sin(np.radians([-20.0, 0.0, 30.0])), abs=ANGLES)
    assert (first.values[..., 1] == 0.2).all()
    turned = [",".join(row.split(",")[::-1]) for row in GOOD[::-1]]
    header = "efficiency,side,order,incidence,along_deg,wavelength_nm"
    second = read_table(write_csv(tmp_path / "b.csv", turned, header))
    assert second.branches == first.branches[::-1]
    assert np.array_equal(second.values, first.values[..., ::-1])


def changed(place: int, row: str) -> list[str]:
    return [*GOOD[:place], row, *GOOD[place + 1 :]]


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (GOOD[:-1], "efficiency: must have a number at every node, got nan at incidence front, "
                    "wavelength_nm 550, along_deg 30, order 1 T"),
        (changed(3, "450,-20,front,1,T,nan"), "efficiency: must be finite, got nan in row 5"),
        (changed(3, "450,-20,front,1,T,-0.2"), "efficiency: must be at least 0, got -0.2 in row 5"),
        (changed(3, "450,-20,front,1,T,20"),
         r"efficiency: must be at most 1 \(shares, no percent\), got 20 at incidence front"),
        (changed(3, "450,-20,front,1,T,0.95"),
         "efficiency: shares of one direction must sum to at most 1, got 1.05 at incidence front"),
        (changed(3, "450,-20,front,1,T,a"), "efficiency: must be a number, got 'a' in row 5"),
        (changed(3, "450,-20,front,1,T"), "must hold 6 columns, got 5 in row 5"),
        (changed(3, "450,-20,top,1,T,0.1"), "incidence: must be back or front, got 'top' in row 5"),
        (changed(3, "450,-20,front,1,X,0.1"), "side: must be T or R, got 'X' in row 5"),
        (changed(3, "450,-20,front,1.5,T,0.1"), "order: must be a whole number, got '1.5' in row"),
        (changed(3, "450,-20,front,101,T,0.1"), "order: must be .* 100, got 101 in row 5"),
        (changed(3, "450,-20.5,front,1,T,0.1"), "efficiency: must have a number at every node"),
        ([*GOOD, "450,-20,back,0,T,0.3"],
         "efficiency: a node stands twice with different shares, got 0.1 in row 2"),
        ([row.replace("450", "0.45").replace("550", "0.55") for row in GOOD],
         "wavelength_nm: must be in nm, got 0.45, which looks like um"),
        ([row.replace("450", "450e-9").replace("550", "550e-9") for row in GOOD],
         "wavelength_nm: must be in nm, got 4.5e-07, which looks like metres"),
        ([row.replace(",30,", ",95,") for row in GOOD],
         "along_deg: must be from -90 to 90 degrees, got 95 in row 10"),
        ([], "rows: must be 1 to"),
    ],
)  # fmt: skip
def test_bad_csv(tmp_path: Path, rows: list[str], message: str) -> None:
    with pytest.raises(SpecError, match=message):
        read_table(write_csv(tmp_path / "a.csv", rows))


@pytest.mark.parametrize(
    ("header", "message"),
    [
        ("wavelength,order,side,efficiency", "header: must name each column once, .* 'wavelength'"),
        ("order,order,side,efficiency", "header: must name each column once, .* got 'order'"),
        ("wavelength_nm,order,efficiency", "header: side is missing"),
        ("theta_deg,order,side,efficiency", "header: directions must be along_deg and across_deg"),
    ],
)
def test_bad_header(tmp_path: Path, header: str, message: str) -> None:
    with pytest.raises(SpecError, match=message):
        read_table(write_csv(tmp_path / "a.csv", ["0,0,0,0"], header))


def test_an_empty_file(tmp_path: Path) -> None:
    for name, text in (("a.csv", ""), ("b.csv", "\n\n"), ("a.npz", ""), ("a.txt", "")):
        (tmp_path / name).write_text(text, encoding="utf-8")
        with pytest.raises(SpecError, match=r"^is empty$"):
            read_table(str(tmp_path / name))


def test_corners_beyond_grazing_may_be_left_out(tmp_path: Path) -> None:
    header = "along_deg,across_deg,order,side,efficiency"
    rows = [
        f"{along},{across},0,T,{0.001 * (90 + across)}"
        for along in (-60, 0, 60)
        for across in (-60, 0, 60)
        if along == 0 or across == 0
    ]
    table = read_table(write_csv(tmp_path / "a.csv", rows, header))
    assert table.values[0, 0, :, :, 0, 0, 0] == pytest.approx(
        np.array([[0.09, 0.09, 0.09], [0.03, 0.09, 0.15], [0.09, 0.09, 0.09]])
    )


def hologram(folder: Path, **efficiency: Any) -> Path:
    document = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    given = {name: part for name, part in document.items() if name != "orders"}
    path = folder / "hologram.json"
    path.write_text(json.dumps(given | {"efficiency": efficiency}), encoding="utf-8")
    return path


def test_the_csv_of_the_command_efficiency(tmp_path: Path) -> None:
    out = tmp_path / "out.csv"
    base = ["efficiency", str(DOCUMENTS / "lens.json"), "--wavelengths", "450,550", "--orders=0:2"]
    assert main([*base, "--theta=-40:40:20", "--phi=0,180", "--out", str(out)]) == 0
    table = read_table(str(out))
    assert table.sides == ("back",)
    angles = np.sin(np.radians([-40.0, -20.0, 0.0, 20.0, 40.0]))
    assert table.along == pytest.approx(angles, abs=ANGLES)
    assert table.values.shape == (1, 2, 5, 1, 1, 1, 6)
    assert main([*base, "--theta=10,20", "--phi=0,30", "--out", str(out)]) == 0
    with pytest.raises(SpecError, match=r"phi_deg: must be 0 or 180, .* got 30 in row"):
        read_table(str(out))


TEXT = """\
# made by hand
Source  Measured
Symmetry  Asymmetrical
SpectralContent  Spectral
ScatterType  2
BTDF BRDF
Order  2
1 1
Wavelength  2
450 550
AngleOfIncidence  2
-10 10
DataBegin back 450
0.5 0.1
0.4 0.2
DataEnd
DataBegin back 550
0.3 0.1

0.2 0.2
DataEnd
"""


def read_text(folder: Path, text: str) -> EfficiencyTable:
    path = folder / "table.bsdf"
    path.write_text(text, encoding="utf-8")
    return read_table(str(path))


def test_text_by_hand(tmp_path: Path) -> None:
    table = read_text(tmp_path, TEXT)
    assert table.branches == (Branch(1), Branch(1, reflected=True))
    assert table.sides == ("back",)
    assert table.values[0, :, :, 0, 0, 0].tolist() == [[[0.5, 0.1], [0.4, 0.2]],
                                                       [[0.3, 0.1], [0.2, 0.2]]]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("450 550\n", "550 450\n", "Wavelength: must increase, got 450 after 550 in entry 2"),
        ("-10 10\n", "10 10\n", "AngleOfIncidence: must increase, got 10 after 10 in entry 2"),
        ("0.3 0.1\n", "0.3\n", "line 18: must hold 2 numbers, one an order, in each of 2 lines"),
        ("0.3 0.1\n", "0.3 x\n", "line 18: must be a number, got 'x'"),
        ("0.3 0.1\n", "0.3 0.8\n", "sum to at most 1, got 1.1 at incidence back, Wavelength 550"),
        ("DataBegin back 550", "DataBegin back 540", "line 17: must be DataBegin back 550.0, got"),
        ("0.4 0.2\nDataEnd\n", "DataEnd\n", "line 15: must hold 2 numbers, .* got 'DataEnd'"),
        ("Order  2\n1 1", "Order  3\n1 1", "Order: must have 3 entries, got 2 in line 8"),
        ("BTDF BRDF", "BTDF BSDF", "ScatterType: must be BTDF or BRDF, got 'BSDF'"),
        ("Asymmetrical", "PlaneSymmetrical", "Symmetry: must be one of Asymmetrical, got"),
        ("Source  Measured", "Origin  Measured", "line 2: must be a keyword and one value"),
        ("Source  Measured", "Wavelength  1\n5", "Wavelength: stands twice, in line 10"),
        ("Order  2\n1 1\n", "", "Order: is missing"),
    ],
)
def test_bad_text(tmp_path: Path, old: str, new: str, message: str) -> None:
    assert TEXT.count(old)
    with pytest.raises(SpecError, match=message):
        read_text(tmp_path, TEXT.replace(old, new, 1))


def test_text_with_too_much_or_too_little(tmp_path: Path) -> None:
    with pytest.raises(SpecError, match="Data: must end after 2 blocks, got more in line 22"):
        read_text(tmp_path, TEXT + "DataBegin back 650\n")
    with pytest.raises(SpecError, match="DataEnd: is missing at the end of the file"):
        read_text(tmp_path, TEXT.removesuffix("DataEnd\n"))
    many = " ".join(str(0.01 * number + 1.0) for number in range(3000))
    huge = TEXT.replace("AngleOfIncidence  2\n-10 10", f"AngleOfIncidence 3000\n{many}")
    many = " ".join(str(number + 400) for number in range(3000))
    wide = huge.replace("Wavelength  2\n450 550", f"Wavelength 3000\n{many}")
    with pytest.raises(SpecError, match="Data: must be at most 4000000 numbers"):
        read_text(tmp_path, wide)


def arrays() -> dict[str, Any]:
    return {
        "wavelength_nm": np.array([450.0, 550.0]),
        "order": np.array([0, 1]),
        "side": np.array(["T", "T"]),
        "efficiency": np.full((1, 2, 1, 1, 1, 1, 2), 0.2),
    }


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"order": np.array([0, None])}, "is no readable .npz file|must hold numbers or words"),
        ({"order": np.array([0.0, 1.0])}, "order: must hold whole numbers, not float64"),
        ({"side": np.array(["T"])}, "side, frequency: must have 2 entries, like order"),
        ({"efficiency": np.zeros((2, 2))}, "efficiency: must have 7 dimensions"),
        ({"efficiency": np.zeros((1, 2, 1, 1, 1, 1, 3))}, "efficiency: must have the shape"),
        ({"wavelength_nm": np.array([550.0, 450.0])}, "wavelength_nm: must increase, got 450"),
        ({"schema": np.array(2)}, "schema: must be 1"),
        ({"beyond": np.array("wrap")}, "beyond: must be clamp or zero"),
        ({"colour": np.zeros(1)}, "holds an array that is not known"),
        ({"frequency": np.array([1.0, np.nan])}, "frequency: must be finite and not 0, got nan in"),
        (
            {"incidence": np.array(["left"])},
            "incidence: must be back or front, got 'left' in entry",
        ),
    ],
)
def test_bad_npz(tmp_path: Path, changes: dict[str, Any], message: str) -> None:
    path = tmp_path / "table.npz"
    np.savez(path, **(arrays() | changes))
    with pytest.raises(SpecError, match=message):
        read_table(str(path))


def test_npz_without_what_may_be_left_out(tmp_path: Path) -> None:
    path = tmp_path / "table.npz"
    np.savez(path, **arrays())
    table = read_table(str(path))
    assert table.sides == ("back",)
    assert table.values.shape == (1, 2, 1, 1, 1, 1, 2)


def damaged(data: bytes, rng: np.random.Generator, kind: int) -> bytes:
    broken = bytearray(data)
    if kind == 0:
        return bytes(broken[: rng.integers(len(broken))])
    if kind == 1:
        for place in rng.integers(len(broken), size=rng.integers(1, 20)):
            broken[place] = rng.integers(256)
        return bytes(broken)
    start, length = rng.integers(len(broken)), rng.integers(1, 60)
    del broken[start : start + length]
    return bytes(broken)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_damaged_files_are_read_or_refused(
    tmp_path: Path, rng: np.random.Generator, suffix: str
) -> None:
    path = tmp_path / f"table{suffix}"
    write_table(path, sample(rng))
    data = path.read_bytes()
    refused = 0
    for turn in range(100):
        path.write_bytes(damaged(data, rng, turn % 3))
        os.utime(path, ns=(turn, turn))
        start = perf_counter()
        try:
            read_table(str(path))
        except SpecError as error:
            refused += 1
            assert "\n" not in str(error)
        assert perf_counter() - start < LONGEST_S
    assert refused > 50


def test_a_changed_file_is_read_again(tmp_path: Path, rng: np.random.Generator) -> None:
    path = tmp_path / "table.npz"
    write_table(path, sample(rng))
    first = read_table(str(path))
    assert read_table(str(path)) is first
    write_table(path, sample(rng, sides=("front",)))
    os.utime(path, ns=(1, 1))
    assert read_table(str(path)).sides == ("front",)


def test_other_files(tmp_path: Path, rng: np.random.Generator) -> None:
    with pytest.raises(SpecError, match="must be a file that exists"):
        read_table(str(tmp_path / "no.npz"))
    with pytest.raises(SpecError, match=r"must end in .npz, .csv, .txt, .bsdf, .exr"):
        read_table(str(tmp_path / "no.json"))
    (tmp_path / "folder.npz").mkdir()
    with pytest.raises(SpecError, match="must be a file"):
        read_table(str(tmp_path / "folder.npz"))


def test_the_model_of_a_document(tmp_path: Path, rng: np.random.Generator) -> None:
    write_table(tmp_path / "table.npz", sample(rng))
    spec = load_hologram(hologram(tmp_path, model="table", file="table.npz", beyond="zero"))
    assert spec.orders == (-2, 0, 1)
    assert spec.efficiency.branches((1, 0, -2), 532.0) == (
        Branch(0),
        Branch(-2),
        Branch(1, reflected=True),
    )
    model = spec.efficiency.model()
    assert isinstance(model, EfficiencyTable)
    assert model.beyond == "zero"
    assert hologram_from(to_document(spec)) == spec


def test_mistakes_of_a_document_name_the_field(tmp_path: Path, rng: np.random.Generator) -> None:
    with pytest.raises(
        SpecError, match=r"hologram.json: efficiency.file: must be a file that exis"
    ):
        load_hologram(hologram(tmp_path, model="table", file="table.npz"))
    (tmp_path / "table.npz").write_bytes(b"PK")
    with pytest.raises(SpecError, match=r"efficiency.file: is no readable .npz file"):
        load_hologram(hologram(tmp_path, model="table", file="table.npz"))
    write_csv(tmp_path / "table.csv", changed(3, "450,-20,front,1,T,20"))
    with pytest.raises(SpecError, match="at incidence front, wavelength_nm 450") as caught:
        load_hologram(hologram(tmp_path, model="table", file="table.csv"))
    assert str(caught.value).count("got") == 1
    write_table(tmp_path / "table.npz", sample(rng))
    with pytest.raises(SpecError, match=r"efficiency.beyond: must be one of clamp, zero"):
        load_hologram(hologram(tmp_path, model="table", file="table.npz", beyond="wrap"))


@pytest.mark.parametrize(("azimuth_deg", "fits"), [(0.0, True), (180.0, False), (30.0, False)])
def test_angles_of_the_element_fit_a_grating_along_its_x_only(
    tmp_path: Path, azimuth_deg: float, fits: bool
) -> None:
    """Else +theta and -theta would change places without a word."""
    path = tmp_path / "t.csv"
    path.write_text("theta_deg,phi_deg,order,side,efficiency\n-5,0,1,T,0.3\n5,0,1,T,0.5\n")
    grating = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 600}
    document = {
        "schema": 1,
        "name": "element",
        "surface": {"shape": "plane", "size_mm": [1, 1]},
        "media": {},
        "characteristic": grating | {"azimuth_deg": azimuth_deg},
        "efficiency": {"model": "table", "file": str(path)},
    }
    if fits:
        assert hologram_from(document).orders == (1,)
        return
    with pytest.raises(SpecError, match=r"efficiency\.file: must tell along_deg"):
        hologram_from(document)
