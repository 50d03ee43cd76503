# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Register several things as one: all of them, or none."""

from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from inspect import get_annotations
from typing import Protocol

import bpy

type BlenderClass = type[
    bpy.types.PropertyGroup
    | bpy.types.Operator
    | bpy.types.Panel
    | bpy.types.Menu
    | bpy.types.UIList
    | bpy.types.AddonPreferences
]
type Registrar = Callable[[], None]


class Part(Protocol):
    """Whatever can be registered: a module or an object with these two functions."""

    def register(self) -> None:
        """Add it to Blender."""
        ...

    def unregister(self) -> None:
        """Take it out again."""
        ...


def register_all(parts: Iterable[Part]) -> None:
    """Register parts in order. When one fails, those before it are taken out, and it is raised.

    Args:
        parts: Each after what it depends on.
    """
    with ExitStack() as undo:
        for part in parts:
            part.register()
            undo.callback(part.unregister)
        undo.pop_all()


def unregister_all(parts: Iterable[Part]) -> None:
    """Unregister parts, the last one first. When one fails the others still go.

    Args:
        parts: In the order in which they were registered.
    """
    with ExitStack() as undo:
        for part in parts:
            undo.callback(part.unregister)


def class_registrars(classes: Sequence[BlenderClass]) -> tuple[Registrar, Registrar]:
    """Make the pair of functions that a module with Blender classes has.

    Args:
        classes: Each after those that it refers to.

    Returns:
        ``register`` and ``unregister``.
    """
    parts = [_ClassPart(blender_class) for blender_class in classes]
    return lambda: register_all(parts), lambda: unregister_all(parts)


def _allow_override(group: type[bpy.types.PropertyGroup]) -> None:
    """Let properties be changed where their datablock overrides one of a linked file.

    One that says by itself what it allows is left alone.
    """
    fields = (get_annotations(each) for each in group.__mro__)
    for declared in (declared for each in fields for declared in each.values()):
        wanted = {"LIBRARY_OVERRIDABLE"}
        if declared.function is bpy.props.CollectionProperty:
            wanted.add("USE_INSERTION")
        declared.keywords.setdefault("override", wanted)


class _ClassPart:
    """One class."""

    def __init__(self, blender_class: BlenderClass) -> None:
        self._class = blender_class

    def register(self) -> None:
        if issubclass(self._class, bpy.types.PropertyGroup):
            _allow_override(self._class)
        bpy.utils.register_class(self._class)

    def unregister(self) -> None:
        bpy.utils.unregister_class(self._class)
