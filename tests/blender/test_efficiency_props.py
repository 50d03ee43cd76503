# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every efficiency model as properties of a material, and back, with nothing lost."""

from pathlib import Path
from typing import Any

import bpy
import pytest

from hoe_addon.blender.ids import EfficiencyModel
from hoe_addon.blender.props.sync import read_spec, write_spec
from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import hologram_from

KINOFORM = {"model": "kinoform", "levels": 0, "design_wavelength_nm": 532, "relief": 1.5}
KOGELNIK = {"model": "kogelnik", "thickness_um": 8.5, "index": 1.5, "modulation": 0.03}
BINARY = {"shape": "binary", "depth_um": 0.1234567890123}
RCWA = {"model": "rcwa", "profile": BINARY, "ridge": {"n": 0.2, "k": 3.4}}
HAZE = {"haze": {"share": 0.123456789, "width_deg": 2.5}}
LOOKUP = {"lookup": {"form": "table", "choice": "stochastic", "tolerance": 0.00123456789}}

MODELS: dict[str, dict[str, Any]] = {
    "kinoform with haze": KINOFORM | HAZE,
    "kinoform from a table": KINOFORM | LOOKUP,
    "kinoform of another shape": KINOFORM
    | {
        "profile": {"shape": "sampled", "heights": [0, 0.123456789, 1, 0.5], "between": "steps"},
        "errors": {"depth_error": 0.0123456789},
        "depth_waves": 1.23456789,
        "angle_dependent": False,
    },
    "constant with haze and table": {"model": "constant", "table": {"T": {"1": 0.5}}}
    | HAZE
    | LOOKUP,
    "volume": KOGELNIK | {"shrinkage": 0.0123456789, "total_internal_reflection": True} | HAZE,
    "rigorous": RCWA,
    "rigorous, all fields": RCWA
    | {
        "groove": "fused silica",
        "under": [{"index": {"table": [[400, 0.1, 2], [700, 0.2, 4.5]]}, "thickness_um": 0.2}],
        "slices": 7,
        "harmonics": 31,
        "tolerance": 0.000123,
    },
    "rigorous volume": {
        "model": "rcwa",
        "profile": {"shape": "volume", "thickness_um": 5, "index": 1.5, "modulation": 0.02},
    },
}


def document(lens: dict[str, Any], efficiency: dict[str, Any]) -> dict[str, Any]:
    return lens | {"efficiency": efficiency, "orders": [-1, 0, 1]}


@pytest.mark.parametrize("efficiency", MODELS.values(), ids=MODELS)
def test_round_trip(registered: Any, lens: dict[str, Any], efficiency: dict[str, Any]) -> None:
    material: Any = bpy.data.materials.new("lens")
    spec = hologram_from(document(lens, efficiency))
    write_spec(material, spec)
    assert read_spec(material) == spec


def test_survives_a_file(registered: Any, lens: dict[str, Any], tmp_path: Path) -> None:
    specs = [hologram_from(document(lens, efficiency)) for efficiency in MODELS.values()]
    for place, spec in enumerate(specs):
        write_spec(bpy.data.materials.new(f"m{place}"), spec)
        bpy.data.materials[f"m{place}"].use_fake_user = True
    path = str(tmp_path / "a.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    for place, spec in enumerate(specs):
        found = read_spec(bpy.data.materials[f"m{place}"])
        assert found.efficiency == spec.efficiency


def test_models_keep_their_details_apart(registered: Any, lens: dict[str, Any]) -> None:
    """Trying another model and going back loses nothing, and what is common goes along."""
    material: Any = bpy.data.materials.new("lens")
    spec = hologram_from(document(lens, KOGELNIK | HAZE))
    write_spec(material, spec)
    group = material.hologram.efficiency
    for model in (EfficiencyModel.RCWA, EfficiencyModel.CONSTANT):
        group.model = model
        tried = read_spec(material).efficiency
        assert type(tried).__struct_config__.tag == model
        assert tried.haze == spec.efficiency.haze
    group.model = EfficiencyModel.KOGELNIK
    assert read_spec(material) == spec


def test_writing_leaves_nothing_of_the_last_one(registered: Any, lens: dict[str, Any]) -> None:
    material: Any = bpy.data.materials.new("lens")
    write_spec(material, hologram_from(document(lens, KINOFORM | HAZE | {"depth_waves": 2})))
    plain = hologram_from(document(lens, KINOFORM))
    write_spec(material, plain)
    assert read_spec(material) == plain


@pytest.mark.parametrize(
    ("field", "text", "message"),
    [
        ("rcwa_details", '{"profile": {"shape": "blob"}}', r"efficiency\.profile\.shape: must be"),
        ("rcwa_details", "[1]", r"efficiency: must be a JSON object"),
        ("rcwa_details", "{", r"efficiency: line 1"),
        ("common_details", '{"haze": {"width_deg": 1}}', r"efficiency\.haze\.share: must be"),
        ("common_details", '{"depth": 1}', r"efficiency\.depth: must not stand in"),
    ],
)
def test_texts_of_people_are_checked(
    registered: Any, lens: dict[str, Any], field: str, text: str, message: str
) -> None:
    material: Any = bpy.data.materials.new("lens")
    write_spec(material, hologram_from(document(lens, RCWA)))
    setattr(material.hologram.efficiency, field, text)
    with pytest.raises(SpecError, match=message):
        read_spec(material)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("common_details", '{"thickness_um": 3}', "efficiency.thickness_um: must not stand"),
        ("common_details", '{"model": "kinoform"}', "efficiency.model: is set outside this text"),
        ("kogelnik_details", '{"haze": {}}', "efficiency.haze: is set outside this text"),
        (
            "kogelnik_details",
            '{"total_internal_reflection": true}',
            "efficiency.total_internal_reflection: is set outside this text",
        ),
    ],
)
def test_a_text_holds_its_own_fields_only(
    registered: Any, lens: dict[str, Any], name: str, text: str, message: str
) -> None:
    material: Any = bpy.data.materials.new("lens")
    write_spec(material, hologram_from(document(lens, KOGELNIK)))
    setattr(material.hologram.efficiency, name, text)
    with pytest.raises(SpecError, match=message):
        read_spec(material)
