# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work in a process of its own, with progress and a way to stop."""

from .current import running

__all__ = ["running"]
