# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The units that V is written in."""

import math
from typing import Literal

from ...core.units import mm_to_m, nm_to_m

type Unit = Literal["mm", "waves", "radians"]
"""Of V: mm of optical path, waves of the stated wavelength, or radians of its phase."""

UNITS = ("mm", "waves", "radians")


def metres_per_unit(unit: Unit, wavelength_nm: float) -> float:
    """Find what 1 of a unit stands for.

    Args:
        unit: The unit.
        wavelength_nm: The wavelength that V is stated for, in nm.

    Returns:
        Optical path in metres.
    """
    wavelength = float(nm_to_m(wavelength_nm))
    match unit:
        case "mm":
            return float(mm_to_m(1.0))
        case "waves":
            return wavelength
        case "radians":
            return wavelength / (2.0 * math.pi)
