# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that older versions wrote, stored in ``tests/files``: they open, and show what they did.

``version_1_first`` is a light guide in spectral colours, written when materials first had
properties; ``version_1_last`` one at a single wavelength, written just before scenes held their
documents. Beside each stand the sockets and the picture that the version itself gave. ``version_2``
is a scene with a room, of the time when things made here had no marks; beside it stand its document
and its picture. ``NAME.N``
are the documents as they were published, each form of them once.
"""

import json
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
import pytest

from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.document import versions
from hoe_addon.blender.document.held import document_of
from hoe_addon.blender.document.live import settle
from hoe_addon.blender.ids import Role
from hoe_addon.blender.marks import is_made
from hoe_addon.blender.pictures.render_settings import write_float_exr
from hoe_addon.blender.props.device import VERSION
from hoe_addon.blender.props.made import is_stale
from hoe_addon.blender.props.sync import hologram_node, read_spec, refresh, refresh_changed
from hoe_addon.core.errors import HoeError, SpecError
from hoe_addon.model.document import SCHEMA, device_from, hologram_from, to_document

FILES = Path(__file__).parents[1] / "files"
FIRST, LAST = FILES / "version_1_first.blend", FILES / "version_1_last.blend"
OLD = (FIRST, LAST)
SECOND = FILES / "version_2.blend"
DOCUMENTS = sorted(FILES.glob("*.[0-9].json"))

ROUNDING = 2e-7
"""Of a number that goes from a document through a property to a socket."""

SHARE_OF_BRIGHTEST = 0.01
"""Of the brightest block; 0.0009 measured with the same seed, where another seed gives 0.1."""


def opened(path: Path) -> Any:
    bpy.ops.wm.open_mainfile(filepath=str(path))
    (scene,) = bpy.data.scenes
    return scene


def expected(path: Path) -> dict[str, Any]:
    return json.loads(path.with_suffix(".expected.json").read_text(encoding="utf-8"))


def holograms() -> dict[str, Any]:
    return {each.name: each for each in bpy.data.materials if each.hologram.enabled}


@pytest.mark.parametrize("path", OLD, ids=lambda path: path.stem)
def test_the_stored_file_is_of_version_1(clean_scene: Any, path: Path) -> None:
    """Nothing has saved it anew by mistake; looked at without the add-on."""
    with bpy.data.libraries.load(str(path)) as (there, wanted):
        wanted.materials = there.materials
    assert not any("Stand-In" in each.node_tree.nodes for each in wanted.materials)
    assert path.stat().st_size < 150_000


@pytest.mark.parametrize("path", OLD, ids=lambda path: path.stem)
def test_an_old_file_opens_whole(registered: Any, path: Path) -> None:
    scene = opened(path)
    assert set(holograms()) == {"in_coupler", "out_coupler"}
    for material in holograms().values():
        assert material.hologram.problem == ""
        assert read_spec(material).name == material.name
        assert not is_stale(material)
    assert scene.hologram.problem == ""
    assert scene.hologram.version == VERSION


@pytest.mark.parametrize("path", OLD, ids=lambda path: path.stem)
def test_shaders_have_the_numbers_of_the_old_version(registered: Any, path: Path) -> None:
    opened(path)
    for name, sockets in expected(path)["sockets"].items():
        node = hologram_node(holograms()[name])
        held = {each.identifier: each.default_value for each in node.inputs}
        for identifier, value in sockets.items():
            if identifier in held and identifier != "wavelength_nm":
                got = np.array(held[identifier], dtype=np.float64)
                np.testing.assert_allclose(got, value, rtol=ROUNDING, atol=ROUNDING)


@pytest.mark.parametrize("path", OLD, ids=lambda path: path.stem)
def test_from_1_to_2_the_scene_knows_its_parts(registered: Any, path: Path) -> None:
    scene = opened(path)
    roles = {item.name: item.hologram.role for item in scene.objects}
    assert roles["Guide"] == Role.HOLOGRAM
    assert roles["Eye"] == Role.EYE or path == LAST  # a filter only where wavelengths are drawn
    assert roles.get("Spectral Filter", Role.FILTER) == Role.FILTER
    assert roles["Lens"] == Role.IDEAL_LENS
    assert scene.hologram.wavelength.name == "Hologram Wavelength"
    if path == FIRST:
        assert scene.hologram.eye.camera == scene.camera
    for material in holograms().values():
        assert "Stand-In" in material.node_tree.nodes


@pytest.mark.parametrize("name", ["diffractive_achromat", "holographic_sight", "two_hologram_ar"])
def test_from_2_to_3_what_was_made_is_told_from_what_is_the_users(
    registered: Any, name: str
) -> None:
    scene = add_scene(name)
    room = scene.hologram.room
    vase = bpy.data.objects.new("Wall", bpy.data.meshes.new("Cube"))
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    parts = set(room.collection.objects)
    for own in (vase, sun):
        room.collection.objects.link(own)
    for item in parts:
        item.hologram.role = Role.NONE
    made = {each for each in (*bpy.data.materials, *bpy.data.meshes) if is_made(each)}
    for block in made:
        del block["hoe_made"]
    scene.hologram.version = 2
    versions.migrate_file()
    assert scene.hologram.version == VERSION
    assert parts
    assert {item.hologram.role for item in parts} == {Role.ROOM}
    assert vase.hologram.role == sun.hologram.role == Role.NONE
    for item in scene.objects:
        if item.hologram.role in (Role.CARD, Role.DISPLAY, Role.LENS, Role.PART, Role.FILTER):
            assert all(map(is_made, (item.data, *item.data.materials))), item.name


def test_the_stored_file_of_version_2_opens_whole(registered: Any) -> None:
    scene = opened(SECOND)
    assert scene.hologram.version == VERSION
    assert to_document(document_of(scene)) == expected(SECOND)["document"]
    room = scene.hologram.room.collection
    assert room.objects
    assert {item.hologram.role for item in room.objects} == {Role.ROOM}
    assert set(settle(scene)) <= {"pupil"}, "it is what its document says"


def test_migrating_twice_changes_nothing(registered: Any) -> None:
    scene = opened(FIRST)
    scene.objects["Guide"].hologram.role = Role.PART
    versions.migrate_file()
    assert scene.hologram.version == VERSION
    assert scene.objects["Guide"].hologram.role == Role.PART


def test_a_migrated_file_is_saved_as_this_version(registered: Any, tmp_path: Path) -> None:
    opened(FIRST)
    path = tmp_path / "again.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    scene = opened(path)
    assert scene.hologram.version == VERSION
    assert scene.objects["Eye"].hologram.role == Role.EYE
    assert not any(is_stale(each) for each in holograms().values())


def test_what_is_appended_from_an_old_file_says_what_it_is(registered: Any) -> None:
    bpy.ops.wm.append(directory=f"{FIRST}/Object/", filename="Guide")
    assert bpy.data.objects["Guide"].hologram.role == Role.HOLOGRAM
    assert not any(is_stale(each) for each in holograms().values())


def test_an_empty_scene_has_no_version(registered: Any) -> None:
    versions.migrate_file()
    assert registered.hologram.version == 0
    assert registered.hologram.problem == ""


def test_a_file_of_a_newer_version_is_left_alone(registered: Any, tmp_path: Path) -> None:
    scene = opened(FIRST)
    scene.hologram.version = VERSION + 1
    material = holograms()["in_coupler"]
    material.hologram.recording.wavelength_nm = 600.0
    path = tmp_path / "newer.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    scene = opened(path)
    words = f"made by a newer version {VERSION + 1} of the add-on; this one knows {VERSION}: update"
    assert scene.hologram.problem.startswith(words)
    assert scene.hologram.version == VERSION + 1
    material = holograms()["in_coupler"]
    node = hologram_node(material)
    text, values = node.script.name, [each.default_value for each in node.inputs][5:9]
    with pytest.raises(HoeError, match=f"scene {scene.name}: {words}"):
        refresh(material)
    material.hologram.recording.wavelength_nm = 610.0
    refresh_changed()
    bpy.ops.ed.undo_push(message="edit")
    assert node.script.name == text
    assert [each.default_value for each in node.inputs][5:9] == values
    assert is_stale(material)


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_published_documents_are_read(path: Path) -> None:
    document = json.loads(path.read_text(encoding="utf-8"))
    read = device_from if "kind" in document else hologram_from
    assert read(document).name == document["name"]


def test_there_are_documents() -> None:
    assert len(DOCUMENTS) >= 15


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.stem)
def test_documents_of_the_next_version_are_refused(path: Path) -> None:
    document = json.loads(path.read_text(encoding="utf-8")) | {"schema": SCHEMA + 1}
    read = device_from if "kind" in document else hologram_from
    with pytest.raises(SpecError, match=r"^schema: must be at most 1, the newest .*update it"):
        read(document)


@pytest.mark.render
@pytest.mark.parametrize("path", (*OLD, SECOND), ids=lambda path: path.stem)
def test_an_old_file_shows_the_old_picture(registered: Any, path: Path, tmp_path: Path) -> None:
    scene = opened(path)
    scene.cycles.samples = 1024
    target = tmp_path / "picture.exr"
    write_float_exr(scene, target)
    bpy.ops.render.render(write_still=True, scene=scene.name)
    pixels = oiio.ImageBuf(str(target)).get_pixels(oiio.FLOAT)[..., :3]
    height, width, _ = pixels.shape
    blocks = pixels.reshape(2, height // 2, 4, width // 4, 3).mean((1, 3))
    before = np.array(expected(path)["blocks"])
    assert before.max() > 0.01
    np.testing.assert_allclose(blocks, before, atol=SHARE_OF_BRIGHTEST * before.max())
