# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume gratings as layers."""

import math

import numpy as np

from ..errors import SpecError
from .stack import Layer, Repeat, Smooth

SLANTED_SLICES = 512
"""Layers per period along z. They are joined by doubling, so that many cost little; the error falls
with their square, and is about 2e-6 for a strong grating of a modulation of 0.1."""
FLAT_SLICES = 64
"""Layers per period of fringes that lie flat; a listed reflection hologram is then within 1e-6."""


def volume_layers(
    thickness: float,
    frequency_z: float,
    *,
    mean: int,
    wave: int,
    plane: bool = False,
    slices_per_fringe: int | None = None,
) -> tuple[Layer | Repeat, ...]:
    """Return a grating of the permittivity ``mean + wave cos(2 pi (x + f z))``.

    z is counted from the bottom of the grating. Fringes that stand upright are one layer. Slanted
    ones are thin layers that are moved copies of each other. Flat ones are layers of one index
    each; in layers of thickness h the wave has only the share sinc(f h), which is made up for.

    Args:
        thickness: Metres, above 0.
        frequency_z: Fringes per metre along z, f above, either sign.
        mean: Material of the mean permittivity, ``n^2``.
        wave: "Material" of its amplitude, ``2 n dn``.
        plane: Whether the fringes lie flat, so that x does not count.
        slices_per_fringe: Layers per period along z; None for `SLANTED_SLICES` or `FLAT_SLICES`.

    Returns:
        The layers from the bottom to the top.
    """
    if not (math.isfinite(thickness) and thickness > 0.0):
        raise SpecError(f"thickness: must be above 0, got {thickness}")
    if not math.isfinite(frequency_z):
        raise SpecError(f"frequency_z: must be finite, got {frequency_z}")
    if plane:
        flat = slices_per_fringe or FLAT_SLICES
        return _flat_fringes(thickness, frequency_z, (mean, wave), flat)
    slices = slices_per_fringe or SLANTED_SLICES
    count = max(1, math.ceil(slices * abs(frequency_z) * thickness))
    step = thickness / count
    series = np.array([[0.0, 1.0, 0.0], [0.5, 0.0, 0.5]], dtype=np.complex128)
    pattern = Smooth((mean, wave), series)
    lowest = Layer(pattern, step, -0.5 * frequency_z * step)
    return (Repeat((lowest,), count, -frequency_z * step),)


def _flat_fringes(
    thickness: float, frequency: float, materials: tuple[int, int], slices: int
) -> tuple[Layer | Repeat, ...]:
    """Return whole fringes as a repetition, then what is left of the last one."""
    fringes = abs(frequency) * thickness
    whole = math.floor(fringes)
    cell = _cosine(1.0, materials, slices)
    period = thickness / fringes if fringes else 0.0
    layers: list[Layer | Repeat] = []
    if whole:
        layers.append(Repeat(tuple(Layer(p, period / slices) for p in cell), whole))
    count = max(1, math.ceil((fringes - whole) * slices))
    rest = _cosine(fringes - whole, materials, count)
    layers += [Layer(p, (thickness - whole * period) / count) for p in rest]
    return tuple(layers)


def _cosine(turns: float, materials: tuple[int, int], count: int) -> list[Smooth]:
    """Return slices of the wave from its crest through a number of turns."""
    strength = 1.0 / float(np.sinc(turns / count))
    phases = 2.0 * np.pi * turns * (np.arange(count) + 0.5) / count
    waves = strength * np.cos(phases)
    return [Smooth(materials, np.array([[1.0], [wave]], dtype=np.complex128)) for wave in waves]
