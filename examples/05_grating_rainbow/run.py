# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a grating shows a line at 546.1 nm, measured in a rendered picture.

Claim: the picture shows the lamp's line at the angle that sin(a) - sin(b) = m wavelength / period
gives for orders 1 and 2, where b is the direction of the ray between grating and lamp.
"""

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.cli.example_scene import seen_angles_deg  # noqa: E402

PRESET: str = "grating_rainbow"
LINE_NM: float = 546.1
LINES_PER_MM: float = 300.0
GRATING_MM: float = 150.0
LAMP_MM: float = 1960.0
ORDERS: tuple[int, ...] = (1, 2)
FIELD_DEG: float = 3.0
SIZE: tuple[int, int] = (120, 60)
SAMPLES: int = 64
TOLERANCE_DEG: float = 0.01
SOURCE: str = (
    "grating equation sin(a) - sin(b) = m wavelength / period, with the places of eye, grating "
    "and lamp, solved by bisection"
)
REASON: str = (
    "0.01 degree: 0.4 of a pixel of the measured picture, mostly the noise of the edge of a lamp "
    "image that is 5 pixels wide"
)


def measure() -> dict[str, float]:
    """Render the neighbourhood of each order, with a thin lamp that gives one line.

    Returns:
        Angles in degrees by name.
    """
    line = f'{{"kind": "line", "centre_nm": {LINE_NM}, "fwhm_nm": 1}}'
    return {
        f"order {order}": seen_angles_deg(
            PRESET,
            [
                f"elements.lamp.spectrum={line}",
                "elements.lamp.size_mm=[4, 40]",
                f"eye.field_deg={FIELD_DEG}",
                f"gaze_deg=[{round(angle_deg(order))}, 0]",
                f"render.size={list(SIZE)}",
                f"render.samples={SAMPLES}",
            ],
        )[0]
        for order in ORDERS
    }


def angle_deg(order: int) -> float:
    """Solve the grating equation together with the geometry by bisection.

    Args:
        order: Order that the eye looks into.

    Returns:
        Angle at the eye, degrees to the right.
    """
    low, high = 0.0, math.pi / 4.0
    for _ in range(100):
        angle = (low + high) / 2.0
        leaving = math.sin(angle) - order * LINE_NM * 1e-6 * LINES_PER_MM
        # Where the ray from the eye, bent by the grating, passes the lamp.
        beside = GRATING_MM * math.tan(angle)
        beside += (LAMP_MM - GRATING_MM) * math.tan(math.asin(leaving))
        low, high = (angle, high) if beside < 0.0 else (low, angle)
    return math.degrees(low)


def expected_numbers() -> list[Row]:
    """The grating equation."""
    return [
        row(f"order {order}", "deg", round(angle_deg(order), 5), TOLERANCE_DEG) for order in ORDERS
    ]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
