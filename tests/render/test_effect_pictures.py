# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of planned scenes in Cycles: as those with everything, whatever the plan leaves out."""

from collections.abc import Sequence
from typing import Any

import pytest
from msgspec import structs

from hoe_addon.blender.bench.effects import (
    Likeness,
    Series,
    compare,
    measure_effects,
    series,
    with_everything,
)
from hoe_addon.blender.pictures.diffracted import is_worth_it
from hoe_addon.model.device import DeviceSpec
from hoe_addon.model.document import device_from, find_device, load_device, to_document
from hoe_addon.model.effects import Effect, plan_effects
from hoe_addon.resources import preset_paths

pytestmark = [pytest.mark.render, pytest.mark.slow]  # each builds two scenes and renders six times

SEEDS = 6
SAMPLES = 16

SIGMAS = 3.0
"""Of the difference of two mean luminances: a right plan fails once in some hundred times, and with
seeds that are the same in every run either always or never."""

BLOCKS = 1.6
"""Root mean square over 48 squares of differences by their scatter, which is about 1 +- 0.12 where
pictures are alike; squares with rare bright samples scatter more."""

TWICE = 2.0
"""Least ratio of variances: a sample costs no more with the plan than with everything."""


def pictures(spec: DeviceSpec, first_seed: int) -> Series:
    seeds = range(first_seed, first_seed + SEEDS)
    return series(spec, find_device("holographic_sight").parent, seeds, SAMPLES)


def both(spec: DeviceSpec) -> Likeness:
    """The picture with everything beside the planned one, with seeds of their own."""
    return compare(pictures(with_everything(spec), 1), pictures(spec, 101))


def assert_alike(likeness: Likeness) -> None:
    """Within the noise; a promise below it is for the tests of the plan's own numbers."""
    assert abs(likeness.sigmas) < SIGMAS
    assert likeness.blocks < BLOCKS
    assert likeness.colours < BLOCKS


@pytest.mark.parametrize("name", preset_paths())
def test_planned_preset_is_the_same_picture(name: str) -> None:
    assert_alike(both(load_device(name, ["render.size=[64,48]"])))


@pytest.mark.parametrize("name", ["holographic_sight", "hud_combiner"])
def test_sights_of_one_colour_are_quieter(name: str) -> None:
    """What is seen straight on needs no wavelength, and the display has one of its primaries."""
    spec = load_device(name, ["render.size=[64,48]"])
    assert pictures(with_everything(spec), 1).variance > TWICE * pictures(spec, 101).variance


def test_grating_in_laser_light_is_quieter() -> None:
    """One wavelength will do, and no pupil is needed."""
    spec = with_relief(levels=4)
    assert not plan_effects(spec).is_on(Effect.DISPERSION)
    assert pictures(with_everything(spec), 1).variance > TWICE * pictures(spec, 101).variance


LASER = {"kind": "line", "centre_nm": 532, "fwhm_nm": 0.5}


def with_relief(
    angle_deg: float = 0.0,
    spectrum: dict[str, Any] = LASER,
    size_mm: Sequence[float] = (900, 900),
    **relief: Any,
) -> DeviceSpec:
    """A grating of 20 lines per mm, a panel of light behind it, and an eye."""
    efficiency = {"model": "kinoform", "design_wavelength_nm": 532, "relief": "PMMA", "levels": 0}
    hologram = {
        "schema": 1,
        "name": "grating",
        "surface": {"shape": "plane", "size_mm": [60, 60]},
        "media": {"back": "air", "front": "air"},
        "characteristic": {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": 20},
        "efficiency": {**efficiency, "total_internal_reflection": False, **relief},
        "orders": [0, 1],
    }
    grating = {"position_mm": [0, 0, -100], "rotation_deg": [0, angle_deg, 0]}
    panel = {"position_mm": [0, 0, -2000], "shape": "rectangle", "size_mm": list(size_mm)}
    return device_from(
        {
            "kind": "scene",
            "schema": 1,
            "name": "relief",
            "title": "A grating with a relief",
            "elements": [
                {"kind": "hologram", "name": "grating", "hologram": hologram, **grating},
                {
                    "kind": "lamp",
                    "name": "panel",
                    "luminance_cd_m2": 100,
                    "spectrum": spectrum,
                    **panel,
                },
            ],
            "eye": {"pupil_diameter_mm": 1, "field_deg": 8},
            "room": {"kind": "none", "luminance_cd_m2": 0},
            "render": {"size": [32, 24]},
        }
    )


def changed(spec: DeviceSpec, *effects: str) -> DeviceSpec:
    """The document with the user's own decisions."""
    return structs.replace(spec, render=structs.replace(spec.render, effects=effects))


@pytest.mark.parametrize(
    ("effect", "plain", "needing"),
    [
        (Effect.ANGLE, {}, {"angle_deg": 50.0}),
    ],
    ids=["tilt"],
)
def test_change_of_the_relief_turns_its_effect_on(
    effect: Effect, plain: dict[str, Any], needing: dict[str, Any]
) -> None:
    assert not plan_effects(with_relief(**plain)).is_on(effect, "grating")
    spec = with_relief(**needing)
    assert plan_effects(spec).is_on(effect, "grating")
    assert_alike(both(spec))
    wrong = compare(pictures(with_everything(spec), 1), pictures(changed(spec, f"-{effect}"), 101))
    assert abs(wrong.sigmas) > SIGMAS


def test_mirror_in_a_lit_room_is_the_same_picture() -> None:
    """Lamps of a room are unseen by the eye itself, and so they have to be in what it sees by order
    0, straight or mirrored; only transmitted light goes without wavelengths."""
    document = to_document(load_device("grating_rainbow", ["render.size=[64,48]"]))
    grating = document["elements"][0]["hologram"]
    grating["efficiency"]["table"] = {"T": {"0": 0.4, "1": 0.25}, "R": {"0": 0.1}}
    grating["orders"] = [0, 1]
    lamp = next(each for each in document["elements"] if each["name"] == "lamp")
    blue = {
        **lamp,
        "name": "blue",
        "shape": "sphere",
        "size_mm": [200.0, 200.0],
        "position_mm": [300.0, 0.0, -1500.0],
        "spectrum": {"kind": "line", "centre_nm": 460.0, "fwhm_nm": 2.0},
    }
    document["elements"].append(blue)
    spec = device_from(document)
    assert is_worth_it(spec)
    assert_alike(both(spec))


def test_more_wavelengths_turn_dispersion_on() -> None:
    small = [300, 300]
    assert not plan_effects(with_relief(size_mm=small)).is_on(Effect.DISPERSION)
    spec = with_relief(size_mm=small, spectrum={"kind": "illuminant", "illuminant": "D65"})
    assert plan_effects(spec).is_on(Effect.DISPERSION)
    assert_alike(both(spec))
    one = pictures(changed(spec, "-dispersion"), 101)
    assert compare(pictures(with_everything(spec), 1), one).blocks > SIGMAS


@pytest.mark.parametrize(
    ("name", "left_out"),
    [("holographic_sight", "bounces"), ("laser_grating", "dispersion")],
)
def test_bench_tells_what_the_plan_gains(name: str, left_out: str) -> None:
    (speed,) = measure_effects((name,))
    assert abs(speed.sigmas) < SIGMAS
    assert speed.blocks < BLOCKS
    assert speed.speed_up > TWICE
    assert left_out in speed.left_out
