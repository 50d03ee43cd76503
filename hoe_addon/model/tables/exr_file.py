# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as float EXR, for the shader and for the cache.

The shares stand in the order of the table's array (side, wavelength, along, across, x, y, branch;
the last runs fastest), three a texel as R, G, B, `WIDTH` texels a row, the top row first; what is
left of the last row is 0. All else is JSON in the attribute `HEADER`: lengths in metres,
directions as cosines.
"""

import hashlib
import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
import OpenImageIO as oiio  # noqa: N813  (the name that its own documentation uses)
from numpy.typing import NDArray

from ...core.efficiency.table import EfficiencyTable
from ...core.efficiency.table_check import AXES
from ...core.errors import SpecError
from ...core.orders import Branch
from ...files import OutputError
from ..image_file import read_exr_pixels
from .edges import MOST_NUMBERS, SCHEMA

WIDTH = 512
"""Texels a row."""

CHANNELS = 3
HEADER = "hoe_table"

_MOST_HEADER = 4 * 2**20


def write_exr(
    part: Path, table: EfficiencyTable, notes: Mapping[str, object] | None = None
) -> None:
    """Write a table into a file that is being replaced; shares are rounded to float32.

    Args:
        part: The file.
        table: The table.
        notes: Anything else to keep in the header, as plain data.

    Raises:
        OutputError: It cannot be written.
    """
    rows = math.ceil(table.size / (WIDTH * CHANNELS))
    texels = np.zeros(rows * WIDTH * CHANNELS, dtype=np.float32)
    # Rounding must not lift a sum of shares: toward zero.
    flat = table.values.ravel()
    rounded = flat.astype(np.float32)
    texels[: table.size] = np.where(rounded > flat, np.nextafter(rounded, np.float32(0)), rounded)
    header = {
        "schema": SCHEMA,
        "sides": list(table.sides),
        "branches": [[way.order, way.reflected, way.frequency] for way in table.branches],
        "beyond": table.beyond,
        **{name: nodes.tolist() for name, nodes in zip(AXES, table.axes, strict=True)},
        "sha256": _digest(texels),
        "notes": dict(notes or {}),
    }
    spec = oiio.ImageSpec(WIDTH, rows, CHANNELS, oiio.FLOAT)
    spec.attribute("compression", "none")
    spec.attribute("oiio:ColorSpace", "data")
    spec.attribute(HEADER, json.dumps(header))
    output = cast("Any", oiio.ImageOutput.create(str(part)))
    if output is None or not output.open(str(part), spec):
        raise OutputError(f"{part}: cannot be written: {oiio.geterror()}")
    done = output.write_image(texels.reshape(rows, WIDTH, CHANNELS))
    if not (output.close() and done):
        raise OutputError(f"{part}: cannot be written: {output.geterror()}")


def read_exr(path: Path) -> EfficiencyTable:
    """Read a table.

    Args:
        path: The file.

    Returns:
        The table.

    Raises:
        SpecError: It is damaged, too large, or no table.
    """
    return read_exr_and_notes(path)[0]


def read_exr_and_notes(path: Path) -> tuple[EfficiencyTable, dict[str, Any]]:
    """Read a table and what else is kept in its header.

    Args:
        path: The file.

    Returns:
        The table and the notes.

    Raises:
        SpecError: It is damaged, too large, or no table.
    """
    pixels, text = read_exr_pixels(path, _check_size, HEADER)
    return _made(text, pixels.ravel())


def _check_size(spec: "oiio.ImageSpec") -> None:
    most = math.ceil(MOST_NUMBERS / (WIDTH * CHANNELS))
    if spec.nchannels != CHANNELS or spec.width != WIDTH or not 1 <= spec.height <= most:
        size = f"{spec.width} x {spec.height} texels of {spec.nchannels} channels"
        raise SpecError(f"must be {WIDTH} texels of {CHANNELS} channels wide, got {size}")


def _made(text: object, texels: NDArray[np.float32]) -> tuple[EfficiencyTable, dict[str, Any]]:
    if not isinstance(text, str) or len(text) > _MOST_HEADER:
        raise SpecError(f"is no table: the header {HEADER} is missing")
    try:
        header: dict[str, Any] = json.loads(text)
        if header["schema"] != SCHEMA or header["sha256"] != _digest(texels):
            raise SpecError("is damaged, or of another version: its numbers are not those written")
        branches = tuple(
            Branch(int(order), reflected=bool(reflected), frequency=float(frequency))
            for order, reflected, frequency in header["branches"]
        )
        axes = [np.asarray(header[name], dtype=np.float64) for name in AXES]
        sides = tuple(header["sides"])
        shape = (len(sides), *(nodes.size for nodes in axes), len(branches))
        size = math.prod(shape)
        if not 0 < size <= texels.size:
            raise SpecError(f"efficiency: must hold {size} numbers, got {texels.size}")
        values = texels[:size].astype(np.float64).reshape(shape)
        wavelength, along, across, x, y = axes
        table = EfficiencyTable(
            branches, wavelength, along, across, x, y, sides, values, header["beyond"]
        )
        return table, dict(header["notes"])
    except (KeyError, TypeError, ValueError, OverflowError, RecursionError) as error:
        raise SpecError(f"is no table: its header is damaged ({_one_line(str(error))})") from error


def _digest(texels: NDArray[np.float32]) -> str:
    return hashlib.sha256(np.ascontiguousarray(texels).tobytes()).hexdigest()


def _one_line(text: str) -> str:
    return " ".join(text.split())[:120]
