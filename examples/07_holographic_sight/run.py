# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distance of a holographic sight's reticle, from two places of the pupil.

Claim: the directions in which two pupils 16 mm apart see the middle of the reticle meet where the
object point of the recording is, 50 m beyond the window: in numpy, and in rendered pictures.
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

PRESET: str = "holographic_sight"
LASER_NM: float = 640.0
DESIGN_M: float = 50.22
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-8.0, 0.0, 0.0), (8.0, 0.0, 0.0))
FIELD_DEG: float = 0.2
SIZE: tuple[int, int] = (96, 96)
SAMPLES: int = 64
RELATIVE_TOLERANCE: float = 0.01
SOURCE: str = (
    "design: the object point of the recording is 50 m beyond the window, which is 0.22 m from "
    "the eye"
)
REASON: str = (
    "1 % of the distance: 3.2e-6 rad between the two directions, a tenth of a pixel of the "
    "measured pictures"
)


def measure() -> dict[str, float]:
    """Find the distance with both engines.

    Returns:
        Distances in m by name.
    """
    sight = load_device(PRESET)
    walked = [chief_ray(sight, "window", "reticle", pupil, LASER_NM) for pupil in PUPILS_MM]
    seen = [seen_from(pupil) for pupil in PUPILS_MM]
    return {
        "distance, numpy": image_distance_mm(PUPILS_MM, walked) * 1e-3,
        "distance, pictures": image_distance_mm(PUPILS_MM, seen) * 1e-3,
    }


def seen_from(pupil_mm: tuple[float, float, float]) -> np.ndarray:
    """Render a small white square in place of the reticle, and find its middle.

    Args:
        pupil_mm: Middle of the pupil.

    Returns:
        Direction from the pupil.
    """
    return seen_spot(
        PRESET,
        "reticle",
        pupil_mm,
        LASER_NM,
        [
            f"eye.field_deg={FIELD_DEG}",
            'elements.window.hologram.efficiency.table={"T": {"1": 1}, "R": {}}',
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
