# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Operations on plain numbers, for what a formula holds of constants."""

import math
import operator
from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import SpecError


def _divide(top: float, bottom: float) -> float:
    return top / bottom


_FUNCTIONS: Mapping[str, Any] = {
    "add": operator.add,
    "subtract": operator.sub,
    "multiply": operator.mul,
    "divide": _divide,
    "negate": operator.neg,
    "power": math.pow,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "atan2": math.atan2,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "abs": abs,
    "hypot": math.hypot,
    "min": min,
    "max": max,
}


def fold(name: str, numbers: Sequence[float]) -> float:
    """Work out an operation on constants.

    Args:
        name: The operation.
        numbers: Finite arguments.

    Returns:
        A finite number.

    Raises:
        SpecError: There is none.
    """
    try:
        value = float(_FUNCTIONS[name](*numbers))
    except ZeroDivisionError as error:
        raise SpecError("divides by zero") from error
    except (OverflowError, ValueError) as error:
        raise SpecError(f"{_written(name, numbers)} has no finite value") from error
    if not math.isfinite(value):
        raise SpecError(f"{_written(name, numbers)} has no finite value")
    return value


def _written(name: str, numbers: Sequence[float]) -> str:
    return f"{name}({', '.join(f'{number:g}' for number in numbers)})"
