# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders: settings, passes, errors, views, surveys and traced rays."""
