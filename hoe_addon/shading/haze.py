# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Haze in the shader: a share of each order leaves around it."""

import math

from ..model.efficiency import HazeSpec
from .part import SocketValues, parameter

_SINE = ("haze_sine", "Haze Width", "Sine of the standard deviation of the haze")
_SHARE = ("haze_share", "Haze", "Share of each order that is scattered, 0 to 1")
_ROUGHNESS = ("haze_roughness_nm", "Roughness", "Root mean square of the roughness, in nm")
_ROUGH = (
    "hoe_rough_share(haze_roughness_nm, "
    "side == HOE_TRANSMITTED ? normal_in - normal_out : normal_in + normal_out, wavelength_nm)"
)


def haze_definitions(spec: HazeSpec | None) -> dict[str, str]:
    """What the hologram shader has to define for a haze.

    Args:
        spec: The haze, or None for none.

    Returns:
        Replacement by macro; nothing without a haze.
    """
    if spec is None:
        return {}
    rough = spec.roughness_nm is not None
    sockets = (_SINE, _ROUGHNESS if rough else _SHARE)
    return {
        "HOE_HAZE_PARAMETERS": " ".join(
            parameter("float", name, "0.0", label, words) for name, label, words in sockets
        ),
        "HOE_HAZE_SHARE(side)": _ROUGH if rough else _SHARE[0],
    }


def haze_sockets(spec: HazeSpec | None) -> SocketValues:
    """The numbers of a haze as socket values.

    Args:
        spec: The haze, or None for none.

    Returns:
        Value by socket identifier.
    """
    if spec is None:
        return {}
    values: SocketValues = {_SINE[0]: math.sin(math.radians(spec.width_deg))}
    if spec.roughness_nm is not None:
        values[_ROUGHNESS[0]] = spec.roughness_nm
    if spec.share is not None:
        values[_SHARE[0]] = spec.share
    return values
