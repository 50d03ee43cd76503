# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A script of a few lines: a preset, another recording source, a picture.

Claim: when the object source of a holographic sight, 50 m away, is moved by half a metre, the
reticle in the rendered picture is seen where the source is now.
"""

import math
import runpy
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402

PRESET: str = "holographic_sight"
SCRIPT: Path = HERE / "script.py"
NAME: str = "reticle, to the right"
ASIDE_MM: float = 500.0
AWAY_MM: float = 50000.0 + 220.0
ALLOWED_DEG: float = 0.04
SOURCE: str = (
    "geometry: a source 500 mm aside, 50 m beyond the window, which is 220 mm from the eye; the "
    "object wave of a recording is seen where its source stood"
)
REASON: str = (
    "half a pixel of the picture, and as much for its noise: the middle of an unmoved reticle is "
    "found 0.02 degrees off"
)


def measure() -> dict[str, float]:
    """Run the script.

    Returns:
        The direction that it finds, in degrees.
    """
    return {NAME: float(runpy.run_path(str(SCRIPT))["right"])}


def expected_numbers() -> list[Row]:
    """The direction of the moved source."""
    return [row(NAME, "deg", round(math.degrees(math.atan(ASIDE_MM / AWAY_MM)), 4), ALLOWED_DEG)]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
