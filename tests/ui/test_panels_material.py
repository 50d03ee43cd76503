# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The panels of a hologram: what they show, and that nothing is shown that does not apply."""

from collections.abc import Callable
from typing import Any

import bpy
import pytest

from hoe_addon.blender.ids import CharacteristicKind, EfficiencyModel, PatternKind, Shape, WaveKind
from hoe_addon.blender.props.detail_fields import document
from hoe_addon.blender.props.efficiency_fields import ReliefShape
from hoe_addon.blender.props.rcwa_fields import ProfileShape
from hoe_addon.blender.props.sync import read_spec
from hoe_addon.blender.props.wave_fields import SourceShape, wavelength_rgb
from hoe_addon.ui.facts.material import FACTS
from hoe_addon.ui.ids import Op
from tests.ui.layouts import Drawn, draw

NAMES = ("", "_element", "_recording", "_efficiency", "_orders", "_document")
PLACES = ("sidebar", "material")

type Make = Callable[..., Any]


def shown(name: str, place: str = "sidebar") -> Drawn:
    drawn = draw(getattr(bpy.types, f"HOE_PT_hologram{name}_{place}"))
    assert drawn is not None
    return drawn


@pytest.fixture
def hologram(make_hologram: Make, lens: dict[str, Any]) -> Any:
    """The hologram properties of the plate's material."""
    material = make_hologram(lens)
    FACTS.update_now(material)
    return material.hologram


@pytest.mark.parametrize("name", NAMES)
def test_same_in_both_places(hologram: Any, name: str) -> None:
    first, second = (
        [(call.kind, call.name, call.text) for call in shown(name, place).calls] for place in PLACES
    )
    assert first == second
    assert first


@pytest.mark.parametrize("place", PLACES)
def test_sub_panels_are_closed_at_first(registered: Any, place: str) -> None:
    for name in NAMES[1:]:
        panel = getattr(bpy.types, f"HOE_PT_hologram{name}_{place}")
        assert panel.bl_options == {"DEFAULT_CLOSED"}
        assert panel.bl_parent_id == f"HOE_PT_hologram_{place}"


def test_nothing_selected(registered: Any) -> None:
    assert draw(bpy.types.HOE_PT_hologram_sidebar) is None


def test_object_without_a_hologram_offers_to_make_one(plate: Any) -> None:
    for place in PLACES:
        offered = draw(getattr(bpy.types, f"HOE_PT_no_hologram_{place}"))
        assert offered is not None
        assert Op.MAKE_HOLOGRAM in offered.operators()
    assert draw(bpy.types.HOE_PT_hologram_sidebar) is None
    assert draw(bpy.types.HOE_PT_hologram_recording_sidebar) is None


def test_grating_in_numbers(hologram: Any) -> None:
    hologram.pattern = PatternKind.CHARACTERISTIC
    FACTS.update_now(hologram.id_data)
    words = shown("").words()
    assert "1.667 \N{MICRO SIGN}m" in words
    assert "600 per mm" in words
    # sin(a) = 532 nm * 600 / mm / 1.5195, in N-BK7
    assert "12.13\N{DEGREE SIGN} off, transmitted" in words


def test_rings_are_told_beside_their_centre(hologram: Any) -> None:
    hologram.pattern = PatternKind.CHARACTERISTIC
    hologram.characteristic.kind = CharacteristicKind.RADIAL
    hologram.characteristic.lines_per_mm = 625.0
    facts = FACTS.update_now(hologram.id_data)
    lines = {line.label: line.value for line in facts.grating}
    assert lines["Period"] == "1.6 \N{MICRO SIGN}m"
    assert lines["Lines"] == "625 per mm"
    assert "Order +1" in lines
    assert facts.efficiency
    assert not facts.without_plot
    for name in ("", "_efficiency"):
        assert "At 10 mm from the centre" in shown(name).words()


def test_hologram_that_gives_no_order_light_says_why_it_has_no_plot(hologram: Any) -> None:
    hologram.efficiency.model = EfficiencyModel.CONSTANT
    hologram.efficiency.shares.clear()
    hologram.efficiency.shares.add().share = 0.0
    facts = FACTS.update_now(hologram.id_data)
    assert not facts.problem
    assert "No order gets light" in facts.without_plot
    assert not facts.plot


def test_recording_shows_wavelength_with_its_colour(hologram: Any) -> None:
    names = shown("_recording").properties()
    assert names[:3] == ["pattern", "wavelength_nm", "colour"]


@pytest.mark.parametrize("kind", list(WaveKind))
def test_wave_shows_its_own_fields_only(hologram: Any, kind: WaveKind) -> None:
    wave = hologram.recording.object
    wave.kind = kind
    read_spec(hologram.id_data)
    names = [call.name for call in shown("_recording").calls if call.owner == wave]
    own = document(wave.details).keys()
    assert ("position_mm" in names) == (kind == WaveKind.POINT)
    assert ("direction" in names) == (kind == WaveKind.PLANE)
    assert ("source_shape" in names) == ("shape" in own)
    assert ("window_thickness_mm" in names) == ("window" in own)
    assert ("first_mm" in names) == ("first_mm" in own)


def test_followed_wave_takes_its_place_from_the_object(hologram: Any, plate: Any) -> None:
    lamp = bpy.data.objects.new("Lamp", None)
    bpy.context.scene.collection.objects.link(lamp)
    wave = hologram.recording.object
    wave.kind, wave.target, wave.follows = WaveKind.POINT, lamp, True
    names = [call.name for call in shown("_recording").calls if call.owner == wave]
    assert "target" in names
    assert "beam" in names
    assert "position_mm" not in names


@pytest.mark.parametrize("kind", list(CharacteristicKind))
def test_function_fields(hologram: Any, kind: CharacteristicKind) -> None:
    hologram.pattern = PatternKind.CHARACTERISTIC
    hologram.characteristic.kind = kind
    names = shown("_recording").properties()
    assert "wavelength_nm" in names
    assert ("lines_per_mm" in names) == (kind in ("linear", "radial"))
    assert ("formula" in names) == (kind == "formula")
    assert ("file" in names) == (kind == "sampled")


@pytest.mark.parametrize("shape", list(Shape))
def test_surface_fields(hologram: Any, shape: Shape) -> None:
    hologram.surface.shape = shape
    names = shown("_element").properties()
    assert ("size_mm" in names) == (shape == Shape.PLANE)
    assert ("radius_mm" in names) == (shape not in (Shape.PLANE, Shape.MESH))


@pytest.mark.parametrize("model", list(EfficiencyModel))
def test_model_fields(hologram: Any, model: EfficiencyModel) -> None:
    hologram.efficiency.model = model
    FACTS.update_now(hologram.id_data)
    drawn = shown("_efficiency")
    names = drawn.properties()
    assert ("levels" in names) == (model == EfficiencyModel.KINOFORM)
    assert ("volume_modulation" in names) == (model == EfficiencyModel.KOGELNIK)
    assert ("profile_shape" in names) == (model == EfficiencyModel.RCWA)
    assert ("table_file" in names) == (model == EfficiencyModel.TABLE)
    assert (Op.ADD_SHARE in drawn.operators()) == (model == EfficiencyModel.CONSTANT)
    assert "haze_width_deg" not in names


@pytest.mark.parametrize("shape", list(ProfileShape))
def test_profile_is_valid_and_shows_its_fields(hologram: Any, shape: ProfileShape) -> None:
    hologram.efficiency.model = EfficiencyModel.RCWA
    hologram.efficiency.profile_shape = shape
    spec = read_spec(hologram.id_data)
    names = shown("_efficiency").properties()
    has_depth = hasattr(spec.efficiency.profile, "depth_um")
    assert ("profile_depth_um" in names) == has_depth
    assert ("ridge_kind" in names) == (spec.efficiency.ridge is not None)


@pytest.mark.parametrize("shape", list(ReliefShape))
def test_relief_is_valid(hologram: Any, shape: ReliefShape) -> None:
    hologram.efficiency.levels = 0
    hologram.efficiency.relief_shape = shape
    read_spec(hologram.id_data)
    names = shown("_efficiency").properties()
    assert ("levels" in names) == (shape == ReliefShape.SAWTOOTH)


@pytest.mark.parametrize("shape", list(SourceShape))
def test_source_is_valid(hologram: Any, shape: SourceShape) -> None:
    wave = hologram.recording.object
    wave.kind = WaveKind.EXTENDED
    wave.source_shape = shape
    read_spec(hologram.id_data)
    assert shown("_recording").properties().count("source_shape") == 1


def test_haze_opens_its_fields(hologram: Any) -> None:
    hologram.efficiency.has_haze = True
    assert {"haze_width_deg", "haze_share"} <= set(shown("_efficiency").properties())
    hologram.efficiency.haze_is_rough = True
    read_spec(hologram.id_data)
    names = shown("_efficiency").properties()
    assert "haze_roughness_nm" in names
    assert "haze_share" not in names


def test_problem_stands_where_it_is(hologram: Any) -> None:
    hologram.efficiency.levels = 1
    FACTS.update_now(hologram.id_data)
    assert "Efficiency" in shown("").words()
    assert "must be 0 (continuous) or at least 2" in shown("_efficiency").words()
    assert "must be 0" not in shown("_recording").words()
    header = [call for call in shown("_efficiency").calls if call.options.get("icon") == "ERROR"]
    assert header


def test_lost_source_is_told_at_its_wave(hologram: Any) -> None:
    hologram.recording.reference.follows = True
    FACTS.update_now(hologram.id_data)
    drawn = shown("_recording")
    alerted = [call.owner for call in drawn.calls if call.name == "target" and call.alert]
    assert alerted == [hologram.recording.reference]
    assert "The reference wave follows no object" in drawn.words()
    assert "recording.reference" not in drawn.words()
    untick = [call for call in drawn.calls if call.text == "Untick Follow"]
    assert [(call.owner, call.name) for call in untick] == [
        (hologram.recording.reference, "follows")
    ]


def test_table_that_was_not_chosen_yet_is_no_fault(hologram: Any) -> None:
    hologram.efficiency.model = EfficiencyModel.TABLE
    FACTS.update_now(hologram.id_data)
    asked = [call for call in shown("_efficiency").calls if call.name == "Choose a table file."]
    assert asked
    assert not any(call.alert for call in asked)
    assert "To be chosen below, in Efficiency" in shown("").words()


def test_rigorous_grating_asks_for_a_bake(hologram: Any) -> None:
    hologram.efficiency.model = EfficiencyModel.RCWA
    facts = FACTS.update_now(hologram.id_data)
    assert "baked" in facts.without_plot
    hologram.needs_bake, hologram.problem = True, "needs its table: press Bake"
    assert Op.BAKE_TABLE in shown("").operators()


def test_document_text_is_shown_only_where_there_is_one(hologram: Any) -> None:
    hologram.recording.object.kind = WaveKind.POINT
    assert "details" not in shown("_document").properties()
    hologram.recording.object.kind = WaveKind.EXTENDED
    assert "details" in shown("_document").properties()


def test_draw_asks_for_facts_and_computes_nothing(
    hologram: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    FACTS.unregister()
    FACTS.register()
    monkeypatch.setattr(FACTS, "_work_out", lambda _: pytest.fail("was worked out in draw"))
    for name in NAMES:
        shown(name)
    assert FACTS.shown(hologram.id_data) is None


def test_every_text_field_has_its_words(registered: Any) -> None:
    seen = 0
    for path in ("efficiency", "surface", "characteristic", "recording"):
        group = bpy.types.Material.bl_rna.properties["hologram"].fixed_type.properties[path]
        for prop in group.fixed_type.properties:
            if prop.identifier not in ("rna_type", "name"):
                assert prop.name, prop.identifier
                assert prop.description, prop.identifier
                seen += 1
    assert seen > 60


def test_colours_of_wavelengths() -> None:
    red, green, blue, beyond = (wavelength_rgb(nm) for nm in (650, 532, 460, 900))
    assert red[0] == max(red)
    assert green[1] == 1.0
    assert blue[2] == max(blue)
    assert len(set(beyond)) == 1


def test_material_panels_stand_above_the_sockets(registered: Any) -> None:
    assert bpy.types.HOE_PT_hologram_material.bl_parent_id == "CYCLES_PT_context_material"
    above = "EEVEE_MATERIAL_PT_context_material"
    assert bpy.types.HOE_PT_hologram_material_eevee.bl_parent_id == above
    assert bpy.types.HOE_PT_hologram_recording_material.bl_parent_id == "HOE_PT_hologram_material"


def test_material_panels_stand_by_themselves_without_cycles(clean_scene: Any) -> None:
    import addon_utils

    import hoe_addon

    addon_utils.disable("cycles")
    try:
        hoe_addon.register()
        assert bpy.types.HOE_PT_hologram_material.bl_parent_id == ""
        hoe_addon.unregister()
    finally:
        addon_utils.enable("cycles")
