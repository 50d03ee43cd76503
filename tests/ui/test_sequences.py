# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random sequences of operators, sliders and undo: no error, and a file that keeps all of it."""

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.document import live
from hoe_addon.blender.document.held import document_of, has_device
from hoe_addon.blender.props.sync import refresh
from hoe_addon.core.errors import HoeError, NotMadeError
from hoe_addon.ui.overlay import failure
from tests.ui.kept import differences, documents, holograms, shaders
from tests.ui.random_steps import Steps
from tests.ui.window import Window

COUNT, FEW = 200, 6
RENDERED = 10
"""Every so manieth sequence is rendered."""


@pytest.fixture
def window(
    registered: Any, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> Window:
    """A window that nobody sees."""
    return Window(monkeypatch, lambda: "".join(capfd.readouterr()))


class Sequence:
    """One sequence: steps with undo and redo between.

    Attributes:
        steps: Its steps.
    """

    def __init__(self, window: Window, seed: int, folder: Path) -> None:
        self.window = window
        self.rng = random.Random(seed)
        self.steps = Steps(self.rng, folder, [], set(), [])
        self._known: list[dict[str, Any]] = []
        self._place = -1

    def run(self) -> None:
        """Take 5 to 12 steps; after each the window settles."""
        self.window.begin(empty=self.rng.random() < 0.5)
        failure.forget()
        self._keep()
        for _ in range(self.rng.randint(5, 12)):
            self.steps.calls = self.window.calls
            self.steps.take()
            self._keep()
            if self.rng.random() < 0.3:
                self._back_and_forth()

    def _keep(self) -> None:
        """Close an undo step, as a window does, and settle."""
        bpy.ops.ed.undo_push(message="step")
        self.window.settle()
        self._place += 1
        self._known[self._place :] = [documents()]

    def _back_and_forth(self) -> None:
        for _ in range(self.rng.randint(1, 3)):
            if self._place > 0:
                self._go(-1, bpy.ops.ed.undo)
        for _ in range(self.rng.randint(0, 3)):
            if self._place < len(self._known) - 1:
                self._go(+1, bpy.ops.ed.redo)

    def _go(self, way: int, operator: Callable[[], object]) -> None:
        self.steps.taken.append("undo" if way < 0 else "redo")
        operator()
        self._place += way
        self.window.settle()
        if bpy.data.actions:
            # Keys bring their own values back, whatever was set by hand since.
            return
        found = differences(documents(), self._known[self._place])
        assert not found, f"after {self.steps.taken[-1]}, found and wanted: {found}"


def is_valid(scene: Any) -> bool:
    """Whether its document can be read."""
    try:
        document_of(scene)
    except HoeError:
        return False
    return True


def settle_scenes() -> dict[str, tuple[str, ...]]:
    """Bring all devices up to date, as the next change does; return what was made."""
    made: dict[str, tuple[str, ...]] = {}
    for scene in bpy.data.scenes:
        if has_device(scene) and is_valid(scene):
            made[scene.name] = live.settle(scene)
    return {name: parts for name, parts in made.items() if parts}


def assert_settled() -> None:
    """A refresh changes nothing."""
    before = shaders()
    for material in holograms():
        try:
            assert not refresh(material, make=False), material.name
        except NotMadeError:
            continue
    assert not (made := settle_scenes()), made
    found = differences(shaders(), before, rounded=True)
    assert not found, f"refreshed and before: {found}"


def small_picture(folder: Path) -> np.ndarray:
    """Render the scene of the window."""
    bpy.context.scene.render.filepath = str(folder / "picture.exr")
    bpy.ops.render.render(write_still=True, scene=bpy.context.scene.name)
    image = bpy.data.images.load(str(folder / "picture.exr"))
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels


def make_small(scene: Any) -> None:
    """Make its picture quick and always the same."""
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    scene.render.resolution_percentage = 100
    scene.cycles.samples, scene.cycles.seed = 4, 7
    scene.cycles.use_adaptive_sampling = False
    scene.render.image_settings.file_format = "OPEN_EXR"


def check_file(window: Window, folder: Path, *, rendered: bool) -> None:
    """Save, open, and compare."""
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    scene = bpy.context.scene
    make_small(scene)
    for each in bpy.data.scenes:
        # What has keys and was changed all the same is as its keys say, as after opening.
        each.frame_set(each.frame_current)
    window.settle()
    # Blender's own operators change what no property notes, such as how many lamps there are.
    settle_scenes()
    assert_settled()
    rendered = rendered and scene.camera is not None and scene.render.engine == "CYCLES"
    before = documents(), shaders()
    pictures = [small_picture(folder)] if rendered else []
    path = str(folder / "sequence.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    window.open(path)
    window.settle()
    # Materials that only orphans use go with them.
    after = documents(), shaders()
    for one, other in zip(before, after, strict=True):
        found = differences(other, {name: one[name] for name in one if name in other})
        assert not found, f"opened and saved: {found}"
    assert_settled()
    if rendered:
        pictures.append(small_picture(folder))
        assert np.array_equal(*pictures)


def play(window: Window, seed: int, folder: Path) -> set[str]:
    """Play a sequence to its end; return the operators that it called."""
    folder.mkdir()
    sequence = Sequence(window, seed, folder)
    try:
        sequence.run()
        sequence.steps.taken.append("save and open")
        check_file(window, folder, rendered=seed % RENDERED == 0)
    except (HoeError, Exception) as error:
        steps = "\n  ".join(sequence.steps.taken)
        raise AssertionError(f"sequence {seed}:\n  {steps}\n{error}") from error
    return sequence.steps.called


@pytest.mark.parametrize("seed", range(FEW))
def test_sequence(window: Window, seed: int, tmp_path: Path) -> None:
    play(window, seed, tmp_path / str(seed))


@pytest.mark.slow
@pytest.mark.parametrize("start", range(0, COUNT, 20))
def test_many_sequences(window: Window, start: int, tmp_path: Path) -> None:
    for seed in range(start, start + 20):
        play(window, seed, tmp_path / str(seed))
