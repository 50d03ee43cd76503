# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holographic optical elements, traced ray by ray.

Layers, each importing only those before it: ``core`` (optics in numpy), ``model`` (validated
documents), ``shading`` (OSL and its tables), ``blender`` (scenes and renders), and on top ``ui``
(Blender's window) and ``cli`` (the command line).
"""


def register() -> None:
    """Register classes, properties and the window's parts with Blender."""
    from . import blender, ui

    blender.register()
    try:
        ui.register()
    except BaseException:
        blender.unregister()
        raise


def unregister() -> None:
    """Undo ``register``."""
    from . import blender, ui

    try:
        ui.unregister()
    finally:
        blender.unregister()
