# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The device of the open file, brought up to date and without what its picture does not need."""

from typing import TYPE_CHECKING

from .session import Work

if TYPE_CHECKING:
    from ...blender.build.device import DeviceScene


def lean_device(work: Work) -> "DeviceScene":
    """Give the device what its properties say, and follow the plan of its effects.

    Args:
        work: The job.

    Returns:
        The device; what its document does not know is left as it is.

    Raises:
        CancelledError: It is to end now.
        HoeError: The document is not valid, or a part or a shader of it cannot be made.
    """
    from ...blender.document.follow_plan import follow_plan
    from ...blender.document.held import device_of
    from ...blender.document.live import settle
    from ...model.effects import plan_effects

    settle(work.scene)
    _refresh_stale()
    work.leash.check()
    device = device_of(work.scene)
    plan = plan_effects(device.spec)
    work.leash.check()
    return follow_plan(device, plan)


def _refresh_stale() -> None:
    """Make shaders agree with properties where the window had not come to it, with their tables."""
    import bpy

    from ...blender.props.followed import properties_of
    from ...blender.props.made import is_stale
    from ...blender.props.sync import refresh

    for material in bpy.data.materials:
        # The property group has its fields only at run time.
        enabled = getattr(properties_of(material), "enabled", False)
        if material.library is None and enabled and is_stale(material):
            refresh(material)
