# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Validated documents: what a hologram and a device are, in nm and mm; free of bpy.

A spec that exists is valid, whether it was read from JSON or made in Python. Every mistake is a
`SpecError` whose message starts with the path of the field.
"""
