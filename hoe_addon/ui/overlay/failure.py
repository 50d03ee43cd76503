# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of a mistake of our own: it is printed once and ends the drawing.

Else it would be printed at every redraw and every change. The panel of the overlay says why
nothing is drawn.
"""

import sys
import traceback
from collections.abc import Callable


class _Failure:
    """The first mistake since the add-on was enabled; one for the process."""

    text = ""


def text() -> str:
    """Why nothing is drawn any more, or nothing."""
    return _Failure.text


def forget() -> None:
    """Try again."""
    _Failure.text = ""


def guarded(work: Callable[[], None]) -> None:
    """Do something, unless there was a mistake before.

    Args:
        work: What is done.
    """
    if _Failure.text:
        return
    try:
        work()
    except Exception as error:  # noqa: BLE001 - whatever it is, it would come again and again
        _Failure.text = f"{type(error).__name__}: {error}"
        traceback.print_exc(file=sys.stderr)
