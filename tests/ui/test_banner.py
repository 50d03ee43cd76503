# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The banner: one trouble, in plain words, with the button that mends it."""

from collections.abc import Callable
from typing import Any

import bpy
import pytest
from msgspec.structs import replace

from hoe_addon.blender import readiness
from hoe_addon.blender.add.presets import add_scene
from hoe_addon.blender.readiness import Mend
from hoe_addon.model.document import load_device
from hoe_addon.ui.ids import Op
from tests.ui.layouts import Drawn, draw

PLACES = ("sidebar", "material", "scene", "render")


@pytest.fixture
def scene(registered: Any) -> Any:
    """The point lens, without its room, as the scene of the window."""
    spec = load_device("point_lens")
    made = add_scene(replace(spec, room=replace(spec.room, kind="none")))
    bpy.context.window.scene = made
    return made


def banner(place: str = "sidebar") -> Drawn | None:
    return draw(getattr(bpy.types, f"HOE_PT_banner_{place}"))


def _eevee(scene: Any) -> None:
    scene.render.engine = "BLENDER_EEVEE"


def _no_osl(scene: Any) -> None:
    scene.cycles.shading_system = False


def _denoised(scene: Any) -> None:
    scene.cycles.use_denoising = True


def _other_camera(scene: Any) -> None:
    scene.camera = None


def _no_blur(scene: Any) -> None:
    scene.render.use_motion_blur = False


def test_all_is_well_and_nothing_is_shown(scene: Any) -> None:
    assert all(banner(place) is None for place in PLACES)
    with pytest.raises(RuntimeError, match="nothing to mend"):
        bpy.ops.hologram.mend()


def test_scene_without_holograms_has_no_banner(registered: Any) -> None:
    _eevee(registered)
    assert banner() is None


@pytest.mark.parametrize(
    ("break_it", "mend"),
    [
        (_eevee, Mend.ENGINE),
        (_no_osl, Mend.OSL),
        (_denoised, Mend.COLOURS),
        (_other_camera, Mend.CAMERA),
        (_no_blur, Mend.WAVELENGTHS),
    ],
)
def test_one_click_mends(scene: Any, break_it: Callable[[Any], None], mend: Mend) -> None:
    break_it(scene)
    for place in PLACES:
        shown = banner(place)
        assert shown is not None
        assert any(call.alert for call in shown.of("label"))
        (button,) = shown.of("operator")
        assert button.name == Op.MEND
        assert button.text
        assert button.assigned["mend"] == mend
    assert bpy.ops.hologram.mend(mend=mend) == {"FINISHED"}
    assert banner() is None


def test_build_without_osl_has_no_button(scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(readiness, "has_osl", lambda: False)
    shown = banner()
    assert shown is not None
    assert "no Open Shading Language" in shown.words()
    assert not shown.operators()


def test_only_the_worst_is_shown(scene: Any) -> None:
    _denoised(scene)
    _eevee(scene)
    shown = banner()
    assert shown is not None
    assert [call.assigned["mend"] for call in shown.of("operator")] == [Mend.ENGINE]


def test_trouble_that_is_gone_is_told(scene: Any) -> None:
    _denoised(scene)
    with pytest.raises(RuntimeError, match="is no trouble of this scene any more"):
        bpy.ops.hologram.mend(mend=Mend.ENGINE)
