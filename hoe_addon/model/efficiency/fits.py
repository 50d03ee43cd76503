# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an efficiency model goes with the pattern and the surface of its element."""

from pathlib import Path

import numpy as np

from ..convert import pattern_from
from ..field_error import FieldError
from ..pattern import PatternSpec
from ..surface import SurfaceSpec
from ..tables.csv_file import counts_along_the_element
from .kogelnik import KogelnikSpec
from .specs import EfficiencySpec
from .table import TableSpec

_STRAIGHT = 1e-3
"""Slope of the grating vector from x; a table is hardly ever better than that."""


def check_fits(efficiency: EfficiencySpec, pattern: PatternSpec, surface: SurfaceSpec) -> None:
    """Check a model against the element that has it.

    Args:
        efficiency: The model.
        pattern: What is recorded in the element.
        surface: The element's surface.

    Raises:
        FieldError: They do not go together; the path begins with ``efficiency``.
    """
    try:
        if isinstance(efficiency, KogelnikSpec):
            efficiency.check_on(pattern, surface)
        elif isinstance(efficiency, TableSpec):
            _check_directions(efficiency, pattern)
    except FieldError as error:
        raise error.inside("efficiency") from error


def _check_directions(table: TableSpec, pattern: PatternSpec) -> None:
    """Check that angles told along the element's x are those along its grating."""
    path = Path(table.file)
    if path.suffix.lower() != ".csv" or not counts_along_the_element(path):
        return
    along, across, _ = pattern_from(pattern).gradient(np.zeros(3)).tolist()
    if not (np.isfinite(along) and along > 0.0 and abs(across) <= _STRAIGHT * along):
        rule = (
            "must tell along_deg and across_deg where the grating vector at the centre does not "
            "point along the element's x; theta_deg and phi_deg are counted from there"
        )
        raise FieldError("file", rule, table.file)
