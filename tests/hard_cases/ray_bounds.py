# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a traced ray may differ from its 50 digits, for the numpy engine and for Cycles alike."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import ArrayLike, NDArray

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable, TraceResult
from tests.hard_cases import exact_rays

type Floats = NDArray[np.float64]

SIZE_MM = 20.0
NM = 532.0
UPRIGHT = {"kind": "plane", "direction": [0.0, 0.0, 1.0]}

CYCLES_TANGENT = 3e-7
"""Error of the tangential part of s': five roundings of float32 (6e-8), in the incidence, the step,
the wavelength and the result. An angle is wrong by this over the cosine."""

NUMPY_TANGENT = 16 * float(np.finfo(np.float64).eps)
"""A dozen roundings of float64."""

HIT = 5e-7
"""Error of a hit in Cycles, over half the size of the element: eight roundings of float32, in the
two numbers by which Cycles counts a place on a triangle and in the sum over its corners."""

ENGINES = [pytest.param("numpy"), pytest.param("cycles", marks=pytest.mark.render)]


def engine_of(name: str) -> Callable[[HologramSpec, RayTable], TraceResult]:
    """The function that sends rays."""
    return trace if name == "numpy" else trace_cycles


def by_engine(values: Sequence[Any], quick: int) -> list[Any]:
    """Parameters (engine, value): with Cycles only the first few of the values are quick.

    Args:
        values: All of them.
        quick: How many are run through Cycles in every run of the tests.

    Returns:
        What ``parametrize`` takes; further runs through Cycles are slow.
    """
    return [pytest.param("numpy", value, id=f"numpy, {value}") for value in values] + [
        pytest.param(
            "cycles",
            value,
            id=f"Cycles, {value}",
            marks=[pytest.mark.render] if place < quick else [pytest.mark.render, pytest.mark.slow],
        )
        for place, value in enumerate(values)
    ]


@dataclass(frozen=True)
class Case:
    """Rays through one recording.

    Attributes:
        recording: Both waves, as `exact_rays` reads them.
        indices: Those of the back and of the front.
        rays: What is sent.
    """

    recording: dict[str, Any]
    indices: tuple[float, float]
    rays: RayTable

    def spec(self) -> HologramSpec:
        """The hologram, which gives an order that is asked for 0.3 on either side."""
        shares = {str(order): 0.3 for order in np.unique(self.rays.order)}
        waves = {
            role: {name: value for name, value in wave.items() if name != "draws"}
            for role, wave in self.recording.items()
        }
        return hologram_from(
            {
                "schema": 1,
                "name": "hard case",
                "surface": {"shape": "plane", "size_mm": [SIZE_MM, SIZE_MM]},
                "media": {"back": self.indices[0], "front": self.indices[1]},
                "recording": {"wavelength_nm": NM, **waves},
                "efficiency": {"model": "constant", "table": {"T": shares, "R": shares}},
                "orders": [int(order) for order in shares],
            }
        )

    def sent(self, engine: str) -> TraceResult:
        """The rays, sent through one of the engines."""
        return engine_of(engine)(self.spec(), self.rays)

    def exact(self, points_mm: Floats) -> list[tuple[Any, Any]]:
        """What `exact_rays.diffracted` says of each ray that hits at such a point."""
        rays = self.rays
        with mp.workdps(exact_rays.DIGITS):
            return [
                exact_rays.diffracted(
                    rays.direction[row],
                    exact_rays.gradient(self.recording, points_mm[row]),
                    int(rays.order[row]) * mpf(float(rays.wavelength_nm[row])) / mpf(NM),
                    self.indices,
                    reflected=bool(rays.reflected[row]),
                )
                for row in range(len(rays))
            ]

    def indices_of(self) -> tuple[Floats, Floats]:
        """Index before and behind, of each ray."""
        forward = self.rays.direction[:, 2] >= 0.0
        before = np.where(forward, *self.indices)
        behind = np.where(forward, *self.indices[::-1])
        return before, np.where(self.rays.reflected, before, behind)


def rays_to(
    points_mm: Floats,
    direction: ArrayLike,
    order: ArrayLike = 1,
    wavelength_nm: ArrayLike = NM,
    reflected: ArrayLike = False,
) -> RayTable:
    """Rays that hit at these points."""
    count = len(points_mm)
    heading = np.broadcast_to(np.asarray(direction, dtype=np.float64), (count, 3)).copy()
    return RayTable(
        points_mm - 4.0 * heading,
        heading,
        np.broadcast_to(np.asarray(wavelength_nm, dtype=np.float64), count).copy(),
        np.broadcast_to(np.asarray(order, dtype=np.int64), count).copy(),
        np.broadcast_to(np.asarray(reflected, dtype=np.bool_), count).copy(),
    )


def float32(values: ArrayLike) -> Floats:
    """Numbers that float32 has, so that none is rounded on the way to the shader."""
    return np.asarray(values, dtype=np.float32).astype(np.float64)


def points_around(
    rng: np.random.Generator, count: int, reach_mm: float, middle_mm: ArrayLike = (0.0, 0.0)
) -> Floats:
    """Points on the element, at distances of all sizes up to `reach_mm` from a place on it."""
    distance = reach_mm * 10.0 ** rng.uniform(-2.0, 0.0, count)
    azimuth = rng.uniform(0.0, 2.0 * np.pi, count)
    offset = np.stack((distance * np.cos(azimuth), distance * np.sin(azimuth)), axis=1)
    return np.column_stack((float32(offset + np.asarray(middle_mm)), np.zeros(count)))


def assert_follows(
    case: Case, result: TraceResult, exact: list[tuple[Any, Any]], tangent: ArrayLike
) -> None:
    """Compare directions and statuses.

    The square of the normal part follows from the tangential part, so it may be wrong by twice that
    one's error; where it is smaller, an engine cannot tell the side of evanescence.

    Args:
        case: What was sent.
        result: What came back.
        exact: What should.
        tangent: Error that the tangential part of each direction may have, shape ``(n,)``.
    """
    _before, behind = case.indices_of()
    allowed = np.broadcast_to(np.asarray(tangent, dtype=np.float64), len(exact))
    for row, (squared, direction) in enumerate(exact):
        band = 2.0 * allowed[row] + allowed[row] ** 2
        found, status = result.direction[row], result.status[row]
        if abs(squared) > band * behind[row] ** 2:
            assert status == (Status.EVANESCENT if direction is None else Status.OK), row
        if status != Status.OK:
            assert np.isnan(found).all() and result.efficiency[row] == 0.0
            continue
        assert result.efficiency[row] > 0.0
        if direction is None:
            continue
        sideways = max(abs(float(found[axis] - direction[axis])) for axis in (0, 1))
        assert sideways <= allowed[row], (row, sideways / allowed[row])
        upright = abs(float(found[2] ** 2 - direction[2] ** 2))
        assert upright <= band, (row, upright / band)
        assert found[2] * direction[2] >= 0


def tangent_of(engine: str, case: Case, points_mm: Floats) -> Floats:
    """Error of the tangential part for a hit that is known.

    Near sources stand at places that float32 has, so that the shader subtracts them without a
    rounding. In numpy both places are rounded as they turn into metres.
    """
    if engine == "cycles":
        return np.full(len(points_mm), CYCLES_TANGENT)
    total = np.ones(len(points_mm))
    for wave in case.recording.values():
        for name in ("position_mm", "first_mm", "second_mm"):
            if name in wave:
                place = np.asarray(wave[name])
                apart = np.linalg.norm(points_mm - place, axis=1)
                total += (np.linalg.norm(points_mm, axis=1) + np.linalg.norm(place)) / apart
    return NUMPY_TANGENT * total


def assert_read_out(engine: str, case: Case, points_mm: Floats) -> None:
    """Hits are as exact as float32 allows, and waves are exact at the hits that were found."""
    result = case.sent(engine)
    error = np.abs(result.hit_mm - points_mm).max()
    assert error <= (HIT if engine == "cycles" else NUMPY_TANGENT) * SIZE_MM / 2.0
    assert_follows(case, result, case.exact(result.hit_mm), tangent_of(engine, case, result.hit_mm))
