# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables for the shader: made once, kept in files, made anew when missing or damaged."""

import hashlib
import logging
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ...core.efficiency.baked import BakedTable
from ...core.efficiency.baking import LARGEST
from ...core.efficiency.table import EfficiencyTable
from ...core.efficiency.table_check import SIDES
from ...core.errors import NotMadeError, SpecError
from ...files import replacing
from ..efficiency import TableSpec
from ..efficiency.common import LookupSpec
from ..hologram import HologramSpec
from ..map_cache import cache_folder
from .exr_file import read_exr_and_notes, write_exr
from .light import TableRange
from .making import bake_hologram, table_key

_log = logging.getLogger(__name__)

type Progress = Callable[[float], None]


@dataclass(frozen=True, eq=False)
class KeptTable:
    """A table in the cache; errors are absolute in the share.

    Attributes:
        table: The table, in float32 precision.
        path: Its file; see `exr_file` for the layout.
        quantile: Interpolation error that 99 % of random points keep, away from cut-offs.
        error: Largest error of them, which may be larger at other points.
        rms: Root of the mean square of it.
        landmark_error: Largest error at landmarks, such as light on Bragg.
        cutoff_error: Largest error in cells with a cut-off.
        cutoff_part: Part of all directions that lie in such cells.
        spread: Largest difference of s and p.
        mean_spread: Mean of it.
    """

    table: EfficiencyTable
    path: Path
    quantile: float
    error: float
    rms: float
    landmark_error: float
    cutoff_error: float
    cutoff_part: float
    spread: float
    mean_spread: float


_NOTES = (
    "quantile",
    "error",
    "rms",
    "landmark_error",
    "cutoff_error",
    "cutoff_part",
    "spread",
    "mean_spread",
)


def table_for(
    spec: HologramSpec,
    progress: Progress | None = None,
    backward: bool = True,
    folder: Path | None = None,
    *,
    make: bool = True,
) -> EfficiencyTable:
    """Give the table of a hologram; see `kept_table`."""
    return kept_table(spec, progress, backward, folder, make=make).table


def kept_table(
    spec: HologramSpec,
    progress: Progress | None = None,
    backward: bool = True,
    folder: Path | None = None,
    *,
    make: bool = True,
) -> KeptTable:
    """Give the table of a hologram with its error, from the cache where it is there.

    Args:
        spec: The hologram; the tolerance is that of its look-up.
        progress: Told the share that is done, where it has to be made; what it raises, such as
            `CancelledError`, stops the work; the next call goes on from there.
        backward: Whether the table is for rays that are walked backward, as a picture is made:
            then each entry is the share of the light that takes the branch into the reverse of the
            walked ray.
        folder: Folder of the cache, unless the environment names one.
        make: Whether to make the table where it is not in the cache.

    Returns:
        The table.

    Raises:
        NotMadeError: It is not in the cache, and is not to be made.
        OutputError: The file cannot be written.
        SpecError: The model or a medium has no answer.
    """
    tolerance = (spec.efficiency.lookup or LookupSpec()).tolerance
    within = TableRange.of(spec.efficiency.lookup)
    text = f"{table_key(spec, within, backward=backward)} {tolerance!r}"
    key = hashlib.sha256(text.encode()).hexdigest()
    path = cache_folder(folder) / f"table-{key}.exr"
    kept = _kept(path, key)
    if kept is not None:
        return kept
    if not make:
        raise NotMadeError("efficiency: needs its table, which may take minutes; press Bake")
    unfinished = path.with_suffix(".part.npz")
    table = None if backward else _own_table(spec)
    notes: dict[str, object] = dict.fromkeys(_NOTES, 0.0)
    if table is None:
        made = bake_hologram(
            spec, tolerance, within, backward=backward, progress=progress, part=unfinished
        )
        table = made.table
        notes = {name: getattr(made, name) for name in _NOTES}
        if not made.reached:
            _log.warning("%s: %s", spec.name, _shortfall(made))
    with replacing(path) as part:
        write_exr(part, table, {"key": key, **notes})
    unfinished.unlink(missing_ok=True)
    kept = _kept(path, key)
    # What was written is what later calls get: rounded alike. Only a broken disk gives none.
    if kept is None:
        raise SpecError(f"{path}: cannot be read back")
    return kept


def _shortfall(made: BakedTable) -> str:
    """Words for a table that is not as good as asked for."""
    return (
        f"a table of {made.table.size} numbers is within {made.quantile:.1e} for 99 % of the "
        f"directions away from cut-offs of orders, {made.landmark_error:.1e} on Bragg, and "
        f"{made.cutoff_error:.1e} beside cut-offs ({100.0 * made.cutoff_part:.0f} % of the "
        f"directions), where {made.tolerance:g} was asked for; lookup.angle_deg and "
        "lookup.wavelengths_nm narrow it"
    )


def _own_table(spec: HologramSpec) -> EfficiencyTable | None:
    """Give the table that a hologram has already, with the orders that it traces, if it serves."""
    if not isinstance(spec.efficiency, TableSpec):
        return None
    table = spec.efficiency.model()
    branches = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    if set(table.sides) != set(SIDES) or not branches:
        return None
    columns = [table.branches.index(way) for way in branches]
    if table.size // len(table.branches) * len(columns) > LARGEST:
        return None
    return replace(table, branches=branches, values=table.values[..., columns])


def _kept(path: Path, key: str) -> KeptTable | None:
    if not path.is_file():
        return None
    try:
        table, notes = read_exr_and_notes(path)
    except SpecError:
        return None
    if notes.get("key") != key:
        return None
    return _with_notes(table, path, notes)


def _with_notes(table: EfficiencyTable, path: Path, notes: dict[str, Any]) -> KeptTable | None:
    try:
        numbers = {name: float(notes[name]) for name in _NOTES}
    except (KeyError, TypeError, ValueError):
        return None
    return KeptTable(table, path, **numbers)
