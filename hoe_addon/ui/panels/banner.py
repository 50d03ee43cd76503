# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The banner: why a picture would be black, pink or wrong, with the button that mends it."""

from typing import ClassVar

import bpy

from ...blender.readiness import troubles
from ...blender.registration import class_registrars
from ..ids import Op
from .base import MATERIAL, RENDER, SCENE, SIDEBAR, Body, panel_classes, wrapped


class Banner(Body):
    """The first trouble of the scene; not there where all is well."""

    name = "banner"
    bl_label = "Not Ready"
    bl_order = 0
    bl_options: ClassVar = {"HIDE_HEADER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(troubles(context.scene))

    def draw(self, context: bpy.types.Context) -> None:
        first = troubles(context.scene)[0]
        box = self.layout.box()
        words = box.column()
        words.alert = True
        wrapped(words, context, first.words, "ERROR")
        if first.mend is not None:
            box.operator(Op.MEND, text=first.button, icon="CHECKMARK").mend = first.mend


register, unregister = class_registrars(
    panel_classes((SIDEBAR, MATERIAL, SCENE, RENDER), (Banner,))
)
