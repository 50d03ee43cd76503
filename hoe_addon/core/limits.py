# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Limits that the documents and the command line share; nothing is imported here."""

MAX_ORDER = 100
"""Highest diffraction order, either sign, that a document may list or a command be asked for."""
