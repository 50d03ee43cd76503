# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Relief profiles of steps or straight pieces as OSL functions with constant arrays."""

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.segments import Segments, Steps
from ..source import array

_COARSE = 2.0**12
"""Places are split at this fraction: times an order below 2^12 the first part is exact."""


def steps_function(profile: Steps) -> str:
    """Write a profile of equal steps as `hoe_profile_efficiency(order, alpha)`.

    Args:
        profile: The steps.

    Returns:
        The OSL function.
    """
    return _function({"heights": profile.heights}, "hoe_steps_efficiency")


def segments_function(profile: Segments) -> str:
    """Write a profile of straight pieces as `hoe_profile_efficiency(order, alpha)`.

    Args:
        profile: The pieces.

    Returns:
        The OSL function.
    """
    coarse = np.rint(profile.middle * _COARSE) / _COARSE
    numbers = {
        "coarse": coarse,
        "fine": profile.middle - coarse,
        "width": profile.width,
        "height": profile.height,
        "rise": profile.rise,
    }
    return _function(numbers, "hoe_segments_efficiency")


def _function(numbers: dict[str, FloatArray], sum_up: str) -> str:
    lines = "".join(
        f"    float {name}[{values.size}] = {array(values)};\n" for name, values in numbers.items()
    )
    given = ", ".join(numbers)
    return (
        "float hoe_profile_efficiency(int order, float alpha)\n{\n"
        f"{lines}    return {sum_up}(order, alpha, {given});\n}}\n"
    )
