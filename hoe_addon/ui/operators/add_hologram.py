# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a hologram: on a plate of its own, or on faces of a mesh."""

import bpy
from bpy.props import FloatProperty, FloatVectorProperty

from ...blender.add.hologram import (
    DISTANCE_MM,
    SIZE_MM,
    WAVELENGTH_NM,
    add_hologram,
    hologram_on_faces,
    plain_hologram,
)
from ...blender.props.recording import WAVELENGTH_LIMITS
from ...blender.registration import class_registrars
from ...model.surface import PlaneSurface
from ..ids import Op
from ..telling import tells
from .add_placing import MM, PlacedElement, report_added


class _Recorded:
    """How the new hologram is recorded; all of it can be changed afterwards."""

    wavelength_nm: FloatProperty(
        name="Wavelength (nm)",
        description="Vacuum wavelength of the recording, in nm; 532 is green",
        default=WAVELENGTH_NM,
        **WAVELENGTH_LIMITS,
    )
    distance_mm: FloatProperty(
        name="Focal Length (mm)",
        description="Distance of the point that the recording wave runs to, in mm; the hologram is "
        "a lens of this focal length",
        default=DISTANCE_MM,
        **MM,
    )


class HOE_OT_add_hologram(_Recorded, PlacedElement, bpy.types.Operator):
    """Add a hologram on a new plate."""

    bl_idname = Op.ADD_HOLOGRAM
    bl_label = "Hologram"
    bl_description = (
        "Add a plate with a hologram: a point source and a plane wave are recorded, which makes a "
        "lens"
    )
    bl_options = {"REGISTER", "UNDO"}

    size_mm: FloatVectorProperty(
        name="Size (mm)",
        description="Width and height of the plate, in mm",
        size=2,
        default=SIZE_MM,
        **MM,
    )

    def add(self, scene, matrix, collection):
        """Add it."""
        spec = plain_hologram(
            PlaneSurface(size_mm=tuple(self.size_mm)),
            wavelength_nm=self.wavelength_nm,
            distance_mm=self.distance_mm,
        )
        return add_hologram(scene, spec, matrix, collection)


class HOE_OT_hologram_on_faces(_Recorded, bpy.types.Operator):
    """Make faces of a mesh a hologram."""

    bl_idname = Op.HOLOGRAM_ON_FACES
    bl_label = "Hologram on Faces"
    bl_description = (
        "Make the selected faces a hologram; in Object Mode all faces of the active object"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        item = context.object
        if item is None or item.type != "MESH" or item.mode not in ("OBJECT", "EDIT"):
            cls.poll_message_set("Select a mesh object, or faces of it in Edit Mode")
            return False
        return True

    @tells
    def execute(self, context):
        item = context.object
        editing = item.mode == "EDIT"
        if editing:
            bpy.ops.object.mode_set(mode="OBJECT")
        given = self.properties.is_property_set("distance_mm")
        faces = [face.index for face in item.data.polygons if face.select] if editing else None
        try:
            material, settings = hologram_on_faces(
                context.scene,
                item,
                faces,
                wavelength_nm=self.wavelength_nm,
                distance_mm=self.distance_mm if given else None,
            )
        finally:
            if editing:
                bpy.ops.object.mode_set(mode="EDIT")
        if not given:
            self.distance_mm = -material.hologram.recording.object.position_mm[2]
        item.active_material_index = item.material_slots.find(material.name)
        report_added(self, material.name, settings)
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_add_hologram, HOE_OT_hologram_on_faces))
