# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distance of a head-up display's picture, from two places of the eye.

Claim: the directions in which two pupils 60 mm apart see the middle of the display meet 10 m ahead,
where the recording put it: in numpy, and in pictures rendered through the curved windshield.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.cli.example_scene import seen_spot  # noqa: E402
from hoe_addon.model.document import load_device  # noqa: E402
from hoe_addon.model.scene_view import chief_ray, image_distance_mm  # noqa: E402

PRESET: str = "hud_combiner"
GREEN_NM: float = 532.0
DESIGN_M: float = 10.0
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-30.0, 0.0, 0.0), (30.0, 0.0, 0.0))
GAZE_DEG: tuple[float, float] = (0.0, -5.0)
FIELD_DEG: float = 0.8
SIZE: tuple[int, int] = (160, 120)
SAMPLES: int = 16
RELATIVE_TOLERANCE: float = 0.01
SOURCE: str = (
    "design: the object point of the recording is 10 m from the middle of the eyebox; no ray is "
    "needed to know it"
)
REASON: str = (
    "1 % of the distance: 6e-5 rad between the two directions, seven tenths of a pixel of the "
    "measured pictures"
)


def measure() -> dict[str, float]:
    """Find the distance with both engines.

    Returns:
        Distances in m by name.
    """
    hud = load_device(PRESET)
    walked = [
        chief_ray(hud, "combiner", "display", pupil, GREEN_NM, reflected=True)
        for pupil in PUPILS_MM
    ]
    seen = [seen_from(pupil) for pupil in PUPILS_MM]
    return {
        "distance, numpy": image_distance_mm(PUPILS_MM, walked) * 1e-3,
        "distance, pictures": image_distance_mm(PUPILS_MM, seen) * 1e-3,
    }


def seen_from(pupil_mm: tuple[float, float, float]) -> np.ndarray:
    """Render a small white square in the middle of the display, and find where it is seen.

    Args:
        pupil_mm: Middle of the pupil.

    Returns:
        Direction from the pupil.
    """
    return seen_spot(
        PRESET,
        "display",
        pupil_mm,
        GREEN_NM,
        [
            f"gaze_deg={list(GAZE_DEG)}",
            f"eye.field_deg={FIELD_DEG}",
            'elements.combiner.hologram.efficiency.table={"T": {}, "R": {"1": 1}}',
            f"render.size={list(SIZE)}",
            f"render.samples={SAMPLES}",
        ],
    )


def expected_numbers() -> list[Row]:
    """The design."""
    allowed = round(RELATIVE_TOLERANCE * DESIGN_M, 4)
    return [row(f"distance, {name}", "m", DESIGN_M, allowed) for name in ("numpy", "pictures")]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
