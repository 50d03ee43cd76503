# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where on a compact disc a lamp shows light of 550 nm, measured in a rendered picture.

Claim: on the line of the disc that lies under lamp and eye, light of one wavelength comes from the
radius where the directions to lamp and eye, projected on the disc, add up to wavelength / pitch.
"""

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.cli.example_scene import seen_angles_deg  # noqa: E402

PRESET: str = "compact_disc"
WAVELENGTHS_NM: tuple[float, ...] = (500.0, 550.0, 600.0)
PITCH_UM: float = 1.6
DISC_MM: tuple[float, float] = (-118.5, -400.0)
EYE_MM: tuple[float, float] = (130.0, 0.0)
LAMP_MM: tuple[float, float] = (211.5, -644.6)
INNER_MM, OUTER_MM = 22.0, 59.0
FIELD_DEG: float = 1.5
SIZE: tuple[int, int] = (80, 80)
SAMPLES: int = 128
TOLERANCE_MM: float = 0.3
SOURCE: str = (
    "grating equation for reflection, sin(in) + sin(out) = wavelength / 1.6 um, solved by "
    "bisection for the places of lamp, disc and eye"
)
REASON: str = (
    "0.3 mm: the image of the 4 mm lamp in a line 1 nm wide is 2 mm long on the disc, and its "
    "centroid is found to a tenth of that"
)


def measure() -> dict[str, float]:
    """Render the far side of the disc with one small lamp of one wavelength.

    Returns:
        Radii in mm by name.
    """
    found: dict[str, float] = {}
    for wavelength in WAVELENGTHS_NM:
        line = f'{{"kind": "line", "centre_nm": {wavelength}, "fwhm_nm": 1}}'
        changes = [
            "elements.left_lamp.luminance_cd_m2=0",
            "elements.right_lamp.luminance_cd_m2=0",
            f"elements.middle_lamp.spectrum={line}",
            "elements.middle_lamp.size_mm=[4, 4]",
            f"eye.field_deg={FIELD_DEG}",
            f"gaze_deg=[0, {round(elevation_deg(radius_mm(wavelength)), 1)}]",
            f"render.size={list(SIZE)}",
            f"render.samples={SAMPLES}",
        ]
        up = math.radians(seen_angles_deg(PRESET, changes)[1])
        away = (EYE_MM[0] - DISC_MM[0]) / math.tan(-up)
        found[f"radius at {wavelength:g} nm"] = away - (EYE_MM[1] - DISC_MM[1])
    return found


def radius_mm(wavelength_nm: float) -> float:
    """Solve the grating equation on the far side of the disc by bisection.

    Args:
        wavelength_nm: Wavelength.

    Returns:
        Distance from the middle of the disc.
    """
    low, high = INNER_MM, OUTER_MM
    for _ in range(100):
        radius = (low + high) / 2.0
        total = 0.0
        for height, depth in (EYE_MM, LAMP_MM):
            along, above = depth - (DISC_MM[1] - radius), height - DISC_MM[0]
            total += along / math.hypot(along, above)
        low, high = (radius, high) if total < wavelength_nm * 1e-3 / PITCH_UM else (low, radius)
    return low


def elevation_deg(radius: float) -> float:
    """Direction in which the eye sees a point of the far side.

    Args:
        radius: Distance of the point from the middle of the disc, mm.

    Returns:
        Degrees up, here below 0.
    """
    away = EYE_MM[1] - DISC_MM[1] + radius
    return math.degrees(math.atan2(DISC_MM[0] - EYE_MM[0], away))


def expected_numbers() -> list[Row]:
    """The grating equation."""
    return [
        row(f"radius at {nm:g} nm", "mm", round(radius_mm(nm), 3), TOLERANCE_MM)
        for nm in WAVELENGTHS_NM
    ]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
