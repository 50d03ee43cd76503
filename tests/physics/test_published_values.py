# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Published and independently evaluated numbers, to their printed digits."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core import media
from hoe_addon.core.arrays import unit
from hoe_addon.core.characteristic import LinearGrating
from hoe_addon.core.efficiency.kinoform import efficiency, phase_depth
from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.recording import Recording
from hoe_addon.core.tracer import (
    Aperture,
    Dielectric,
    Frame,
    Grating,
    Rays,
    Rectangle,
    Step,
    walk_sequence,
)
from hoe_addon.core.units import MM, NM
from hoe_addon.core.waves import PlaneWave, PointSource

REFERENCE = Path(__file__).resolve().parents[1] / "reference"
AXIS = np.array([0.0, 0.0, 1.0])
AIR = media.by_name("air")
WIDE = Aperture(Rectangle(1.0, 1.0))


def load(name: str) -> dict[str, Any]:
    return json.loads((REFERENCE / name).read_text(encoding="utf-8"))


GRATING_RAYS = load("grating_rays.json")
KINOFORM = load("kinoform.json")
WAVEGUIDES = load("waveguides.json")


def printed(entry: dict[str, Any]) -> float:
    """Tolerance of printed digits: half a unit of the last one, unless the entry says why not."""
    rounding = 1.0 + 1e-6  # of a printed decimal as a float
    return entry.get("units_of_last_digit", 0.5) * rounding * 10.0 ** -entry["digits"]


RAY_TOLERANCE = printed(GRATING_RAYS["provenance"])


@pytest.mark.parametrize("row", GRATING_RAYS["two_point"]["rows"])
def test_two_point_hologram(row: dict[str, Any]) -> None:
    case = GRATING_RAYS["two_point"]
    index = case["index"]
    position = tuple(value * MM for value in case["object_point_mm"])
    recording = Recording(
        PointSource(position, converging=case["object_beam"] == "converging", index=index),
        PlaneWave(tuple(case["reference_direction"]), index),
        case["recording_wavelength_nm"] * NM,
    )
    gradient = recording.gradient(np.array(row["point_mm"]) * MM)
    ratio = row["wavelength_nm"] * NM / recording.wavelength
    out, status = diffract(unit(row["direction"]), AXIS, gradient, 1, ratio, index, index, False)
    assert status == Status.OK
    np.testing.assert_allclose(out, row["out"], rtol=0, atol=RAY_TOLERANCE)


@pytest.mark.parametrize("row", GRATING_RAYS["uniform"]["rows"])
def test_uniform_grating(row: dict[str, Any]) -> None:
    frequency = [value / MM for value in GRATING_RAYS["uniform"]["lines_per_mm"]]
    grating = Grating(
        frame=Frame.at((0, 0, 0)),
        aperture=WIDE,
        pattern=LinearGrating(tuple(frequency)),
        index_back=media.constant(row["index_in"]),
        index_front=media.constant(row["index_out"]),
        branches=(Branch(1),),
        efficiency=lambda *_: 1.0,
    )
    rays = Rays.of((0, 0, -1e-3), row["direction"], row["wavelength_nm"] * NM)
    walk = walk_sequence(rays, [Step(grating, order=1)])
    np.testing.assert_allclose(walk.rays.direction[0], row["out"], rtol=0, atol=RAY_TOLERANCE)


@pytest.mark.parametrize("row", KINOFORM["first_order_at_design"]["rows"])
def test_kinoform_first_order(row: dict[str, Any]) -> None:
    tolerance = printed(KINOFORM["first_order_at_design"])
    assert efficiency(1, 1.0, row["levels"]) == pytest.approx(row["efficiency"], abs=tolerance)


@pytest.mark.parametrize("row", KINOFORM["other_orders_at_design"]["rows"])
def test_kinoform_other_orders(row: dict[str, Any]) -> None:
    tolerance = printed(KINOFORM["other_orders_at_design"])
    answer = efficiency(row["order"], 1.0, row["levels"])
    assert answer == pytest.approx(row["efficiency"], abs=tolerance)


@pytest.mark.parametrize("row", KINOFORM["away_from_design"]["rows"])
def test_kinoform_away_from_design(row: dict[str, Any]) -> None:
    case = KINOFORM["away_from_design"]
    design, relief = case["design_wavelength_nm"] * NM, media.constant(1.5)
    depth = phase_depth(row["wavelength_nm"] * NM, design, relief)
    answers = efficiency(case["orders"], depth, row["levels"])
    np.testing.assert_allclose(answers, row["efficiency"], rtol=0, atol=printed(case))


@pytest.mark.parametrize("row", KINOFORM["band_mean_first_order_continuous"]["rows"])
def test_kinoform_mean_over_a_band(row: dict[str, Any]) -> None:
    low, high = (value * NM for value in row["band_nm"])
    cells = 20_000  # midpoint rule: error of the order of 1 / cells^2
    wavelengths = low + (np.arange(cells) + 0.5) / cells * (high - low)
    depth = phase_depth(wavelengths, row["design_wavelength_nm"] * NM, media.constant(1.5))
    tolerance = printed(KINOFORM["band_mean_first_order_continuous"])
    mean = float(np.mean(efficiency(1, depth, 0)))
    assert mean == pytest.approx(row["efficiency"], abs=tolerance)


@pytest.mark.parametrize("row", WAVEGUIDES["single_order"]["rows"])
def test_single_order_is_not_achromatic(row: dict[str, Any]) -> None:
    case = WAVEGUIDES["single_order"]
    ratio = row["wavelength_nm"] / case["period_nm"]
    out, _ = diffract(AXIS, AXIS, (1.0, 0.0, 0.0), 1, ratio, 1.0, 1.0, False)
    angle = np.degrees(np.arctan2(out[0], out[2]))
    assert angle == pytest.approx(row["angle_deg"], abs=printed(case))


@pytest.mark.parametrize("row", WAVEGUIDES["replication_pitch"]["rows"])
def test_replication_pitch(row: dict[str, Any]) -> None:
    thickness, angle = row["thickness_mm"] * MM, np.radians(row["angle_deg"])
    bottom = Frame.at((0, 0, 0), normal=(0, 0, -1))
    plate = [
        Step(
            Dielectric(frame=f, aperture=WIDE, index_back=media.constant(1.5), index_front=AIR),
            reflected=True,
        )
        for f in (Frame.at((0, 0, thickness)), bottom)
    ]
    rays = Rays.of((0, 0, 0.5 * thickness), (np.sin(angle), 0, np.cos(angle)), 532 * NM)
    walk = walk_sequence(rays, [*plate, plate[0]])
    pitch_mm = (walk.hits[2, 0, 0] - walk.hits[0, 0, 0]) / MM
    tolerance = printed(WAVEGUIDES["replication_pitch"])
    assert pitch_mm == pytest.approx(row["pitch_mm"], abs=tolerance)


@pytest.mark.parametrize("row", WAVEGUIDES["largest_field"]["rows"])
def test_largest_field(row: dict[str, Any]) -> None:
    """Inside the field the plate guides both edges, outside it loses one."""
    slack = printed(WAVEGUIDES["largest_field"])
    half = row["field_deg"] / 2.0
    assert all(is_guided(row["index"], sign * (half - slack)) for sign in (1, -1))
    assert not any(is_guided(row["index"], sign * (half + slack)) for sign in (1, -1))


def is_guided(index: float, field_deg: float) -> bool:
    """Tell whether coupled light is reflected totally, below the largest guided angle."""
    steepest = np.sin(np.radians(WAVEGUIDES["largest_field"]["largest_guided_angle_deg"]))
    wavelength, plate = 532 * NM, media.constant(index)
    coupler = Grating(
        frame=Frame.at((0, 0, 0)),
        aperture=WIDE,
        pattern=LinearGrating((0.5 * (index * steepest + 1.0) / wavelength, 0.0)),
        index_back=AIR,
        index_front=plate,
        branches=(Branch(1),),
        efficiency=lambda *_: 1.0,
    )
    face = Dielectric(
        frame=Frame.at((0, 0, 1e-3)), aperture=WIDE, index_back=plate, index_front=AIR
    )
    field = np.radians(field_deg)
    rays = Rays.of((0, 0, -1e-3), (np.sin(field), 0, np.cos(field)), wavelength)
    inside = walk_sequence(rays, [Step(coupler, order=1)])
    leak = walk_sequence(rays, [Step(coupler, order=1), Step(face)])
    shallow_enough = inside.status[0] == Status.OK and inside.rays.direction[0, 0] <= steepest
    return bool(shallow_enough and leak.status[0] == Status.EVANESCENT)
