# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add the eye."""

import bpy
from bpy.props import BoolProperty, FloatProperty

from ...blender.add.eye import give_eye
from ...blender.registration import class_registrars
from ...model.device_parts import EyeSpec
from ..ids import Op
from .add_placing import MM, PlacedElement
from .redo_box import RedoBox


class HOE_OT_add_eye(RedoBox, PlacedElement, bpy.types.Operator):
    """Add the eye."""

    bl_idname = Op.ADD_EYE
    bl_label = "Eye"
    bl_description = (
        "Add an eye: a camera with a pupil that sees all wavelengths, so that the picture has "
        "its true colours"
    )
    bl_options = {"REGISTER", "UNDO"}

    pupil_diameter_mm: FloatProperty(
        name="Pupil (mm)",
        description="Diameter of the eye's pupil, in mm; 2 in sunlight, 6 at night",
        default=4.0,
        min=1e-3,
        max=1000.0,
        soft_min=1.0,
        soft_max=8.0,
        step=10,
        precision=2,
    )
    field_deg: FloatProperty(
        name="Field (deg)",
        description="Horizontal field of the picture, in degrees",
        default=40.0,
        min=0.01,
        max=179.0,
        soft_max=120.0,
        step=100,
        precision=2,
    )
    at_infinity: BoolProperty(
        name="Focus at Infinity",
        description="Whether the eye is focused on infinity",
        default=True,
    )
    focus_mm: FloatProperty(
        name="Focus (mm)",
        description="Distance that the eye is focused on, in mm, where it is not infinity",
        default=1000.0,
        **MM,
    )

    def left_out(self):
        """A distance to focus on counts only where it is not infinity."""
        return ("focus_mm",) if self.at_infinity else ()

    def add(self, scene, matrix, collection):
        """Add it."""
        spec = EyeSpec(
            pupil_diameter_mm=self.pupil_diameter_mm,
            focus_mm=None if self.at_infinity else self.focus_mm,
            field_deg=self.field_deg,
        )
        return give_eye(scene, spec, matrix, collection)

    def note(self, scene, item):
        """Say what the picture is seen by."""
        if scene.camera == item:
            return ""
        return f"the camera is still {scene.camera.name}; Look through the Eye changes that"


register, unregister = class_registrars((HOE_OT_add_eye,))
