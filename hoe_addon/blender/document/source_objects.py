# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects as sources of a recording: made where the source is, and bound to a wave."""

import bpy
from mathutils import Matrix, Vector

from ...core.errors import HoeError
from ..ids import WaveKind
from ..props.followed import carrier_of, carries, read_frame
from ..props.values import number, numbers
from ..units import scale_of

_PLANE_DISTANCE_MM = 100.0
"""How far from the element the object of a plane wave is put; only its direction counts."""
_EMPTIES = {WaveKind.PLANE: "SINGLE_ARROW", WaveKind.POINT: "SPHERE"}
_LABELS = {"object": "Object Source", "reference": "Reference Source"}


def bind_source(material: bpy.types.Material, role: str, source: bpy.types.Object) -> None:
    """Let a wave of a recording follow an object.

    Args:
        material: A hologram.
        role: ``object`` or ``reference``.
        source: The object that becomes its source.

    Raises:
        HoeError: The object carries the hologram itself, or the wave cannot follow one.
    """
    wave = getattr(material.hologram.recording, role)
    if wave.kind == WaveKind.SYSTEM:
        raise HoeError(
            "a source behind optics cannot follow an object; choose another kind of wave first"
        )
    if carries(source, material):
        raise HoeError(f"object {source.name}: carries the hologram; select another object")
    wave.target = source
    wave.follows = True


def make_source(
    collection: bpy.types.Collection, material: bpy.types.Material, role: str
) -> bpy.types.Object:
    """Make an object where the source of a wave is, and let the wave follow it.

    Args:
        collection: Collection that the object is put in.
        material: A hologram.
        role: ``object`` or ``reference``.

    Returns:
        An empty; the recording stays as it is until it is moved.

    Raises:
        HoeError: The wave cannot follow an object, or nothing carries the hologram.
    """
    carrier = carrier_of(material)
    if carrier is None:
        raise HoeError(f"material {material.name}: is on no object; give it to one first")
    wave = getattr(material.hologram.recording, role)
    made = bpy.data.objects.new(_LABELS[role], None)
    try:
        bind_source(material, role, made)
    except HoeError:
        bpy.data.objects.remove(made)
        raise
    units = number(material.hologram, "units_per_mm")
    mm = units * scale_of(carrier)
    made.empty_display_type = _EMPTIES.get(WaveKind(wave.kind), "PLAIN_AXES")
    made.empty_display_size = 10.0 * mm
    collection.objects.link(made)
    frame = Matrix(read_frame(material).matrix().tolist())
    made.matrix_world = _place(wave, carrier.matrix_world @ frame, units, mm)
    return made


def _place(wave: bpy.types.PropertyGroup, here: Matrix, units: float, mm: float) -> Matrix:
    """Where the object stands; ``here`` is the frame of the recording, ``mm`` is in scene units."""
    _, turn, _ = here.decompose()
    match WaveKind(wave.kind):
        case WaveKind.POINT:
            return Matrix.Translation(here @ (Vector(numbers(wave, "position_mm")) * units))
        case WaveKind.PLANE:
            direction = turn @ Vector(numbers(wave, "direction")).normalized()
            start = here.translation - direction * _PLANE_DISTANCE_MM * mm
            return Matrix.LocRotScale(start, direction.to_track_quat("-Z", "Y"), None)
        case _:
            return Matrix.LocRotScale(here.translation, turn, None)
