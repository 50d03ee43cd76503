# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What layers of a stack have in common, so that nothing is worked out twice."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from .stack import Layer, Repeat

_SAME = 1e-12
"""Thicknesses (relative) and shifts (periods) closer than this are equal."""


@dataclass(frozen=True, eq=False)
class Run:
    """Equal layers on one another, each moved by the same step against the one below.

    Attributes:
        layer: The lowest.
        count: How many, at least 1.
        step: Shift of each against the one below, in periods.
    """

    layer: Layer
    count: int = 1
    step: float = 0.0


def equal_runs(layers: Sequence[Layer | Repeat]) -> list[Run | Repeat]:
    """Take equal layers together and leave out those without thickness.

    Args:
        layers: From the back to the front.

    Returns:
        Runs in the same order; repeated layers are kept as they are.
    """
    runs: list[Run | Repeat] = []
    for layer in layers:
        if isinstance(layer, Repeat):
            runs.append(layer)
        elif layer.thickness > 0.0:
            last = runs[-1] if runs else None
            longer = _lengthened(last, layer) if isinstance(last, Run) else None
            if longer is None:
                runs.append(Run(layer))
            else:
                runs[-1] = longer
    return runs


def _lengthened(run: Run, layer: Layer) -> Run | None:
    """Return the run with a layer more on top, None if that is another one."""
    if not _equal(run.layer, layer):
        return None
    step = layer.shift - run.layer.shift - run.step * (run.count - 1)
    if run.count == 1:
        return Run(run.layer, 2, step)
    # A whole period more or less is no difference.
    if abs((step - run.step + 0.5) % 1.0 - 0.5) > _SAME:
        return None
    return Run(run.layer, run.count + 1, run.step)


def _equal(first: Layer, second: Layer) -> bool:
    near = abs(first.thickness - second.thickness) <= _SAME * first.thickness
    return near and first.pattern is second.pattern


class Kept[K, V]:
    """Results that are kept until they have been read as often as was announced."""

    def __init__(self, uses: Iterable[K]) -> None:
        """Announce the uses.

        Args:
            uses: The key of each.
        """
        self._left = Counter(uses)
        self._values: dict[K, V] = {}

    def get(self, key: K, make: Callable[[], V]) -> V:
        """Return the result of the key, made at its first use and dropped after its last."""
        value = self._values.pop(key) if key in self._values else make()
        self._left[key] -= 1
        if self._left[key]:
            self._values[key] = value
        return value
