# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hologram without one of its effects: the simpler document that is left."""

from collections.abc import Mapping

import numpy as np
from msgspec.structs import replace

from ...core.arrays import FloatArray
from ...core.orders import TRANSMITTED_ZERO, Branch
from ...core.recording import Recording
from ..characteristic import FormulaSpec, LinearSpec, SampledSpec, SplineSpec
from ..convert import pattern_from
from ..efficiency import (
    ConstantSpec,
    EfficiencySpec,
    KinoformSpec,
    KogelnikSpec,
    PlaceFormula,
    RcwaSpec,
    ShareTable,
    TableSpec,
    Varying,
)
from ..efficiency.common import LookupSpec
from ..field_error import FieldError
from ..hologram import HologramSpec
from ..recording import RecordingSpec
from ..waves import ExtendedSourceSpec, PlaneWaveSpec, PointSourceSpec, WaveSpec
from .names import Effect

_WITH_HOLES = (FormulaSpec, SampledSpec, SplineSpec)
"""Patterns that may have places where nothing is recorded."""

_ALONG_NORMAL = 1e-9
_TABLE_HALF_NM = 0.01
"""Half of the range of a table for one wavelength."""


def without(
    spec: HologramSpec, effect: Effect, mean: Mapping[Branch, float], wavelength_nm: float
) -> HologramSpec | None:
    """Take one effect from a hologram.

    Args:
        spec: The hologram.
        effect: The effect.
        mean: Mean share of each branch over the rays that occur.
        wavelength_nm: Mean vacuum wavelength of them.

    Returns:
        The simpler hologram, or None where it has no such effect, or no simpler document exists.
    """
    try:
        return _without(spec, effect, mean, wavelength_nm)
    except FieldError:
        # What is left is no valid document, such as masks of a relief without levels.
        return None


def _without(
    spec: HologramSpec, effect: Effect, mean: Mapping[Branch, float], wavelength_nm: float
) -> HologramSpec | None:
    model = spec.efficiency
    match effect:
        case Effect.POSITION:
            return _without_position(spec)
        case Effect.EXTENDED_SOURCE:
            return _without_extent(spec)
        case Effect.HAZE if model.haze is not None:
            return replace(spec, efficiency=replace(model, haze=None))
        case Effect.TOTAL_REFLECTION if model.total_internal_reflection:
            return replace(spec, efficiency=replace(model, total_internal_reflection=False))
        case Effect.MAKING_ERRORS if isinstance(model, KinoformSpec) and model.errors is not None:
            return replace(spec, efficiency=replace(model, errors=None))
        case Effect.LEVELS if isinstance(model, KinoformSpec) and model.levels:
            return replace(spec, efficiency=replace(model, levels=0))
        case Effect.ANGLE if isinstance(model, KinoformSpec) and model.angle_dependent:
            return replace(spec, efficiency=replace(model, angle_dependent=False))
        case Effect.ABSORPTION if isinstance(model, KogelnikSpec) and model.absorption_per_mm:
            return replace(spec, efficiency=_clear(model))
        case Effect.TABLE_WAVELENGTH if _makes_table(spec):
            return _at_one_wavelength(spec, wavelength_nm)
        case _ if effect in constant_effects(spec):
            return _constant(spec, mean)
        case _:
            return None


def constant_effects(spec: HologramSpec) -> tuple[Effect, ...]:
    """Tell which effects constant shares would take from a hologram.

    Args:
        spec: The hologram.

    Returns:
        The effects that then are left out together.
    """
    match spec.efficiency:
        case KinoformSpec(angle_dependent=True):
            return (Effect.WAVELENGTH, Effect.ANGLE)
        case KinoformSpec():
            return (Effect.WAVELENGTH,)
        case KogelnikSpec():
            return (Effect.VOLUME, Effect.WAVELENGTH, Effect.ANGLE)
        case TableSpec():
            return (Effect.TABLE, *TABLE_DIMENSIONS)
        case _:
            return ()


TABLE_DIMENSIONS = (
    Effect.TABLE_WAVELENGTH,
    Effect.TABLE_ANGLE_X,
    Effect.TABLE_ANGLE_Y,
    Effect.TABLE_PLACE,
)


def has_constant_vector(spec: HologramSpec) -> bool:
    """Tell whether the grating vector is the same all over a hologram."""
    pattern = spec.pattern
    if isinstance(pattern, RecordingSpec):
        waves = (pattern.object, pattern.reference)
        return all(isinstance(wave, PlaneWaveSpec) for wave in waves)
    return isinstance(pattern, LinearSpec)


def _makes_table(spec: HologramSpec) -> bool:
    return spec.efficiency.uses_table and not isinstance(spec.efficiency, TableSpec)


def _at_one_wavelength(spec: HologramSpec, wavelength_nm: float) -> HologramSpec:
    lookup = spec.efficiency.lookup or LookupSpec()
    ends = (wavelength_nm - _TABLE_HALF_NM, wavelength_nm + _TABLE_HALF_NM)
    narrow = replace(lookup, wavelengths_nm=ends)
    return replace(spec, efficiency=replace(spec.efficiency, lookup=narrow))


def _constant(spec: HologramSpec, mean: Mapping[Branch, float]) -> HologramSpec | None:
    """The same hologram with the mean shares; None where a table of orders can not tell them."""
    model = spec.efficiency
    listed = model.branches(spec.orders, spec.pattern.wavelength_nm)
    if any(branch.frequency != 1.0 for branch in listed) or isinstance(model, RcwaSpec):
        return None
    sides: dict[bool, dict[str, float]] = {False: {}, True: {}}
    total = max(1.0, sum(mean.get(branch, 0.0) for branch in listed))
    for branch in listed:
        share = mean.get(branch, 0.0) / total
        if share > 0.0 or branch == TRANSMITTED_ZERO:
            sides[branch.reflected][str(branch.order)] = share
    constant = ConstantSpec(
        table=ShareTable(T=sides[False], R=sides[True]),
        total_internal_reflection=model.total_internal_reflection,
        haze=model.haze,
    )
    return replace(spec, efficiency=constant)


def _clear(model: KogelnikSpec) -> KogelnikSpec:
    exposures = tuple(replace(each, absorption_modulation_per_mm=0.0) for each in model.exposures)
    return replace(
        model, absorption_per_mm=0.0, absorption_modulation_per_mm=0.0, exposures=exposures
    )


def _without_extent(spec: HologramSpec) -> HologramSpec | None:
    pattern = spec.pattern
    if not isinstance(pattern, RecordingSpec):
        return None
    waves = (pattern.object, pattern.reference)
    if not any(isinstance(wave, ExtendedSourceSpec) for wave in waves):
        return None
    first, second = (_middle(wave) for wave in waves)
    return replace(spec, recording=replace(pattern, object=first, reference=second))


def _middle(wave: WaveSpec) -> WaveSpec:
    if isinstance(wave, ExtendedSourceSpec):
        return PointSourceSpec(position_mm=wave.position_mm, beam=wave.beam, index=wave.index)
    return wave


def _without_position(spec: HologramSpec) -> HologramSpec | None:
    """The same hologram with the grating vector and the layer of its centre all over."""
    if has_constant_vector(spec) and not _varies(spec):
        return None
    changed = replace(spec, efficiency=_same_everywhere(spec))
    if has_constant_vector(spec):
        return changed
    centre = np.zeros(3)
    pattern = spec.pattern
    made = pattern_from(pattern)
    if isinstance(pattern, RecordingSpec):
        assert isinstance(made, Recording), "a recording gives one"
        waves = [_plane(np.asarray(vector)) for vector in made.waves(centre)]
        if waves[0] is None or waves[1] is None:
            return None
        recording = RecordingSpec(pattern.wavelength_nm, waves[0], waves[1])
        return replace(changed, recording=recording)
    if isinstance(pattern, _WITH_HOLES):
        return None
    gradient = np.asarray(made.gradient(centre), dtype=np.float64).reshape(3)
    across = float(np.hypot(gradient[0], gradient[1]))
    if not (across > 0.0 and abs(gradient[2]) <= _ALONG_NORMAL):
        return None
    linear = LinearSpec(
        wavelength_nm=pattern.wavelength_nm,
        lines_per_mm=across / pattern.wavelength_nm * 1e6,
        azimuth_deg=float(np.degrees(np.arctan2(gradient[1], gradient[0]))),
    )
    return replace(changed, characteristic=linear)


def _plane(vector: FloatArray) -> PlaneWaveSpec | None:
    size = float(np.linalg.norm(vector))
    if not np.isfinite(size):
        return None
    x, y, z = (vector.reshape(3) / size).tolist()
    return PlaneWaveSpec(direction=(x, y, z), index=max(size, 1.0))


def _varies(spec: HologramSpec) -> bool:
    model = spec.efficiency
    if not isinstance(model, KogelnikSpec):
        return False
    values = (model.thickness_um, model.modulation, *(each.modulation for each in model.exposures))
    return any(isinstance(value, PlaceFormula) for value in values)


def _same_everywhere(spec: HologramSpec) -> EfficiencySpec:
    model = spec.efficiency
    if not isinstance(model, KogelnikSpec):
        return model
    exposures = tuple(
        replace(each, modulation=_at_centre(each.modulation)) for each in model.exposures
    )
    return replace(
        model,
        thickness_um=_at_centre(model.thickness_um),
        modulation=_at_centre(model.modulation),
        exposures=exposures,
    )


def _at_centre(value: Varying) -> float:
    if isinstance(value, PlaceFormula):
        return float(value.parsed().at(np.zeros(1), np.zeros(1))[0])
    return value
