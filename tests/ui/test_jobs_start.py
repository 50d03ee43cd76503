# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Starting jobs: the copy of the file, the command, the folder for results, and what is refused."""

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.document.held import whole
from hoe_addon.blender.document.holding import hold
from hoe_addon.blender.job_files import COPY, Description, JobKind
from hoe_addon.blender.pictures import exr
from hoe_addon.core.errors import HoeError
from hoe_addon.files import OutputError
from hoe_addon.model.document import load_device
from hoe_addon.ui.ids import Op
from hoe_addon.ui.jobs import current, launch, pictures, places, status_bar
from hoe_addon.ui.jobs.job import Job
from tests.ui.layouts import Call, Layout

SLEEPER = "import sys; sys.stdin.read()"


@pytest.fixture
def device(registered: Any) -> Any:
    """A scene that holds a small device."""
    spec = load_device("holographic_sight", ["render.size=[16, 12]", "render.quality=null"])
    built = build_device(bpy.context.scene, whole(spec), resources.PRESETS_DIR)
    hold(DeviceScene(**{**vars(built), "spec": spec}))
    return built.scene


@pytest.fixture
def asleep(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes that only wait until they are ended."""
    command = [sys.executable, "-c", SLEEPER]
    monkeypatch.setattr(launch, "command_line", lambda _folder: command)


def test_copy_leaves_the_open_file_as_it_is(device: Any, asleep: None, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
    before = bpy.data.filepath, bpy.data.is_dirty, bpy.data.is_saved
    preview = bpy.context.preferences.filepaths.file_preview_type
    job = launch.launch(JobKind.RENDER, "Render", device, None, {"denoise": True})
    try:
        assert (bpy.data.filepath, bpy.data.is_dirty, bpy.data.is_saved) == before
        assert bpy.context.preferences.filepaths.file_preview_type == preview
        assert (job.folder / COPY).stat().st_size > 0
        description = Description.read(job.folder)
        assert (description.kind, description.scene) == (JobKind.RENDER, device.name)
        assert description.settings == {"denoise": True}
        assert job.is_running
    finally:
        job.discard()
    assert not job.folder.exists()


def test_paths_in_the_copy_lead_to_the_same_files(
    device: Any, asleep: None, tmp_path: Path
) -> None:
    picture = tmp_path / "photo.png"
    made = bpy.data.images.new("Photo", 4, 4)
    made.filepath_raw, made.file_format = str(picture), "PNG"
    made.save()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
    image = bpy.data.images.load(str(picture))
    image.filepath = "//photo.png"
    device.render.filepath = "//"
    image.use_fake_user = True
    job = launch.launch(JobKind.RENDER, "Render", device)
    try:
        with bpy.data.libraries.load(str(job.folder / COPY)) as (source, wanted):
            wanted.images = [name for name in source.images if name == image.name]
        copied = wanted.images[0]
        assert Path(bpy.path.abspath(copied.filepath, library=copied.library)).resolve() == picture
        assert image.filepath == "//photo.png"
    finally:
        job.discard()


def test_failure_to_start_leaves_nothing(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    before = set(Path(bpy.app.tempdir).iterdir())
    monkeypatch.setattr(launch, "command_line", lambda _folder: ["/nonexistent/blender"])
    with pytest.raises(HoeError, match="Render: cannot be started: No such file or directory"):
        launch.launch(JobKind.RENDER, "Render", device)
    assert set(Path(bpy.app.tempdir).iterdir()) == before


def test_command_of_the_bpy_module_and_of_blender(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(launch, "_PACKAGE", "hoe_addon")
    module = launch.command_line(tmp_path)
    assert module[:2] == [sys.executable, "-c"]
    beside = str(Path(launch.__file__).parents[3])
    assert module[-4:] == [str(tmp_path), beside, "", "hoe_addon"]
    program = launch.command_line(tmp_path, "/opt/blender")
    assert program[0] == "/opt/blender"
    assert "--background" in program
    assert "--disable-autoexec" in program
    assert program.index("--python-expr") < program.index("--") == len(program) - 5
    assert program[-4:] == module[-4:]


def test_command_inside_an_extension(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(launch, "_PACKAGE", "repo.user.hoe_addon.hoe_addon")
    assert launch.command_line(tmp_path)[-3:] == [
        "",
        "repo.user.hoe_addon",
        "repo.user.hoe_addon.hoe_addon",
    ]


def test_scripts_of_a_file_run_only_with_consent(clean_scene: Any) -> None:
    preferences = bpy.context.preferences.filepaths
    kept = preferences.use_scripts_auto_execute
    try:
        preferences.use_scripts_auto_execute = False
        assert launch.runs_scripts()
        bpy.data.texts.new("start.py").use_module = True
        assert not launch.runs_scripts()
        preferences.use_scripts_auto_execute = True
        assert launch.runs_scripts()
    finally:
        preferences.use_scripts_auto_execute = kept


class TestPlaces:
    def test_beside_the_file_and_numbered(self, clean_scene: Any, tmp_path: Path) -> None:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        first = places.next_place(clean_scene, "render")
        second = places.next_place(clean_scene, "render")
        assert first.folder == tmp_path / "renders" / "Scene" / "render_001"
        assert second.folder == tmp_path / "renders" / "Scene" / "render_002"
        assert first.words == ""

    def test_of_a_file_that_is_not_saved(self, clean_scene: Any) -> None:
        place = places.next_place(clean_scene, "render")
        try:
            assert place.folder.is_dir()
            assert Path(bpy.app.tempdir) not in place.folder.parents
            assert "not saved" in place.words
        finally:
            remove_empty(place)

    def test_name_of_a_scene_leads_nowhere_else(self, clean_scene: Any, tmp_path: Path) -> None:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        clean_scene.name = "../../etc/x"
        place = places.next_place(clean_scene, "render")
        assert tmp_path / "renders" == place.folder.parents[1]

    def test_empty_folders_go_and_others_stay(self, clean_scene: Any, tmp_path: Path) -> None:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        place = places.next_place(clean_scene, "render")
        Job(JobKind.RENDER, "Render", tmp_path / "none", place, 0).discard()
        assert not (tmp_path / "renders").exists()
        kept = tmp_path / "own"
        kept.mkdir()
        (kept / "views").mkdir()
        given = places.given_place(str(kept))
        Job(JobKind.RENDER, "Render", tmp_path / "none", given, 0).discard()
        given = places.given_place(str(kept / "new"))
        Job(JobKind.RENDER, "Render", tmp_path / "none", given, 0).discard()
        assert (kept / "views").exists()
        assert not given.folder.exists()

    def test_folder_that_cannot_be_written(self, clean_scene: Any, tmp_path: Path) -> None:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        (tmp_path / "renders").write_text("a file")
        with pytest.raises(OutputError, match="cannot be written"):
            places.next_place(clean_scene, "render")


def remove_empty(place: places.Place) -> None:
    for made in place.made:
        if made.exists():
            made.rmdir()


class TestOperators:
    def test_no_device(self, registered: Any) -> None:
        for run in (bpy.ops.hologram.render, bpy.ops.hologram.eyebox, bpy.ops.hologram.accuracy):
            with pytest.raises(RuntimeError, match="holds no device; add one with Add > Hologram"):
                run()

    def test_scene_has_no_eyebox(self, device: Any) -> None:
        with pytest.raises(RuntimeError, match="Only a light guide has an eyebox"):
            bpy.ops.hologram.eyebox()

    def test_no_hologram_to_bake(self, registered: Any) -> None:
        with pytest.raises(RuntimeError, match="active material is a hologram"):
            bpy.ops.hologram.bake_table()

    def test_nothing_to_cancel(self, registered: Any) -> None:
        with pytest.raises(RuntimeError, match="No job is at work"):
            bpy.ops.hologram.cancel()

    def test_without_an_eye_nothing_is_rendered(self, device: Any) -> None:
        assert bpy.ops.hologram.render.poll()
        device.hologram.eye.camera = None
        with pytest.raises(RuntimeError, match="This scene has no eye; add one"):
            bpy.ops.hologram.render()

    def test_document_that_is_not_valid_is_told_before_anything(
        self, device: Any, tmp_path: Path
    ) -> None:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "mine.blend"))
        device.hologram.eye.camera.scale = (1.0, 2.0, 1.0)
        with pytest.raises(RuntimeError, match=r"eye\.scale: must be the same"):
            bpy.ops.hologram.render()
        assert not (tmp_path / "renders").exists()

    def test_one_job_at_a_time(self, device: Any, asleep: None) -> None:
        job = launch.launch(JobKind.RENDER, "Render", device)
        current.begin(job)
        try:
            assert current.running(bpy.context) is job
            with pytest.raises(RuntimeError, match="Only one job at a time: Render is at work"):
                bpy.ops.hologram.accuracy()
            bpy.ops.hologram.cancel()
            assert job.asked
            assert job.is_running
        finally:
            current.unregister()
        assert current.running() is None
        assert not job.folder.exists()
        assert not job.is_running

    def test_disabling_ends_the_job(self, clean_scene: Any, asleep: None) -> None:
        import hoe_addon

        hoe_addon.register()
        job = launch.launch(JobKind.RENDER, "Render", clean_scene)
        current.begin(job)
        hoe_addon.unregister()
        assert not job.is_running
        assert not job.folder.exists()
        assert not bpy.app.timers.is_registered(current._look)


def test_picture_is_loaded_once_and_anew(clean_scene: Any, tmp_path: Path) -> None:
    for number, value in enumerate((0.25, 0.5)):
        path = tmp_path / f"view{number}.exr"
        exr.write(path, np.full((4, 6, 3), value, dtype=np.float32))
        image = pictures.load_picture(path, pictures.PICTURE)
        assert image.name == "Hologram Render"
        assert image.colorspace_settings.name == "Linear Rec.709"
        assert image.use_view_as_render
        assert image.pixels[0] == value
    assert len(bpy.data.images) == 1


def test_picture_of_the_user_with_our_name_stays(clean_scene: Any, tmp_path: Path) -> None:
    mine = bpy.data.images.new(pictures.PICTURE, 4, 4)
    path = tmp_path / "view.exr"
    exr.write(path, np.full((4, 6, 3), 0.5, dtype=np.float32))
    first, second = (pictures.load_picture(path, pictures.PICTURE) for _ in range(2))
    assert first == second != mine
    assert mine.source == "GENERATED"
    assert len(bpy.data.images) == 2


def test_end_is_told_anew_where_blender_has_ended_the_telling(
    device: Any, asleep: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    job = launch.launch(JobKind.RENDER, "Render", device)
    told: list[str] = []
    fake = SimpleNamespace(job_ended=told.append)
    monkeypatch.setattr(current.bpy.ops, "hologram", fake, raising=False)
    current.begin(job)
    try:
        job.process.end()
        assert not job.is_running
        assert current._look() == current._look() == pytest.approx(0.1)
        assert told == ["INVOKE_DEFAULT"] * 2
        assert current.take_ended() is job
        assert current._look() is None
    finally:
        current.unregister()
        job.discard()


def drawn() -> list[Call]:
    """What the status bar shows of a job."""
    layout = Layout()
    status_bar.draw(SimpleNamespace(layout=layout), bpy.context)
    return layout.calls


class TestStatusBar:
    def test_shows_the_job_and_a_way_to_end_it(self, device: Any, asleep: None) -> None:
        assert drawn() == []
        job = launch.launch(JobKind.RENDER, "Render", device)
        current.begin(job)
        assert job.process is not None
        job.process.share, job.process.words = 0.42, "error 0.08 so far"
        try:
            bar, button, label = drawn()
        finally:
            current.unregister()
        assert (bar.text, bar.options["factor"]) == ("Render 42 %", 0.42)
        assert button.name == Op.CANCEL
        assert label.text == "error 0.08 so far, 0 s; Esc ends and keeps what is done"

    def test_esc_is_for_the_job(self, registered: Any) -> None:
        keymap = bpy.context.window_manager.keyconfigs.addon.keymaps["Window"]
        items = [item for item in keymap.keymap_items if item.idname == Op.CANCEL]
        assert [(item.type, item.value) for item in items] == [("ESC", "PRESS")]
