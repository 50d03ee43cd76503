# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a display or a lamp."""

import bpy
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty

from ...blender.add.emitters import add_display, add_lamp, plain_display
from ...blender.ids import PictureKind
from ...blender.props.display import LUMINANCE_LIMITS
from ...blender.registration import class_registrars
from ...model.scene_spectra import IlluminantSpec, LedSpec, LineSpec, SpectrumSpec
from ..ids import Op
from .add_placing import MM, PlacedElement
from .redo_box import RedoBox

_LED_NM, _LASER_NM = 25.0, 1.0
"""Widths at half maximum."""


class HOE_OT_add_display(RedoBox, PlacedElement, bpy.types.Operator):
    """Add a display."""

    bl_idname = Op.ADD_DISPLAY
    bl_label = "Display"
    bl_description = "Add a picture that gives light, with the spectra of real primaries"
    bl_options = {"REGISTER", "UNDO"}

    picture: EnumProperty(
        name="Picture",
        description="What the display shows; an image of your own can be set afterwards",
        items=[item for item in PictureKind.items() if item[0] != PictureKind.IMAGE],
        default=PictureKind.CHART,
    )
    size_mm: FloatVectorProperty(
        name="Size (mm)",
        description="Width and height of the picture, in mm",
        size=2,
        default=(64.0, 36.0),
        **MM,
    )
    luminance_cd_m2: FloatProperty(
        name="Luminance (cd/m²)",
        description="Luminance of its white, in cd/m²; a phone has about 500",
        default=500.0,
        **LUMINANCE_LIMITS,
    )

    def add(self, scene, matrix, collection):
        """Add it."""
        spec = plain_display(self.picture, tuple(self.size_mm), self.luminance_cd_m2)
        return add_display(scene, spec, matrix, collection)


class HOE_OT_add_lamp(RedoBox, PlacedElement, bpy.types.Operator):
    """Add a lamp."""

    bl_idname = Op.ADD_LAMP
    bl_label = "Lamp with a Spectrum"
    bl_description = (
        "Add a lamp whose light has a spectrum, which a hologram takes apart into its colours"
    )
    bl_options = {"REGISTER", "UNDO"}

    shape: EnumProperty(
        name="Shape",
        description="Shape of the lamp",
        items=(
            ("disc", "Disc", "Round and flat, shines to its front", 0),
            ("rectangle", "Rectangle", "Flat, shines to its front", 1),
            ("sphere", "Ball", "Shines all around", 2),
            ("line", "Rod", "A round rod, shines all around", 3),
        ),
        default="disc",
    )
    size_mm: FloatVectorProperty(
        name="Size (mm)",
        description="Width and height, in mm; of a ball and a rod, thickness and height",
        size=2,
        default=(10.0, 10.0),
        **MM,
    )
    luminance_cd_m2: FloatProperty(
        name="Luminance (cd/m²)",
        description="Luminance of the lamp, in cd/m²; the sky has about 5000",
        default=1000.0,
        **LUMINANCE_LIMITS,
    )
    light: EnumProperty(
        name="Light",
        description="Spectrum of its light",
        items=(
            ("D65", "Daylight", "Average daylight, 6500 K", 0),
            ("A", "Tungsten", "A tungsten lamp, 2856 K", 1),
            ("E", "Equal Energy", "The same power at every wavelength", 2),
            ("LED", "LED", "One colour, 25 nm wide", 3),
            ("LASER", "Laser", "One colour, 1 nm wide", 4),
        ),
        default="D65",
    )
    centre_nm: FloatProperty(
        name="Colour (nm)",
        description="Wavelength of an LED or a laser, in nm: 465 blue, 532 green, 625 red",
        default=532.0,
        min=400.0,
        max=700.0,
        step=100,
        precision=1,
    )

    def add(self, scene, matrix, collection):
        """Add it."""
        size = tuple(self.size_mm)
        return add_lamp(
            scene, self.shape, size, self.luminance_cd_m2, self._spectrum(), matrix, collection
        )

    def left_out(self):
        """Only an LED and a laser have a colour to choose."""
        return () if self.light in ("LED", "LASER") else ("centre_nm",)

    def _spectrum(self) -> SpectrumSpec:
        match self.light:
            case "LED":
                return LedSpec(centre_nm=self.centre_nm, fwhm_nm=_LED_NM)
            case "LASER":
                return LineSpec(centre_nm=self.centre_nm, fwhm_nm=_LASER_NM)
            case name:
                return IlluminantSpec(illuminant=name)


register, unregister = class_registrars((HOE_OT_add_display, HOE_OT_add_lamp))
