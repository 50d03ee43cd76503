# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors by cause. Everything that a user can mend is a HoeError; the rest is a bug."""


class HoeError(Exception):
    """Base of all errors whose message is meant for the user: one printable line."""

    def __init__(self, message: str = "") -> None:
        """Keep the message, which may quote what a stranger wrote.

        Args:
            message: What is wrong, the value, and what to do.
        """
        super().__init__(one_line(message))


def one_line(text: str) -> str:
    """Make any text one line that a terminal and a panel show as it is.

    Args:
        text: The text.

    Returns:
        The text; white space is one space and what cannot be printed is escaped, unless all of it
        can be printed.
    """
    if text.isprintable():
        return text
    return "".join(
        letter if letter.isprintable() else ascii(letter)[1:-1] for letter in " ".join(text.split())
    )


class SpecError(HoeError):
    """A value breaks a rule; the message starts with the path of the field."""


class MissingOslError(HoeError):
    """This Blender build, or the chosen device, cannot run OSL."""


class ShaderCompileError(HoeError):
    """An OSL shader did not compile; the message holds the first error line."""


class RenderError(HoeError):
    """A render did not give a usable picture."""


class CancelledError(HoeError):
    """The user stopped the work."""


class NotMadeError(HoeError):
    """A table or a map has to be made first, which takes long."""


class ConvergenceError(SpecError):
    """What the document asks for cannot be reached by a search; the message holds the error."""
