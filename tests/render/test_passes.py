# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture in passes is the picture in one, and is sooner without noise than the published way."""

import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.blender.build.device import DeviceScene, build_device
from hoe_addon.blender.pictures.division import Division, divided
from hoe_addon.blender.pictures.passes import DISPLAY_LAYER, FirstOrders, Pass, is_divisible, whole
from hoe_addon.blender.pictures.render import COMBINED, Region
from hoe_addon.core.colour import LUMINANCE_WEIGHTS
from hoe_addon.model.document import load_device
from hoe_addon.model.field import field_mask

pytestmark = pytest.mark.render

SIGMAS = 3.5
"""Of one number; a few dozen are looked at."""

PUBLISHED = ("render.wavelengths=uniform", "render.order_selection=significance")
TIMES_BETTER = 5.0
"""At equal error, the least that is aimed at."""


def _built(preset: str, *sets: str) -> DeviceScene:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    spec = load_device(preset, ['render.effects=["all"]', *sets])
    return build_device(bpy.context.scene, spec, Path())


def _terms(device: DeviceScene, region: Region) -> tuple[Pass, ...]:
    straight = Pass(device, "straight", FirstOrders.STRAIGHT, 1, 0.8, stream=1)
    around = Pass(
        device, "around", FirstOrders.DIFFRACTED, 2, 0.2, weight=0.25, inside=region, stream=2
    )
    inside = Pass(
        device, "in", FirstOrders.DIFFRACTED, 2, 0.2, region, 0.75, inside=region, stream=3
    )
    return straight, around, inside


def _blocks(picture: NDArray[Any]) -> NDArray[np.float64]:
    """Means over 8 x 8 pixels, shape (rows, columns, 3)."""
    height, width, _ = picture.shape
    cut = picture.reshape(height // 8, 8, width // 8, 8, 3)
    return cut.mean(axis=(1, 3)).astype(np.float64)


@pytest.mark.slow
@pytest.mark.parametrize("preset", ["two_hologram_ar", "holographic_sight", "compact_disc"])
def test_sum_of_passes_is_the_picture(preset: str) -> None:
    """Colours too: each pass has another distribution of wavelengths."""
    device = _built(preset, "render.size=[64,48]")
    region = Region(16, 8, 48, 40)
    ways = {"one": (whole(device),), "sum": _terms(device, region)}
    seen = {
        name: np.array(
            [
                _blocks(sum(each.render(seed, 0, 32)[COMBINED] for each in passes))
                for seed in range(8)
            ]
        )
        for name, passes in ways.items()
    }
    mean = {name: pictures.mean(axis=0) for name, pictures in seen.items()}
    spread = sum(pictures.var(axis=0, ddof=1) / len(pictures) for pictures in seen.values())
    # A block with next to no light has a spread that eight pictures do not tell.
    floor = (1e-3 * mean["one"].mean()) ** 2
    z = (mean["sum"] - mean["one"]) / np.sqrt(spread + floor)
    # Student's t with 14 degrees of freedom exceeds 3.5 in 0.4 % of all cases.
    assert np.mean(np.abs(z) > SIGMAS) < 0.02
    assert np.mean(z**2) < 1.5
    assert abs(z.mean()) < SIGMAS / np.sqrt(z.size / 3)


def test_scene_is_whole_again_after_a_pass() -> None:
    device = _built("two_hologram_ar", "render.size=[16,12]", "render.samples=1")
    render, cycles = device.scene.render, device.scene.cycles
    before = render.use_border, cycles.seed, cycles.samples, _pass_values(device)
    found = _terms(device, Region(4, 3, 12, 9))[2].render(5, 0, 2)[COMBINED]
    assert (render.use_border, cycles.seed, cycles.samples, _pass_values(device)) == before
    outside = found.copy()
    outside[3:9, 4:12] = 0.0
    assert not outside.any()
    assert found.any()


def _pass_values(device: DeviceScene) -> list[float]:
    names = {"first_orders", "first_gain", "sampling"}
    return [
        socket.default_value
        for material in bpy.data.materials
        if material.node_tree
        for node in material.node_tree.nodes
        for socket in node.inputs
        if socket.identifier in names
    ]


@pytest.mark.parametrize(
    ("size", "region"),
    [
        ((100, 75), Region(59, 31, 83, 65)),
        ((640, 480), Region(325, 118, 585, 228)),
        ((108, 60), Region(0, 0, 108, 60)),
    ],
)
def test_region_is_rendered_to_the_pixel(size: tuple[int, int], region: Region) -> None:
    """Blender cuts products of single precision off; these sizes lost a row by it."""
    device = _built("two_hologram_ar", "render.samples=1")
    render = device.scene.render
    render.resolution_x, render.resolution_y = size
    found = Pass(device, "part", region=region).render(1, 0, 1)[COMBINED].any(axis=2)
    rows, columns = np.flatnonzero(found.any(axis=1)), np.flatnonzero(found.any(axis=0))
    assert (rows[0], rows[-1] + 1) == (region.top, region.bottom)
    assert (columns[0], columns[-1] + 1) == (region.left, region.right)


def test_pass_of_a_small_share_keeps_the_light_of_a_laser() -> None:
    """Its weight in the filter is small already; Cycles drops what weighs less than 1e-5."""
    lamp = '{"kind":"line","centre_nm":532,"fwhm_nm":0.01}'
    device = _built(
        "grating_rainbow", "render.size=[24,18]", f"elements.lamp.spectrum={lamp}", "room.kind=none"
    )
    seen = [
        Pass(device, "part", FirstOrders.DIFFRACTED, 2, share).render(3, 0, 16)[DISPLAY_LAYER]
        for share in (0.1, 1.0)
    ]
    # A lamp that is met straight on counts by its share, one by diffraction fully.
    straight = Pass(device, "straight", FirstOrders.STRAIGHT, 2).render(3, 0, 16)[DISPLAY_LAYER]
    diffracted = straight.sum(axis=2) == 0.0
    np.testing.assert_allclose(seen[0][diffracted], seen[1][diffracted], rtol=1e-4, atol=1e-6)
    assert seen[1][diffracted].max() > 0.0


def test_published_and_small_pictures_stay_whole() -> None:
    published = _built("two_hologram_ar", "render.size=[16,12]", *PUBLISHED)
    assert not is_divisible(published)
    assert len(published.spectral.samplings) == 1
    device = _built("two_hologram_ar", "render.size=[16,12]")
    assert is_divisible(device)
    assert [each.name for each in divided(device, samples=4).passes] == ["whole"]


@pytest.mark.slow
def test_guided_is_several_times_better_than_published() -> None:
    """Error squared times processor time over the display's field: pilot and set-up counted."""
    size = "render.size=[320,240]"
    efforts = {}
    for name, sets in (("published", PUBLISHED), ("guided", ())):
        device = _built("two_hologram_ar", size, *sets)
        one = Division((whole(device),), (1.0,), 1.0)
        one.render(99, 1)  # compiles the shaders
        started = time.process_time()
        division = divided(device)
        efforts[name] = _effort(device, division, time.process_time() - started)
    assert efforts["published"] > TIMES_BETTER * efforts["guided"], efforts


def _effort(device: DeviceScene, division: Division, pilot: float, seeds: int = 2) -> float:
    started = time.process_time()
    pictures = [division.render(seed, 64)[0][COMBINED] @ LUMINANCE_WEIGHTS for seed in range(seeds)]
    seconds = pilot + (time.process_time() - started) / seeds
    height, width = pictures[0].shape
    inside = field_mask(device.guide_spec, width, height)
    variance = np.var(pictures, axis=0, ddof=1)[inside].mean()
    return float(variance * seconds)
