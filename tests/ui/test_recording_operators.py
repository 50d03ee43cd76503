# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators of a hologram's own panels."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import pytest
from mathutils import Matrix

from hoe_addon.blender.ids import EfficiencyModel, WaveKind
from hoe_addon.blender.props.sync import hologram_node, read_spec
from hoe_addon.model.document import load_hologram
from hoe_addon.ui.facts.material import FACTS
from tests.ui.layouts import draw

type Make = Callable[..., Any]

OPS = bpy.ops.hologram


@pytest.fixture
def material(make_hologram: Make, lens: dict[str, Any]) -> Any:
    """The lens of the README on a plate."""
    return make_hologram(lens)


def orders(material: Any) -> list[int]:
    return [entry.order for entry in material.hologram.orders]


def undone_and_redone(read: Callable[[], Any], change: Callable[[], Any]) -> tuple[Any, Any, Any]:
    """What is there before a change, after undoing it, and after redoing it."""
    bpy.ops.ed.undo_push(message="before")
    before = read()
    assert change() == {"FINISHED"}
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    undone = read()
    bpy.ops.ed.redo()
    return before, undone, read()


def test_polls_say_why_not(registered: Any) -> None:
    for operator in (OPS.add_order, OPS.check, OPS.refresh, OPS.export_hologram):
        assert not operator.poll()
        with pytest.raises(RuntimeError, match="Select an object whose active material"):
            operator()
    with pytest.raises(RuntimeError, match="Select a mesh object"):
        OPS.make_hologram()


def test_make_hologram(plate: Any) -> None:
    assert OPS.make_hologram() == {"FINISHED"}
    made = plate.active_material
    assert made.hologram.enabled
    assert not made.hologram.problem
    assert hologram_node(made) is not None
    assert read_spec(made).orders == (0, 1)
    assert not OPS.make_hologram.poll()


def test_make_hologram_tells_its_true_focal_length(
    plate: Any, capfd: pytest.CaptureFixture[str]
) -> None:
    plate.data.transform(Matrix.Scale(0.5, 4))
    assert OPS.make_hologram() == {"FINISHED"}
    wave = plate.active_material.hologram.recording.object
    assert wave.beam == "converging"
    told = f"a lens with a focal length of {-wave.position_mm[2]:.4g} mm at 532 nm"
    assert told in capfd.readouterr().out
    assert "converges to a point behind" in OPS.make_hologram.get_rna_type().description


def test_add_and_remove_order(material: Any) -> None:
    first = orders(material)
    assert OPS.add_order() == {"FINISHED"}
    added = orders(material)
    assert len(added) == len(set(added)) == len(first) + 1
    assert OPS.remove_order(index=len(added) - 1) == {"FINISHED"}
    assert orders(material) == first
    with pytest.raises(RuntimeError, match="the list has no entry 99"):
        OPS.remove_order(index=99)


def test_add_order_can_be_undone(material: Any) -> None:
    name = material.name
    before, undone, redone = undone_and_redone(
        lambda: orders(bpy.data.materials[name]), OPS.add_order
    )
    assert undone == before
    assert len(redone) == len(before) + 1


def test_shares(material: Any) -> None:
    material.hologram.efficiency.model = EfficiencyModel.CONSTANT
    for _ in range(3):
        assert OPS.add_share() == {"FINISHED"}
    shares = material.hologram.efficiency.shares
    assert [entry.order for entry in shares] == [0, 1, -1]
    shares[1].share = 0.75
    assert read_spec(material).efficiency.table.T["1"] == 0.75
    assert OPS.remove_share(index=0) == {"FINISHED"}
    assert [entry.order for entry in shares] == [1, -1]


def test_source_becomes_an_object_where_it_was(material: Any) -> None:
    before = read_spec(material).recording
    assert OPS.source_from_selection(role="object") == {"FINISHED"}
    wave = material.hologram.recording.object
    assert wave.follows
    assert wave.target.users_collection
    after = read_spec(material).recording
    assert after.object.position_mm == pytest.approx(before.object.position_mm, abs=1e-4)
    wave.target.location.x += 5.0
    moved = read_spec(material).recording.object.position_mm
    assert moved[0] == pytest.approx(before.object.position_mm[0] + 5.0, abs=1e-4)


def test_plane_wave_becomes_an_object_with_its_direction(material: Any, plate: Any) -> None:
    plate.rotation_euler = (0.3, -0.2, 0.9)
    plate.location = (10.0, 20.0, 30.0)
    wave = material.hologram.recording.reference
    wave.kind, wave.direction = WaveKind.PLANE, (0.6, 0.0, 0.8)
    bpy.context.view_layer.update()
    assert OPS.source_from_selection(role="reference") == {"FINISHED"}
    found = read_spec(material).recording.reference.direction
    assert found == pytest.approx((0.6, 0.0, 0.8), abs=1e-6)


def test_selected_object_becomes_the_source(material: Any, registered: Any) -> None:
    lamp = bpy.data.objects.new("Lamp", None)
    registered.collection.objects.link(lamp)
    lamp.location = (1.0, 2.0, -70.0)
    lamp.select_set(True)
    material.hologram.recording.object.kind = WaveKind.POINT
    assert OPS.source_from_selection(role="object") == {"FINISHED"}
    assert material.hologram.recording.object.target == lamp
    found = read_spec(material).recording.object.position_mm
    assert found == pytest.approx((1.0, 2.0, -70.0), abs=1e-4)


def test_source_behind_optics_follows_nothing(material: Any) -> None:
    material.hologram.recording.object.kind = WaveKind.SYSTEM
    objects = len(bpy.data.objects)
    with pytest.raises(RuntimeError, match="choose another kind of wave"):
        OPS.source_from_selection(role="object")
    assert len(bpy.data.objects) == objects


def test_source_can_be_undone(material: Any) -> None:
    name = material.name

    def read() -> tuple[bool, int]:
        recording = bpy.data.materials[name].hologram.recording
        return recording.object.follows, len(bpy.data.objects)

    _, undone, redone = undone_and_redone(read, OPS.source_from_selection)
    assert undone == (False, 1)
    assert redone == (True, 2)


def test_refresh(material: Any) -> None:
    assert hologram_node(material) is None
    assert OPS.refresh() == {"FINISHED"}
    assert hologram_node(material) is not None
    material.hologram.efficiency.levels = 1
    with pytest.raises(RuntimeError, match=r"efficiency\.levels: must be 0"):
        OPS.refresh()


def test_check_is_shown_until_the_hologram_changes(material: Any) -> None:
    assert OPS.check() == {"FINISHED"}
    facts = FACTS.shown(material)
    assert facts is not None
    assert facts.check is not None
    drawn = draw(bpy.types.HOE_PT_hologram_efficiency_sidebar)
    assert drawn is not None
    assert facts.check.warnings or "All its assumptions hold" in drawn.words()
    material.hologram.efficiency.levels = 2
    assert FACTS.update_now(material).check is None


def test_check_warns(material: Any) -> None:
    """A volume hologram of 1 um is too thin for two-wave theory."""
    efficiency = material.hologram.efficiency
    efficiency.model = EfficiencyModel.KOGELNIK
    efficiency.volume_thickness_um = 1.0
    while len(material.hologram.orders) > 0:
        OPS.remove_order(index=0)
    for _ in range(2):
        OPS.add_order()
    assert OPS.check() == {"FINISHED"}
    facts = FACTS.shown(material)
    assert facts is not None
    assert facts.check is not None
    assert any("does not hold here" in warning for warning in facts.check.warnings)


def test_files_there_and_back(material: Any, lens: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "out.json"
    assert OPS.export_hologram(filepath=str(path)) == {"FINISHED"}
    assert load_hologram(path) == read_spec(material)
    changed = json.loads(path.read_text()) | {"orders": [0, 1, 2, 3]}
    path.write_text(json.dumps(changed))
    assert OPS.import_hologram(filepath=str(path)) == {"FINISHED"}
    assert orders(material) == [0, 1, 2, 3]
    assert hologram_node(material) is not None


def test_import_can_be_undone(material: Any, lens: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "other.json"
    path.write_text(json.dumps(lens | {"orders": [5]}))
    name = material.name
    before, undone, redone = undone_and_redone(
        lambda: orders(bpy.data.materials[name]),
        lambda: OPS.import_hologram(filepath=str(path)),
    )
    assert undone == before
    assert redone == [5]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"orders": []}, "orders"),
        ({"schema": 99}, "schema: must be"),
        ({"surface": {"shape": "plane", "size_mm": [-1, 1]}}, r"surface\.size_mm\[0\]"),
    ],
)
def test_bad_file_changes_nothing(
    material: Any, lens: dict[str, Any], tmp_path: Path, change: dict[str, Any], words: str
) -> None:
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(lens | change))
    before, materials = read_spec(material), len(bpy.data.materials)
    with pytest.raises(RuntimeError, match=words) as error:
        OPS.import_hologram(filepath=str(path))
    assert "bad.json" in str(error.value)
    assert read_spec(material) == before
    assert len(bpy.data.materials) == materials


def test_file_that_cannot_be_written(material: Any, tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="cannot be written"):
        OPS.export_hologram(filepath=str(tmp_path / "missing" / "out.json"))
