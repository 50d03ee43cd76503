# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A number of samples in rounds: the same picture, and one that can be ended early."""

from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon import resources
from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.pictures import rounds
from hoe_addon.blender.pictures.passes import whole
from hoe_addon.blender.pictures.render import COMBINED
from hoe_addon.blender.pictures.rounds import render_in_rounds
from hoe_addon.blender.pictures.view import render_view
from hoe_addon.core.errors import CancelledError
from hoe_addon.model.document import load_device

pytestmark = [pytest.mark.render, pytest.mark.slow]

SAMPLES = 16
ROUNDING = 1e-5
"""Sums of float32 pictures, in another order."""


@pytest.fixture
def device(clean_scene: Any) -> DeviceScene:
    changes = ["render.size=[16, 12]", f"render.samples={SAMPLES}", "render.quality=null"]
    spec = load_device("grating_rainbow", changes)
    return build_device(bpy.context.scene, spec, resources.PRESETS_DIR)


@pytest.fixture
def in_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rounds, "_LEAST_PATHS", 0)


def ignore(_share: float) -> None:
    """Nobody is told."""


def never() -> bool:
    return False


def test_few_samples_are_one_round_and_the_same_picture(device: DeviceScene) -> None:
    wanted = render_view(device)
    found, early = render_in_rounds(device, ignore, never)
    assert not early
    np.testing.assert_array_equal(found.picture, wanted.picture)
    np.testing.assert_array_equal(found.display, wanted.display)


def test_rounds_together_are_the_picture(device: DeviceScene, in_rounds: None) -> None:
    wanted = render_view(device)
    shares: list[float] = []
    found, early = render_in_rounds(device, shares.append, never)
    assert not early
    assert found.samples == {"whole": SAMPLES}
    assert shares == pytest.approx([number / 8 for number in range(1, 9)])
    np.testing.assert_allclose(found.picture, wanted.picture, rtol=ROUNDING, atol=ROUNDING)


@pytest.mark.parametrize("inside", [False, True], ids=["between rounds", "inside a round"])
def test_stop_keeps_the_rounds_that_are_done(
    device: DeviceScene, in_rounds: None, inside: bool
) -> None:
    shares: list[float] = []

    def progress(share: float) -> None:
        shares.append(share)
        if inside and len(shares) == 3:
            raise CancelledError("stopped")

    found, early = render_in_rounds(device, progress, lambda: not inside and len(shares) >= 2)
    assert early
    assert found.samples == {"whole": 4}
    assert device.scene.cycles.samples == 4
    # The sequence of 16 samples is another than that of 4.
    device.scene.cycles.samples = SAMPLES
    wanted = whole(device).render(device.scene.cycles.seed, 0, 4)[COMBINED]
    np.testing.assert_allclose(found.picture, wanted, rtol=ROUNDING, atol=ROUNDING)


def test_stop_before_the_first_round_leaves_nothing(device: DeviceScene, in_rounds: None) -> None:
    def stop(_share: float) -> None:
        raise CancelledError("stopped")

    with pytest.raises(CancelledError):
        render_in_rounds(device, stop, never)
