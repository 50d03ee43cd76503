# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiencies of a hologram against wavelength and angle, for the plot of its panel."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray, as_float
from ...core.efficiency import Polarization
from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ...core.orders import Branch, order_weights
from ...model.check import light_on, recorded_place_mm, usual_light
from ...model.check.light import Angles, Lit
from ...model.hologram import HologramSpec

WAVELENGTHS_NM = np.linspace(380.0, 780.0, 201)
ANGLES_DEG = np.linspace(-89.0, 89.0, 357)
MOST_CURVES = 6
_LEAST = 0.002
"""A way out that never gets more is not drawn."""

type Way = tuple[int, bool]
"""Order, and whether it is reflected."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Shares of the traced orders at one place of a hologram, unpolarised.

    Attributes:
        ways: The ways out that get light; none where no grating was found.
        light: Angle of the light for the wavelengths, and in whose plane it is tilted for the
            angles.
        recorded_nm: Wavelength of the light for the angles, nm.
        by_wavelength: Shares at `WAVELENGTHS_NM`, shape ``(W, K)``; NaN where a medium has no
            index.
        by_angle: Shares at `ANGLES_DEG`, shape ``(A, K)``.
    """

    ways: tuple[Way, ...]
    light: Angles
    recorded_nm: float
    by_wavelength: FloatArray
    by_angle: FloatArray


def curves_of(spec: HologramSpec, table: EfficiencyTable | None = None) -> Curves:
    """Work the efficiencies out.

    Args:
        spec: The hologram.
        table: Table of its shader, made for light that is walked backward; for models that take
            too long to be evaluated here.

    Returns:
        The curves.

    Raises:
        SpecError: A medium has no index at the wavelength of the pattern.
    """
    place_mm = recorded_place_mm(spec)
    light = usual_light(spec, place_mm)
    recorded_nm = spec.pattern.wavelength_nm
    ways, sides = _ways(spec)

    def shares(wavelengths: Sequence[float], angles: Sequence[float]) -> FloatArray:
        lit = light_on(
            spec,
            wavelengths,
            angles,
            [light.phi_deg],
            from_front=light.from_front,
            at_mm=place_mm,
        )
        return _summed(_weights(spec, table, lit, ways), ways, sides)

    by_angle = shares([recorded_nm], ANGLES_DEG.tolist())
    by_wavelength = _by_wavelength(lambda nm: shares(nm, [light.theta_deg]), len(sides))
    highest = np.fmax(_highest(by_angle), _highest(by_wavelength))
    chosen = sorted(np.argsort(-highest)[:MOST_CURVES])
    chosen = [place for place in chosen if highest[place] > _LEAST]
    return Curves(
        tuple(sides[place] for place in chosen),
        light,
        recorded_nm,
        by_wavelength[:, chosen],
        by_angle[:, chosen],
    )


def _highest(shares: FloatArray) -> FloatArray:
    """Most that each way gets; 0 where nothing is known of it."""
    return as_float(np.max(np.nan_to_num(shares), axis=0))


def _ways(spec: HologramSpec) -> tuple[tuple[Branch, ...], list[Way]]:
    listed = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    return listed, list(dict.fromkeys((way.order, way.reflected) for way in listed))


def _by_wavelength(shares: Callable[[Sequence[float]], FloatArray], count: int) -> FloatArray:
    """Shares where all media have an index; a table of an index may not span what is plotted."""
    try:
        return shares(WAVELENGTHS_NM.tolist())
    except SpecError:
        rows = np.full((len(WAVELENGTHS_NM), count), np.nan)
    for place, wavelength in enumerate(WAVELENGTHS_NM.tolist()):
        try:
            rows[place] = shares([wavelength])[0]
        except SpecError:
            continue
    return rows


def _weights(
    spec: HologramSpec, table: EfficiencyTable | None, lit: Lit, ways: tuple[Branch, ...]
) -> FloatArray:
    light = lit.incidence
    if table is None:
        shares = spec.efficiency.model().shares(ways, light, Polarization.UNPOLARISED)
    else:
        shares = np.stack([_walked_back(table, lit, way) for way in ways], axis=-1)
    fan = order_weights(
        ways,
        shares,
        lit.direction,
        lit.normal,
        lit.gradient,
        lit.wavelength_nm / lit.recorded_nm,
        light.index_in,
        light.index_out,
        total_internal_reflection=spec.efficiency.total_internal_reflection,
    )
    return fan.weights[:, : len(ways)]


def _walked_back(table: EfficiencyTable, lit: Lit, way: Branch) -> FloatArray:
    back = lit.incidence.reversed(way.steps, reflected=way.reflected)
    return as_float(table.shares((way,), back, Polarization.UNPOLARISED))[:, 0]


def _summed(weights: FloatArray, ways: tuple[Branch, ...], sides: list[Way]) -> FloatArray:
    """Sum over the exposures of a multiplexed hologram."""
    total = np.zeros((len(weights), len(sides)))
    for place, way in enumerate(ways):
        total[:, sides.index((way.order, way.reflected))] += weights[:, place]
    return total
