# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Published tables that ship with the package, read once and kept."""

from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_FOLDER = Path(__file__).parent


@cache
def load(name: str) -> NDArray[np.float64]:
    """Read a table of this folder.

    Args:
        name: File name without ``.csv``; the file has comment lines, one line of column names,
            then numbers.

    Returns:
        Table of shape ``(rows, columns)``, read-only, in the units of the column names.
    """
    with (_FOLDER / f"{name}.csv").open(encoding="utf-8") as file:
        numbers = [line for line in file if line[0].isdigit()]
    table = np.loadtxt(numbers, delimiter=",", dtype=np.float64)
    table.flags.writeable = False
    return table
