# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How operators tell what went wrong."""

from collections.abc import Callable
from functools import wraps
from typing import Any

import bpy

from ..core.errors import HoeError

type Execute = Callable[[Any, bpy.types.Context], set[str]]


def tells(execute: Execute) -> Execute:
    """Let an operator tell an error of ours in its one line; faults keep their traceback.

    Args:
        execute: An operator's method.

    Returns:
        The method, which reports and cancels where it would raise ``HoeError``.
    """

    @wraps(execute)
    def told(self: Any, context: bpy.types.Context) -> set[str]:
        try:
            return execute(self, context)
        except HoeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return told
