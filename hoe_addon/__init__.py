# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holographic optical elements, traced ray by ray.

Layers, each importing only those before it: ``core`` (optics in numpy), ``model`` (validated
documents), ``shading`` (OSL and its tables), ``blender`` (the only one with bpy), ``cli``.
"""


def register() -> None:
    """Register classes and properties with Blender."""
    from . import blender

    blender.register()


def unregister() -> None:
    """Undo ``register``."""
    from . import blender

    blender.unregister()
