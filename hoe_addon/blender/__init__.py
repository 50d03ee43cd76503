# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that touches Blender: shaders as nodes, elements, scenes, renders."""
