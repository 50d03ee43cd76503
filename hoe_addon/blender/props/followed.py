# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What of a hologram's properties depends on objects: followed sources, and the frame."""

import math

import bpy

from ...core.errors import HoeError, SpecError
from ...model.field_error import FieldError
from ...model.motion import to_wave
from ...shading.following import ROLES
from ...shading.hologram import Frame
from ..ids import PatternKind, Role, WaveKind
from ..shaders.following import Followed, lamp_like
from .values import numbers

_ORTHONORMAL = 1e-5
"""How far axes may be from unit length and a right angle; float32 is good to 1e-7."""


def has_properties() -> bool:
    """Whether materials have the properties of a hologram, that is, the add-on is registered."""
    return hasattr(bpy.types.Material, "hologram")


def properties_of(material: bpy.types.Material) -> bpy.types.PropertyGroup:
    """The properties of a material's hologram.

    Args:
        material: Any material.

    Returns:
        The group.

    Raises:
        HoeError: The add-on is not registered.
    """
    if not has_properties():
        raise HoeError("materials have no hologram properties; call hoe_addon.register() first")
    return material.hologram


def read_followed(material: bpy.types.Material) -> dict[str, Followed]:
    """Read which waves of a hologram follow an object.

    Args:
        material: The material.

    Returns:
        Waves by role.

    Raises:
        SpecError: The object is gone, or the wave cannot follow one.
    """
    recording = properties_of(material).recording
    return {
        role: _followed(getattr(recording, role), f"recording.{role}")
        for role in read_followed_roles(material)
    }


def read_followed_roles(material: bpy.types.Material) -> tuple[str, ...]:
    """List the waves of a hologram that are said to follow an object, there or not.

    Args:
        material: The material.

    Returns:
        Their roles.
    """
    properties = properties_of(material)
    if properties.pattern != PatternKind.RECORDING:
        return ()
    return tuple(role for role in ROLES if getattr(properties.recording, role).follows)


def carries(item: bpy.types.Object, material: bpy.types.Material) -> bool:
    """Tell whether an object has a material, by its mesh or by a slot of its own.

    Args:
        item: The object.
        material: The material, or its evaluated self.
    """
    return any(slot.material == material.original for slot in item.material_slots)


def carrier_of(material: bpy.types.Material) -> bpy.types.Object | None:
    """Find the object that carries a hologram.

    Args:
        material: The material, or its evaluated self.

    Returns:
        One of the scene that is shown, if it can be; there, parts of a device come before other
        objects, those of this file before linked ones, then it goes by name. Or None.
    """
    for items in (bpy.context.scene.objects, bpy.data.objects):
        found = [item for item in items if carries(item, material)]
        if found:
            return min(found, key=_rank)
    return None


def _rank(item: bpy.types.Object) -> tuple[bool, bool, str]:
    return (item.hologram.role == Role.NONE, item.library is not None, item.name)


def read_frame(material: bpy.types.Material) -> Frame:
    """Read where the frame of the recording lies in the object.

    Args:
        material: The material.

    Returns:
        The frame.

    Raises:
        SpecError: Its axes are not two unit vectors at a right angle.
    """
    frame = properties_of(material).frame
    origin, x, y = (tuple(numbers(frame, field)) for field in ("origin", "x", "y"))
    dots = (math.sumprod(x, x) - 1.0, math.sumprod(y, y) - 1.0, math.sumprod(x, y))
    if max(map(abs, dots)) > _ORTHONORMAL:
        raise SpecError(f"frame: must have two unit axes at a right angle, got {x} and {y}")
    return Frame(origin, x, y)


def out_of_scene(material: bpy.types.Material) -> str:
    """Say whether a source object was deleted, or never came along with its material.

    Blender keeps a deleted object while something points to it, only in no collection. Its last
    place goes on to count.

    Args:
        material: A hologram.

    Returns:
        What is wrong, or nothing.
    """
    recording = properties_of(material).recording
    for role in ROLES:
        group = getattr(recording, role)
        if group.follows and group.target is not None and not group.target.users_collection:
            name = group.target.name
            return f"recording.{role}.target: {name} is in no scene; its last place counts"
    return ""


def _followed(group: bpy.types.PropertyGroup, path: str) -> Followed:
    if group.target is None:
        raise FieldError(f"{path}.target", "must be an object of the scene", None)
    if group.target.matrix_world.determinant() < 0.0:
        rule = "must not be mirrored; apply its scale, or that of its parents"
        raise FieldError(f"{path}.target", rule, group.target.name)
    if group.kind == WaveKind.SYSTEM:
        raise FieldError(f"{path}.follows", "must be off for a source behind optics", True)
    try:
        wave = to_wave(group.to_document(path))
    except FieldError as error:
        raise error.inside(path) from error
    return Followed(group.target, lamp_like(wave))
