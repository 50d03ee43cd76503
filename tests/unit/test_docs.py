# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every JSON block of the documentation is a valid document, or a valid part of one."""

import copy
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args

import pytest

from hoe_addon.model.characteristic import CHARACTERISTICS
from hoe_addon.model.document import device_from, hologram_from, to_document
from hoe_addon.model.efficiency import EFFICIENCIES
from hoe_addon.model.scene_parts import ElementSpec
from hoe_addon.model.surface import SURFACES
from hoe_addon.model.waves import WAVES

ROOT = Path(__file__).resolve().parents[2]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
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
