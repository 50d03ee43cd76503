# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a light-guide slab, an ideal lens, or dispersive glass."""

import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty

from ...blender.add.bodies import add_glass, add_ideal_lens, add_slab, make_glass
from ...blender.ids import catalogue_items
from ...blender.registration import class_registrars
from ..ids import Op
from ..telling import tells
from .add_placing import MM, PlacedElement, report_added


class _Clear:
    """What a body is made of."""

    medium: EnumProperty(
        name="Medium",
        description="What it is made of; its index depends on the wavelength as published",
        items=catalogue_items(),
        default="N-BK7",
    )


class HOE_OT_add_slab(_Clear, PlacedElement, bpy.types.Operator):
    """Add a light-guide slab."""

    bl_idname = Op.ADD_SLAB
    bl_label = "Light-Guide Slab"
    bl_description = (
        "Add a clear plate with a black rim, in which light is guided by total reflection; put "
        "holograms on its faces with Hologram on Faces"
    )
    bl_options = {"REGISTER", "UNDO"}

    size_mm: FloatVectorProperty(
        name="Size (mm)",
        description="Width and height of the plate, in mm",
        size=2,
        default=(50.0, 30.0),
        **MM,
    )
    thickness_mm: FloatProperty(
        name="Thickness (mm)", description="Distance of its two faces, in mm", default=2.0, **MM
    )

    def add(self, scene, matrix, collection):
        """Add it."""
        size = tuple(self.size_mm)
        return add_slab(scene, size, self.thickness_mm, self.medium, matrix, collection)


class HOE_OT_add_ideal_lens(PlacedElement, bpy.types.Operator):
    """Add an ideal lens."""

    bl_idname = Op.ADD_IDEAL_LENS
    bl_label = "Ideal Lens"
    bl_description = "Add a thin lens without any error, for light of every colour"
    bl_options = {"REGISTER", "UNDO"}

    focal_length_mm: FloatProperty(
        name="Focal Length (mm)",
        description="Focal length in mm; below 0 for a lens that spreads light",
        default=100.0,
        min=-1e6,
        max=1e6,
        soft_min=-500.0,
        soft_max=500.0,
        step=100,
        precision=3,
    )
    diameter_mm: FloatProperty(
        name="Diameter (mm)", description="Diameter of the lens, in mm", default=25.0, **MM
    )

    def add(self, scene, matrix, collection):
        """Add it."""
        return add_ideal_lens(scene, self.focal_length_mm, self.diameter_mm, matrix, collection)


class HOE_OT_add_glass(_Clear, PlacedElement, bpy.types.Operator):
    """Add dispersive glass."""

    bl_idname = Op.ADD_GLASS
    bl_label = "Dispersive Glass"
    bl_description = (
        "Add a prism or a ball of real glass, which bends blue more than red; or make the selected "
        "objects of it"
    )
    bl_options = {"REGISTER", "UNDO"}

    shape: EnumProperty(
        name="Shape",
        description="What is made of glass",
        items=(
            ("PRISM", "Prism", "A prism of 60 degrees", 0),
            ("BALL", "Ball", "A ball", 1),
            ("SELECTED", "Selected Objects", "The selected mesh objects; they stay in place", 2),
        ),
        default="PRISM",
    )
    length_mm: FloatProperty(
        name="Size (mm)",
        description="Side of the prism or diameter of the ball, in mm",
        default=30.0,
        **MM,
    )

    def add(self, scene, matrix, collection):
        """Add a new body."""
        shape = self.shape.lower()
        return add_glass(scene, shape, self.length_mm, self.medium, matrix, collection)

    @tells
    def execute(self, context):
        if self.shape != "SELECTED":
            return super().execute(context)
        items = [item for item in context.selected_objects if item.type == "MESH"]
        if not items:
            self.report({"ERROR"}, "No mesh object is selected; select what is to be of glass")
            return {"CANCELLED"}
        settings = make_glass(context.scene, items, self.medium)
        report_added(self, f"{self.medium} on {len(items)} objects", settings)
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_add_slab, HOE_OT_add_ideal_lens, HOE_OT_add_glass))
