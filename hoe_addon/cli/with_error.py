# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with their standard errors, for people."""


def with_error(value: float, error: float | None, digits: int) -> str:
    """Write a number with its standard error, such as ``22.6 +- 0.04``.

    Args:
        value: The number.
        error: Its standard error; None where that is not known.
        digits: Digits of the number after the point.

    Returns:
        The text; the error has one digit that counts.
    """
    spread = "" if error is None else f" +- {float(f'{error:.1g}'):g}"
    return f"{value:.{digits}f}{spread}"
