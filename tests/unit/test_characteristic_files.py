# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""V in a file: where its values stand, which files are refused, and whose folder counts."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.characteristic import SampledSpec
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import load_hologram, to_document


def smooth(x: Any, y: Any) -> Any:
    return 0.02 * np.sin(x / 4.0) * np.cos(y / 5.0 + 0.4) + 1e-3 * x


def samples(columns: int = 61, rows: int = 41) -> np.ndarray:
    """Values in mm of V over 20 mm x 12 mm, the first row at the top."""
    x, y = np.meshgrid(np.linspace(-10.0, 10.0, columns), np.linspace(6.0, -6.0, rows))
    return smooth(x, y)


def write(path: Path, values: np.ndarray) -> Path:
    match path.suffix:
        case ".npy":
            np.save(path, values)
        case ".csv":
            path.write_text("\n".join(",".join(map(repr, row)) for row in values.tolist()) + "\n")
        case _:
            rows, columns = values.shape[:2]
            values = values.astype(np.float32).reshape(rows, columns, -1)
            spec = oiio.ImageSpec(columns, rows, values.shape[2], oiio.FLOAT)
            output = oiio.ImageOutput.create(str(path))
            output.open(str(path), spec)
            output.write_image(values)
            output.close()
    return path


def sampled(path: Path, **fields: Any) -> SampledSpec:
    known: dict[str, Any] = {"wavelength_nm": 532.0, "size_mm": (20.0, 12.0), "unit": "mm"}
    return SampledSpec(file=str(path), **{**known, **fields})


@pytest.mark.parametrize("suffix", [".npy", ".csv", ".exr"])
def test_values_stand_where_they_should(
    suffix: str, tmp_path: Path, rng: np.random.Generator
) -> None:
    pattern = pattern_from(sampled(write(tmp_path / f"v{suffix}", samples())))
    x, y = rng.uniform(-10.0, 10.0, 500), rng.uniform(-6.0, 6.0, 500)
    places = np.stack((x, y, 0.0 * x), axis=-1) / 1e3
    # The pitch to the fourth power over the 384 of cubic splines, times the fourth derivative.
    assert np.abs(pattern.function(places) * 1e3 - smooth(x, y)).max() < 2e-8
    slope = 0.005 * np.cos(x / 4.0) * np.cos(y / 5.0 + 0.4) + 1e-3
    assert np.abs(pattern.gradient(places)[:, 0] - slope).max() < 1e-6
    assert np.isnan(pattern.gradient([[10.1e-3, 0.0, 0.0], [0.0, 6.1e-3, 0.0]])).all()
    assert np.isfinite(pattern.gradient([[10e-3, 6e-3, 0.0], [-10e-3, -6e-3, 0.0]])).all()


def test_a_file_that_changed_is_read_again(tmp_path: Path) -> None:
    path = write(tmp_path / "v.npy", samples())
    spec = sampled(path)
    before = pattern_from(spec).function((1e-3, 0.0, 0.0))
    write(path, 2.0 * samples(60, 40))
    assert pattern_from(spec).function((1e-3, 0.0, 0.0)) == pytest.approx(2.0 * before, rel=1e-4)
    path.unlink()
    with pytest.raises(SpecError, match=r"file: must be a file that exists \(No such file"):
        pattern_from(spec)


def text(path: Path, content: str) -> Path:
    path.write_text(content)
    return path


def data(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


def with_nan() -> np.ndarray:
    values = samples()
    values[3, 5] = np.nan
    return values


class _Harm:
    """Whoever unpickles it writes a file."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> Any:
        return (Path.touch, (self.path,))


MISTAKES: dict[str, tuple[Any, str]] = {
    "missing": (lambda at: at / "none.npy", "must be a file that exists (No such file"),
    "a folder": (lambda at: (at / "v.npy").mkdir() or at / "v.npy", "must be a file"),
    "nul": (lambda at: at / "a\0.npy", "must be a file that exists ("),
    "suffix": (lambda at: text(at / "v.png", ""), "must end in .csv, .exr, .npy"),
    "few": (lambda at: write(at / "v.npy", np.zeros((3, 9))), "must hold 4 to 8192 rows and"),
    "many": (lambda at: write(at / "v.npy", np.zeros((4, 8193))), "not 4 rows of 8193"),
    "flat": (lambda at: write(at / "v.npy", np.zeros(16)), "must have two dimensions"),
    "complex": (lambda at: write(at / "v.npy", np.zeros((4, 4), complex)), "must hold real num"),
    "nan": (
        lambda at: write(at / "v.npy", with_nan()),
        "must hold finite numbers up to 1e+12, not nan in row 4, column 6",
    ),
    "nan exr": (lambda at: write(at / "v.exr", with_nan()), "not nan in row 4, column 6"),
    "nan csv": (lambda at: write(at / "v.csv", with_nan()), "not nan in row 4, column 6"),
    "rgb": (lambda at: write(at / "v.exr", np.zeros((8, 8, 3))), "must have one channel, not 3"),
    "small exr": (lambda at: write(at / "v.exr", np.zeros((2, 8))), "not 2 rows of 8"),
    "no npy": (lambda at: text(at / "v.npy", "hello, world"), "is no readable .npy file ("),
    "empty npy": (lambda at: text(at / "v.npy", ""), "is no readable .npy file ("),
    "cut npy": (
        lambda at: data(at / "v.npy", write(at / "w.npy", samples()).read_bytes()[:5000]),
        "is no readable .npy file (",
    ),
    "no exr": (lambda at: text(at / "v.exr", "hello, world"), "is no readable .exr file ("),
    "cut exr": (
        lambda at: data(at / "v.exr", write(at / "w.exr", samples()).read_bytes()[:700]),
        "is no readable .exr file (",
    ),
    "ragged": (
        lambda at: text(at / "v.csv", "1,2,3,4\n" * 4 + "1,2,3\n"),
        "must hold 4 numbers a row, not 3 in row 5",
    ),
    "words": (
        lambda at: text(at / "v.csv", "1,2,3,4\n" * 4 + "1,2,x\x07,4\n"),
        "must hold numbers, not 'x\\x07' in row 5, column 3",
    ),
    "binary csv": (lambda at: data(at / "v.csv", b"\xff\xfe\x00"), "cannot be read: not UTF-8"),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_bad_files_are_refused(case: str, tmp_path: Path) -> None:
    make, message = MISTAKES[case]
    with pytest.raises(SpecError) as caught:
        sampled(make(tmp_path))
    assert str(caught.value).startswith("file: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_pickle_is_not_opened(tmp_path: Path) -> None:
    harm = tmp_path / "harm"
    np.save(tmp_path / "v.npy", np.full((4, 4), _Harm(harm), dtype=object), allow_pickle=True)
    with pytest.raises(SpecError, match="is no readable"):
        sampled(tmp_path / "v.npy")
    assert not harm.exists()


def test_sizes_are_checked() -> None:
    with pytest.raises(SpecError, match=r"size_mm\[1\]: must be above 0"):
        sampled(Path("v.npy"), size_mm=(1.0, 0.0))


def test_a_relative_file_is_beside_the_document(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "sub").mkdir()
    write(tmp_path / "sub" / "v.npy", samples())
    document = {
        "schema": 1,
        "name": "sampled",
        "surface": {"shape": "plane", "size_mm": [20, 12]},
        "media": {},
        "characteristic": {
            "kind": "sampled",
            "wavelength_nm": 532,
            "file": "sub/v.npy",
            "size_mm": [20, 12],
            "unit": "mm",
        },
        "efficiency": {"model": "constant", "table": {"T": {"1": 1.0}}},
    }
    (tmp_path / "hologram.json").write_text(json.dumps(document))
    spec = load_hologram(tmp_path / "hologram.json")
    assert to_document(spec)["characteristic"]["file"] == str(tmp_path / "sub" / "v.npy")
    monkeypatch.chdir(tmp_path)
    assert load_hologram("hologram.json") == spec
    document["characteristic"]["file"] = "v.npy"
    (tmp_path / "hologram.json").write_text(json.dumps(document))
    with pytest.raises(SpecError) as caught:
        load_hologram(tmp_path / "hologram.json")
    assert "hologram.json: characteristic.file: must be a file that exists" in str(caught.value)
