# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From documents to shader text and socket values, without Blender.

A shipped shader (folder `osl/`) is specialised by `#define`s that depend on the kind of a document
only: which waves, which model, which orders. Numbers travel in sockets, so that a slider does not
compile anything. Tables over the wavelength are written into the text.
"""
