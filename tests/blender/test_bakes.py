# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms that need a table or a map: a window waits for neither."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender.props.made import is_stale
from hoe_addon.blender.props.sync import catch_up, hologram_node, read_spec, refresh
from hoe_addon.blender.shaders.maps import map_image
from hoe_addon.blender.shaders.tables import prepare_table
from hoe_addon.core.errors import NotMadeError
from hoe_addon.model.document import hologram_from, to_document

type Make = Callable[..., Any]

SHARES = {
    "model": "constant",
    "table": {"T": {"0": 0.6, "1": 0.3}},
    "lookup": {"form": "table", "tolerance": 0.01},
}
NEEDS_TABLE = "efficiency: needs its table, which may take minutes; press Bake"
NEEDS_MAP = "recording: needs its map, which takes some seconds; press Bake"
PARABOLOID = {
    "source": {"kind": "point", "position_mm": [0, 0, 30]},
    "surfaces": [
        {
            "shape": "conic",
            "vertex_mm": [0, 0, 80],
            "radius_mm": -100,
            "conic": -1,
            "semi_diameter_mm": 60,
            "interaction": "reflect",
        }
    ],
}


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "cache"
    folder.mkdir()
    monkeypatch.setenv("HOE_CACHE_DIR", str(folder))
    return folder


@pytest.fixture
def asking(make_material: Make, lens: dict[str, Any]) -> Any:
    """A hologram whose properties ask for a table that its shader does not have yet."""
    material = make_material(lens | {"orders": [0, 1]})
    spec = hologram_from(lens | {"orders": [0, 1], "efficiency": SHARES})
    material.hologram.efficiency.from_document(to_document(spec)["efficiency"], "efficiency")
    return material


def files(folder: Path) -> list[str]:
    return sorted(path.suffix for path in folder.iterdir())


def test_a_table_is_asked_for_and_the_last_shader_stays(asking: Any, cache: Path) -> None:
    before = hologram_node(asking).script.name
    with pytest.raises(NotMadeError, match=NEEDS_TABLE):
        refresh(asking, make=False)
    assert asking.hologram.problem == NEEDS_TABLE
    assert asking.hologram.needs_bake
    assert hologram_node(asking).script.name == before
    assert files(cache) == []


def test_baked_elsewhere_the_table_is_taken(asking: Any, cache: Path) -> None:
    """As a job does it: another process fills the cache."""
    with pytest.raises(NotMadeError):
        refresh(asking, make=False)
    prepare_table(read_spec(asking))
    assert files(cache) == [".exr"]
    assert refresh(asking, make=False)
    assert asking.hologram.problem == ""
    assert not asking.hologram.needs_bake
    assert not is_stale(asking)


def test_a_script_makes_what_is_needed(asking: Any, cache: Path) -> None:
    assert refresh(asking)
    assert files(cache) == [".exr"]
    assert asking.hologram.problem == ""


def test_a_deleted_table_is_told_and_the_shader_stays(asking: Any, cache: Path) -> None:
    refresh(asking)
    before = hologram_node(asking).script.name
    (file,) = cache.iterdir()
    file.unlink()
    asking.hologram.recording.wavelength_nm = 600.0
    with pytest.raises(NotMadeError):
        refresh(asking, make=False)
    assert asking.hologram.problem == NEEDS_TABLE
    assert hologram_node(asking).script.name == before


def test_opening_a_file_makes_no_table(asking: Any, cache: Path, tmp_path: Path) -> None:
    asking.use_fake_user = True
    path = str(tmp_path / "asking.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    (material,) = (each for each in bpy.data.materials if each.hologram.enabled)
    assert material.hologram.problem == NEEDS_TABLE
    assert files(cache) == []


def behind_a_mirror(material: Any) -> None:
    wave = material.hologram.recording.object
    wave.details, wave.kind = json.dumps(PARABOLOID), "system"


def test_a_map_is_asked_for(make_material: Make, lens: dict[str, Any], cache: Path) -> None:
    material = make_material(lens)
    behind_a_mirror(material)
    with pytest.raises(NotMadeError, match=NEEDS_MAP):
        refresh(material, make=False)
    assert material.hologram.needs_bake
    assert map_image(material) is None
    assert refresh(material)
    assert not material.hologram.needs_bake


def test_a_packed_map_serves_where_the_cache_is_empty(
    make_material: Make, lens: dict[str, Any], cache: Path
) -> None:
    """A file from another machine brings its map along."""
    material = make_material(lens)
    behind_a_mirror(material)
    refresh(material)
    (file,) = cache.iterdir()
    content = file.read_bytes()
    file.unlink()
    material.hologram.efficiency.levels = 4
    assert not refresh(material, make=False)
    assert material.hologram.problem == ""
    assert file.read_bytes() == content


def test_copies_share_a_map_until_one_needs_another(
    make_material: Make, lens: dict[str, Any]
) -> None:
    material = make_material(lens)
    behind_a_mirror(material)
    refresh(material)
    copy = material.copy()
    shared = map_image(material)
    assert map_image(copy) == shared
    copy.hologram.recording.object.kind = "plane"
    refresh(copy)
    assert map_image(copy) is None
    assert map_image(material) == shared
    assert shared.packed_file is not None
    catch_up()
    assert not is_stale(material)
