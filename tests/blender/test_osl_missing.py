# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where holograms cannot be rendered: a build without OSL, a device that cannot run it."""

import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.build.device import build_device
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.blender.shaders import osl
from hoe_addon.cli import main
from hoe_addon.core.errors import MissingOslError
from hoe_addon.model.document import find_device, hologram_from, load_device
from hoe_addon.model.rays import RayTable
from hoe_addon.shading.source import ShaderSource

PRESET = "two_hologram_ar"
REFUSAL = rf"this Blender \({bpy.app.version_string}\) was built without .* use the official build"
LENS = Path(__file__).parents[1] / "documents" / "lens.json"
CHEAP = {"samples": 1, "seed": 0, "spectral": True, "max_bounces": 8}


@pytest.fixture
def without_osl(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cycles as it is where Blender was built without OSL."""
    monkeypatch.setattr("_cycles.with_osl", False)


def preferences(monkeypatch: pytest.MonkeyPatch, kind: str) -> None:
    """Let the preferences of Cycles name a kind of GPU that this machine need not have."""
    cycles = SimpleNamespace(preferences=SimpleNamespace(compute_device_type=kind))
    context = SimpleNamespace(preferences=SimpleNamespace(addons={"cycles": cycles}))
    stand_in = SimpleNamespace(context=context, app=bpy.app, types=bpy.types)
    monkeypatch.setattr(osl, "bpy", stand_in)


def test_this_build_has_osl() -> None:
    assert osl.has_osl()
    osl.require_osl()


def test_a_build_without_cycles_has_no_osl(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "_cycles", None)
    assert not osl.has_osl()


def test_a_cycles_without_osl_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = ModuleType("_cycles")
    plain.with_osl = False  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "_cycles", plain)
    assert not osl.has_osl()


@pytest.mark.usefixtures("without_osl")
def test_set_up_refuses(clean_scene: bpy.types.Scene) -> None:
    with pytest.raises(MissingOslError, match=REFUSAL):
        set_up(clean_scene, **CHEAP)


@pytest.mark.usefixtures("without_osl")
def test_build_device_refuses_and_leaves_the_scene_empty(clean_scene: bpy.types.Scene) -> None:
    with pytest.raises(MissingOslError, match=REFUSAL):
        build_device(clean_scene, load_device(PRESET), find_device(PRESET).parent)
    assert not bpy.data.objects
    assert not bpy.data.materials
    assert clean_scene.camera is None


@pytest.mark.usefixtures("without_osl")
def test_trace_refuses_and_leaves_no_scene(
    clean_scene: bpy.types.Scene, lens: dict[str, Any]
) -> None:
    rays = RayTable(
        origin_mm=np.array([[0.0, 0.0, -1.0]]),
        direction=np.array([[0.0, 0.0, 1.0]]),
        wavelength_nm=np.array([532.0]),
        order=np.array([1]),
        reflected=np.array([False]),
    )
    with pytest.raises(MissingOslError, match=REFUSAL):
        trace_cycles(hologram_from(lens), rays)
    assert list(bpy.data.scenes) == [clean_scene]


@pytest.mark.usefixtures("without_osl")
def test_compiling_refuses() -> None:
    with pytest.raises(MissingOslError, match=REFUSAL):
        osl.compiled(ShaderSource("hoe_new", "shader hoe_new() {} // not compiled before"))


@pytest.mark.usefixtures("without_osl")
def test_render_ends_with_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", PRESET, "--out", str(tmp_path / "out")]) == 2
    _one_line(capsys)
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("without_osl")
def test_trace_command_ends_with_one_line_and_no_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rays = tmp_path / "rays.csv"
    rays.write_text("x_mm,y_mm,z_mm,l,m,n,wavelength_nm,order,side\n0,0,-1,0,0,1,532,1,T\n")
    out = tmp_path / "out.csv"
    command = ["trace", str(LENS), str(rays), "--out", str(out), "--engine", "cycles"]
    assert main(command) == 2
    _one_line(capsys)
    assert list(tmp_path.iterdir()) == [rays]


def _one_line(capsys: pytest.CaptureFixture[str]) -> None:
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert line.startswith("hoe: error: ")
    assert bpy.app.version_string in line
    assert "without Open Shading Language" in line
    assert "bpy module" in line


@pytest.mark.parametrize("kind", ["CUDA", "HIP", "METAL", "ONEAPI"])
def test_a_gpu_that_cannot_run_osl_is_refused(
    clean_scene: bpy.types.Scene, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    clean_scene.cycles.device = "GPU"
    preferences(monkeypatch, kind)
    with pytest.raises(MissingOslError, match=f"render device {kind} cannot run .* choose CPU"):
        set_up(clean_scene, **CHEAP)
    with pytest.raises(MissingOslError, match=kind):
        build_device(clean_scene, load_device(PRESET), find_device(PRESET).parent)
    assert not bpy.data.objects


def test_a_gpu_does_not_matter_while_the_scene_renders_on_the_cpu(
    clean_scene: bpy.types.Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    clean_scene.cycles.device = "CPU"
    preferences(monkeypatch, "CUDA")
    set_up(clean_scene, **CHEAP)
    assert clean_scene.cycles.shading_system


@pytest.mark.parametrize("kind", ["OPTIX", "NONE"])
def test_devices_that_run_osl_are_taken(
    clean_scene: bpy.types.Scene, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    """NONE stands in the preferences where no GPU is chosen: Cycles then takes the CPU."""
    clean_scene.cycles.device = "GPU"
    preferences(monkeypatch, kind)
    set_up(clean_scene, **CHEAP)
    assert clean_scene.cycles.shading_system
