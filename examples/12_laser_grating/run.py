# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a grating shows a lamp of laser light, in a picture that is rendered without dispersion.

Claims: the plan of effects leaves dispersion out; the picture shows the star of the tree at the
angle that sin(a) - sin(b) = m wavelength / period gives for orders -2 to +2, where b is the
direction of the ray between grating and star.
"""

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.cli.example_scene import seen_angles_deg  # noqa: E402
from hoe_addon.model.document import load_device  # noqa: E402
from hoe_addon.model.effects import Effect, plan_effects  # noqa: E402

PRESET: str = "laser_grating"
LINE_NM: float = 632.8
LINES_PER_MM: float = 300.0
GRATING_MM: float = 150.0
LAMP_MM: float = 1960.0
ORDERS: tuple[int, ...] = (-2, -1, 0, 1, 2)
DISPERSION: str = "dispersion"
STEEPEST: float = math.radians(35.0)
"""Beyond it the light of order -2 or 2 would have to come along the grating."""

FIELD_DEG: float = 2.0
SIZE: tuple[int, int] = (64, 64)
SAMPLES: int = 32
TOLERANCE_DEG: float = 0.005
SOURCE: str = (
    "grating equation sin(a) - sin(b) = m wavelength / period, with the places of eye, grating "
    "and star, solved by bisection; dispersion: 1 where the plan has it, 0 where it has not"
)
REASON: str = (
    "0.005 degree: a sixth of a pixel of the measured picture, for the noise of the star's edge; "
    "dispersion is left out or not"
)


def measure() -> dict[str, float]:
    """Ask the plan, and render the neighbourhood of each order with the star alone.

    Returns:
        1 or 0 for dispersion, and angles in degrees, by name.
    """
    plan = plan_effects(load_device(PRESET))
    found = {DISPERSION: float(plan.is_on(Effect.DISPERSION))}
    return found | {f"order {order}": seen_angle_deg(order) for order in ORDERS}


def seen_angle_deg(order: int) -> float:
    """Render the neighbourhood of one order, with the star in the middle and nothing else.

    Args:
        order: Order that the eye looks into.

    Returns:
        Angle at the eye, degrees to the right.
    """
    names = [each.name for each in load_device(PRESET).elements]
    others = [name for name in names if name not in ("grating", "frame", "star", "ground")]
    right, _ = seen_angles_deg(
        PRESET,
        [
            *(f"elements.{name}.luminance_cd_m2=0" for name in others),
            "elements.ground.color=[0, 0, 0]",
            f"elements.star.position_mm=[0, 0, {-LAMP_MM}]",
            f"eye.field_deg={FIELD_DEG}",
            f"gaze_deg=[{round(angle_deg(order))}, 0]",
            f"render.size={list(SIZE)}",
            f"render.samples={SAMPLES}",
        ],
    )
    return right


def angle_deg(order: int) -> float:
    """Solve the grating equation together with the geometry by bisection.

    Args:
        order: Order that the eye looks into.

    Returns:
        Angle at the eye, degrees to the right.
    """
    low, high = -STEEPEST, STEEPEST
    for _ in range(100):
        angle = (low + high) / 2.0
        leaving = math.sin(angle) - order * LINE_NM * 1e-6 * LINES_PER_MM
        # Where the ray from the eye, bent by the grating, passes the star.
        beside = GRATING_MM * math.tan(angle)
        beside += (LAMP_MM - GRATING_MM) * math.tan(math.asin(leaving))
        low, high = (angle, high) if beside < 0.0 else (low, angle)
    return round(math.degrees(low), 5) + 0.0  # not -0.0


def expected_numbers() -> list[Row]:
    """The plan's answer, and the grating equation."""
    return [
        row(DISPERSION, "1", 0, 0),
        *(row(f"order {order}", "deg", angle_deg(order), TOLERANCE_DEG) for order in ORDERS),
    ]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
