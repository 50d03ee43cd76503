# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinoform of a document: a thin phase relief, a sawtooth by default."""

from collections.abc import Iterable

from msgspec import field

from ...core.efficiency.profiles import Profile
from ...core.efficiency.relief import Kinoform
from ...core.efficiency.segments import Segments, Steps
from ...core.orders import Branch
from ...core.units import nm_to_m
from .. import field_kinds, fields, medium
from ..field_error import FieldError
from ..medium import MediumRef, medium_from
from .common import CommonFields
from .relief_errors import NO_ERRORS, ReliefErrors, check_together, made_profile
from .relief_shapes import RELIEF_SHAPES, BinaryRelief, ReliefShape, SawtoothRelief

MOST_PIECES = 64
"""Pieces of a profile that the shader sums up by itself."""

_MAX_LEVELS = 1_000_000
_ABOUT_EQUAL = 0.4
"""Share of the period from which on ridge and groove count as equal."""
_DEEPEST_WAVES = 100.0


class KinoformSpec(CommonFields, frozen=True, tag_field="model", tag="kinoform"):
    """A thin phase relief in scalar theory: a sawtooth, continuous or in steps, or another shape.

    Attributes:
        levels: Number of levels; 0 is the continuous relief.
        design_wavelength_nm: Vacuum wavelength in nm where the relief is `depth_waves` deep.
        relief: Medium of the relief, in air.
        depth_waves: Phase depth at that wavelength for light along the normal, in waves.
        angle_dependent: Whether the phase depth follows the direction of the light.
        profile: Shape of one period.
        errors: What the making of the relief does to it; None for nothing.
    """

    levels: int
    design_wavelength_nm: float
    relief: MediumRef
    depth_waves: float = 1.0
    angle_dependent: bool = True
    profile: ReliefShape = field(default_factory=SawtoothRelief)
    errors: ReliefErrors | None = None

    def __post_init__(self) -> None:
        """Check the levels, and that the relief has a depth at the design wavelength."""
        if fields.integer(self, "levels", 0, _MAX_LEVELS) == 1:
            raise FieldError("levels", "must be 0 (continuous) or at least 2", 1)
        design_nm = fields.wavelength(self, "design_wavelength_nm")
        medium.check(self, "relief")
        if medium.index_at(self, "relief", design_nm) <= 1.0:
            rule = "must have an index above 1 at the design wavelength"
            raise FieldError("relief", rule, self.relief)
        fields.number(self, "depth_waves", above=0.0, at_most=_DEEPEST_WAVES)
        field_kinds.flag(self, "angle_dependent")
        field_kinds.instance(self, "profile", *RELIEF_SHAPES)
        if self.errors is not None:
            field_kinds.instance(self, "errors", ReliefErrors)
            check_together(self.profile, self.levels, self.errors)
        else:
            check_together(self.profile, self.levels, NO_ERRORS)
        self.check_common()

    @property
    def made_depth_waves(self) -> float:
        """The phase depth with the error of the depth, in waves."""
        return self.depth_waves * (1.0 + (self.errors or NO_ERRORS).depth_error)

    @property
    def has_formula(self) -> bool:
        """Whether the shader can work the orders out by itself."""
        profile = self.made_profile()
        return not isinstance(profile, Segments | Steps) or profile.pieces <= MOST_PIECES

    def made_profile(self) -> Profile:
        """Make the profile, with the errors of its making except that of the depth."""
        return made_profile(self.profile, self.levels, self.errors or NO_ERRORS)

    @property
    def narrowest(self) -> float:
        """Width of the feature that scalar theory has to resolve, in periods.

        It is the period, but of a binary relief the narrower of ridge and groove, unless they are
        about equal: then what scalar theory is wrong by mostly cancels.
        """
        if not isinstance(self.profile, BinaryRelief):
            return 1.0
        share = min(self.profile.duty, 1.0 - self.profile.duty)
        return 1.0 if share >= _ABOUT_EQUAL else share

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

    def model(self) -> Kinoform:
        """Make the model of the core."""
        return Kinoform(
            profile=self.made_profile(),
            design_wavelength=float(nm_to_m(self.design_wavelength_nm)),
            relief=medium_from(self.relief),
            depth=self.made_depth_waves,
            angle_dependent=self.angle_dependent,
        )
