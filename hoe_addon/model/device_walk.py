# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an eye sees of a light guide's display, by walking light forward from the display.

Basic radiance is kept along a ray, and the weight of an order is its power efficiency. So the
luminance in a pupil, averaged over pupil and field, is the flux that arrives there over the
extent (etendue) of pupil and field. Light that comes in any direction of the display's field
counts, ghosts included: an eye cannot tell them from the picture.

Points on the display, wavelengths and points on the lens come from a rank-1 sequence with a
random shift for each part of the rays; the scatter of the parts gives the standard error.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core import colour, tracer
from ..core.arrays import FloatArray, as_float
from ..core.errors import SpecError
from ..core.spectrum import Spectrum
from ..core.units import m_to_mm, mm_to_m
from .device import LightGuideSpec
from .device_light import Beam, DeviceLight, extent, projection
from .device_surfaces import DeviceSurfaces, surfaces_of

_PARTS = 16
"""Least number of parts with a shift of their own: enough for a fair standard error."""

_RAYS_AT_ONCE = 12_500
"""Rays of one walk: their branches still fit into a processor's cache."""

_FIELD_SLACK = 1e-9
"""Relative. Rounding must not drop rays that arrive at the very edge of the field."""


@dataclass(frozen=True, eq=False)
class EyeboxLuminance:
    """White field of the display as seen from N places of the pupil.

    Attributes:
        positions_mm: Centres of the pupil, shape ``(N, 3)``.
        mean_cd_m2: Luminance, mean over the display's field, shape ``(N,)``.
        error_cd_m2: Its standard error, shape ``(N,)``.
        xyz_cd_m2: Mean tristimulus values, Y in cd/m^2, shape ``(N, 3)``.
        field_cd_m2: Luminance over the field as the eye sees it, top row first, shape
            ``(N, rows, columns)``; columns and rows are of equal width in the tangent.
        energy: Where the light went that enters through the lens, in lm; the receiver is the
            eye's side outside the light engine.
    """

    positions_mm: FloatArray
    mean_cd_m2: FloatArray
    error_cd_m2: FloatArray
    xyz_cd_m2: FloatArray
    field_cd_m2: FloatArray
    energy: tracer.EnergyBalance

    @property
    def uv_prime(self) -> FloatArray:
        """CIE 1976 u' and v' of the mean colour, shape ``(N, 2)``; NaN for black."""
        return colour.uv_prime(self.xyz_cd_m2)


def eyebox_luminance(
    spec: LightGuideSpec,
    positions_mm: ArrayLike,
    *,
    rays: int = 200_000,
    seed: int = 0,
    grid: tuple[int, int] = (1, 1),
    light: Spectrum | None = None,
    weight_cut: float = 1e-6,
) -> EyeboxLuminance:
    """Walk light from a white display to pupils.

    Args:
        spec: The device; its pupil diameter holds for all positions.
        positions_mm: Centres of the pupil in the frame of the device, shape ``(N, 3)``, at or
            in front of the plane of the lens; the pupil is parallel to the guide.
        rays: Number of rays to launch, at least the number of parts, 16.
        seed: Seed of the random shifts.
        grid: Rows and columns of the map over the field.
        light: Spectrum of the display's light, instead of its white's; the luminance stays.
        weight_cut: A branch ends below this part of its ray's power.

    Returns:
        Luminance and colour at each position.

    Raises:
        SpecError: A position is between lens and guide or beyond, or there are too few rays.
    """
    device = surfaces_of(spec)
    places_mm = as_float(positions_mm).reshape(-1, 3)
    if not np.all(mm_to_m(places_mm[:, 2]) >= device.housing.front):
        raise SpecError(
            "positions_mm: z must be at or in front of the lens, "
            f"{m_to_mm(device.housing.front):g}, got {places_mm[:, 2].min():g}"
        )
    if rays < _PARTS:
        raise SpecError(f"rays: must be at least {_PARTS}, got {rays}")
    source = DeviceLight.of(spec, device, light)
    pupils = _Pupils(places_mm, spec.eye.pupil_diameter_mm, source.half_field, grid)
    rng = np.random.default_rng(seed)
    energies: list[tracer.EnergyBalance] = []
    fields: list[FloatArray] = []
    for count, parts in _batches(rays):
        beam = source.launch(count, parts, rng)
        walk = tracer.walk_tree(beam.rays, device.parts, device.receiver, weight_cut=weight_cut)
        energies.append(walk.energy)
        fields.append(pupils.collect(walk.landed, beam, parts, device))
    whole = np.concatenate(fields)
    return _result(places_mm, whole, grid, _mean(energies, len(whole)))


def _batches(rays: int) -> list[tuple[int, int]]:
    """Return the rays of a part and the number of parts of each walk."""
    parts = max(_PARTS, math.ceil(rays / _RAYS_AT_ONCE))
    count = rays // parts
    together = min(parts, max(1, _RAYS_AT_ONCE // count))
    full, rest = divmod(parts, together)
    return [(count, together)] * full + [(count, rest)] * (rest > 0)


def _result(
    places_mm: FloatArray, fields: FloatArray, grid: tuple[int, int], energy: tracer.EnergyBalance
) -> EyeboxLuminance:
    """Return means and errors of the parts' fields, shape (parts, N, cells, 3)."""
    means = fields.mean(axis=2)
    error = means[..., 1].std(axis=0, ddof=1) / math.sqrt(len(fields))
    xyz = means.mean(axis=0)
    maps = fields[..., 1].mean(axis=0).reshape(-1, *grid)
    return EyeboxLuminance(places_mm, xyz[:, 1], error, xyz, maps, energy)


def _mean(walks: list[tracer.EnergyBalance], parts: int) -> tracer.EnergyBalance:
    """Return the mean over all parts of the walks' energies."""
    return tracer.EnergyBalance(
        launched=math.fsum(walk.launched for walk in walks) / parts,
        landed=math.fsum(walk.landed for walk in walks) / parts,
        absorbed=math.fsum(walk.absorbed for walk in walks) / parts,
        escaped=math.fsum(walk.escaped for walk in walks) / parts,
        pruned=math.fsum(walk.pruned for walk in walks) / parts,
    )


@dataclass(frozen=True, eq=False)
class _Pupils:
    """Pupils that collect light, and the map over the field.

    Attributes:
        places_mm: Their centres, shape ``(N, 3)``.
        diameter_mm: Of each.
        half_field: Tangents of the field's half angles, along x and y.
        grid: Rows and columns of the map.
    """

    places_mm: FloatArray
    diameter_mm: float
    half_field: FloatArray
    grid: tuple[int, int]

    def collect(
        self, landed: tracer.Landed, beam: Beam, parts: int, device: DeviceSurfaces
    ) -> FloatArray:
        """Return XYZ in cd/m^2 per part, pupil and cell of the map, shape (P, N, cells, 3)."""
        rows, columns = self.grid
        slope = landed.direction[:, :2] / landed.direction[:, 2:]
        seen = np.all(np.abs(slope) <= self.half_field * (1.0 + _FIELD_SLACK), axis=1)
        seen &= landed.direction[:, 2] > 0.0
        slope, ids = slope[seen], landed.ray_id[seen]
        # Light that travels to the right comes from the left of the field.
        column, row = (0.5 * (1.0 + [-1.0, 1.0] * slope / self.half_field) * [columns, rows]).T
        cell = np.clip(row.astype(np.int64), 0, rows - 1) * columns
        cell += np.clip(column.astype(np.int64), 0, columns - 1)
        radius = mm_to_m(self.diameter_mm / 2.0)
        accepted = extent(self.half_field) / (rows * columns) * np.pi * radius**2
        flux = landed.weight[seen] / projection(landed.direction[seen])
        xyz = beam.xyz_per_lm[ids] * (flux / accepted)[:, None]
        start = landed.position[seen] + device.housing.centre
        result = np.zeros((parts, len(self.places_mm), rows * columns, 3))
        for number, (x, y, z) in enumerate(mm_to_m(self.places_mm)):
            offset = start + (z - device.housing.front) * slope - (x, y)
            into = np.hypot(offset[:, 0], offset[:, 1]) <= radius
            into[into] = ~device.housing.shades(start[into], slope[into], z)
            np.add.at(result[:, number], (beam.part[ids[into]], cell[into]), xyz[into])
        return result
