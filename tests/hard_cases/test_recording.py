# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording sources that are very near, very far, equal, opposite, or all but on the surface."""

from typing import Any

import numpy as np
import pytest

from hoe_addon.core.ray_law import Status
from hoe_addon.shading import extended
from tests.hard_cases.ray_bounds import (
    CYCLES_TANGENT,
    ENGINES,
    HIT,
    NUMPY_TANGENT,
    SIZE_MM,
    UPRIGHT,
    Case,
    Floats,
    assert_follows,
    assert_read_out,
    by_engine,
    float32,
    points_around,
    rays_to,
    tangent_of,
)

RAYS = 40
ORDER = 100
"""The highest that a document may ask for."""

TOWARD = np.array((0.3, -0.2, -0.93)) / np.linalg.norm((0.3, -0.2, -0.93))
"""Direction from the element to the sources."""

DECADES = [9, -3, 3, *(k for k in range(-2, 9) if k != 3)]
"""Powers of ten of the distance of a source, in mm."""

SHARES = (0.3, 0.8)
"""Instead of random numbers: both engines meet the same point of an extended source."""

ROUNDING = {"numpy": NUMPY_TANGENT / 16.0, "cycles": CYCLES_TANGENT / 5.0}

TURN = 8.0
"""Roundings of the difference of two far waves."""


@pytest.fixture(autouse=True)
def fixed_shares(monkeypatch: pytest.MonkeyPatch) -> None:
    """Extended sources in the shader send from one point."""
    monkeypatch.setattr(extended, "draw", lambda _role, dimension: str(SHARES[dimension]))


def point(position_mm: Floats, **more: Any) -> dict[str, Any]:
    return {"kind": "point", "position_mm": position_mm.tolist(), **more}


def both_sides(points_mm: Floats) -> Floats:
    """Directions along the normal, from the back and from the front by turns."""
    upward = np.where(np.arange(len(points_mm)) % 2 == 0, 1.0, -1.0)
    return upward[:, None] * np.array((0.0, 0.0, 1.0))


@pytest.mark.parametrize("beam", ["diverging", "converging"])
@pytest.mark.parametrize("engine, decade", by_engine(DECADES, quick=2))
def test_point_source(engine: str, decade: int, beam: str, rng: np.random.Generator) -> None:
    distance = 10.0**decade
    source = float32(distance * TOWARD) * (1.0 if beam == "diverging" else -1.0)
    points = points_around(rng, RAYS, min(9.0, 30.0 * distance))
    recording = {"object": point(source, beam=beam), "reference": UPRIGHT}
    case = Case(recording, (1.0, 1.0), rays_to(points, both_sides(points)))
    assert_read_out(engine, case, points)


@pytest.mark.render
@pytest.mark.parametrize("decade", [-3, -2, -1, 0, 1])
def test_what_the_rounding_of_a_hit_makes_of_a_near_source(
    decade: int, rng: np.random.Generator
) -> None:
    """A hit that is wrong by d turns the wave of a point at the distance r by d / r at most."""
    distance = 10.0**decade
    source = float32(distance * TOWARD)
    points = points_around(rng, RAYS, 9.0)
    apart = np.linalg.norm(points - source, axis=1)
    recording = {"object": point(source), "reference": UPRIGHT}
    case = Case(recording, (1.0, 1.0), rays_to(points, (0.0, 0.0, 1.0)))
    shift = np.sqrt(2.0) * HIT * SIZE_MM / 2.0
    allowed = CYCLES_TANGENT + shift / (apart - shift)
    assert_follows(case, case.sent("cycles"), case.exact(points), allowed)


@pytest.mark.parametrize("height_mm", [1e-9, 2e-9, 1e-6, 1e-3])
@pytest.mark.parametrize("engine", ENGINES)
def test_source_just_off_the_surface(
    engine: str, height_mm: float, rng: np.random.Generator
) -> None:
    """Up to 1e-9 mm, which is twice what counts as on the surface; hit points all around it."""
    source = float32((3.25, 1.75, -height_mm))
    points = points_around(rng, RAYS, 3.0, source[:2])
    points[: RAYS // 2] = points_around(rng, RAYS // 2, 30.0 * height_mm, source[:2])
    points = points[np.linalg.norm(points - source, axis=1) > 0.5 * height_mm]
    recording = {"object": point(source), "reference": UPRIGHT}
    for reflected in (False, True):
        sent = rays_to(points, both_sides(points), reflected=reflected)
        assert_read_out(engine, Case(recording, (1.0, 1.0), sent), points)


KINDS = {
    "toric": lambda place: {
        "kind": "astigmatic",
        "first_mm": place.tolist(),
        "second_mm": float32(1.7 * place + (0.1 * place[2], 0.0, 0.0)).tolist(),
        "line_direction": [1.0, 0.3, 0.0],
    },
    "toric, far arc": lambda place: {
        "kind": "astigmatic",
        "first_mm": place.tolist(),
        "second_mm": (1e9 * TOWARD).tolist(),
        "line_direction": [1.0, 0.3, 0.0],
    },
    "toric, far line": lambda place: {
        "kind": "astigmatic",
        "first_mm": (1e9 * TOWARD).tolist(),
        "second_mm": place.tolist(),
        "line_direction": [1.0, 0.3, 0.0],
    },
    "window": lambda place: {
        "kind": "window",
        "position_mm": (place - (0.0, 0.0, 5.0)).tolist(),
        "window": {
            "position_mm": [0.0, 0.0, -5.0],
            "normal": [0.05, -0.02, 1.0],
            "thickness_mm": 2.0,
            "index": 1.6,
        },
        "source_index": 1.3,
        "index": 1.2,
    },
    "rectangle": lambda place: {
        "kind": "extended",
        "position_mm": place.tolist(),
        "shape": {"shape": "rectangle", "size_mm": (0.25 * np.abs(place[:2])).tolist()},
        "draws": list(SHARES),
    },
}
"""Document of a wave with its source at a place."""


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("engine, decade", by_engine([9, -3, 0, 3, 6], quick=1))
def test_other_sources(
    engine: str, decade: int, kind: str, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    distance = 10.0**decade
    wave = KINDS[kind](float32(distance * TOWARD))
    points = points_around(rng, RAYS // 2, min(9.0, 30.0 * distance))
    if "draws" in wave and engine == "numpy":
        _same_shares(monkeypatch)
    index = wave.get("index", 1.0)
    recording = {"object": wave, "reference": UPRIGHT | {"index": index}}
    case = Case(recording, (index, index), rays_to(points, both_sides(points)))
    assert_read_out(engine, case, points)


def _same_shares(monkeypatch: pytest.MonkeyPatch) -> None:
    class Fixed:
        def __init__(self, _seed: int) -> None:
            pass

        def random(self, shape: tuple[int, int]) -> Floats:
            return np.broadcast_to(np.asarray(SHARES)[: shape[1]], shape)

    monkeypatch.setattr(np.random, "default_rng", Fixed)


PAIRS = {
    "both 1e9 mm": (1e9, 1e9, 1e-6),
    "1e9 and 2e9 mm": (1e9, 2e9, 1e-6),
    "both 1e5 mm": (1e5, 1e5, 1e-6),
    "1e4 and 2e4 mm": (1e4, 2e4, 1e-6),
    "1e9 and 1e3 mm": (1e9, 1e3, 1e-6),
    "100 and 101 mm": (100.0, 101.0, 0.0),
    "1e-7 mm apart": (100.0, 100.0 + 1e-7, 0.0),
    "same direction, 1e3 and 1e9 mm": (1e3, 1e9, 0.0),
}
"""Distances of object and reference source in mm, and the angle between them."""


@pytest.mark.parametrize("index", [1.0, 4.0])
@pytest.mark.parametrize("engine, name", by_engine(list(PAIRS), quick=2))
def test_difference_of_nearly_equal_waves(
    engine: str, name: str, index: float, rng: np.random.Generator
) -> None:
    """In the order 100, which multiplies what is wrong with the difference of the two waves.

    The difference at the frame's origin is rounded once, and each wave's turn from there on, which
    is at most the distance of the hit over that of the source.
    """
    first, second, angle = PAIRS[name]
    aside = TOWARD + angle * np.array((1.0, -2.0, 0.0))
    sources = (first * TOWARD, second * aside / np.linalg.norm(aside))
    recording = {
        role: point(place, index=index)
        for role, place in zip(("object", "reference"), sources, strict=True)
    }
    points = points_around(rng, RAYS, 9.0)
    case = Case(recording, (index, index), rays_to(points, (0.0, 0.0, 1.0), ORDER))
    result = case.sent(engine)
    units = [place / np.linalg.norm(place) for place in sources]
    reach = np.linalg.norm(result.hit_mm, axis=1)
    turns = reach / first + reach / second
    apart = np.linalg.norm(units[0] - units[1])
    allowed = CYCLES_TANGENT + ORDER * TURN * ROUNDING["cycles"] * (apart + turns)
    if engine == "numpy":
        # Two unit vectors are subtracted, and places in mm turn into metres.
        allowed = NUMPY_TANGENT * (1.0 + 2.0 * ORDER)
    assert_follows(case, result, case.exact(result.hit_mm), allowed)
    assert (result.status == Status.OK).any()


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("distance_mm", [5.0, 100.0, 1e9])
def test_equal_sources_record_nothing(
    engine: str, distance_mm: float, rng: np.random.Generator
) -> None:
    """Q is exactly 0, so that even the order 100 goes straight on."""
    source = point(distance_mm * TOWARD, index=1.5)
    points = points_around(rng, RAYS, 9.0)
    recording = {"object": source, "reference": source}
    case = Case(recording, (1.0, 1.0), rays_to(points, (0.0, 0.0, 1.0), ORDER))
    result = case.sent(engine)
    assert (result.status == Status.OK).all()
    np.testing.assert_array_equal(result.direction, case.rays.direction)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("distance_mm", [5.0, 100.0, 1e9])
def test_opposite_sources(engine: str, distance_mm: float, rng: np.random.Generator) -> None:
    """A beam from one side and its reverse: grad V is twice one wave, within the plane too."""
    source = float32(distance_mm * np.array((0.3, -0.2, -0.93)))
    recording = {
        "object": point(source),
        "reference": point(-source),
    }
    points = points_around(rng, RAYS, 9.0)
    case = Case(recording, (1.0, 1.0), rays_to(points, (0.0, 0.0, 1.0)))
    assert_read_out(engine, case, points)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("index", [1.0, 1.5, 4.0])
def test_indices_up_to_4(engine: str, index: float, rng: np.random.Generator) -> None:
    near, far = float32(30.0 * TOWARD), 1e9 * TOWARD
    recording = {"object": point(near, index=index), "reference": point(far, index=2.5)}
    points = points_around(rng, RAYS, 9.0)
    for order in (1, -1):
        case = Case(recording, (2.5, index), rays_to(points, (0.0, 0.0, 1.0), order))
        result = case.sent(engine)
        before, behind = case.indices_of()
        scale = np.maximum(1.0, before / behind)
        allowed = scale * tangent_of(engine, case, result.hit_mm)
        assert_follows(case, result, case.exact(result.hit_mm), allowed)


@pytest.mark.parametrize("engine", ENGINES)
def test_an_order_that_is_not_recorded_is_undefined(engine: str) -> None:
    """A tilted window that leaves x < 2 mm free."""
    window = {
        "kind": "window",
        "position_mm": [-20.0, 0.0, -40.0],
        "window": {"position_mm": [2.0, 0.0, 0.0], "normal": [1.0, 0.0, 0.5], "index": 1.0},
        "source_index": 1.2,
    }
    points = np.array([[-5.0, 0.0, 0.0], [-1.0, 3.0, 0.0], [6.0, 0.0, 0.0]])
    recording = {"object": window, "reference": UPRIGHT}
    result = Case(recording, (1.0, 1.0), rays_to(points, (0.0, 0.0, 1.0))).sent(engine)
    assert result.status.tolist() == [Status.UNDEFINED, Status.UNDEFINED, Status.OK]
    assert result.efficiency.tolist()[:2] == [0.0, 0.0]
