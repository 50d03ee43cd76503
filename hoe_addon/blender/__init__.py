# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that touches Blender: shaders as nodes, elements, scenes, renders.

Scripts take what they need from here, ``from hoe_addon.blender import build_device``; the list of
names is in `api`. Nothing is imported before it is asked for.
"""

from importlib import import_module
from importlib.util import find_spec


def register() -> None:
    """Register classes and properties with Blender: all of them, or none."""
    from . import parts
    from .registration import register_all

    register_all(parts.PARTS)


def unregister() -> None:
    """Undo ``register``."""
    from . import parts
    from .registration import unregister_all

    unregister_all(parts.PARTS)


def __getattr__(name: str) -> object:
    """Look a name up in `api`, which loads on first use."""
    # The import system asks here for submodules too, before it looks for their files.
    if not name.startswith("_") and find_spec(f"{__name__}.{name}") is None:
        api = import_module(f"{__name__}.api")
        if name in api.__all__:
            return getattr(api, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
