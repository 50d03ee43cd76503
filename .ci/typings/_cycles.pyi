# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later

# What the add-on uses of Cycles' own module, which exists only inside Blender.

with_osl: bool

def osl_compile(input_path: str, output_path: str, /) -> bool: ...
