# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs: the measures of `accuracy` beside numbers that are known, and the gain.

Claim: the contrast that is measured at 5 cycles per degree is that of the closed form for an eye
out of focus; the published algorithm and the best sampling give the same light over the display's
field; and the best sampling has the display's light 5 times sooner, at least, at equal noise.
"""

import itertools
import json
import math
import sys
from functools import cache
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import bpy  # noqa: E402

from hoe_addon.blender.accuracy.results import relative_noise  # noqa: E402
from hoe_addon.blender.accuracy.shots import Shots, division_of  # noqa: E402
from hoe_addon.blender.accuracy.target import CYCLES_PER_DEGREE, sharpness  # noqa: E402
from hoe_addon.blender.build.device import DeviceScene, build_device  # noqa: E402
from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.core.picture_error import reference_of  # noqa: E402
from hoe_addon.core.picture_pieces import relative_luminance  # noqa: E402
from hoe_addon.model.document import load_device  # noqa: E402
from hoe_addon.model.field import field_mask  # noqa: E402
from hoe_addon.model.methods import METHODS  # noqa: E402

PRESET: str = "two_hologram_ar"
SIZE: tuple[int, int] = (64, 48)
FOCUS_MM: tuple[float | None, ...] = (None, 3000.0, 2000.0)
PUPIL_MM: float = 4.0
TARGET_SAMPLES: int = 128
SAMPLES: tuple[int, ...] = (16, 16, 32, 32, 64, 64, 128, 128)
GAIN: float = 5.0
SOURCE: str = (
    "2 J1(x) / x with x = pi blur f for a disc of blur; the same light however it is sampled"
)
REASON: str = (
    "0.03: noise of the contrast, and a pupil that the guide fills a little unevenly; 0.1: noise "
    "of the published algorithm in the mean of the field; a gain of 5 or more counts as 5"
)


def built(*changes: str) -> DeviceScene:
    """Build the device in an empty file."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    spec = load_device(PRESET, [f"render.size={list(SIZE)}", *changes])
    assert bpy.context.scene is not None
    return build_device(bpy.context.scene, spec, HERE)


def contrast(focus_mm: float | None) -> float:
    """Contrast that an eye with that focus sees."""
    focus = "null" if focus_mm is None else repr(focus_mm)
    device = built(f"eye.focus_mm={focus}", "room.kind=none")
    return sharpness(device, TARGET_SAMPLES, seed=1).value


def name_of(focus_mm: float | None) -> str:
    """Name of a contrast."""
    where = "infinity" if focus_mm is None else f"{focus_mm / 1000.0:g} m"
    return f"contrast at {CYCLES_PER_DEGREE:g}/deg, focus {where}"


@cache
def sampled(method: str) -> tuple[float, float]:
    """Mean luminance over the field, and processor time to a given noise of the display's light."""
    changes = [f"render.{name}={json.dumps(value)}" for name, value in METHODS[method].items()]
    device = built(*changes)
    shots = Shots(device, itertools.count(1), division_of(device))
    for count in SAMPLES:
        shots.shoot(count)
    field = field_mask(device.guide_spec, *SIZE)
    mean = float(np.mean(relative_luminance(shots.pictures().mean())[field]))
    displays = shots.displays()
    noise = relative_noise(displays, reference_of(displays, field))
    return mean, noise * shots.processor_seconds_per_sample


def measure() -> dict[str, float]:
    """Measure contrasts, means and gain.

    Returns:
        Numbers by name.
    """
    found = {name_of(focus): contrast(focus) for focus in FOCUS_MM}
    theirs, own = sampled("published"), sampled("guided")
    print(f"display's light at equal noise: {theirs[1] / own[1]:.1f} times sooner")
    found["mean over the field, best / published"] = own[0] / theirs[0]
    found["gain, 5 or more"] = min(GAIN, theirs[1] / own[1])
    return found


def closed_form(focus_mm: float | None) -> float:
    """Contrast that a disc of blur leaves, with J1 by its integral."""
    if focus_mm is None:
        return 1.0
    x = math.pi * math.degrees(PUPIL_MM / focus_mm) * CYCLES_PER_DEGREE
    angle = (np.arange(2000) + 0.5) / 2000 * math.pi
    return round(2.0 * float(np.mean(np.cos(angle - x * np.sin(angle)))) / x, 6)


def expected_numbers() -> list[Row]:
    """The closed form, equality, and the aim."""
    return [
        *(row(name_of(focus), "1", closed_form(focus), 0.03) for focus in FOCUS_MM),
        row("mean over the field, best / published", "1", 1.0, 0.1),
        row("gain, 5 or more", "1", GAIN, 1e-9),
    ]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
