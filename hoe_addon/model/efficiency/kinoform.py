# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinoform of a document: a blazed phase relief, continuous or in steps."""

from collections.abc import Iterable

from ...core.efficiency import EfficiencyModel
from ...core.efficiency.relief import Kinoform
from ...core.orders import Branch
from ...core.units import nm_to_m
from .. import fields, medium
from ..field_error import FieldError
from ..medium import MediumRef, medium_from
from .common import CommonFields

_MAX_LEVELS = 1_000_000


class KinoformSpec(CommonFields, frozen=True, tag_field="model", tag="kinoform"):
    """A blazed phase relief, continuous or in steps.

    Attributes:
        levels: Number of levels; 0 is the continuous relief.
        design_wavelength_nm: Vacuum wavelength in nm where the relief is one wave deep.
        relief: Medium of the relief, in air.
    """

    levels: int
    design_wavelength_nm: float
    relief: MediumRef

    def __post_init__(self) -> None:
        """Check the levels, and that the relief has a depth at the design wavelength."""
        if fields.integer(self, "levels", 0, _MAX_LEVELS) == 1:
            raise FieldError("levels", "must be 0 (continuous) or at least 2", 1)
        design_nm = fields.wavelength(self, "design_wavelength_nm")
        medium.check(self, "relief")
        if medium.index_at(self, "relief", design_nm) <= 1.0:
            rule = "must have an index above 1 at the design wavelength"
            raise FieldError("relief", rule, self.relief)
        self.check_common()

    def listed_orders(self) -> tuple[int, ...]:
        """Give the orders that the model names by itself: none."""
        return ()

    def branches(self, orders: Iterable[int], recorded_nm: float) -> tuple[Branch, ...]:
        """List the ways out that can get light.

        Args:
            orders: The orders to trace.
            recorded_nm: Wavelength that the pattern is stated for, nm.

        Returns:
            The transmitted orders.
        """
        del recorded_nm
        return tuple(Branch(order) for order in orders)

    def model(self) -> EfficiencyModel:
        """Make the model of the core."""
        return Kinoform(
            levels=self.levels,
            design_wavelength=float(nm_to_m(self.design_wavelength_nm)),
            relief=medium_from(self.relief),
        )
