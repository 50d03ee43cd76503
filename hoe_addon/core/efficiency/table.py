# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shares of the light on a grid of wavelengths, directions and places.

A direction is told by its two cosines: the tangential components of the unit direction of travel in
the medium that the light comes from, along the grating (x) and across it (y). Between the nodes the
shares are linear in the wavelength, in each cosine, and in x and y. A dimension of one node is
collapsed: the node stands for any value.

Light from a side that is not in the table is looked up by reciprocity: a transmitted order has the
share of its reversed ray, which comes from the other side. Its reflected orders get nothing.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import BoolArray, FloatArray, IntArray, as_float
from ..errors import SpecError
from ..orders import Branch
from .incidence import Incidence, Polarization
from .interpolation import Cell, draw_node, interpolate, locate, outside
from .table_check import AXES, SIDES, Side, check_axis, check_shares

type Beyond = Literal["clamp", "zero"]

NODE_DRAWS = len(AXES)
"""Uniform numbers that choose a node, one an axis; one more chooses the order."""

_ROUNDING = 1e-9
"""A value this far beyond the nodes, as a share of the axis, still counts as inside."""


@dataclass(frozen=True, eq=False)
class EfficiencyTable:
    """Shares on a grid; an `EfficiencyModel`.

    Attributes:
        branches: The K ways out, each once.
        wavelength: Vacuum wavelengths, metres, shape ``(W,)``.
        along: Direction cosines along the grating, strictly increasing in [-1, 1], shape ``(A,)``.
        across: Direction cosines across it, shape ``(B,)``.
        x: Places on the element, metres, shape ``(X,)``.
        y: Places on the element, metres, shape ``(Y,)``.
        sides: Sides that the light comes from, each once.
        values: Power over incident power, shape ``(S, W, A, B, X, Y, K)``.
        beyond: What holds outside the wavelengths and cosines: ``clamp`` takes the nearest node,
            ``zero`` gives nothing. Places are always clamped.
    """

    branches: tuple[Branch, ...]
    wavelength: FloatArray
    along: FloatArray
    across: FloatArray
    x: FloatArray
    y: FloatArray
    sides: tuple[Side, ...]
    values: FloatArray
    beyond: Beyond = "clamp"

    def __post_init__(self) -> None:
        """Check axes and numbers."""
        if not self.branches or len(set(self.branches)) < len(self.branches):
            raise SpecError(f"order: must be listed once each, got {self.branches}")
        if (
            not self.sides
            or not set(self.sides) <= set(SIDES)
            or len(set(self.sides)) < len(self.sides)
        ):
            raise SpecError(f"incidence: must be back, front or both, got {self.sides}")
        if self.beyond not in ("clamp", "zero"):
            raise SpecError(f"beyond: must be clamp or zero, got {self.beyond!r}")
        for axis, nodes in enumerate(self.axes):
            check_axis(axis, nodes)
        check_shares(self.values, self.sides, self.axes, self.branches)

    @property
    def axes(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """The five axes in the order of the numbers: wavelength, along, across, x, y."""
        return self.wavelength, self.along, self.across, self.x, self.y

    @property
    def size(self) -> int:
        """How many numbers it holds."""
        return self.values.size

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        """Return the shares of K branches, shape ``(..., K)``; see `EfficiencyModel`.

        A branch that the table does not hold gets nothing. The polarisation is that of the table.
        """
        del polarization
        found = np.zeros((*light.shape, len(branches)))
        held = [self.branches.index(way) if way in self.branches else None for way in branches]
        seen = self._interpolated(light)
        for place, column in enumerate(held):
            if column is not None:
                found[..., place] = seen[..., column]
        absent = self._absent(light)
        if absent.any():
            for place, column in enumerate(held):
                if column is not None:
                    back = self._sent_back(light, column)
                    found[..., place] = np.where(absent, back, found[..., place])
        return found

    def stochastic(self, light: Incidence, draws: ArrayLike) -> IntArray:
        """Draw one node by its weight in the interpolation, then one branch by its share there.

        The mean over draws is that of `shares`; absorption is one of the outcomes.

        Args:
            light: The light, shape ``(...)``.
            draws: Uniform numbers in [0, 1): one for each axis, in the order of `axes`, and the
                last one for the branch; shape ``(..., 6)``.

        Returns:
            Number of the branch, or -1 where the light is absorbed, shape ``(...)``.
        """
        numbers = as_float(draws)
        shares = self._drawn(light, numbers)
        absent = self._absent(light)
        if absent.any():
            for column, way in enumerate(self.branches):
                back = light.reversed(way.steps, reflected=False)
                there = 0.0 if way.reflected else self._drawn(back, numbers)[..., column]
                shares[..., column] = np.where(absent, there, shares[..., column])
        total = np.cumsum(shares, axis=-1)
        passed = np.sum(numbers[..., NODE_DRAWS, None] >= total, axis=-1)
        return np.where(passed < len(self.branches), passed, -1).astype(np.int64)

    def _interpolated(self, light: Incidence, chosen: slice = slice(None)) -> FloatArray:
        """Shares of the table's own branches; the first side stands for one that is missing."""
        found = interpolate(self.values[..., chosen], self._side(light), self._cells(light))
        return np.where(self._beyond(light)[..., None], 0.0, found)

    def _drawn(self, light: Incidence, draws: FloatArray) -> FloatArray:
        node = draw_node(self._cells(light), draws)
        found = self.values[self._side(light), *node]
        return np.where(self._beyond(light)[..., None], 0.0, found)

    def _sent_back(self, light: Incidence, column: int) -> FloatArray | float:
        """Share of a branch by that of its reversed ray, which comes from the other side."""
        way = self.branches[column]
        if way.reflected:
            return 0.0
        back = light.reversed(way.steps, reflected=False)
        return self._interpolated(back, slice(column, column + 1))[..., 0]

    def _side(self, light: Incidence) -> IntArray:
        places = [self.sides.index(side) if side in self.sides else 0 for side in SIDES]
        return np.asarray(places, dtype=np.int64)[light.from_front.astype(np.int64)]

    def _absent(self, light: Incidence) -> BoolArray:
        missing = [side not in self.sides for side in SIDES]
        return np.asarray(missing, dtype=np.bool_)[light.from_front.astype(np.int64)]

    def _seen(self, light: Incidence) -> list[FloatArray]:
        cosines = light.tangential / light.index_in[..., None]
        values = (light.wavelength, cosines[..., 0], cosines[..., 1])
        return [*values, light.place[..., 0], light.place[..., 1]]

    def _cells(self, light: Incidence) -> list[Cell]:
        return [locate(nodes, at) for nodes, at in zip(self.axes, self._seen(light), strict=True)]

    def _beyond(self, light: Incidence) -> BoolArray:
        if self.beyond == "clamp":
            return np.zeros(light.shape, dtype=np.bool_)
        pairs = list(zip(self.axes, self._seen(light), strict=True))[:3]
        return np.any([outside(nodes, at, _ROUNDING) for nodes, at in pairs], axis=0)
