# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The light of a table's nodes at a hologram, and the ranges that a table covers."""

import math
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency import Incidence, Polarization, meet
from ...core.efficiency.node_source import LightAt, NodeSource, Progress
from ...core.efficiency.table_check import SIDES, Side
from ...core.errors import SpecError
from ...core.units import mm_to_m, nm_to_m
from ..convert import pattern_from
from ..efficiency.common import VISIBLE_NM, WIDEST_DEG, LookupSpec
from ..element import element_shape
from ..evaluate import centre_mm
from ..hologram import HologramSpec
from ..medium import medium_from

WIDEST_COSINE = math.sin(math.radians(WIDEST_DEG))

_LOOKED_AT = 9
_ALIKE = 1e-9
"""Patterns that differ by less from place to place, of their size, are the same everywhere."""


@dataclass(frozen=True)
class TableRange:
    """What a table covers.

    Attributes:
        wavelength_nm: First and last vacuum wavelength, nm.
        along: First and last direction cosine along the grating.
        across: First and last direction cosine across it.
        sides: Sides that the light comes from.
    """

    wavelength_nm: tuple[float, float] = VISIBLE_NM
    along: tuple[float, float] = (-WIDEST_COSINE, WIDEST_COSINE)
    across: tuple[float, float] = (-WIDEST_COSINE, WIDEST_COSINE)
    sides: tuple[Side, ...] = SIDES

    @classmethod
    def of(cls, lookup: LookupSpec | None) -> Self:
        """What the shader's table covers.

        Args:
            lookup: The look-up of a model; None for the defaults.

        Returns:
            Its wavelengths, and all directions of its cone, from both sides.
        """
        asked = lookup or LookupSpec()
        cosine = math.sin(math.radians(asked.angle_deg))
        return cls(asked.wavelengths_nm, (-cosine, cosine), (-cosine, cosine))

    @property
    def radius(self) -> float:
        """Largest cosine of a direction in the plane of the element."""
        return max(WIDEST_COSINE, *map(abs, (*self.along, *self.across)))


def node_source(
    spec: HologramSpec,
    within: TableRange | None = None,
    *,
    backward: bool = False,
    polarization: Polarization = Polarization.UNPOLARISED,
    notice: Progress | None = None,
) -> NodeSource:
    """Make the source of a table's values.

    Args:
        spec: The hologram.
        within: What the table is to cover; None for all that is visible.
        backward: Whether nodes are rays that are walked backward; see `NodeSource`.
        polarization: Of the light.
        notice: Told the share of each evaluation that is done.

    Returns:
        The source.

    Raises:
        SpecError: Of the orders, none can get light.
    """
    branches = spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)
    if not branches:
        raise SpecError("orders: the efficiency model gives light to none of them")
    return NodeSource(
        spec.efficiency.model(),
        branches,
        light_at(spec),
        (within or TableRange()).radius,
        backward,
        polarization,
        notice,
    )


def light_at(spec: HologramSpec) -> LightAt:
    """Make the function that gives the light of nodes.

    Args:
        spec: The hologram; light of extended sources is that of their middle points.

    Returns:
        The function; x and y of a node are a place on the element, in metres.
    """
    pattern, shape = pattern_from(spec.pattern), element_shape(spec)
    media = {side: medium_from(getattr(spec.media, side)) for side in SIDES}
    vertex = mm_to_m(centre_mm(spec))

    def light(nodes: FloatArray) -> Incidence:
        wavelength = nodes[:, 1]
        indices: list[FloatArray] = []
        for side, medium in media.items():
            try:
                indices.append(np.broadcast_to(medium.index(wavelength), wavelength.shape))
            except SpecError as error:
                raise SpecError(f"media.{side}: {error}") from error
        height = np.asarray(shape.sag(nodes[:, 4], nodes[:, 5]), dtype=np.float64)
        points = np.stack((nodes[:, 4], nodes[:, 5], height), axis=-1)
        # Beside the element nothing is recorded; the vertex stands in, so that all is a number.
        beside = ~np.isfinite(height)
        points = np.where(beside[:, None], vertex, points)
        normal = shape.normal(points)
        _, met = meet(pattern, points, None, normal, normal, wavelength, (indices[0], indices[1]))
        from_front = nodes[:, 0] > 0.0
        index = np.where(from_front, met.index_front, met.index_back)
        return replace(
            met,
            tangential=index[:, None] * nodes[:, 2:4],
            from_front=from_front,
            frequency=np.where(beside, np.nan, met.frequency),
        )

    return light


def ranges(spec: HologramSpec, within: TableRange) -> tuple[tuple[float, float], ...]:
    """Give the range of each axis of a hologram's table.

    Args:
        spec: The hologram.
        within: Wavelengths and directions to cover.

    Returns:
        First and last wavelength, cosine along and across, x and y, metres; x and y are the centre
        alone where the light meets the same grating everywhere.
    """
    first, last = (float(nm_to_m(end)) for end in within.wavelength_nm)
    half_width, half_height = (float(mm_to_m(0.5 * side)) for side in spec.surface.size_mm)
    directions = ((first, last), within.along, within.across)
    if _same_everywhere(light_at(spec), (half_width, half_height), 0.5 * (first + last)):
        x, y, _ = (float(part) for part in mm_to_m(centre_mm(spec)))
        return (*directions, (x, x), (y, y))
    return (*directions, (-half_width, half_width), (-half_height, half_height))


def _same_everywhere(light: LightAt, half: tuple[float, float], wavelength: float) -> bool:
    steps = np.linspace(-1.0, 1.0, _LOOKED_AT)
    x, y = (part.ravel() for part in np.meshgrid(half[0] * steps, half[1] * steps))
    nodes = np.zeros((len(x), 6))
    nodes[:, 1], nodes[:, 4], nodes[:, 5] = wavelength, x, y
    met = light(nodes)
    seen = [met.frequency[:, None] * wavelength]
    if met.waves is not None:
        seen += [met.waves.object, met.waves.reference]
    parts = np.concatenate(seen, axis=-1)
    parts = parts[np.isfinite(parts).all(axis=-1)]
    return len(parts) > 0 and bool(np.all(np.ptp(parts, axis=0) <= _ALIKE))
