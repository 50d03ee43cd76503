# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A formula that has been read: its value and its exact gradient."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import FloatArray, as_float
from ..errors import SpecError
from .derivative import derivative
from .error import FormulaError
from .evaluate import evaluate
from .graph import VARIABLES, Graph
from .parser import parse

MAX_OPERATIONS = 400
MAX_WITH_DERIVATIVES = 6000


@dataclass(frozen=True, eq=False)
class Formula:
    """A function of x, y, and their polar form r, phi, in one unit of length and radians.

    Attributes:
        graph: Its operations.
        value: Place of the function.
        slopes: Places of its derivatives with respect to x, y, r and phi as if they were four
            independent variables. The gradient is put together from them, so that the gradient
            of a smooth function of r, such as ``cos(r)``, is right at the origin too.
    """

    graph: Graph
    value: int
    slopes: tuple[int, int, int, int]

    @classmethod
    def read(cls, text: str, constants: Mapping[str, float] | None = None) -> "Formula":
        """Read a formula.

        Args:
            text: The formula, as `parser` describes.
            constants: Further names and their finite values.

        Returns:
            The formula.

        Raises:
            FormulaError: The text breaks a rule; the message says where.
        """
        graph = Graph(MAX_OPERATIONS)
        value = parse(text, constants or {}, graph)
        graph.limit = MAX_WITH_DERIVATIVES
        try:
            x, y, r, phi = (derivative(graph, value, variable) for variable in VARIABLES)
        except SpecError as error:
            raise FormulaError(1, f"its derivative {error}") from error
        return cls(graph, value, (x, y, r, phi))

    @property
    def is_radial(self) -> bool:
        """Whether r occurs in it in such a way that V depends on it."""
        return self.graph.constant(self.slopes[2]) != 0.0

    @property
    def is_angular(self) -> bool:
        """Whether phi occurs in it in such a way that V depends on it."""
        return self.graph.constant(self.slopes[3]) != 0.0

    def at(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the function.

        Args:
            x: In the formula's unit, shape ``(...)``.
            y: The same, broadcasting with ``x``.

        Returns:
            Shape ``(...)``; NaN where an operation has no finite value.
        """
        across, up = np.broadcast_arrays(as_float(x), as_float(y))
        (value,), finite = evaluate(self.graph, [self.value], across, up)
        return np.where(finite, value, np.nan)

    def gradient(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Return the derivatives along x and y.

        At the origin itself phi has no value: a formula with phi has no gradient there.

        Args:
            x: In the formula's unit, shape ``(...)``.
            y: The same, broadcasting with ``x``.

        Returns:
            Shape ``(..., 2)``; NaN where there is a kink, or an operation has no finite value.
        """
        across, up = np.broadcast_arrays(as_float(x), as_float(y))
        # Where V has no value it has no gradient, such as log(x) where x < 0.
        (along_x, along_y, along_r, along_phi, _), finite = evaluate(
            self.graph, (*self.slopes, self.value), across, up
        )
        radius = np.hypot(across, up)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            radial = np.where((radius == 0.0) & (along_r == 0.0), 0.0, along_r / radius)
            turning = (along_phi / radius) / radius if self.is_angular else np.zeros(())
            total = np.stack(
                (
                    along_x + radial * across - turning * up,
                    along_y + radial * up + turning * across,
                ),
                axis=-1,
            )
        finite = finite & np.isfinite(total).all(axis=-1)
        return np.where(finite[..., None], total, np.nan)
