# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ``map`` command: what it bakes, what it says, and where the file goes."""

import json
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.cli import main
from hoe_addon.model import map_cache

DOCUMENTS = Path(__file__).parents[1] / "documents"

MIRROR: dict[str, Any] = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [0, 0, 30]},
    "surfaces": [
        {
            "shape": "conic",
            "vertex_mm": [0, 0, 80],
            "normal": [0, 0, 1],
            "radius_mm": -100,
            "conic": -1,
            "semi_diameter_mm": 30,
            "interaction": "reflect",
        }
    ],
}
"""A paraboloid with the source in its focus."""


@pytest.fixture
def document(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(map_cache.FOLDER_VARIABLE, str(tmp_path / "cache"))
    hologram = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    hologram["surface"]["size_mm"] = [20, 20]
    hologram["recording"]["object"] = MIRROR
    path = tmp_path / "mirror.json"
    path.write_text(json.dumps(hologram), encoding="utf-8")
    return path


def test_map_is_reported_kept_and_written(
    document: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["map", str(document), "--out", str(tmp_path / "map.exr")]) == 0
    lines = dict(line.split(": ", 1) for line in capsys.readouterr().out.splitlines())
    assert lines["rays behind optics"] == "4225 of 4225 fitted"
    assert lines["map"] == "32 x 32 texels over 20 x 20 mm"
    assert lines["recorded"].startswith("100.00 %")
    assert float(lines["interpolation error"].split()[0]) < 1e-6
    kept = Path(lines["file"])
    assert kept.parent == tmp_path / "cache"
    assert kept.read_bytes() == (tmp_path / "map.exr").read_bytes()


def test_no_map_for_formulas(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["map", str(DOCUMENTS / "lens.json")]) == 0
    assert "no map is needed" in capsys.readouterr().out


def test_unwritable_cache_of_the_user_is_replaced(
    document: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A folder below a file cannot be made, whoever runs this."""
    (tmp_path / "taken").touch()
    (tmp_path / "temporary").mkdir()
    monkeypatch.delenv(map_cache.FOLDER_VARIABLE)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "taken"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    assert main(["map", str(document)]) == 0
    assert f"file: {tmp_path / 'temporary'}" in capsys.readouterr().out


def test_unwritable_folder_that_was_named_is_told(
    document: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "taken").touch()
    monkeypatch.setenv(map_cache.FOLDER_VARIABLE, str(tmp_path / "taken" / "maps"))
    assert main(["map", str(document)]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_lost_rays_name_the_surface(document: Path, capsys: pytest.CaptureFixture[str]) -> None:
    hologram = json.loads(document.read_text(encoding="utf-8"))
    hologram["recording"]["object"]["source"]["position_mm"] = [0, 0, 200]
    document.write_text(json.dumps(hologram), encoding="utf-8")
    assert main(["map", str(document)]) == 2
    assert "recording.object.surfaces[0]: must " in capsys.readouterr().err
