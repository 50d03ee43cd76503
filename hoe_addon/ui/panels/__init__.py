# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels of the sidebar and of the material properties; they draw, and compute nothing."""
