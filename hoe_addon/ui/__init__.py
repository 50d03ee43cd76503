# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's window: menus, panels, drawings in the viewport, operators, and long work beside it.

``operators`` call the functions of `blender`; ``facts`` are what panels show, worked out when
something changes; ``panels`` only draw; ``overlay`` draws into the viewport; ``jobs`` run what is
long in a process of its own.
"""


def register() -> None:
    """Register menus, panels and operators: all of them, or none."""
    from ..blender.registration import register_all
    from . import parts

    register_all(parts.PARTS)


def unregister() -> None:
    """Undo ``register``."""
    from ..blender.registration import unregister_all
    from . import parts

    unregister_all(parts.PARTS)
