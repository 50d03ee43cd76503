# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions given outright, one kind a file; each is a `Pattern`."""

from .linear import LinearGrating

__all__ = ["LinearGrating"]
