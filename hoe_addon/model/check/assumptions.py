# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What each model takes for granted, as numbers with the rule that they are held against.

References:
    Pommet, Moharam, Grann (1994), Limits of scalar diffraction theory for diffractive phase
    elements, J. Opt. Soc. Am. A 11, 1827, doi:10.1364/JOSAA.11.001827.
    Klein, Cook (1967), Unified approach to ultrasonic light diffraction, IEEE Trans. Sonics
    Ultrason. 14, 123.
    Kogelnik (1969), Coupled wave theory for thick hologram gratings, Bell Syst. Tech. J. 48, 2909,
    doi:10.1002/j.1538-7305.1969.tb01198.x.
    Moharam, Young (1978), Criterion for Bragg and Raman-Nath diffraction regimes, Appl. Opt. 17,
    1757, doi:10.1364/AO.17.001757.
"""

from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import FloatArray
from ...core.fresnel import reflectance_unpolarised
from ...core.limits import MAX_ORDER
from ...core.units import UM, nm_to_m
from ..efficiency import KinoformSpec, KogelnikSpec, RcwaSpec
from ..efficiency.rcwa_stack import materials_from
from ..hologram import HologramSpec
from ..medium import index_at, medium_from
from .fringes import Fringes, of_kogelnik
from .light import Lit
from .shares import ModelShares, absorbed, highest_order, propagating

LEAST_FEATURE = 14.0
"""Wavelengths in a feature below which scalar theory is off by more than 5 % (Pommet)."""
MOST_SHADE = 0.05
"""Share of a period that oblique light may cross inside a relief that counts as thin."""
LEAST_Q = 10.0
LEAST_RHO = 10.0
MOST_STRENGTH = np.pi / 2.0
MOST_FRESNEL = 0.01
MOST_LOSS = 1e-8
LEAST_KEPT = 0.99
"""Light that two-wave theory may not lose without absorption: it goes where nothing leaves."""

_GRAZING = 1e-3
"""Square of the least cosine of light inside a relief: it need not propagate there."""


@dataclass(frozen=True)
class Finding:
    """A number that an assumption rests on.

    Attributes:
        model: The model that makes the assumption.
        name: What the number is.
        value: The number for the ray where it is worst.
        rule: What it should be, as ``>= 10``; empty for a number without a rule.
        holds: Whether it is; None without a rule.
        words: What the number means, and where the rule comes from.
        light: The ray, in words.
        breach: What it means for the model when the rule is broken.
    """

    model: str
    name: str
    value: float
    rule: str
    holds: bool | None
    words: str
    light: str
    breach: str = "does not hold here"

    @property
    def warning(self) -> str:
        """The broken rule, such as ``kogelnik does not hold here: Q' = 3.1 < 10``; else empty."""
        if self.holds is not False:
            return ""
        sign = "<" if self.rule.startswith(">=") else ">"
        return f"{self.model} {self.breach}: {self.name} = {self.value:.3g} {sign} {self.rule[3:]}"


def findings(spec: HologramSpec, lit: Lit, models: list[ModelShares]) -> list[Finding]:
    """Test what the models of an element take for granted.

    Args:
        spec: The hologram.
        lit: The light.
        models: The models that were evaluated.

    Returns:
        The findings, model by model.
    """
    found: list[Finding] = []
    for model in models:
        found.append(_energy(lit, model))
        efficiency = model.candidate.efficiency
        if isinstance(efficiency, KinoformSpec):
            found += _thin(efficiency, lit)
        elif isinstance(efficiency, KogelnikSpec):
            found += _kept(efficiency, lit, model)
            found += _thick(efficiency, lit, own=model.candidate.own)
        elif isinstance(efficiency, RcwaSpec):
            found += _converged(efficiency, lit, model)
    return [*found, *_orders(lit)]


def _energy(lit: Lit, model: ModelShares) -> Finding:
    """The audit R + T + A = 1: A must not be negative, nor above 0 in a lossless grating."""
    name, efficiency = model.candidate.name, model.candidate.efficiency
    lost = absorbed(model)
    lossless = isinstance(efficiency, RcwaSpec) and _is_lossless(efficiency, lit)
    if lossless and highest_order(lit.incidence) < MAX_ORDER:
        words = "energy that a lossless grating loses or gains, of s or p light"
        found = _most(lit, name, "|1 - R - T|", np.abs(lost).max(axis=1), MOST_LOSS, words)
    else:
        share = f"{100.0 * (1.0 - lost.min()):.6g} %"
        words = f"at most {share} of the light goes out, s or p, and no more than 100 % may"
        found = _most(lit, name, "R + T - 1", (-lost).max(axis=1), MOST_LOSS, words)
    return replace(found, breach="does not keep the energy")


def _kept(volume: KogelnikSpec, lit: Lit, model: ModelShares) -> list[Finding]:
    """R + T of an emulsion that does not absorb: what is missing goes where nothing leaves."""
    if volume.absorption_per_mm > 0.0:
        return []
    light = lit.incidence
    kept = 1.0 - absorbed(model).mean(axis=1)
    words = "light that leaves the hologram, which does not absorb"
    found = _least(lit, "kogelnik", "R + T", kept, LEAST_KEPT, words)
    worst = int(np.argmin(kept))
    index = medium_from(volume.index).index(light.wavelength) + volume.index_shift
    outside = np.sum(light.tangential**2, axis=-1) >= index**2
    share = f"{100.0 * (1.0 - found.value):.3g} %"
    if bool(outside[worst]):
        breach = f"loses light, {share} cannot enter the emulsion"
    else:
        breach = f"loses light, {share} goes into an order that cannot leave"
        if not volume.total_internal_reflection:
            breach += "; set total_internal_reflection"
    return [replace(found, breach=breach)]


def _is_lossless(grating: RcwaSpec, lit: Lit) -> bool:
    values = [each.permittivity(lit.incidence.wavelength) for each in materials_from(grating)]
    return all(bool(np.all(value.imag == 0.0)) for value in values)


def _thin(relief: KinoformSpec, lit: Lit) -> list[Finding]:
    light = lit.incidence
    frequency = np.nan_to_num(light.frequency)
    design = index_at(relief, "relief", relief.design_wavelength_nm)
    depth = relief.made_depth_waves * nm_to_m(relief.design_wavelength_nm) / (design - 1.0)
    inside = medium_from(relief.relief).index(light.wavelength)
    if not np.any(frequency > 0.0):
        return [_fresnel(lit, "kinoform", inside)]
    with np.errstate(divide="ignore"):
        periods = 1.0 / (light.wavelength * frequency)
    slope = np.maximum(_slope(light.tangential, inside), _slope(light.shifted(1.0), np.ones(1)))
    return [
        _least(
            lit,
            "kinoform",
            "feature / wavelength",
            periods * relief.narrowest,
            LEAST_FEATURE,
            "scalar theory is off by some 5 % below features of 14 wavelengths (Pommet 1994)",
        ),
        _most(
            lit,
            "kinoform",
            "depth * tan(angle) / period",
            depth * frequency * slope,
            MOST_SHADE,
            "share of a period that light crosses inside the relief, which counts as thin",
        ),
        _plain(lit, "kinoform", "depth / period", depth * frequency, "of one whole phase depth"),
        _fresnel(lit, "kinoform", inside),
    ]


def _slope(tangential: FloatArray, index: FloatArray) -> FloatArray:
    """Tangent of the angle from the normal; large for light that does not propagate there."""
    sine = np.sqrt(np.sum(tangential**2, axis=-1)) / index
    return sine / np.sqrt(np.maximum(1.0 - sine**2, _GRAZING))


def _thick(volume: KogelnikSpec, lit: Lit, *, own: bool) -> list[Finding]:
    light = lit.incidence if own else replace(lit.incidence, waves=None)
    fringes = of_kogelnik(volume, light)
    if fringes is None:
        return []
    ray = fringes.ray(light)
    index = fringes.index.index(light.wavelength).real
    cosine = ray[:, 2] / index
    strength = fringes.modulation
    over = light.wavelength / fringes.period
    quality = 2.0 * np.pi * over**2 / light.wavelength * fringes.thickness / (index * cosine)
    with np.errstate(divide="ignore"):
        ratio = over**2 / (index * np.float64(strength))
    return [
        _least(
            lit,
            "kogelnik",
            "Q'",
            quality,
            LEAST_Q,
            "2 pi lambda d / (n Lambda^2 cos theta): thick enough for two waves (Klein, Cook 1967)",
        ),
        _least(
            lit,
            "kogelnik",
            "rho",
            ratio,
            LEAST_RHO,
            "lambda^2 / (n dn Lambda^2): weak enough for two waves (Moharam, Young 1978)",
        ),
        *_coupling(lit, fringes, ray, index),
        _fresnel(lit, "kogelnik", index),
    ]


def _coupling(lit: Lit, fringes: Fringes, ray: FloatArray, index: FloatArray) -> list[Finding]:
    """Strength pi dn d / (lambda sqrt(c_R |c_S|)) of order +1."""
    light = lit.incidence
    along_z = np.where(light.from_front, -fringes.normal, fringes.normal)
    leaving = ray[:, 2] + light.wavelength * along_z
    product = ray[:, 2] * np.abs(leaving) / index**2
    with np.errstate(divide="ignore", invalid="ignore"):
        strength = np.pi * fringes.modulation * fringes.thickness / light.wavelength
        strength = strength / np.sqrt(product)
    findings: list[Finding] = []
    back = leaving < 0.0
    if np.any(back):
        words = "pi dn d / (lambda sqrt(c_R |c_S|)) of a reflection grating: tanh^2 of it on Bragg"
        findings.append(_plain(lit, "kogelnik", "nu", np.where(back, strength, 0.0), words))
    if not np.all(back):
        words = "pi dn d / (lambda sqrt(c_R c_S)): above pi/2 light comes back into order 0"
        onward = np.where(back, 0.0, strength)
        found = _most(lit, "kogelnik", "nu", onward, float(MOST_STRENGTH), words)
        findings.append(replace(found, breach="is overmodulated"))
    return findings


def _fresnel(lit: Lit, model: str, index: FloatArray) -> Finding:
    """Light that the faces reflect, which the model leaves out."""
    light = lit.incidence
    size = np.sqrt(np.sum(light.tangential**2, axis=-1))
    kept = np.ones(light.shape)
    for first, second in ((light.index_in, index), (index, light.index_out)):
        cosine = np.sqrt(np.maximum(1.0 - (size / first) ** 2, 0.0))
        kept = kept * (1.0 - reflectance_unpolarised(cosine, first, second))
    words = "share that the two faces of the layer reflect, left out by the model"
    found = _most(lit, model, "Fresnel loss", 1.0 - kept, MOST_FRESNEL, words)
    return replace(found, breach="leaves out light that its faces reflect")


def _converged(grating: RcwaSpec, lit: Lit, model: ModelShares) -> list[Finding]:
    if model.error is None or model.harmonics is None:
        return []
    harmonics = _plain(lit, "rcwa", "harmonics", model.harmonics, "number of Fourier harmonics")
    if np.all(np.isnan(model.error)):
        return [harmonics]
    words = "bound of what any share is off by, from the last two steps of the harmonics"
    error = np.nan_to_num(model.error)
    found = _most(lit, "rcwa", "error reached", error, grating.tolerance, words)
    return [replace(found, breach="has not converged"), harmonics]


def _orders(lit: Lit) -> list[Finding]:
    beyond, back = propagating(lit.incidence)
    with np.errstate(divide="ignore"):
        period_um = 1.0 / np.nan_to_num(lit.incidence.frequency) / UM
    return [
        _plain(lit, "", "period, um", period_um, "at the centre, along the surface"),
        _plain(lit, "", "transmitted orders", beyond, "orders that propagate"),
        _plain(lit, "", "reflected orders", back, "orders that propagate"),
    ]


def _least(
    lit: Lit, model: str, name: str, values: FloatArray, bound: float, words: str
) -> Finding:
    worst = int(np.argmin(np.where(np.isnan(values), np.inf, values)))
    value = float(values[worst])
    rule, holds = f">= {bound:.3g}", bool(value >= bound)
    return Finding(model, name, value, rule, holds, words, lit.words(worst))


def _most(lit: Lit, model: str, name: str, values: FloatArray, bound: float, words: str) -> Finding:
    worst = int(np.argmax(np.where(np.isnan(values), -np.inf, values)))
    value = float(values[worst])
    rule, holds = f"<= {bound:.3g}", bool(value <= bound)
    return Finding(model, name, value, rule, holds, words, lit.words(worst))


def _plain(lit: Lit, model: str, name: str, values: FloatArray, words: str) -> Finding:
    largest = int(np.argmax(np.where(np.isnan(values), -np.inf, values)))
    return Finding(model, name, float(values[largest]), "", None, words, lit.words(largest))
