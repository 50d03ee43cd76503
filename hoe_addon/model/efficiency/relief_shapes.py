# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of one period of a thin relief in a document; 1 is the full depth."""

from typing import Literal

from msgspec import Struct
from msgspec.structs import force_setattr

from ...core.arrays import FloatArray, as_float
from ...core.errors import SpecError
from .. import field_kinds, fields
from ..field_error import FieldError
from .lists import listed
from .relief_file import FEWEST, LARGEST, MOST, read_heights


def _inside(owner: Struct, field: str) -> None:
    """Check a place or share that is neither 0 nor 1."""
    if fields.number(owner, field, above=0.0, at_most=1.0) == 1.0:
        raise FieldError(field, "must be below 1", 1.0)


class SawtoothRelief(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sawtooth"
):
    """A relief that rises along Q, continuous or in the levels of the model, with upright walls."""


class SinusoidRelief(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sinusoid"
):
    """A relief of the height (1 + cos(2 pi x)) / 2."""


class BinaryRelief(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="binary"
):
    """Ridges with upright walls, in the middle of the period.

    Attributes:
        duty: Share of the period that the ridge takes.
    """

    duty: float = 0.5

    def __post_init__(self) -> None:
        """Check the duty."""
        _inside(self, "duty")


class TriangleRelief(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="triangle"
):
    """A relief that rises straight to its ridge and falls straight again.

    Attributes:
        peak: Place of the ridge, in periods, between 0 and 1.
    """

    peak: float = 0.5

    def __post_init__(self) -> None:
        """Check the peak."""
        _inside(self, "peak")


class SampledRelief(
    Struct, frozen=True, forbid_unknown_fields=True, tag_field="shape", tag="sampled", kw_only=True
):
    """A relief by its heights at equal distances over one period, in the document or in a file.

    Attributes:
        heights: Heights at x = j / n, in full depths.
        file: A one-dimensional .npy, or a .csv or .txt of numbers; in a document's file it may be
            relative to that file. Exactly one of the two is given.
        between: ``linear`` joins the heights by straight lines, the last one to the first;
            ``steps`` holds each height up to the next one.
    """

    heights: tuple[float, ...] | None = None
    file: str | None = None
    between: Literal["linear", "steps"] = "linear"

    def __post_init__(self) -> None:
        """Check the heights, or read the file."""
        if (self.heights is None) == (self.file is None):
            both = "both" if self.file is not None else "neither"
            raise FieldError("heights", "must be given, or else a file", both)
        field_kinds.choice(self, "between", ("linear", "steps"))
        if self.file is not None:
            field_kinds.text(self, "file")
            self.samples()
            return
        items = listed("heights", self.heights, FEWEST, MOST)
        values = tuple(fields.value(f"heights[{place}]", item) for place, item in enumerate(items))
        for place, height in enumerate(values):
            if abs(height) > LARGEST:
                raise FieldError(f"heights[{place}]", f"must be at most {LARGEST:g}", height)
        force_setattr(self, "heights", values)

    def samples(self) -> FloatArray:
        """Give the heights.

        Returns:
            Heights in full depths, shape ``(n,)``.

        Raises:
            FieldError: The file is no longer there or no longer valid.
        """
        if self.file is None:
            return as_float(self.heights or ())
        try:
            return read_heights(self.file)
        except SpecError as error:
            raise FieldError("file", str(error), self.file) from error


type ReliefShape = SawtoothRelief | SinusoidRelief | BinaryRelief | TriangleRelief | SampledRelief

RELIEF_SHAPES = (SawtoothRelief, SinusoidRelief, BinaryRelief, TriangleRelief, SampledRelief)
