# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several waves that take light from order 0 at once, each known from two-wave theory alone.

The orders +1 and -1 of one grating are a pair: while the stronger takes more than twice as much as
the weaker, it has exactly what two-wave theory says, and the weaker its share of the rest; toward
equal strength both lose half of their product. The gratings of a multiplexed hologram, which take
p_1, p_2, ... each alone, get ``p_j (1 - prod(1 - p_i)) / sum(p_i)``, and ``prod(1 - p_i)`` stays in
order 0. This keeps the energy; it is no solution of the coupled waves, see the docs for its error.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Taken:
    """What one wave does to the light in two-wave theory; shapes ``(...)``.

    Attributes:
        wave: Share that the wave takes.
        rest: Share that stays in order 0.
    """

    wave: FloatArray
    rest: FloatArray


def share_out(
    gratings: Sequence[Sequence[Taken]], bare: FloatArray
) -> tuple[FloatArray, list[list[FloatArray]]]:
    """Share the light among all waves.

    Args:
        gratings: Of each grating its orders +1 and -1, each alone with the light.
        bare: Share that passes the layer without any grating, shape ``(...)``.

    Returns:
        The share of order 0, and those of the waves. They never sum to more than 1; without
        absorption they sum to 1.
    """
    pairs = [_pair(first.wave, second.wave) for first, second in gratings]
    taken = [first + second for first, second in pairs]
    left = np.prod([1.0 - share for share in taken], axis=0)
    total = np.sum(taken, axis=0)
    if len(pairs) > 1:
        factor = np.where(total > 0.0, (1.0 - left) / np.where(total > 0.0, total, 1.0), 1.0)
        pairs = [(first * factor, second * factor) for first, second in pairs]
    passed = np.where(bare > 0.0, bare, 1.0)
    kept = bare * np.prod([each.rest / passed for pair in gratings for each in pair], axis=0)
    # Gratings of absorption can let more through than the bare layer does, but never all of them
    # together more than is there.
    return np.minimum(kept, left), [[first, second] for first, second in pairs]


def _pair(first: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
    strong, weak = np.maximum(first, second), np.minimum(first, second)
    alike = np.maximum(2.0 * weak / np.where(strong > 0.0, strong, 1.0) - 1.0, 0.0)
    both = strong * weak
    strong, weak = strong - 0.5 * alike * both, weak - (1.0 - 0.5 * alike) * both
    ahead = first >= second
    return np.where(ahead, strong, weak), np.where(ahead, weak, strong)
