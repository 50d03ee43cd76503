# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Device documents: the shipped presets, the rules, and changes from the command line."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.document import (
    device_from,
    dump,
    load_device,
    picture_paths,
    preset_titles,
    to_document,
)
from hoe_addon.model.override import override
from hoe_addon.model.reading import parse_json
from hoe_addon.resources import preset_paths

AR = "two_hologram_ar"


def preset() -> dict[str, Any]:
    return json.loads(preset_paths()[AR].read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", preset_paths())
def test_every_preset_is_valid_and_round_trips(name: str) -> None:
    spec = load_device(name)
    assert spec.name == name
    assert device_from(parse_json(dump(spec))) == spec
    assert preset_titles()[name] == spec.title


BROKEN = [
    ("kind=torch", 'kind: must be one of light_guide, scene, got "torch"'),
    ("guide.thickness_mm=0", "guide.thickness_mm: must be above 0, got 0"),
    ("guide.relief_mm=-1", "guide.relief_mm: must be above 0, got -1"),
    ("guide.medium=0.5", "guide.medium: must be at least 1, got 0.5"),
    (
        "guide.size_mm=[64, 10]",
        "holograms[0] (in_coupler).center_mm[1]: must keep the patch on the guide in y",
    ),
    (
        "holograms.0.center_mm=[14, 0]",
        "holograms[1] (out_coupler).center_mm: must keep the patch clear of in_c",
    ),
    (
        "holograms.1.name=in_coupler",
        'holograms[1] (in_coupler).name: must be used once, got "in_coupler"',
    ),
    ("holograms.1.face=top", "holograms[1] (out_coupler).face: must be one of eye, world"),
    (
        "holograms.1.recording.object.index=0",
        "holograms[1] (out_coupler).recording.object.index: must be at l",
    ),
    (
        "holograms.in_coupler.orders=[0, 0]",
        "holograms[0] (in_coupler).orders: must list each order once, got",
    ),
    ("holograms=[]", "holograms: must hold at least one hologram, got []"),
    ("source.patch=lost", "source.patch: must name a hologram (in_coupler, out_coupler), got"),
    ("display.luminance_cd_m2=-1", "display.luminance_cd_m2: must be at least 0, got -1"),
    ("display.primaries=gas", "display.primaries: must be one of led_rgb, laser_rgb, oled_rgb"),
    ("display.primaries=[]", "display.primaries: must be a list of length 3, got []"),
    ("display.white=F11", 'display.white: must be one of D65, E, A, got "F11"'),
    ("eye.pupil_diameter_mm=0", "eye.pupil_diameter_mm: must be above 0, got 0"),
    ("eye.focus_mm=0", "eye.focus_mm: must be above 0, got 0"),
    ("eye.field_deg=180", "eye.field_deg: must be below 180, got 180"),
    ("eyebox.grid=[0, 3]", "eyebox.grid[0]: must be from 1 to 101, got 0"),
    ("room.kind=cave", "room.kind: must be one of desk, living_room, none"),
    ("render.mode=fast", "render.mode: must be one of preview, spectral"),
    ("render.size=[640]", "render.size: must be a list of length 2, got [640]"),
    ("render.samples=0", "render.samples: must be from 1 to 1000000, got 0"),
    ("render.preview_wavelength_nm=100", "render.preview_wavelength_nm: must be from 200 to 20000"),
]


@pytest.mark.parametrize(("change", "message"), BROKEN)
def test_each_rule_names_field_and_value(change: str, message: str) -> None:
    with pytest.raises(SpecError) as caught:
        load_device(AR, [change])
    assert str(caught.value).startswith(f"{AR}: {message}")


def test_primaries_must_mix_the_white() -> None:
    lines = [{"centre_nm": centre, "fwhm_nm": 5} for centre in (625, 620, 615)]
    with pytest.raises(SpecError, match=r"display\.primaries: must be able to mix the white D65"):
        load_device(AR, [f"display.primaries={json.dumps(lines)}"])


def test_touching_patches_are_fine() -> None:
    # The out-coupler ends at x = 14, and the in-coupler is 6 mm wide.
    spec = load_device(AR, ["holograms.in_coupler.center_mm=[17, 0]"])
    assert spec.patch("in_coupler").center_mm == (17.0, 0.0)


def test_guide_medium_is_named_where_it_stands() -> None:
    bad = {"sellmeier": {"b": [-1, 0, 0], "c_um2": [0.01, 0, 0]}}
    with pytest.raises(SpecError, match=r"guide\.medium: must have an index of at least 1 at 532"):
        load_device(AR, [f"guide.medium={json.dumps(bad)}"])


def test_patch_as_hologram() -> None:
    spec = load_device(AR)
    patch = spec.patch("out_coupler")
    hologram = patch.hologram(spec.guide)
    assert hologram.media.back == spec.guide.medium
    assert hologram.media.front == "air"
    assert hologram.surface.size_mm == patch.size_mm
    assert spec.guide.face_z_mm("eye") == -18.0
    assert spec.guide.face_z_mm("world") == -18.0 - spec.guide.thickness_mm
    with pytest.raises(SpecError, match="in_coupler, out_coupler"):
        spec.patch("lost")


def test_own_file_with_its_picture(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    shutil.copy(preset_paths()[AR], path)
    with pytest.raises(
        SpecError, match=r"display\.image: must be chart, white, dots, bars, reticle, speed or a"
    ):
        load_device(path, ["display.image=photo.png"])
    (tmp_path / "photo.png").touch()
    spec = load_device(path, ["display.image=photo.png"])
    assert picture_paths(spec, path.parent) == {"display.image": tmp_path / "photo.png"}
    assert picture_paths(load_device(AR), tmp_path) == {}


def test_override_by_index_and_by_name() -> None:
    document = to_document(load_device(AR))
    changes = [
        "holograms.out_coupler.size_mm.0=20",
        "holograms.0.efficiency.table.T.1=0.5",
        "eye.focus_mm=1000",
        "title=far and wide",
        'description="42"',
    ]
    spec = device_from(override(document, changes))
    assert isinstance(spec, LightGuideSpec)
    assert spec.patch("out_coupler").size_mm == (20.0, 20.0)
    assert spec.patch("in_coupler").hologram(spec.guide).orders == (0, 1)
    assert (spec.eye.focus_mm, spec.title, spec.description) == (1000.0, "far and wide", "42")
    assert document == to_document(load_device(AR))


def test_defaults_that_the_file_leaves_out_can_be_set(tmp_path: Path) -> None:
    document = preset()
    del document["render"]["seed"]
    path = tmp_path / "mine.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert load_device(path, ["render.seed=7"]).render.seed == 7


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("guide.thick=1", "guide.thick: no such field, there is: medium, outside, thickness_mm"),
        ("holograms.lost.face=eye", "holograms.lost: no such field, there is: in_coupler, out_c"),
        ("holograms.2.face=eye", "holograms.2: no such field, there is: in_coupler, out_coupler"),
        ("guide.size_mm.2=1", "guide.size_mm.2: no such field, there is: 0, 1"),
        ("name.first=x", "name.first: no such field, there is: nothing below it"),
        ("render.samples", '--set: must be path.to.field=value, got "render.samples"'),
        ("render.samples=NaN", "render.samples: must be a finite number, got NaN"),
        ("render.samples=many", 'render.samples: must be a whole number, got "many"'),
    ],
)
def test_override_tells_what_exists(change: str, message: str) -> None:
    with pytest.raises(SpecError) as caught:
        load_device(AR, [change])
    assert str(caught.value).startswith(f"{AR}: {message}")
