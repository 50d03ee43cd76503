# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""V as a formula."""

import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Annotated, cast

import numpy as np
from msgspec import Meta, Struct, field
from msgspec.structs import force_setattr

from ...core.arrays import BoolArray, FloatArray
from ...core.formula import Formula, FormulaError
from ...core.formula.check import find_trouble
from ...core.formula.parser import CONSTANTS, FUNCTIONS, VARIABLES
from ...core.formula.tokens import MAX_CHARACTERS
from .. import field_kinds, fields
from ..field_error import FieldError
from ..surface import SurfaceSpec
from .unit import UNITS, Unit

MAX_CONSTANTS = 32

_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]{0,31}")
_TAKEN = {**VARIABLES, **CONSTANTS, **FUNCTIONS}


class FormulaSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="formula"):
    """V as a formula of x, y, r (in mm) and phi (in radians, from x toward y, -pi to pi).

    Known are numbers, ``pi``, ``+ - * / ^`` (or ``**``), brackets, and the functions sqrt, exp,
    log, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, abs, hypot, pow, min, max.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        formula: The formula.
        unit: Unit of its value.
        constants: Further names and their values.
    """

    wavelength_nm: float
    formula: Annotated[str, Meta(max_length=MAX_CHARACTERS)]
    unit: Unit
    constants: Annotated[dict[str, float], Meta(max_length=MAX_CONSTANTS)] = field(
        default_factory=dict[str, float]
    )

    def __post_init__(self) -> None:
        """Check all fields, and read the formula."""
        fields.wavelength(self, "wavelength_nm")
        field_kinds.text(self, "formula")
        field_kinds.choice(self, "unit", UNITS)
        force_setattr(self, "constants", _checked(self.constants))
        try:
            self.parsed()
        except FormulaError as error:
            raise FieldError("formula", str(error), self.formula) from error

    def parsed(self) -> Formula:
        """Read the formula, or give it again.

        Returns:
            The formula in mm and its own unit.
        """
        return _read(self.formula, tuple(self.constants.items()))

    def check_on(self, surface: SurfaceSpec) -> None:
        """Check that it has a value and a bounded gradient on an element.

        Args:
            surface: The element's surface.

        Raises:
            FieldError: It has not; the message says where.
        """

        def inside(x: FloatArray, y: FloatArray) -> BoolArray:
            return surface.covers(np.stack((x, y, np.zeros_like(x)), axis=-1))

        half_width, half_height = surface.size_mm[0] / 2.0, surface.size_mm[1] / 2.0
        corners = (-half_width, half_width, -half_height, half_height)
        trouble = find_trouble(self.parsed(), corners, inside)
        if trouble is not None:
            rule = (
                "must have a value and a bounded gradient all over the surface: "
                f"at x = {trouble.x:.6g} mm, y = {trouble.y:.6g} mm {trouble.what}"
            )
            raise FieldError("formula", rule, self.formula)


@lru_cache(maxsize=64)
def _read(text: str, constants: tuple[tuple[str, float], ...]) -> Formula:
    return Formula.read(text, dict(constants))


def _checked(value: object) -> dict[str, float]:
    if not isinstance(value, Mapping):
        raise FieldError("constants", "must map names to numbers", value)
    table = cast("Mapping[object, object]", value)
    if len(table) > MAX_CONSTANTS:
        raise FieldError("constants", f"must be at most {MAX_CONSTANTS}", len(table))
    found: dict[str, float] = {}
    for name, number in table.items():
        if not isinstance(name, str) or not _NAME.fullmatch(name):
            rule = "names must be up to 32 letters, digits and _, not beginning with a digit"
            raise FieldError("constants", rule, name)
        if name in _TAKEN:
            raise FieldError("constants", "names must not be those of the formulas", name)
        found[name] = fields.value(f"constants.{name}", number)
    return found
