# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Places of the pupil for a survey of the eyebox."""

from collections.abc import Iterator
from dataclasses import dataclass

from .device import LightGuideSpec


@dataclass(frozen=True)
class PupilPosition:
    """One place of the pupil.

    Attributes:
        column: Number along x, from 0 at the least x.
        row: Number along y, from 0 at the greatest y, as in a picture.
        centre_mm: Centre of the pupil in the frame of the device, mm.
    """

    column: int
    row: int
    centre_mm: tuple[float, float, float]

    @property
    def name(self) -> str:
        """Name for files, such as ``row1_column2``, counted from 1 at the top left."""
        return f"row{self.row + 1}_column{self.column + 1}"


def pupil_positions(spec: LightGuideSpec) -> Iterator[PupilPosition]:
    """The grid of the eyebox around the eye's own place, row by row from the top left.

    Args:
        spec: The device.

    Yields:
        The positions.
    """
    columns, rows = spec.eyebox.grid
    pitch_x, pitch_y = spec.eyebox.pitch_mm
    x, y, z = spec.eye.position_mm
    for row in range(rows):
        for column in range(columns):
            across = (column - (columns - 1) / 2.0) * pitch_x
            up = ((rows - 1) / 2.0 - row) * pitch_y
            yield PupilPosition(column, row, (x + across, y + up, z))
