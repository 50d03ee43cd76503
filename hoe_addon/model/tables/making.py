# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of a hologram, made of its own efficiency model, and what a stopped run leaves."""

import json
import math
from collections.abc import Callable
from pathlib import Path
from time import monotonic
from typing import cast

import msgspec
import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency import Polarization
from ...core.efficiency.baked import BakedTable
from ...core.efficiency.baking import LARGEST, bake
from ...core.efficiency.node_source import NODE, NodeSource
from ...core.errors import SpecError
from ...files import replacing
from ..contents import digest, with_contents
from ..efficiency import KogelnikSpec
from ..hologram import HologramSpec
from .landmarks import landmarks
from .light import TableRange, node_source, ranges
from .npz import read_arrays

FORMAT = 3
"""Raised whenever the same hologram gives another table."""

_SAVE_SECONDS = 20.0
_PART_NAMES = {"key", "nodes", "rows"}

type Progress = Callable[[float], None]


def bake_hologram(
    spec: HologramSpec,
    tolerance: float,
    within: TableRange | None = None,
    *,
    polarization: Polarization = Polarization.UNPOLARISED,
    backward: bool = False,
    largest: int = LARGEST,
    checks: int | None = None,
    progress: Progress | None = None,
    part: Path | None = None,
) -> BakedTable:
    """Make the table of a hologram.

    Args:
        spec: The hologram.
        tolerance: Largest interpolation error to reach, absolute in the share.
        within: What to cover; None for all visible light up to a cosine of 0.98, on both sides.
        polarization: Of the light.
        backward: Whether the table is for rays that are walked backward; see `NodeSource`.
        largest: Most numbers.
        checks: Fewest random points of each measurement of the error; None for as many as fit the
            model.
        progress: Told the share that is done; what it raises stops the work.
        part: File that keeps what has been evaluated if the work is stopped; the same call goes on
            from there. Who has written the table takes it away.

    Returns:
        The table with its error.

    Raises:
        SpecError: The model or a medium does, or no order gets light.
    """
    covered = within or TableRange()
    source = node_source(spec, covered, backward=backward, polarization=polarization)
    keeper = _Keeper(source, part, table_key(spec, covered, polarization, backward=backward))
    source.notice = _Teller(progress, keeper)
    try:
        ends = ranges(spec, covered)
        peaks = landmarks(spec, source, covered.sides, ends)
        made = bake(source, covered.sides, ends, tolerance, largest, checks, peaks)
    except BaseException:
        # Whatever stops the work, what has been evaluated is worth keeping.
        keeper.save()
        raise
    if progress is not None:
        progress(1.0)
    return made


def table_key(
    spec: HologramSpec,
    within: TableRange,
    polarization: Polarization = Polarization.UNPOLARISED,
    *,
    backward: bool = False,
) -> str:
    """Hash all that the shares at a node depend on.

    Args:
        spec: The hologram.
        within: What the table covers.
        polarization: Of the light.
        backward: Whether nodes are rays that are walked backward.

    Returns:
        SHA-256 of its canonical text, and of the files named in it.
    """
    efficiency = msgspec.to_builtins(spec.efficiency)
    for name in ("haze", "lookup"):
        efficiency.pop(name, None)
    if not isinstance(spec.efficiency, KogelnikSpec):
        # All other models leave the fold to what the shares are used for.
        del efficiency["total_internal_reflection"]
    data = {
        "format": FORMAT,
        "efficiency": efficiency,
        "media": msgspec.to_builtins(spec.media),
        "pattern": msgspec.to_builtins(spec.pattern),
        "surface": msgspec.to_builtins(spec.surface),
        "orders": spec.orders,
        "range": [within.wavelength_nm, within.along, within.across, within.sides],
        "polarization": polarization.value,
        "backward": backward,
    }
    return digest(json.dumps(with_contents(data), sort_keys=True).encode())


class _Keeper:
    """Keeps what has been evaluated in a file."""

    def __init__(self, source: NodeSource, path: Path | None, key: str) -> None:
        self._source, self._path, self._key = source, path, key
        self._saved, self._time = 0, monotonic()
        if path is not None and path.is_file():
            self._restore(path)

    def _restore(self, path: Path) -> None:
        try:
            found = read_arrays(path, _PART_NAMES)
        except SpecError:
            return
        if set(found) != _PART_NAMES or str(found["key"]) != self._key:
            return
        nodes, rows = (cast("FloatArray", found[name]) for name in ("nodes", "rows"))
        width = len(self._source.branches) + len(self._source.watched)
        sound = nodes.dtype == np.float64 and rows.dtype == np.float64
        if sound and nodes.shape[1:] == (NODE,) and rows.shape == (len(nodes), width):
            self._source.restore(nodes, rows)
            self._saved = self._source.evaluated

    def now_and_then(self) -> None:
        """Save if it is some time since."""
        if monotonic() - self._time > _SAVE_SECONDS:
            self.save()

    def save(self) -> None:
        """Write the file, if there is one and anything new."""
        self._time = monotonic()
        if self._path is None or self._source.evaluated == self._saved:
            return
        nodes, rows = self._source.state()
        with replacing(self._path) as temporary, temporary.open("wb") as file:
            np.savez(file, key=np.array(self._key), nodes=nodes, rows=rows)
        self._saved = len(nodes)


class _Teller:
    """Turns how far single evaluations are into a share of all, of which nobody knows the end."""

    def __init__(self, progress: Progress | None, keeper: _Keeper) -> None:
        self._progress, self._keeper, self._steps = progress, keeper, 0

    def __call__(self, _done: float) -> None:
        self._steps += 1
        self._keeper.now_and_then()
        if self._progress is not None:
            self._progress(1.0 - math.exp(-self._steps / _TYPICAL_STEPS))


_TYPICAL_STEPS = 60.0
"""Batches of evaluations of a table of the usual size."""
