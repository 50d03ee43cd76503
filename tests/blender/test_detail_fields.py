# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties that are fields of texts: nobody types JSON, and nothing else in a text changes."""

import json
from typing import Any

import bpy
import pytest

from hoe_addon.blender.ids import CharacteristicKind, EfficiencyModel, PatternKind, Shape, WaveKind
from hoe_addon.blender.props import changes
from hoe_addon.blender.props.detail_media import Given
from hoe_addon.blender.props.sync import read_spec, write_spec
from hoe_addon.model.document import hologram_from
from hoe_addon.model.efficiency import PlaceFormula


@pytest.fixture
def hologram(registered: Any, lens: dict[str, Any]) -> Any:
    """The properties of a lens."""
    material = bpy.data.materials.new("lens")
    write_spec(material, hologram_from(lens))
    return material.hologram


def test_number_is_written_as_typed(hologram: Any) -> None:
    hologram.efficiency.volume_modulation = 0.0312
    assert json.loads(hologram.efficiency.kogelnik_details)["modulation"] == 0.0312


def test_neighbours_keep_their_last_bit(hologram: Any) -> None:
    fine = 0.1234567890123456
    text = {"thickness_um": fine, "index": "N-BK7", "modulation": 0.02}
    hologram.efficiency.kogelnik_details = json.dumps(text)
    hologram.efficiency.volume_shrinkage = 0.05
    assert json.loads(hologram.efficiency.kogelnik_details) == text | {"shrinkage": 0.05}


def test_numbers_stay_within_their_limits(hologram: Any) -> None:
    hologram.efficiency.profile_duty = 7.0
    assert json.loads(hologram.efficiency.rcwa_details)["profile"]["duty"] == 0.999


def test_setting_one_marks_the_material(hologram: Any) -> None:
    changes.forget(hologram.id_data)
    hologram.efficiency.volume_thickness_um = 12.0
    assert list(changes.taken(bpy.data.materials)) == [hologram.id_data]


def test_unreadable_text_gives_defaults_and_is_told(hologram: Any) -> None:
    hologram.efficiency.model = EfficiencyModel.KOGELNIK
    hologram.efficiency.kogelnik_details = '{"thickness_um": '
    assert hologram.efficiency.volume_thickness_um == 10.0
    with pytest.raises(Exception, match="efficiency"):
        read_spec(hologram.id_data)


def test_formula_and_back(hologram: Any) -> None:
    efficiency = hologram.efficiency
    efficiency.model = EfficiencyModel.KOGELNIK
    efficiency.volume_thickness_um = 12.5
    efficiency.volume_thickness_varies = True
    assert efficiency.volume_thickness_formula == "12.5"
    efficiency.volume_thickness_formula = "10 + x / 10"
    spec = read_spec(hologram.id_data)
    assert spec.efficiency.thickness_um == PlaceFormula(formula="10 + x / 10")
    efficiency.volume_thickness_varies = False
    assert read_spec(hologram.id_data).efficiency.thickness_um == 10.0


def test_medium_three_ways(hologram: Any) -> None:
    efficiency = hologram.efficiency
    efficiency.model = EfficiencyModel.KOGELNIK
    for given in (*Given, *reversed(Given)):
        efficiency.volume_index_kind = given
        assert efficiency.volume_index_kind == given
        read_spec(hologram.id_data)
    efficiency.volume_index_kind = Given.CATALOGUE
    efficiency.volume_index_name = "PMMA"
    assert read_spec(hologram.id_data).efficiency.index == "PMMA"


@pytest.mark.parametrize("kind", list(WaveKind))
@pytest.mark.parametrize("before", list(WaveKind))
def test_any_wave_becomes_any_other(hologram: Any, before: WaveKind, kind: WaveKind) -> None:
    wave = hologram.recording.object
    wave.kind = before
    wave.kind = kind
    assert type(read_spec(hologram.id_data).recording.object).__struct_config__.tag == kind


def test_wave_keeps_its_place(hologram: Any) -> None:
    wave = hologram.recording.object
    wave.kind, wave.position_mm = WaveKind.POINT, (3.0, 4.0, -150.0)
    wave.kind = WaveKind.EXTENDED
    assert read_spec(hologram.id_data).recording.object.position_mm == (3.0, 4.0, -150.0)
    wave.own_position_mm = (0.0, 1.0, -120.0)
    wave.kind = WaveKind.WINDOW
    assert read_spec(hologram.id_data).recording.object.position_mm == (0.0, 1.0, -120.0)


@pytest.mark.parametrize("kind", [kind for kind in CharacteristicKind if kind != "sampled"])
@pytest.mark.parametrize("before", list(CharacteristicKind))
def test_any_function_becomes_any_other(
    hologram: Any, before: CharacteristicKind, kind: CharacteristicKind
) -> None:
    hologram.pattern = PatternKind.CHARACTERISTIC
    hologram.characteristic.kind = before
    hologram.characteristic.kind = kind
    spec = read_spec(hologram.id_data).characteristic
    assert type(spec).__struct_config__.tag == kind


def test_longer_list_keeps_its_tail(hologram: Any) -> None:
    function = hologram.characteristic
    function.kind = CharacteristicKind.EVEN_RADIAL
    found = json.loads(function.details) | {"coefficients": [1, 2, 3, 4, 5, 6]}
    function.details = json.dumps(found)
    function.coefficients[1] = 7.0
    assert json.loads(function.details)["coefficients"] == [1, 7, 3, 4, 5, 6]


@pytest.mark.parametrize("shape", [shape for shape in Shape if shape != Shape.MESH])
def test_surface_keeps_its_size(hologram: Any, shape: Shape) -> None:
    hologram.surface.size_mm = (30.0, 20.0)
    hologram.surface.shape = shape
    surface = read_spec(hologram.id_data).surface
    assert type(surface).__struct_config__.tag == shape
    assert surface.size_mm == (30.0, 20.0)


def test_valid_text_survives_its_kind(hologram: Any) -> None:
    """A script, or an undo, that sets the kind again does not change the text."""
    wave = hologram.recording.object
    wave.kind = WaveKind.ASTIGMATIC
    wave.first_mm = (0.0, 0.0, -77.0)
    text = wave.details
    wave.kind = WaveKind.PLANE
    wave.kind = WaveKind.ASTIGMATIC
    assert wave.details == text
