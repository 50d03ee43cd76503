# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Windows and line foci where their geometry degenerates, at hits that are known."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

from hoe_addon.model.document import hologram_from
from hoe_addon.model.field_error import FieldError
from tests.hard_cases import exact_rays
from tests.hard_cases.ray_bounds import (
    CYCLES_TANGENT,
    ENGINES,
    HIT,
    NM,
    NUMPY_TANGENT,
    SIZE_MM,
    UPRIGHT,
    Case,
    assert_follows,
    assert_read_out,
    by_engine,
    engine_of,
    points_around,
    rays_to,
)

RAYS = 20

type Place = Sequence[float]


def window(
    position_mm: Place,
    face_mm: float,
    thickness_mm: float,
    indices: tuple[float, float, float],
    normal: Place = (0.0, 0.0, 1.0),
) -> dict[str, Any]:
    before, inside, behind = indices
    return {
        "kind": "window",
        "position_mm": list(position_mm),
        "source_index": before,
        "window": {
            "position_mm": [0.0, 0.0, face_mm],
            "normal": list(normal),
            "thickness_mm": thickness_mm,
            "index": inside,
        },
        "index": behind,
    }


def toric(first: Place, second: Place, line: Place, beam: str = "diverging") -> dict[str, Any]:
    return {
        "kind": "astigmatic",
        "first_mm": list(first),
        "second_mm": list(second),
        "line_direction": list(line),
        "beam": beam,
    }


RISING, FALLING = (1.3, 1.6, 1.2), (1.0, 1.6, 1.2)
ASIDE = (3.25, 1.75)

WAVES = {
    "line foci 20 mm apart at 1e9 mm": toric((0, 3e8, -1e9), (6, 3e8 + 6, -1e9 - 18), (1, 0.3, 0)),
    "all of a window at 1e9 mm": window((1e9, 0, -1e9), -1e8, 1e7, (1.0, 1.5, 1.2)),
    "point 1e-6 mm before a window": window((*ASIDE, -5 - 2.0**-20), -5, 2, RISING),
    "the same, in air": window((*ASIDE, -5 - 2.0**-20), -5, 2, FALLING),
    "window of 1e-6 mm": window((*ASIDE, -6), -5, 1e-6, RISING),
    "indices 1e-12 apart": window((*ASIDE, -6), -5, 2, (1.5, 1.5 + 1e-12, 1.5)),
    "indices 1e-7 apart": window((*ASIDE, -6), -5, 2, (1.5, 1.5 + 1e-7, 1.5 - 1e-7)),
    "element on the far face": window((*ASIDE, -6), -2, 2, (1.5, 1.2, 1.5)),
    "element 1e-6 mm behind the far face": window((*ASIDE, -6), -2 - 2.0**-20, 2, (1.5, 1.2, 1.5)),
    "grazing by 1e-3": window((1e6, 0, -1e3), -5, 2, (1.5, 1.6, 1.7)),
    "grazing by 1e-6": window((1e9, 0, -1e3), -5, 2, (1.5, 1.6, 1.7)),
    "grazing by 1e-6, index 4": window((1e9, 0, -1e3), -5, 2, (1.0, 4.0, 4.0)),
    "on the axis, 1e9 mm": window((0, 0, -1e9), -5, 2, FALLING),
    "tilted window, 1e9 mm": window((0, 0, -1e9), -5, 2, FALLING, (0.3, 0, 1)),
    "line foci 1e-12 mm apart": toric((0, 0, -100), (0, 0, -100 - 1e-12), (0, 1, 0)),
    "line foci 1e-6 mm apart, sideways": toric((0, 0, -100), (1e-6, 0, -100), (0, 1, 0)),
    "line foci 30 mm apart, sideways, 1e9 mm": toric((0, 0, -1e9), (30, 0, -1e9), (0, 0.3, 1)),
    "line and arc at 1e9 mm, before and beyond": toric(
        (0, 0, -1e9), (0, 0, 1e9), (1, 0.3, 0), "converging"
    ),
    "line 1e-3 mm before, arc 1e9 mm beyond": toric(
        (0, 0, -(2.0**-10)), (0, 0, 1e9), (1, 0.3, 0), "converging"
    ),
    "line 2e-9 mm off the surface": toric((5, 0, -(2.0**-29)), (5, 0, -60), (0, 1, 0)),
    "arc 2e-9 mm off the surface": toric((5, 0, -60), (5, 0, -(2.0**-29)), (0, 1, 0)),
    "arc 2e-9 mm beyond": toric((5, 0, -60), (5, 0, 2.0**-29), (0, 1, 0), "converging"),
}
"""Places are numbers of float32 where they are near."""


@pytest.mark.parametrize("engine, name", by_engine(list(WAVES), quick=2))
def test_wave_reads_out(engine: str, name: str, rng: np.random.Generator) -> None:
    wave = WAVES[name]
    index = wave.get("index", 1.0)
    recording = {"object": wave, "reference": UPRIGHT | {"index": index}}
    points = points_around(rng, RAYS, 4.0)
    assert_read_out(
        engine, Case(recording, (index, index), rays_to(points, (0.0, 0.0, 1.0))), points
    )


BEND = 20.0 / 8.0**2
"""Second derivative of V, at most, 1 / mm."""


@pytest.mark.parametrize("engine", ENGINES)
def test_characteristic_function_that_bends_strongly(engine: str, rng: np.random.Generator) -> None:
    """A slope of up to 2.5, in a medium of index 3; the rounding of a hit turns it by BEND."""
    document = {
        "schema": 1,
        "name": "bends",
        "surface": {"shape": "plane", "size_mm": [SIZE_MM, SIZE_MM]},
        "media": {"back": 3.0, "front": 3.0},
        "characteristic": {
            "kind": "formula",
            "wavelength_nm": NM,
            "unit": "mm",
            "formula": "20*cos(r/8)",
        },
        "efficiency": {"model": "constant", "table": {"T": {"1": 0.5}}},
        "orders": [1],
    }
    points = points_around(rng, 4 * RAYS, 9.0)
    case = Case({}, (3.0, 3.0), rays_to(points, (0.0, 0.0, 1.0)))
    result = engine_of(engine)(hologram_from(document), case.rays)
    each = CYCLES_TANGENT if engine == "cycles" else NUMPY_TANGENT
    for places, shift in ((result.hit_mm, 0.0), (points, np.sqrt(2.0) * HIT * SIZE_MM / 2.0)):
        exact = []
        with mp.workdps(exact_rays.DIGITS):
            for place in places:
                x, y, _z = exact_rays.exact(place)
                radius = mp.sqrt(x**2 + y**2)
                slope = -mpf(20) / 8 * mp.sin(radius / 8)
                gradient = [slope * x / radius, slope * y / radius, mpf(0)]
                heading = (0.0, 0.0, 1.0)
                exact.append(
                    exact_rays.diffracted(heading, gradient, mpf(1), (3.0, 3.0), reflected=False)
                )
        assert_follows(case, result, exact, each + BEND * shift / 3.0)


@pytest.mark.parametrize("height_mm", [0.0, 4e-10, -4e-10])
def test_a_source_within_5e_10_mm_counts_as_on_the_surface(height_mm: float) -> None:
    """Where its wave has no direction; one at 2e-9 mm is tried with the other sources."""
    document = {
        "schema": 1,
        "name": "on the surface",
        "surface": {"shape": "plane", "size_mm": [20, 20]},
        "media": {"back": 1.0, "front": 1.0},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "point", "position_mm": [3.0, 1.0, height_mm]},
            "reference": UPRIGHT,
        },
        "efficiency": {"model": "constant", "table": {"T": {"1": 0.5}}},
        "orders": [1],
    }
    with pytest.raises(FieldError, match="must not lie on the surface"):
        hologram_from(document)
