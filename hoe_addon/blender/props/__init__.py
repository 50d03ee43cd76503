# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram document as properties of a material, ``Material.hologram``.

Each group mirrors one object of the document, field by field, so that the path in an error
message is also the path of the property.
"""
