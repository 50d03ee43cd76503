# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Entry of the Blender extension.

It imports nothing until Blender calls it: pytest treats the folder as a package because of this
file, and would otherwise load a second copy of everything below.
"""


def register() -> None:
    """Register the add-on with Blender."""
    from . import hoe_addon

    hoe_addon.register()


def unregister() -> None:
    """Take the add-on out of Blender again."""
    from . import hoe_addon

    hoe_addon.unregister()
