# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The box at the lower left after an element was added, in which it can be changed."""

from collections.abc import Container

import bpy

_PLACING = ("align", "location", "rotation")


class RedoBox:
    """Shows the fields that apply: those of the element first, then its place."""

    def left_out(self) -> Container[str]:
        """Names of the fields that do not apply now; a subclass says which."""
        return ()

    def draw(self, _context: bpy.types.Context) -> None:
        """Lay the box out, in Blender's usual two columns."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        left_out = self.left_out()
        for field in (*type(self).__annotations__, *_PLACING):
            if field not in left_out:
                self.layout.prop(self, field)
