# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Orders at the limit of evanescence, total internal reflection at its limit, grazing incidence."""

import numpy as np
import pytest

from hoe_addon.core.ray_law import Status
from hoe_addon.model.document import hologram_from
from hoe_addon.model.rays import RayTable
from tests.hard_cases.ray_bounds import (
    CYCLES_TANGENT,
    ENGINES,
    NM,
    NUMPY_TANGENT,
    Case,
    Floats,
    assert_follows,
    by_engine,
    engine_of,
    points_around,
    rays_to,
)

STEPS = np.concatenate([[0.0], *((s, -s) for s in 10.0 ** np.arange(-15.0, -2.0))])
"""How far the tangential part is beyond n', over n'."""

INDICES = [(1.0, 1.0), (1.0, 1.5), (1.5, 1.0), (1.0, 4.0), (4.0, 1.0), (2.0, 2.5)]
"""Back and front."""

SLOPE = 0.6
"""Of the grating: length of grad V in the plane."""

COSINES = 10.0 ** -np.arange(1.0, 13.0)

COSINE = {"numpy": 8 * float(np.finfo(np.float64).eps), "cycles": 5e-7}
"""Relative error of the small cosine of a grazing ray: it is a component of its own, that nothing
is added to, so it keeps all digits; eight roundings."""

PLANES = {
    "object": {"kind": "plane", "direction": [0.0, SLOPE, 0.8]},
    "reference": {"kind": "plane", "direction": [0.0, 0.0, 1.0]},
}


def tangent_of(engine: str, case: Case) -> Floats:
    """Denser media before the surface enlarge what is rounded in front of it."""
    before, behind = case.indices_of()
    each = CYCLES_TANGENT if engine == "cycles" else NUMPY_TANGENT
    return each * np.maximum(1.0, before / behind)


def turned(case: Case, angle: float) -> Case:
    """The same, turned about z."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.array(((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
    recording = {
        role: wave | {"direction": (matrix @ np.asarray(wave["direction"])).tolist()}
        for role, wave in case.recording.items()
    }
    rays, heading = case.rays, case.rays.direction @ matrix.T
    hit = rays.origin_mm + 4.0 * rays.direction
    sent = rays_to(hit, heading, rays.order, rays.wavelength_nm, rays.reflected)
    return Case(recording, case.indices, sent)


def at_the_limit(
    rng: np.random.Generator, indices: tuple[float, float], side: float, *, reflected: bool
) -> Case:
    """Rays whose tangential part behind the surface is n' (1 + step), by their wavelength."""
    before, behind = indices if side > 0.0 else indices[::-1]
    leaving = before if reflected else behind
    tilt = 0.28 / before * rng.choice((0.0, -1.0, 1.0), len(STEPS))
    order = round(leaving / 0.5)
    wavelength = NM * (leaving * (1.0 + STEPS) - before * tilt) / (order * SLOPE)
    heading = np.column_stack((0.0 * tilt, tilt, side * np.sqrt(1.0 - tilt**2)))
    points = points_around(rng, len(STEPS), 5.0)
    return Case(PLANES, indices, rays_to(points, heading, order, wavelength, reflected))


@pytest.mark.parametrize("reflected", [False, True], ids=["T", "R"])
@pytest.mark.parametrize("side", [1.0, -1.0], ids=["from the back", "from the front"])
@pytest.mark.parametrize("engine, indices", by_engine(INDICES, quick=1))
def test_orders_at_the_limit_of_evanescence(
    engine: str,
    indices: tuple[float, float],
    side: float,
    reflected: bool,
    rng: np.random.Generator,
) -> None:
    case = turned(at_the_limit(rng, indices, side, reflected=reflected), 0.7)
    result = case.sent(engine)
    points = case.rays.origin_mm + 4.0 * case.rays.direction
    exact = case.exact(points)
    assert {direction is None for _squared, direction in exact} == {False, True}
    assert_follows(case, result, exact, tangent_of(engine, case))


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("side", [1.0, -1.0], ids=["from the back", "from the front"])
def test_order_exactly_at_the_limit_lies_in_the_plane(engine: str, side: float) -> None:
    """Numbers that are exact in float32, too: n s = 0, and a step of 1."""
    planes = {
        "object": {"kind": "plane", "direction": [1.0, 0.0, 0.0]},
        "reference": {"kind": "plane", "direction": [0.0, 0.0, 1.0]},
    }
    flat = rays_to(np.array([[1.0, 1.0, 0.0]]), (0.0, 0.0, side))
    result = Case(planes, (1.0, 1.0), flat).sent(engine)
    assert result.status.tolist() == [Status.OK]
    np.testing.assert_array_equal(result.direction, [[1.0, 0.0, 0.0]])


@pytest.mark.parametrize("engine, index", by_engine([1.5, 2.5, 4.0], quick=1))
def test_total_internal_reflection_at_its_limit_loses_no_light(
    engine: str, index: float, rng: np.random.Generator
) -> None:
    """The share of the order 0 is either transmitted or reflected, and never both or neither."""
    sine = (1.0 + STEPS) / index
    angle = rng.uniform(0.0, 2.0 * np.pi, len(STEPS))
    heading = np.column_stack(
        (sine * np.cos(angle), sine * np.sin(angle), np.sqrt((1.0 - sine) * (1.0 + sine)))
    )
    points = points_around(rng, len(STEPS), 5.0)
    spec = hologram_from(
        {
            "schema": 1,
            "name": "total internal reflection",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"back": index, "front": 1.0},
            "recording": {"wavelength_nm": NM, **PLANES},
            "efficiency": {
                "model": "constant",
                "table": {"T": {"0": 0.5}},
                "total_internal_reflection": True,
            },
            "orders": [0],
        }
    )
    count = len(STEPS)
    case = Case(PLANES, (index, 1.0), rays_to(points, heading, 0))
    both = [case.rays, rays_to(points, heading, 0, reflected=True)]
    sent = RayTable(
        *(
            np.concatenate([getattr(rays, name) for rays in both])
            for name in ("origin_mm", "direction", "wavelength_nm", "order", "reflected")
        )
    )
    result = engine_of(engine)(spec, sent)
    through, back = result.efficiency[:count], result.efficiency[count:]
    np.testing.assert_allclose(through + back, 0.5, atol=1e-6)
    assert ((through == 0.0) | (back == 0.0)).all()
    band = 2.0 * tangent_of(engine, case)
    beyond = np.abs(STEPS) > band
    assert ((through > 0.0) == (STEPS < 0.0))[beyond].all()
    assert beyond.sum() >= 4


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("reflected", [False, True], ids=["T", "R"])
def test_order_0_keeps_each_digit_of_a_grazing_cosine(
    engine: str,
    reflected: bool,
    rng: np.random.Generator,
) -> None:
    case = _grazing(rng, (1.5, 1.5), 0, reflected=reflected)
    result = case.sent(engine)
    assert (result.status == Status.OK).all()
    sign = -1.0 if reflected else 1.0
    np.testing.assert_allclose(
        result.direction[:, 2], sign * case.rays.direction[:, 2], rtol=COSINE[engine]
    )
    np.testing.assert_allclose(
        result.direction[:, :2], case.rays.direction[:, :2], atol=CYCLES_TANGENT
    )


@pytest.mark.parametrize("order", [-1, 0, 1])
@pytest.mark.parametrize(
    "engine, indices", by_engine([(1.5, 1.0), (1.0, 1.5), (4.0, 1.0)], quick=1)
)
def test_grazing_incidence(
    engine: str, indices: tuple[float, float], order: int, rng: np.random.Generator
) -> None:
    for reflected in (False, True):
        case = _grazing(rng, indices, order, reflected=reflected)
        exact = case.exact(case.rays.origin_mm)
        assert_follows(case, case.sent(engine), exact, tangent_of(engine, case))


def _grazing(
    rng: np.random.Generator, indices: tuple[float, float], order: int, *, reflected: bool
) -> Case:
    cosine = np.concatenate([COSINES, -COSINES])
    angle = rng.uniform(0.0, 2.0 * np.pi, len(cosine))
    sine = np.sqrt((1.0 - cosine) * (1.0 + cosine))
    heading = np.column_stack((sine * np.cos(angle), sine * np.sin(angle), cosine))
    points = points_around(rng, len(cosine), 5.0)
    return Case(PLANES, indices, rays_to(points, heading, order, reflected=reflected))
