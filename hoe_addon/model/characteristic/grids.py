# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""V on a grid: spline coefficients in the document, or values in a file."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Annotated, cast

import numpy as np
from msgspec import Meta, Struct
from msgspec.structs import force_setattr

from ...core.arrays import FloatArray, as_float
from ...core.errors import SpecError
from ...core.spline import MINIMUM_SAMPLES, Spline2D
from ...core.units import mm_to_m
from .. import field_kinds, fields
from ..field_error import FieldError
from .file import read_grid, stamped
from .unit import UNITS, Unit

MAX_COEFFICIENTS = 512

type _Row = Annotated[tuple[float, ...], Meta(min_length=4, max_length=MAX_COEFFICIENTS)]
type Rows = Annotated[tuple[_Row, ...], Meta(min_length=4, max_length=MAX_COEFFICIENTS)]


class SplineSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="spline"):
    """V as a uniform bicubic B-spline, given by its coefficients.

    The basis function of ``coefficients[j][i]`` is centred at ``origin_mm + (i, j) * pitch_mm``.
    V is there where all 16 coefficients around are: one pitch inside the outer centres. Nothing
    is recorded beyond.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        origin_mm: Centre of ``coefficients[0][0]``, x and y in mm.
        pitch_mm: Distance of the centres along x and y, in mm.
        coefficients: Rows from low to high y, each from low to high x, in the unit; 4 to 512 each
            way.
        unit: Unit of V.
    """

    wavelength_nm: float
    origin_mm: tuple[float, float]
    pitch_mm: tuple[float, float]
    coefficients: Rows
    unit: Unit

    def __post_init__(self) -> None:
        """Check all fields."""
        fields.wavelength(self, "wavelength_nm")
        fields.vector(self, "origin_mm", 2)
        fields.vector(self, "pitch_mm", 2, above=0.0)
        field_kinds.choice(self, "unit", UNITS)
        force_setattr(self, "coefficients", _checked_rows(self.coefficients))

    def spline(self, metres_per_unit: float) -> Spline2D:
        """Make the spline of the core.

        Args:
            metres_per_unit: What 1 of the unit stands for.

        Returns:
            V in metres over metres.
        """
        return Spline2D(
            metres_per_unit * as_float(self.coefficients),
            _pair(self.origin_mm),
            _pair(self.pitch_mm),
        )


class SampledSpec(Struct, frozen=True, forbid_unknown_fields=True, tag_field="kind", tag="sampled"):
    """V as an image or an array in a file, joined by the smooth cubic spline through its values.

    The values stand on a regular grid whose outer rows and columns lie on the edges of
    ``size_mm``, centred on the origin; the first row of the file is the top one, at the largest
    y. Nothing is recorded beyond. An .exr holds float32 at best: its rounding, 6e-8 of V, comes
    out as a direction error of about that much V over the distance of two values.

    Attributes:
        wavelength_nm: Vacuum wavelength that V is stated for, in nm.
        file: A one-channel .exr, a two-dimensional .npy, or a .csv with commas; 4 to 8192 values
            each way, all finite. In a document's file it may be relative to that file.
        size_mm: Width and height of the grid on the element, in mm.
        unit: Unit of V.
    """

    wavelength_nm: float
    file: str
    size_mm: tuple[float, float]
    unit: Unit

    def __post_init__(self) -> None:
        """Check all fields, and read the file."""
        fields.wavelength(self, "wavelength_nm")
        field_kinds.text(self, "file")
        fields.vector(self, "size_mm", 2, above=0.0)
        field_kinds.choice(self, "unit", UNITS)
        try:
            read_grid(self.file)
        except SpecError as error:
            raise FieldError("file", str(error), self.file) from error

    def spline(self, metres_per_unit: float) -> Spline2D:
        """Make the spline of the core.

        Args:
            metres_per_unit: What 1 of the unit stands for.

        Returns:
            V in metres over metres.

        Raises:
            FieldError: The file is no longer there or no longer valid.
        """
        try:
            return _through(stamped(self.file), _pair(self.size_mm), metres_per_unit)
        except SpecError as error:
            raise FieldError("file", str(error), self.file) from error


@lru_cache(maxsize=2)
def _through(
    file: tuple[str, int, int], size: tuple[float, float], metres_per_unit: float
) -> Spline2D:
    """Return the spline through a file's values; the key holds the file's time and size."""
    values = read_grid(file[0])
    rows, columns = values.shape
    width, height = size
    return Spline2D.through(
        metres_per_unit * values[::-1],
        (-width / 2.0, -height / 2.0),
        (width / (columns - 1), height / (rows - 1)),
    )


def _pair(both_mm: tuple[float, float]) -> tuple[float, float]:
    return (float(mm_to_m(both_mm[0])), float(mm_to_m(both_mm[1])))


def _checked_rows(value: object) -> tuple[tuple[float, ...], ...]:
    rows = [list(row) for row in cast("Sequence[Sequence[float]]", value)]
    columns = len(rows[0]) if rows else 0
    low, high = MINIMUM_SAMPLES, MAX_COEFFICIENTS
    if not (low <= len(rows) <= high and low <= columns <= high):
        rule = f"must be {low} to {high} rows of {low} to {high} numbers"
        raise FieldError("coefficients", rule, [len(rows), columns])
    for place, row in enumerate(rows):
        if len(row) != columns:
            rule = f"must have {columns} numbers, like the first row"
            raise FieldError(f"coefficients[{place}]", rule, len(row))
        _check_row(place, row)
    numbers: FloatArray = np.asarray(rows, dtype=np.float64)
    return tuple(tuple(row) for row in numbers.tolist())


def _check_row(place: int, row: list[float]) -> None:
    for column, number in enumerate(row):
        fields.value(f"coefficients[{place}][{column}]", number)
