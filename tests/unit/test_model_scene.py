# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scene documents: rules, round trips, places and directions."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from hoe_addon.core import colour
from hoe_addon.core.errors import SpecError
from hoe_addon.core.units import nm_to_m
from hoe_addon.model.document import device_from, load_device, picture_paths, to_document
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_parts import LampElement
from hoe_addon.model.scene_spectra import IlluminantSpec, LampLine, LinesSpec
from hoe_addon.model.scene_view import gaze_direction, gaze_of, image_distance_mm, rotation_of
from hoe_addon.resources import preset_paths

RAINBOW = "grating_rainbow"
SCENES = ["compact_disc", "grating_rainbow", "holographic_sight", "laser_grating", "point_lens"]

ROUNDING = 1e-12


def scene(name: str = RAINBOW, *changes: str) -> SceneSpec:
    spec = load_device(name, changes)
    assert isinstance(spec, SceneSpec)
    return spec


@pytest.mark.parametrize("name", SCENES)
def test_presets_are_scenes_that_write_themselves_back(name: str) -> None:
    spec = scene(name)
    assert device_from(to_document(spec)) == spec


def test_scene_without_elements_is_one() -> None:
    """Such is a scene of a window that holds only an eye and things that documents do not know."""
    assert scene("compact_disc", "elements=[]").elements == ()


def test_too_many_elements_are_refused() -> None:
    document = to_document(scene("compact_disc"))
    block = next(each for each in document["elements"] if each["kind"] == "block")
    document["elements"] = [block | {"name": f"block {k}"} for k in range(201)]
    with pytest.raises(SpecError, match=r"elements: must hold at most 200 elements, got 201"):
        device_from(document)


BROKEN = [
    ("elements.lamp.name=frame", 'elements[2] (frame).name: must be used once, got "frame"'),
    ("elements.lamp.kind=torch", "elements[2] (lamp).kind: must be one of "),
    (
        "elements.lamp.shape=cube",
        "elements[2] (lamp).shape: must be one of disc, line, rectangle, sph",
    ),
    ("elements.lamp.size_mm=[0, 1]", "elements[2] (lamp).size_mm[0]: must be above 0, got 0"),
    (
        "elements.lamp.luminance_cd_m2=-1",
        "elements[2] (lamp).luminance_cd_m2: must be at least 0, got",
    ),
    (
        "elements.lamp.spectrum.illuminant=F2",
        "elements[2] (lamp).spectrum.illuminant: must be one of ",
    ),
    (
        'elements.lamp.spectrum={"kind": "line", "centre_nm": 300, "fwhm_nm": 1}',
        "elements[2] (lamp).spectrum.centre_nm: must be visible, from 380 to 780, got 300",
    ),
    (
        'elements.lamp.spectrum={"kind": "led", "centre_nm": 500, "fwhm_nm": 400}',
        "elements[2] (lamp).spectrum.fwhm_nm: must be below 166.667, a third of the centre, "
        "got 400",
    ),
    (
        'elements.lamp.spectrum={"kind": "lines", "lines": [{"centre_nm": 1000, "power": 1}]}',
        "elements[2] (lamp).spectrum.lines: must have one from 380 to 780 nm, got 1",
    ),
    ("elements.lamp.spectrum={}", "elements[2] (lamp).spectrum.kind: is missing"),
    ("elements.frame.rim_mm=0", "elements[1] (frame).rim_mm: must be above 0, got 0"),
    ("elements.frame.rod_mm=-1", "elements[1] (frame).rod_mm: must be at least 0, got -1"),
    ("elements.frame.color=[2, 0, 0]", "elements[1] (frame).color[0]: must be"),
    ("elements.socket.size_mm=[1, 1]", "elements[3] (socket).size_mm: must be a list of length 3"),
    (
        "elements.grating.position_mm=[0, 0]",
        "elements[0] (grating).position_mm: must be a list of length 3",
    ),
    (
        "elements.grating.hologram.orders=[0, 0]",
        "elements[0] (grating).hologram.orders: must list each",
    ),
    (
        "elements.grating.hologram.media.back=0.5",
        "elements[0] (grating).hologram.media.back: must be at",
    ),
    ("gaze_deg=[0, 91]", "gaze_deg[1]: must be within 90, got 91"),
    ("room.kind=cave", "room.kind: must be one of "),
    ("eyebox.grid=[1, 1]", "eyebox: no such field, there is: "),
    ("render.samples=0", "render.samples: must be from 1 to 1000000, got 0"),
]


@pytest.mark.parametrize(("change", "message"), BROKEN)
def test_each_rule_names_field_and_value(change: str, message: str) -> None:
    with pytest.raises(SpecError) as caught:
        load_device(RAINBOW, [change])
    text = str(caught.value).removeprefix(f"{RAINBOW}: ")
    assert text.startswith(message)
    assert "\n" not in text


def test_pictures_beside_the_document(tmp_path: Path) -> None:
    path = tmp_path / "mine.json"
    shutil.copy(preset_paths()["point_lens"], path)
    change = "elements.display.display.image=photo.png"
    with pytest.raises(SpecError, match=r"elements\[2\]\.display\.image: must be chart, white"):
        load_device(path, [change])
    (tmp_path / "photo.png").touch()
    found = picture_paths(load_device(path, [change]), tmp_path)
    assert found == {"elements[2].display.image": tmp_path / "photo.png"}
    card = '{"kind": "card", "name": "c", "position_mm": [0, 0, -9], "image": "no", '
    card += '"size_mm": [1, 1]}'
    with pytest.raises(SpecError, match=r"elements\[0\]\.image: must be chart, white"):
        load_device(path, [f"elements=[{card}]"])


def test_elements_by_name() -> None:
    spec = scene()
    assert isinstance(spec.element("lamp"), LampElement)
    assert spec.hologram("grating").hologram.orders == (-2, -1, 0, 1, 2)
    with pytest.raises(SpecError, match="must name an element \\(grating, frame, lamp"):
        spec.element("lost")
    with pytest.raises(SpecError, match='must name a hologram, got "lamp"'):
        spec.hologram("lamp")


def test_lines_keep_their_powers() -> None:
    lines = LinesSpec(lines=(LampLine(centre_nm=500, power=1), LampLine(centre_nm=600, power=3)))
    found = lines.spectrum()(nm_to_m(np.array([500.0, 550.0, 600.0])))
    np.testing.assert_allclose(found, (1.0, 0.0, 3.0), atol=1e-9)


def test_illuminant_is_that_of_the_core() -> None:
    x, y, z = colour.xyz_of(IlluminantSpec(illuminant="E").spectrum())
    assert x / y == pytest.approx(1.0, abs=1e-3)
    assert z / y == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("gaze", [(0.0, 0.0), (30.0, 0.0), (0.0, -40.0), (-20.0, 15.0)])
def test_gaze_and_back(gaze: tuple[float, float]) -> None:
    assert gaze_of(3.0 * gaze_direction(gaze)) == pytest.approx(gaze, abs=1e-12)


def test_gaze_right_and_up() -> None:
    np.testing.assert_allclose(gaze_direction((90.0, 0.0)), (1.0, 0.0, 0.0), atol=ROUNDING)
    np.testing.assert_allclose(gaze_direction((0.0, 90.0)), (0.0, 1.0, 0.0), atol=ROUNDING)


def test_elements_turn_about_x_then_y_then_z() -> None:
    lying = scene("compact_disc").element("disc")
    np.testing.assert_allclose(rotation_of(lying) @ (0, 0, 1), (0, 1, 0), atol=ROUNDING)
    change = "elements.grating.rotation_deg=[90, 90, 0]"
    both = rotation_of(scene(RAINBOW, change).element("grating"))
    # y turns to z about x, and z to x about y.
    np.testing.assert_allclose(both @ (0, 1, 0), (1, 0, 0), atol=ROUNDING)


def test_lines_of_sight_meet_at_the_point_that_they_come_from(rng: np.random.Generator) -> None:
    point = np.array((30.0, -20.0, -5000.0))
    pupils = rng.uniform(-10.0, 10.0, (2, 3))
    rays = point - pupils
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    middle = pupils.mean(axis=0)
    expected = float((point - middle) @ rays.sum(axis=0) / np.linalg.norm(rays.sum(axis=0)))
    assert image_distance_mm(pupils, rays) == pytest.approx(expected, rel=1e-9)


def test_parallel_lines_of_sight_meet_nowhere() -> None:
    pupils = [(-5.0, 0.0, 0.0), (5.0, 0.0, 0.0)]
    ahead = [(0.0, 0.0, -1.0)] * 2
    assert image_distance_mm(pupils, ahead) == np.inf
    apart = [(-0.6, 0.0, -0.8), (0.6, 0.0, -0.8)]
    assert image_distance_mm(pupils, apart) < 0.0
