# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Which meshes and materials the add-on made; all others are the user's and are never removed."""

import bpy

_MARK = "hoe_made"
"""Custom property; copies and files keep it, and it needs no registered add-on."""


def mark[B: bpy.types.ID](block: B) -> B:
    """Note that the add-on made a datablock.

    Args:
        block: A new mesh or material.

    Returns:
        The same.
    """
    block[_MARK] = True
    return block


def is_made(block: bpy.types.ID | None) -> bool:
    """Tell whether the add-on made a datablock, and so may exchange it or take it away.

    Args:
        block: A mesh or a material, or None for an empty slot.
    """
    return block is not None and _MARK in block
