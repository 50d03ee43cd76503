# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes on Bragg, and beside it: what random points miss where a hologram is sharp.

With the grating vector K of the developed layer and rho that of the light inside it, the order +1
is on Bragg where 2 rho.K + K.K = 0; of the order -1 K has the other sign. For a direction that is
the wavelength, but for dispersion; for a wavelength it is the angle in the plane of K.
"""

from collections.abc import Callable
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import BoolArray, FloatArray, as_float, dot
from ...core.efficiency import Incidence
from ...core.efficiency.node_source import NODE, NodeSource
from ...core.efficiency.table_check import SIDES, Side
from ...core.efficiency.volume import VolumeGrating
from ...core.units import UM, nm_to_m
from ..efficiency import KogelnikSpec, RcwaSpec
from ..efficiency.optical_index import material_from
from ..efficiency.rcwa_profile import VolumeProfile
from ..hologram import HologramSpec

type _Fringes = Callable[[Incidence], tuple[FloatArray, list[FloatArray]]]
"""See `VolumeGrating.fringes`."""

type _Ranges = tuple[tuple[float, float], ...]

_MOST_CHIEF = {False: 48, True: 6}
"""Most chief landmarks, those of the recording; fewer of a rigorous model, which takes its time."""
_MOST_OTHERS = {False: 256, True: 32}

_APART = np.outer((1.0, -1.0), (1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2)).ravel()
"""Neighbours of a chief landmark: relative of the wavelength, absolute of a cosine."""

_STEPS = (9, 9, 5, 3, 3)
"""Wavelengths, cosines along and across, x and y that landmarks are looked for at."""

_BESIDE = 1.0 / 32.0
"""Landmarks with a cut-off nearer than this part of an axis do not count, but for chief ones."""

_ROUNDS = 6
_ROUNDING = 1e-9
_SAME = (1e-14, 1e-9, 1e-9, 1e-6, 1e-6)
"""Landmarks that differ by less, in metres and cosines, are one."""
_SEED = 20260602


def landmarks(
    spec: HologramSpec, source: NodeSource, sides: tuple[Side, ...], ranges: _Ranges
) -> FloatArray:
    """Find nodes at which a hologram of fringes is on Bragg, and some beside them.

    Args:
        spec: The hologram.
        source: The source of its table.
        sides: Sides that the light comes from.
        ranges: First and last value of each axis of the table.

    Returns:
        Nodes within the ranges, the most important ones first, shape ``(N, 6)``; none for models
        without fringes.
    """
    fringes = _fringes(spec)
    if fringes is None:
        return np.empty((0, NODE))
    rng = np.random.default_rng(_SEED)
    slow = isinstance(spec.efficiency, RcwaSpec)
    fronts = [float(SIDES.index(side)) for side in sides]
    chief = _solved(source, fringes, ranges, *_chief_seeds(spec, source, fronts, ranges))
    chief = rng.permutation(chief)[: _MOST_CHIEF[slow]]
    others = _solved(source, fringes, ranges, *_lattice(fronts, ranges))
    others = others[_far_from_cutoffs(source, others, ranges)]
    others = rng.permutation(others)[: _MOST_OTHERS[slow]]
    beside = _inside(_neighbours(chief, ranges), source, ranges)
    beside = beside[_far_from_cutoffs(source, beside, ranges)]
    return np.concatenate((chief, others, beside))


def _fringes(spec: HologramSpec) -> _Fringes | None:
    """Give the function of the fringes of a hologram; None where it has none."""
    if isinstance(spec.efficiency, KogelnikSpec):
        model = spec.efficiency.model()
        return model.fringes if isinstance(model, VolumeGrating) else None
    if not isinstance(spec.efficiency, RcwaSpec):
        return None
    profile = spec.efficiency.profile
    if not isinstance(profile, VolumeProfile):
        return None
    material = material_from(profile.index, "efficiency.profile.index")

    def fringes(light: Incidence) -> tuple[FloatArray, list[FloatArray]]:
        normal = np.zeros(light.shape)
        if profile.normal_period_um is not None:
            normal = np.full(light.shape, 1.0 / (profile.normal_period_um * UM))
        elif profile.slant_deg is not None:
            normal = -light.frequency * np.tan(np.radians(profile.slant_deg))
        normal = np.where(light.from_front, -normal, normal)
        vector = np.stack((light.frequency, np.zeros(light.shape), normal), axis=-1)
        return as_float(np.real(material.index(light.wavelength))), [vector]

    return fringes


def _chief_seeds(
    spec: HologramSpec, source: NodeSource, fronts: list[float], ranges: _Ranges
) -> tuple[FloatArray, FloatArray]:
    """Nodes of the recording's waves: those to find the wavelength of, and the angle of."""
    recorded = [float(nm_to_m(spec.pattern.wavelength_nm))]
    if isinstance(spec.efficiency, KogelnikSpec):
        recorded += [float(nm_to_m(each.wavelength_nm)) for each in spec.efficiency.exposures]
    places = [np.linspace(*ends, _STEPS[axis]) for axis, ends in enumerate(ranges) if axis > 2]
    nodes = _mesh(fronts, recorded, [0.0], [0.0], *places)
    light = source.light_at(nodes)
    if light.waves is None:
        return np.empty((0, NODE)), nodes
    found: list[FloatArray] = []
    for wave, sign in product((light.waves.object, light.waves.reference), (1.0, -1.0)):
        seeds = nodes.copy()
        seeds[:, 2:4] = sign * wave[:, :2] / light.index_in[:, None]
        # Each wave, and its reverse, comes from one side.
        found.append(seeds[(sign * wave[:, 2] < 0.0) == light.from_front])
    seeds = np.concatenate(found)
    return seeds, seeds


def _lattice(fronts: list[float], ranges: _Ranges) -> tuple[FloatArray, FloatArray]:
    """Nodes all over the ranges: those to find the wavelength of, and the angle of."""
    axes = [np.linspace(*ends, steps) for ends, steps in zip(ranges, _STEPS, strict=True)]
    middle = [np.array([0.5 * sum(ends)]) for ends in ranges]
    return (
        _mesh(fronts, middle[0], *axes[1:]),
        _mesh(fronts, axes[0], middle[1], *axes[2:]),
    )


def _mesh(*parts: ArrayLike) -> FloatArray:
    mesh = np.meshgrid(*(as_float(part) for part in parts), indexing="ij")
    return np.unique(np.stack([part.ravel() for part in mesh], axis=-1), axis=0)


def _solved(
    source: NodeSource,
    fringes: _Fringes,
    ranges: _Ranges,
    coloured: FloatArray,
    tilted: FloatArray,
) -> FloatArray:
    """Put nodes on Bragg by their wavelength, others by their cosine along; keep what is inside."""
    found = [np.empty((0, NODE))]
    for sign in (1.0, -1.0):
        found += _by_wavelength(source, fringes, ranges, coloured, sign)
        found += _by_angle(source, fringes, ranges, tilted, sign)
    nodes = _inside(np.concatenate(found), source, ranges)
    scaled = np.round(nodes / [1.0, *_SAME])
    return nodes[np.unique(scaled, axis=0, return_index=True)[1]]


def _by_wavelength(
    source: NodeSource, fringes: _Fringes, ranges: _Ranges, seeds: FloatArray, sign: float
) -> list[FloatArray]:
    seeds = seeds[np.hypot(seeds[:, 2], seeds[:, 3]) <= source.radius]
    if not len(seeds):
        return []
    found: list[FloatArray] = []
    for exposure in range(len(fringes(source.light_at(_clipped(seeds[:1], ranges)))[1])):
        nodes = seeds.copy()
        for _ in range(_ROUNDS):
            # Media need not have an index outside the range.
            light = source.light_at(_clipped(nodes, ranges))
            index, vectors = fringes(light)
            step, across = sign * vectors[exposure], light.tangential
            squared = index**2 - dot(across, across)
            normal = np.sqrt(np.where(squared > 0.0, squared, np.nan))
            ray = np.concatenate((across, normal[:, None]), axis=-1)
            size = dot(step, step)
            nodes[:, 1] = -2.0 * dot(ray, step) / np.where(size > 0.0, size, np.nan)
        found.append(nodes)
    return found


def _by_angle(
    source: NodeSource, fringes: _Fringes, ranges: _Ranges, seeds: FloatArray, sign: float
) -> list[FloatArray]:
    low, high = ranges[0]
    seeds = seeds[(seeds[:, 1] >= low) & (seeds[:, 1] <= high)]
    if not len(seeds):
        return []
    light = source.light_at(seeds)
    index, vectors = fringes(light)
    squared = index**2 - light.index_in**2 * seeds[:, 3] ** 2
    inside = np.sqrt(np.where(squared > 0.0, squared, np.nan))
    found: list[FloatArray] = []
    for vector in vectors:
        along, normal = sign * vector[:, 0], sign * vector[:, 2]
        # (along, normal).(sin, cos) N = -lambda |K|^2 / 2
        cosine = -light.wavelength * np.hypot(along, normal) / (2.0 * inside)
        turn = np.arccos(np.where(cosine >= -1.0, cosine, np.nan))
        for way in (1.0, -1.0):
            angle = np.arctan2(along, normal) + way * turn
            nodes = seeds.copy()
            nodes[:, 2] = inside * np.sin(angle) / light.index_in
            found.append(nodes[np.cos(angle) > 0.0])
    return found


def _clipped(nodes: FloatArray, ranges: _Ranges) -> FloatArray:
    """Move wavelengths into the range; those that are no number into its middle."""
    moved = nodes.copy()
    known = np.isfinite(moved[:, 1])
    moved[:, 1] = np.clip(np.where(known, moved[:, 1], 0.5 * sum(ranges[0])), *ranges[0])
    return moved


def _inside(nodes: FloatArray, source: NodeSource, ranges: _Ranges) -> FloatArray:
    """Keep nodes within the ranges that are directions; rounding does not put them outside."""
    low, high = np.asarray(ranges).T
    slack = _ROUNDING * np.maximum(np.maximum(np.abs(low), np.abs(high)), [0.0, 1.0, 1.0, 0.0, 0.0])
    values = nodes[:, 1:]
    kept = np.all((values >= low - slack) & (values <= high + slack), axis=1)
    kept &= np.hypot(nodes[:, 2], nodes[:, 3]) <= source.radius
    return np.concatenate((nodes[kept, :1], np.clip(values[kept], low, high)), axis=1)


def _neighbours(nodes: FloatArray, ranges: _Ranges) -> FloatArray:
    found = [np.empty((0, NODE))]
    for axis, (low, high) in enumerate(ranges[:3]):
        for apart in _APART if low < high else ():
            moved = nodes.copy()
            moved[:, 1 + axis] += apart * (moved[:, 1 + axis] if axis == 0 else 1.0)
            found.append(moved)
    return np.concatenate(found)


def _far_from_cutoffs(source: NodeSource, nodes: FloatArray, ranges: _Ranges) -> BoolArray:
    if not len(nodes):
        return np.zeros(0, dtype=np.bool_)
    passing = source.passing(nodes)
    far = np.ones(len(nodes), dtype=np.bool_)
    for (axis, (low, high)), sign in product(enumerate(ranges), (1.0, -1.0)):
        moved = nodes.copy()
        beside = moved[:, 1 + axis] + sign * _BESIDE * (high - low)
        moved[:, 1 + axis] = np.clip(beside, low, high)
        far &= (source.passing(moved) == passing).all(axis=-1)
    return far
