# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A grating of a document that is solved rigorously: relief, layers, or volume grating."""

from collections.abc import Iterable
from typing import Literal

from msgspec import Struct
from msgspec.structs import force_setattr

from ...core.efficiency.rigorous import RigorousGrating
from ...core.orders import Branch
from ...core.rcwa.solve import MAX_HARMONICS
from .. import field_kinds, fields
from ..field_error import FieldError
from . import optical_index
from .common import CommonFields
from .lists import structs
from .optical_index import OpticalIndex
from .rcwa_layers import DEEPEST_UM
from .rcwa_profile import PROFILES, RELIEFS, ProfileSpec, SlantedProfile, VolumeProfile
from .rcwa_stack import materials_from, most_harmonics, stack_from

AUTO = "auto"
LEAST_TOLERANCE, MOST_TOLERANCE = 1e-9, 0.1
_MOST_SLICES = 1000
_MOST_COATINGS = 200


class CoatingSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A homogeneous layer.

    Attributes:
        index: Its material.
        thickness_um: Thickness, micrometres.
    """

    index: OpticalIndex
    thickness_um: float

    def __post_init__(self) -> None:
        """Check material and thickness."""
        optical_index.check(self, "index")
        fields.number(self, "thickness_um", above=0.0, at_most=DEEPEST_UM)


class RcwaSpec(CommonFields, frozen=True, kw_only=True, tag_field="model", tag="rcwa"):
    """A one-dimensional grating, solved by rigorous coupled-wave analysis in conical mount.

    The half spaces are the media of the hologram, back and front. The grating is the same all over
    the element, but for its period.

    Attributes:
        profile: The cross-section, from its foot at the back to its top.
        ridge: Material of a relief; reliefs only.
        groove: What fills the rest of the relief's depth; reliefs only, which have air by default.
        under: Layers between the back medium and the profile, from the back to the front.
        over: Layers between the profile and the front medium, from the back to the front.
        slices: Into how many layers a profile without upright walls is cut; ``auto`` cuts finer
            with more harmonics.
        harmonics: Number of Fourier harmonics, odd, -N .. N; ``auto`` raises it until the error
            of the shares is below the tolerance.
        tolerance: Largest error of a share, as the last numbers of harmonics tried show it.
    """

    profile: ProfileSpec
    ridge: OpticalIndex | None = None
    groove: OpticalIndex | None = None
    under: tuple[CoatingSpec, ...] = ()
    over: tuple[CoatingSpec, ...] = ()
    slices: Literal["auto"] | int = AUTO
    harmonics: Literal["auto"] | int = AUTO
    tolerance: float = 1e-3

    def __post_init__(self) -> None:
        """Check all fields."""
        field_kinds.instance(self, "profile", *PROFILES)
        self._check_materials()
        for field in ("under", "over"):
            structs(self, field, CoatingSpec, 0, _MOST_COATINGS)
        if isinstance(self.slices, str):
            self._check_auto("slices")
        else:
            fields.integer(self, "slices", 1, _MOST_SLICES)
        self._check_harmonics()
        fields.number(self, "tolerance", at_least=LEAST_TOLERANCE, at_most=MOST_TOLERANCE)
        self.check_common()

    def _check_materials(self) -> None:
        shape = type(self.profile).__struct_config__.tag
        relief = isinstance(self.profile, RELIEFS)
        for field in ("ridge", "groove"):
            value = getattr(self, field)
            if value is not None and not relief:
                rule = f"must be left out where profile.shape is {shape}, which has its own indices"
                raise FieldError(field, rule, value)
            if value is not None:
                optical_index.check(self, field)
        if relief and self.ridge is None:
            raise FieldError("ridge", f"must be given where profile.shape is {shape}", None)
        if relief and self.groove is None:
            force_setattr(self, "groove", 1.0)

    def _check_auto(self, field: str) -> None:
        word = getattr(self, field)
        if word != AUTO:
            raise FieldError(field, f"must be {AUTO} or a whole number", word)

    def _check_harmonics(self) -> None:
        if isinstance(self.harmonics, str):
            self._check_auto("harmonics")
        elif fields.integer(self, "harmonics", 1, MAX_HARMONICS) % 2 == 0:
            raise FieldError("harmonics", "must be odd, 2 N + 1, or auto", self.harmonics)

    @property
    def has_formula(self) -> bool:
        """Whether the shader has a formula: none, the shares are baked into a table."""
        return False

    def listed_orders(self) -> tuple[int, ...]:
        """Give the orders that the model names by itself: none."""
        return ()

    def branches(self, orders: Iterable[int], recorded_nm: float) -> tuple[Branch, ...]:
        """List the ways out that can get light.

        Args:
            orders: The orders to trace.
            recorded_nm: Wavelength that the pattern is stated for, nm.

        Returns:
            All orders, transmitted first.
        """
        del recorded_nm
        asked = tuple(orders)
        return tuple(Branch(order, reflected=side) for side in (False, True) for order in asked)

    def model(self) -> RigorousGrating:
        """Make the model of the core."""
        return RigorousGrating(
            stack=lambda frequency, harmonics: stack_from(self, frequency, harmonics),
            materials=[material.permittivity for material in materials_from(self)],
            fixed=not isinstance(self.profile, SlantedProfile | VolumeProfile),
            harmonics=self.harmonics if isinstance(self.harmonics, int) else None,
            tolerance=self.tolerance,
            maximum=most_harmonics(self),
            path="efficiency.",
        )
