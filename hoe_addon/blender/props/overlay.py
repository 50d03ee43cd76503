# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3-D view, as properties: on and off for each kind, and how dense."""

from typing import Any

import bpy
from bpy.props import BoolProperty, IntProperty

from ..registration import class_registrars
from .changes import mark

MOST_RAYS = 64
"""Rays that are drawn of one source at most."""

_ORDER_LIMITS = {"min": -99, "max": 99, "soft_min": -5, "soft_max": 5}


def _switch(name: str, description: str) -> Any:
    return BoolProperty(name=name, description=description, default=True, update=mark)


class HOE_PG_overlay(bpy.types.PropertyGroup):
    """What is drawn over the 3-D view of a scene with holograms."""

    show: _switch("Hologram Overlays", "Draw sources, rays, pupil and eyebox over the 3-D view")
    sources: _switch(
        "Recording Sources",
        "Draw the two waves that made each hologram: object wave in full lines, reference wave "
        "dashed, in the colour of the recording wavelength",
    )
    chief_rays: _switch(
        "Chief Rays",
        "Draw the rays that pass the middle of the pupil, in the colour of their wavelength",
    )
    pupil: _switch(
        "Pupil", "Draw the pupil of the eye in its true size, where it looks, and the eye relief"
    )
    eyebox: _switch("Eyebox", "Draw the places of the pupil that the eyebox study looks at")
    corners: BoolProperty(
        name="Corners of the Field",
        description="Draw chief rays for the corners of the display, or of the hologram, too",
        default=True,
        update=mark,
    )
    rays: IntProperty(
        name="Rays per Source",
        description="Number of rays that are drawn from each recording source",
        default=5,
        min=1,
        max=MOST_RAYS,
        soft_max=32,
        update=mark,
    )
    lowest_order: IntProperty(
        name="Orders from",
        description="Lowest diffraction order that chief rays take; orders that a hologram does "
        "not trace are left out",
        default=0,
        update=mark,
        **_ORDER_LIMITS,
    )
    highest_order: IntProperty(
        name="Orders to",
        description="Highest diffraction order that chief rays take; orders that a hologram does "
        "not trace are left out",
        default=1,
        update=mark,
        **_ORDER_LIMITS,
    )


register, unregister = class_registrars((HOE_PG_overlay,))
