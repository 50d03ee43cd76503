# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors by cause. Everything that a user can mend is a HoeError; the rest is a bug."""


class HoeError(Exception):
    """Base of all errors whose message is meant for the user."""


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


class ConvergenceError(SpecError):
    """What the document asks for cannot be reached by a search; the message holds the error."""
