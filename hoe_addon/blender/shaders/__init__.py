# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""OSL in Blender: nodes, materials, the sampled spectrum, maps and tables."""
