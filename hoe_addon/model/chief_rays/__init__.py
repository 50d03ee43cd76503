# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays through the middle of the pupil, in chosen diffraction orders, as lines for a drawing.

`guide` and `scene` walk them backward from the eye by the core's ray law, `pieces` is what they
come to, and `wavelengths` says in which colours.
"""

from ..device import DeviceSpec, LightGuideSpec
from .guide import guide_chief_rays
from .pieces import Orders, Pieces
from .scene import scene_chief_rays
from .wavelengths import chief_wavelengths_nm

__all__ = ["Orders", "Pieces", "chief_rays", "chief_wavelengths_nm"]


def chief_rays(spec: DeviceSpec, orders: Orders, *, corners: bool = False) -> Pieces:
    """Find the chief rays of a document.

    Args:
        spec: The document.
        orders: Diffraction orders that are followed.
        corners: Whether rays for the corners of the field are added to that for its middle.

    Returns:
        Their pieces in the frame of the document.
    """
    if isinstance(spec, LightGuideSpec):
        return guide_chief_rays(spec, orders, corners=corners)
    return scene_chief_rays(spec, orders, corners=corners)
