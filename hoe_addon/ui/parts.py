# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The modules of the window that register something, each after those that it depends on."""

from ..blender.registration import Part
from . import menus
from .facts import material as material_facts
from .facts import plans, previews, scenes
from .jobs import current, status_bar
from .operators import (
    add_bodies,
    add_emitters,
    add_eye,
    add_hologram,
    add_preset,
    device_files,
    hologram_files,
    mend,
    recording,
)
from .operators import bake as bake_operators
from .operators import device as device_operators
from .operators import effects as effect_operators
from .operators import render as render_operators
from .operators import study as study_operators
from .overlay import draw as overlay_drawing
from .overlay import watch as overlay_watch
from .panels import banner
from .panels import device as device_panels
from .panels import effects as effect_panels
from .panels import efficiency as efficiency_panels
from .panels import hologram as hologram_panels
from .panels import overlay as overlay_panel
from .panels import recording as recording_panels
from .panels import render as render_panels
from .panels import study as study_panels

PARTS: tuple[Part, ...] = (
    # long work
    current,
    status_bar,
    render_operators,
    study_operators,
    bake_operators,
    # device and effects
    scenes,
    plans,
    device_operators,
    device_files,
    effect_operators,
    mend,
    banner,
    device_panels,
    render_panels,
    effect_panels,
    study_panels,
    # the hologram of a material
    previews,
    material_facts,
    recording,
    hologram_files,
    hologram_panels,
    recording_panels,
    efficiency_panels,
    # the viewport
    overlay_watch,
    overlay_drawing,
    overlay_panel,
    # adding
    add_bodies,
    add_emitters,
    add_eye,
    add_hologram,
    add_preset,
    menus,
)
