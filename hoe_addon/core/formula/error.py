# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of a formula's text."""

from ..errors import SpecError


class FormulaError(SpecError):
    """A formula breaks a rule.

    Attributes:
        column: Place of the mistake in the text, counted from 1.
    """

    def __init__(self, column: int, rule: str) -> None:
        """Make the message ``column N: rule``."""
        self.column = column
        super().__init__(f"column {column}: {rule}")
