# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiencies of a document that stand in a table of their own, in a file."""

from collections.abc import Iterable
from dataclasses import replace
from typing import Literal

from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ...core.orders import Branch
from .. import field_kinds
from ..field_error import FieldError, show
from ..tables.file import read_table
from .common import CommonFields


class TableSpec(CommonFields, frozen=True, kw_only=True, tag_field="model", tag="table"):
    """Shares by wavelength, direction and place, from a file.

    Attributes:
        file: An .npz, .csv, .txt, .bsdf or .exr file; in a document's file it may be relative to
            that file.
        beyond: What holds outside the wavelengths and angles of the table: ``clamp`` for the
            nearest, ``zero`` for nothing; None for what the file says.
    """

    file: str
    beyond: Literal["clamp", "zero"] | None = None

    @property
    def has_formula(self) -> bool:
        """Whether the shader can compute the shares itself: no, it looks them up."""
        return False

    def __post_init__(self) -> None:
        """Check the fields, and read the file."""
        field_kinds.text(self, "file")
        if self.beyond is not None:
            field_kinds.choice(self, "beyond", ("clamp", "zero"))
        self.check_common()
        self.model()

    def listed_orders(self) -> tuple[int, ...]:
        """Give every order that the file holds.

        Returns:
            The orders, increasing.
        """
        return tuple(sorted({way.order for way in self.model().branches}))

    def branches(self, orders: Iterable[int], recorded_nm: float) -> tuple[Branch, ...]:
        """List the ways out that can get light.

        Args:
            orders: The orders to trace.
            recorded_nm: Wavelength that the pattern is stated for, nm.

        Returns:
            Those of the file with one of the orders, transmitted first.
        """
        del recorded_nm
        asked = list(orders)
        held = [way for way in self.model().branches if way.order in asked]
        return tuple(sorted(held, key=lambda way: (way.reflected, asked.index(way.order))))

    def model(self) -> EfficiencyTable:
        """Make the model of the core.

        Raises:
            FieldError: The file is no longer there or no longer valid.
        """
        try:
            table = read_table(self.file)
        except SpecError as error:
            raise FieldError.told("file", f"{error}, in {show(self.file)}") from error
        return table if self.beyond is None else replace(table, beyond=self.beyond)
