# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The banner: why a picture would be black, pink or wrong, with the button that mends it."""

from typing import ClassVar

import bpy

from ...blender.readiness import troubles
from ..ids import Op
from ..wording import in_plain_words
from .base import MATERIAL, RENDER, SCENE, SIDEBAR, Body, panel_registrars, wrapped


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
        wrapped(words, context, _plain(first.words), "ERROR")
        if first.mend is not None:
            box.operator(Op.MEND, text=first.button, icon="CHECKMARK").mend = first.mend


def _plain(words: str) -> str:
    """Trouble of a hologram begins with its name, and the problem follows."""
    name, colon, told = words.partition(": ")
    return f"{name}{colon}{in_plain_words(told)}"


register, unregister = panel_registrars((SIDEBAR, *MATERIAL, SCENE, RENDER), (Banner,))
