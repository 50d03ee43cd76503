# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs from end to end: real processes, real renders."""

import json
import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

import hoe_addon
from hoe_addon import resources
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.document.held import document_of, whole
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.document.live import remember
from hoe_addon.blender.job_files import JobKind
from hoe_addon.blender.pictures import exr
from hoe_addon.cli import main
from hoe_addon.files import VIEW_FILES
from hoe_addon.model.document import load_device, to_document
from hoe_addon.ui.facts.study import eyebox_of
from hoe_addon.ui.jobs.ending import finish
from hoe_addon.ui.jobs.launch import launch
from hoe_addon.ui.jobs.places import given_place

pytestmark = [pytest.mark.render, pytest.mark.slow]

LONG_S = 200.0
SIZE = "render.size=[32, 24]"
FEW = ("render.samples=4", "render.quality=null")

RELIEF = {"profile": {"shape": "binary", "depth_um": 0.5}, "ridge": 1.5, "harmonics": 5}
COARSE = {"tolerance": 0.1, "wavelengths_nm": [530.0, 535.0]}

ROUNDING = 1e-4
"""Places are float32 in a file, and the command makes them anew from the document."""

type Hold = Callable[..., bpy.types.Scene]


@pytest.fixture
def held(clean_scene: Any, tmp_path: Path) -> Iterator[Hold]:
    """A saved file with a scene that holds a preset; nothing of a job is left at the end."""
    hoe_addon.register()

    def made(name: str, *changes: str) -> bpy.types.Scene:
        spec = load_device(name, [SIZE, *changes])
        built = build_device(bpy.context.scene, whole(spec), resources.PRESETS_DIR)
        hold(DeviceScene(**{**vars(built), "spec": spec}))
        remember(built.scene)
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        return built.scene

    yield made
    hoe_addon.unregister()
    assert not list(Path(bpy.app.tempdir).glob("hoe_job_*"))
    assert bpy.data.filepath in ("", str(tmp_path / "mine.blend"))
    assert os.waitpid(-1, os.WNOHANG) == (0, 0) if has_children() else True


def has_children() -> bool:
    try:
        os.waitid(os.P_ALL, 0, os.WNOHANG | os.WEXITED | os.WNOWAIT)
    except ChildProcessError:
        return False
    return True


class Reports:
    """Takes reports as an operator does."""

    def __init__(self) -> None:
        self.said: list[tuple[set[str], str]] = []

    def report(self, level: set[str], words: str) -> None:
        self.said.append((level, words))


def until(found: Callable[[], Any]) -> None:
    end = time.monotonic() + LONG_S
    while not found():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.02)


@pytest.mark.parametrize("name", ["holographic_sight", "two_hologram_ar"])
def test_picture_is_that_of_the_command_line(held: Hold, tmp_path: Path, name: str) -> None:
    scene = held(name, *FEW)
    folder = as_by_command(scene, tmp_path, (32, 24))
    assert sorted(path.name for path in folder.iterdir()) == sorted(VIEW_FILES)


@pytest.mark.parametrize(
    ("sides", "percentage", "size"), [((64, 48), 50, (32, 24)), ((100, 83), 29, (29, 24))]
)
def test_percentage_of_the_resolution_counts(
    held: Hold, tmp_path: Path, sides: tuple[int, int], percentage: int, size: tuple[int, int]
) -> None:
    scene = held("holographic_sight", *FEW)
    scene.render.resolution_x, scene.render.resolution_y = sides
    scene.render.resolution_percentage = percentage
    folder = as_by_command(scene, tmp_path, size)
    assert exr.read(folder / "view.exr").shape == (size[1], size[0], 3)


def as_by_command(scene: bpy.types.Scene, tmp_path: Path, size: tuple[int, int]) -> Path:
    """Render by the button and by the command; the folder of the first."""
    (tmp_path / "device.json").write_text(json.dumps(to_document(document_of(scene))))
    assert bpy.ops.hologram.render() == {"FINISHED"}
    folder = tmp_path / "renders" / "Scene" / "render_001"
    image = bpy.data.images["Hologram Render"]
    assert tuple(image.size) == size
    device, out = str(tmp_path / "device.json"), str(tmp_path / "out")
    assert main(["render", device, "--out", out, "--no-denoise"]) == 0
    ours, theirs = exr.read(folder / "view.exr"), exr.read(tmp_path / "out" / "view.exr")
    assert np.mean(theirs) > 0.0
    assert np.mean(np.abs(ours - theirs)) <= ROUNDING * np.mean(theirs)
    return folder


def test_change_that_the_window_has_not_followed_yet_is_in_the_picture(
    held: Hold, tmp_path: Path
) -> None:
    scene = held("holographic_sight", *FEW)
    bpy.ops.hologram.render(folder=str(tmp_path / "before"))
    panel = next(item for item in scene.objects if item.hologram.role == "display")
    panel.hologram.display.luminance_cd_m2 *= 4.0
    bpy.ops.hologram.render(folder=str(tmp_path / "after"))
    before, after = (
        json.loads((tmp_path / name / "metrics.json").read_text())["emitters"]["mean_cd_m2"]
        for name in ("before", "after")
    )
    assert after == pytest.approx(4.0 * before, rel=1e-3)


def test_stopped_render_keeps_its_picture(held: Hold, tmp_path: Path) -> None:
    scene = held("holographic_sight", 'render.quality={"error": 0.0001}')
    place = given_place(str(tmp_path / "out"))
    job = launch(JobKind.RENDER, "Render", scene, place, {"denoise": True})
    assert job.process is not None
    until(lambda: "so far" in job.words or not job.is_running)
    job.cancel()
    until(lambda: not job.is_running)
    reports: Any = Reports()
    assert finish(reports, bpy.context, job) == {"FINISHED"}
    ((level, words),) = reports.said
    assert level == {"INFO"}
    assert words.startswith("Render: error ")
    assert words.endswith(f", stopped by the user; 4 files in {tmp_path / 'out'}")
    metrics = json.loads((tmp_path / "out" / "metrics.json").read_text())
    assert metrics["reached"]["end"] == "stopped"
    assert exr.read(tmp_path / "out" / "view.exr").max() > 0.0


def test_eyebox_tells_the_panel(held: Hold, tmp_path: Path) -> None:
    scene = held("two_hologram_ar", *FEW, "eyebox.grid=[2, 1]")
    assert bpy.ops.hologram.eyebox(field_samples=4) == {"FINISHED"}
    folder = tmp_path / "renders" / "Scene" / "eyebox_001"
    report = json.loads((folder / "eyebox.json").read_text())
    assert len(report["positions"]) == 2
    assert not report["stopped_by_user"]
    assert len(list((folder / "views").glob("*.exr"))) == 2
    facts = eyebox_of(scene)
    assert facts is not None
    assert facts.folder == str(folder)


def test_stopped_eyebox_keeps_the_positions_that_are_done(held: Hold, tmp_path: Path) -> None:
    scene = held("two_hologram_ar", *FEW, "eyebox.grid=[60, 1]", "eyebox.pitch_mm=[0.05, 0.05]")
    settings = {"field_samples": 4, "denoise": False}
    place = given_place(str(tmp_path / "out"))
    job = launch(JobKind.EYEBOX, "Eyebox", scene, place, settings)
    until(lambda: list((tmp_path / "out" / "views").glob("*.png")) or not job.is_running)
    job.cancel()
    until(lambda: not job.is_running)
    reports: Any = Reports()
    assert finish(reports, bpy.context, job) == {"FINISHED"}
    report = json.loads((tmp_path / "out" / "eyebox.json").read_text())
    assert report["stopped_by_user"]
    assert 0 < len(report["positions"]) < 60
    assert " of 60 positions; white field: brightest pupil" in reports.said[0][1]


def test_accuracy_writes_its_page(held: Hold, tmp_path: Path) -> None:
    held("grating_rainbow", *FEW)
    assert bpy.ops.hologram.accuracy(budget=6.0) == {"FINISHED"}
    folder = tmp_path / "renders" / "Scene" / "accuracy_001"
    assert {"accuracy.json", "accuracy.csv", "accuracy.html"} <= {
        path.name for path in folder.iterdir()
    }


def test_bake_fills_the_cache_for_the_window(
    held: Hold, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path / "cache"))
    held("grating_rainbow", *FEW)
    item = next(each for each in bpy.data.objects if each.hologram.role == "hologram")
    bpy.context.view_layer.objects.active = item
    efficiency = item.active_material.hologram.efficiency
    efficiency.model, efficiency.rcwa_details = "rcwa", json.dumps(RELIEF)
    efficiency.common_details = json.dumps({"lookup": COARSE})
    assert bpy.ops.hologram.bake_table() == {"FINISHED"}
    assert list((tmp_path / "cache").glob("table-*.exr"))
    assert item.active_material.hologram.problem == ""


def test_what_cannot_be_rendered_is_told_once(held: Hold, tmp_path: Path) -> None:
    scene = held("holographic_sight", *FEW)
    scene.hologram.render.effects.add().name = "-no_such_effect"
    with pytest.raises(RuntimeError, match=r"Error: Render: .*no_such_effect") as told:
        bpy.ops.hologram.render(folder=str(tmp_path / "out"))
    assert str(told.value).count("\n") <= 1
    assert not (tmp_path / "out").exists()
