# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands that look at one hologram take it out of a device, with its surface and media."""

import json
from pathlib import Path

import pytest

from hoe_addon.cli import main
from hoe_addon.model.document import load_device, to_document
from hoe_addon.model.effects.holograms import holograms_of

LENS = Path(__file__).resolve().parents[1] / "documents" / "lens.json"
GUIDE = "two_hologram_ar"
RAYS = "x_mm,y_mm,z_mm,l,m,n,wavelength_nm,order,side\n0,0,-1,0,0.1,1,532,1,T\n"

COMMANDS = {
    "check": "check {document} --json out.json",
    "trace": "trace {document} rays.csv --out out.json",
    "efficiency": "efficiency {document} --wavelengths 532 --orders -1:1 --out out.json",
    "bake": "bake {document} --out out.csv --tolerance 0.1 --wavelengths 530:540",
    "map": "map {document}",
    "explain": "explain {document} --json",
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("rays.csv").write_text(RAYS, encoding="utf-8")
    return tmp_path


def results(command: str, capsys: pytest.CaptureFixture[str], folder: Path, *document: str) -> str:
    """What a command prints and writes about a hologram."""
    words = COMMANDS[command].split()
    place = words.index("{document}")
    assert main([*words[:place], *document, *words[place + 1 :]]) == 0
    written = [path.read_text(encoding="utf-8") for path in sorted(folder.glob("out.*"))]
    return "\n".join((capsys.readouterr().out, *written))


@pytest.mark.parametrize("command", COMMANDS)
def test_a_hologram_of_a_device_is_as_if_it_stood_in_a_file(
    command: str, capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    hologram = holograms_of(load_device(GUIDE))["in_coupler"]
    Path("alone.json").write_text(json.dumps(to_document(hologram)), encoding="utf-8")
    taken = results(command, capsys, folder, GUIDE, "--hologram", "in_coupler")
    assert taken == results(command, capsys, folder, "alone.json")


def test_the_only_hologram_is_taken(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    device = Path("hud.json")
    device.write_text(json.dumps(to_document(load_device("hud_combiner"))), encoding="utf-8")
    by_itself = results("efficiency", capsys, folder, str(device))
    assert by_itself == results("efficiency", capsys, folder, "hud_combiner")
    named = results("efficiency", capsys, folder, "hud_combiner", "--hologram", "combiner")
    assert by_itself == named


def test_a_face_of_a_lens_has_a_name(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    named = ("diffractive_achromat", "--hologram", "achromat lens back")
    assert "no map is needed" in results("map", capsys, folder, *named)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([GUIDE], f"{GUIDE}: --hologram: is missing, must be one of in_coupler, out_coupler"),
        (
            [GUIDE, "--hologram", "coupler"],
            f'{GUIDE}: --hologram: must be one of in_coupler, out_coupler, got "coupler"',
        ),
        (
            [str(LENS), "--hologram", "lens"],
            f'{LENS}: --hologram: must be left out for a hologram by itself, got "lens"',
        ),
        (["empty.json"], "empty.json: --hologram: the device holds no hologram"),
    ],
)
def test_mistakes(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    empty = to_document(load_device("hud_combiner")) | {"elements": []}
    (folder / "empty.json").write_text(json.dumps(empty), encoding="utf-8")
    assert main(["map", *arguments]) == 2
    assert capsys.readouterr().err == f"hoe: error: {message}\n"


def test_a_device_is_changed_before_its_hologram_is_taken(
    capsys: pytest.CaptureFixture[str],
) -> None:
    change = "elements.grating.hologram.characteristic.lines_per_mm=5000"
    chosen = ("--hologram", "grating", "--set", change, "--json")
    assert main(["explain", "grating_rainbow", *chosen]) == 0
    decisions = json.loads(capsys.readouterr().out)["decisions"]
    kept = [each["part"] for each in decisions if each["effect"] == "orders" and each["on"]]
    assert kept == ["T0"]
