# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The documentation: JSON blocks are valid, links lead somewhere, labels are the window's."""

import ast
import copy
import json
import re
import runpy
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args

import pytest

from hoe_addon.model.characteristic import CHARACTERISTICS
from hoe_addon.model.document import device_from, hologram_from, preset_titles, to_document
from hoe_addon.model.efficiency import EFFICIENCIES
from hoe_addon.model.scene_parts import ElementSpec
from hoe_addon.model.surface import SURFACES
from hoe_addon.model.waves import WAVES

ROOT = Path(__file__).resolve().parents[2]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
ALL_PAGES = (*PAGES, *sorted((ROOT / "examples").rglob("*.md")))
TUTORIALS = sorted(ROOT.glob("examples/*_tutorial/README.md"))
BLENDERS_OWN = {
    "Add",
    "Edit",
    "Face",
    "File",
    "General",
    "Get Extensions",
    "Grid",
    "Install from Disk",
    "Location",
    "Mesh",
    "New",
    "Preferences",
}
"""Labels in the tutorials that Blender itself has."""
LENS = json.loads((ROOT / "tests" / "documents" / "lens.json").read_text(encoding="utf-8"))
FILES_NEEDED = {"sampled", "table"}
"""Kinds that name a file, which a page does not have."""


ELEMENTS = get_args(ElementSpec.__value__)


def tags(*structs: Any) -> set[str]:
    return {struct.__struct_config__.tag for struct in structs}


def blocks() -> list[Any]:
    found: list[Any] = []
    for page in PAGES:
        for text in re.findall(r"^```json\n(.*?)^```", page.read_text("utf-8"), re.M | re.S):
            part = json.loads(text)
            name = next(part[key] for key in ("kind", "shape", "model", "name") if key in part)
            found.append(pytest.param(part, id=f"{page.stem}-{len(found)}-{name}"))
    return found


def whole_scene(part: dict[str, Any]) -> dict[str, Any]:
    """A scene that holds this element, or the scene itself."""
    if part["kind"] == "scene":
        return part
    preset = json.loads((ROOT / "presets" / "point_lens.json").read_text(encoding="utf-8"))
    preset["elements"].append(part)
    preset["elements"][:-1] = [e for e in preset["elements"][:-1] if e["name"] != part["name"]]
    return preset


def whole(part: dict[str, Any]) -> dict[str, Any]:
    """A hologram that holds this part."""
    document = copy.deepcopy(LENS)
    if part.get("kind") in tags(*WAVES):
        document["recording"]["object"] = part
    elif part.get("kind") in tags(*CHARACTERISTICS):
        document["characteristic"] = part
        del document["recording"]
    elif "model" in part:
        document["efficiency"] = part
        orders = part.get("table", {"T": dict.fromkeys(document["orders"], 0)})
        document["orders"] = sorted({int(order) for side in orders.values() for order in side})
    elif "schema" in part:
        document = part
    else:
        document["surface"] = part
    return document


@pytest.mark.parametrize("part", blocks())
def test_block_is_valid(part: dict[str, Any]) -> None:
    """It is read, and what was read is written as a document that says the same."""
    if part.get("kind") in ("scene", *tags(*ELEMENTS)):
        scene = device_from(whole_scene(part))
        assert device_from(to_document(scene)) == scene
    else:
        hologram = hologram_from(whole(part))
        assert hologram_from(to_document(hologram)) == hologram


def test_every_kind_is_documented() -> None:
    shown = [block.values[0] for block in blocks()]
    kinds = {part.get("kind") for part in shown}
    assert tags(*WAVES, *CHARACTERISTICS) - FILES_NEEDED <= kinds
    shapes = [part.get("shape") for part in shown]
    assert all(shape in shapes for shape in tags(*SURFACES))
    elements = {
        e["kind"] for part in shown for e in (part, *part.get("elements", ())) if "kind" in e
    }
    assert tags(*ELEMENTS) <= elements
    models = {part.get("model") or part.get("efficiency", {}).get("model") for part in shown}
    assert tags(*EFFICIENCIES) - FILES_NEEDED <= models
    page = "".join(path.read_text(encoding="utf-8") for path in PAGES)
    for kind in FILES_NEEDED:
        assert re.search(rf'{{"(kind|model)": "{kind}"', page)


def test_python_of_the_holograms_page_runs() -> None:
    page = (ROOT / "docs" / "holograms.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    code += "\nassert material.hologram.problem == ''\n"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_the_readme_shows_the_short_script() -> None:
    page = (ROOT / "README.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    script = (ROOT / "examples" / "14_script" / "script.py").read_text(encoding="utf-8")
    lines = script.splitlines(keepends=True)
    assert all(line.startswith("# SPDX-") for line in lines[:2])
    assert code == "".join(lines[2:])
    assert code.count("\n") < 20


@pytest.mark.parametrize("page", ALL_PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r'(?:src|href)="([^"]+)"', text)
    missing = [
        link
        for link in links
        if not link.startswith(("http", "#"))
        and not (page.parent / link.partition("#")[0]).exists()
    ]
    assert not missing


@pytest.mark.parametrize("page", ALL_PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_that_are_named_are_there(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"`((?:hoe_addon|tests|osl|presets|examples|docs)/[\w./-]+)`", text)
    assert not [name for name in named if not (ROOT / name).exists()]


def window_labels() -> set[str]:
    """All texts in the code of the window, and the presets, but for initials in capitals."""
    folders = (ROOT / "hoe_addon" / "ui", ROOT / "hoe_addon" / "blender")
    found = {
        node.value
        for folder in folders
        for path in folder.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and isinstance(node.value, str)
    }
    return found | {name.replace("_", " ").title() for name in preset_titles()}


@pytest.mark.parametrize("page", TUTORIALS, ids=lambda page: page.parent.name)
def test_labels_of_the_tutorials_are_those_of_the_window(page: Path) -> None:
    named = re.findall(r"\*\*(.+?)\*\*", page.read_text(encoding="utf-8"), re.S)
    labels = {" ".join(part.split()) for each in named for part in each.split(" > ")}
    assert len(labels) > 2
    assert not labels - window_labels() - BLENDERS_OWN


def test_the_engineers_page_shows_the_commands_that_are_run() -> None:
    folder = ROOT / "examples" / "16_engineer_tutorial"
    page = (folder / "README.md").read_text(encoding="utf-8")
    page = " ".join(page.replace("\\\n", " ").split())
    commands = runpy.run_path(str(folder / "run.py"), run_name="tutorial")["COMMANDS"]
    unseen = [command for command in commands if command not in page]
    # Three more of them only make numbers to compare with.
    assert [command.split()[-1] for command in unseen] == ["green.csv", "table.csv", "model.csv"]


def test_the_gallery_is_up_to_date() -> None:
    gallery = runpy.run_path(str(ROOT / "examples" / "gallery.py"), run_name="gallery")
    assert {entry.preset for entry in gallery["ENTRIES"]} == set(preset_titles())
    folders = {path.parent.name for path in ROOT.glob("examples/*/README.md")}
    assert {*(entry.folder for entry in gallery["ENTRIES"]), *gallery["OTHERS"]} == folders
    page = (ROOT / "examples" / "README.md").read_text(encoding="utf-8")
    assert page == gallery["page"](), "renew it with: python examples/gallery.py"
