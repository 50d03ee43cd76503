# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From documents (nm, mm) to the core's own types (SI)."""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..core import kinoform
from ..core.arrays import FloatArray, as_float
from ..core.errors import SpecError
from ..core.orders import Branch
from ..core.pattern import Pattern
from ..core.recording import Recording
from ..core.shapes import Shape
from ..core.units import nm_to_m
from .characteristic.convert import characteristic_from
from .convert_waves import wave_from
from .efficiency import EfficiencySpec, KinoformSpec
from .medium import medium_from
from .pattern import PatternSpec
from .recording import RecordingSpec
from .surface import SurfaceSpec

type EfficiencyFunction = Callable[[Sequence[Branch], ArrayLike], FloatArray]
"""Base efficiencies of K branches at wavelengths in metres, shape ``(...)`` -> ``(..., K)``."""


def recording_from(spec: RecordingSpec) -> Recording:
    """Make a recording of the core.

    Args:
        spec: The recording of a document.

    Returns:
        The same recording in SI units.
    """
    return Recording(
        object=wave_from(spec.object, spec.wavelength_nm),
        reference=wave_from(spec.reference, spec.wavelength_nm),
        wavelength=float(nm_to_m(spec.wavelength_nm)),
    )


def pattern_from(spec: PatternSpec) -> Pattern:
    """Make what is recorded in an element, for the core.

    Args:
        spec: The recording or the characteristic function of a document.

    Returns:
        The pattern in SI units.
    """
    if isinstance(spec, RecordingSpec):
        return recording_from(spec)
    return characteristic_from(spec)


def shape_from(spec: SurfaceSpec) -> Shape:
    """Make the surface of an element, for the core.

    Args:
        spec: The surface of a document.

    Returns:
        The shape in metres; a mesh as it is given, see ``element.element_shape``.
    """
    return spec.core_shape()


def branches_from(efficiency: EfficiencySpec, orders: Iterable[int]) -> tuple[Branch, ...]:
    """List the ways out that the model can give light to.

    Args:
        efficiency: The model of a document.
        orders: The orders to trace.

    Returns:
        Branches, transmitted first; for a table only those with an entry. The reflected order 0
        of total internal reflection is not listed: ``core.orders.order_weights`` adds it.
    """
    if isinstance(efficiency, KinoformSpec):
        return tuple(Branch(order, reflected=False) for order in orders)
    transmitted, reflected = efficiency.table.shares("T"), efficiency.table.shares("R")
    return (
        *(Branch(order, reflected=False) for order in orders if order in transmitted),
        *(Branch(order, reflected=True) for order in orders if order in reflected),
    )


def efficiency_from(efficiency: EfficiencySpec) -> EfficiencyFunction:
    """Make the function that gives base efficiencies, before evanescence is looked at.

    Args:
        efficiency: The model of a document.

    Returns:
        Function of branches and wavelength; its result is what ``core.orders.order_weights``
        takes. It answers for any order, whether or not the document traces it.
    """
    if isinstance(efficiency, KinoformSpec):
        return _kinoform(efficiency)
    transmitted, reflected = efficiency.table.shares("T"), efficiency.table.shares("R")

    def constant(branches: Sequence[Branch], wavelength: ArrayLike) -> FloatArray:
        shares = [
            (reflected if way.reflected else transmitted).get(way.order, 0.0) for way in branches
        ]
        return np.broadcast_to(as_float(shares), (*np.shape(wavelength), len(branches)))

    return constant


def _kinoform(spec: KinoformSpec) -> EfficiencyFunction:
    relief = medium_from(spec.relief)
    design = float(nm_to_m(spec.design_wavelength_nm))

    def shares(branches: Sequence[Branch], wavelength: ArrayLike) -> FloatArray:
        try:
            alpha = kinoform.phase_depth(wavelength, design, relief)[..., None]
        except SpecError as error:
            raise SpecError(f"efficiency.relief: {error}") from error
        orders = np.asarray([way.order for way in branches], dtype=np.int64)
        transmitted = np.asarray([not way.reflected for way in branches], dtype=np.bool_)
        return np.where(transmitted, kinoform.efficiency(orders, alpha, spec.levels), 0.0)

    return shares
