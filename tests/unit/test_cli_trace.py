# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``trace`` with the numpy engine: published directions, misses, both sides, exact numbers."""

import csv
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.cli import main
from hoe_addon.core.arrays import unit

LENS = Path(__file__).parents[1] / "documents" / "lens.json"
REFERENCE = Path(__file__).parents[1] / "reference" / "grating_rays.json"
COLUMNS = "x_mm,y_mm,z_mm,l,m,n,wavelength_nm,order,side"
RETURN = 1e-9
"""A ray and its reverse: two passes in float64 and positions of 20 mm, read from text."""


def element(folder: Path, **parts: Any) -> Path:
    path = folder / "hologram.json"
    path.write_text(json.dumps(json.loads(LENS.read_text()) | parts), encoding="utf-8")
    return path


def traced(folder: Path, hologram: Path, *rays: tuple[Any, ...]) -> list[dict[str, str]]:
    source, out = folder / "rays.csv", folder / "out.csv"
    lines = [",".join(repr(cell) if isinstance(cell, float) else str(cell) for cell in ray)
             for ray in rays]  # fmt: skip
    source.write_text("\n".join((COLUMNS, *lines)) + "\n", encoding="utf-8")
    assert main(["trace", str(hologram), str(source), "--out", str(out)]) == 0
    with out.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def direction(row: dict[str, str]) -> list[float]:
    return [float(row[name]) for name in ("out_l", "out_m", "out_n")]


def test_published_directions_of_a_two_point_hologram(tmp_path: Path) -> None:
    reference = json.loads(REFERENCE.read_text(encoding="utf-8"))
    case = reference["two_point"]
    provenance = reference["provenance"]
    tolerance = provenance["units_of_last_digit"] * 10.0 ** -provenance["digits"]
    path = element(tmp_path, media={"back": 1.0, "front": 1.0})
    rays = []
    for row in case["rows"]:
        start = np.array(row["point_mm"]) - 50.0 * np.array(row["direction"])
        rays.append((*start.tolist(), *row["direction"], row["wavelength_nm"], 1, "T"))
    for row, found in zip(case["rows"], traced(tmp_path, path, *rays), strict=True):
        assert found["status"] == "ok"
        assert direction(found) == pytest.approx(row["out"], abs=tolerance)
        hit = [float(found["hit_x_mm"]), float(found["hit_y_mm"])]
        assert hit == pytest.approx(row["point_mm"][:2], abs=RETURN)


def test_published_directions_of_a_uniform_grating(tmp_path: Path) -> None:
    reference = json.loads(REFERENCE.read_text(encoding="utf-8"))
    provenance = reference["provenance"]
    tolerance = provenance["units_of_last_digit"] * 10.0 ** -provenance["digits"]
    for row in reference["uniform"]["rows"]:
        sine = [lines * 532e-6 for lines in reference["uniform"]["lines_per_mm"]]
        plane = {"kind": "plane", "index": 1}
        recording = {
            "wavelength_nm": 532,
            "object": plane | {"direction": [*sine, math.sqrt(1 - sine[0] ** 2 - sine[1] ** 2)]},
            "reference": plane | {"direction": [0, 0, 1]},
        }
        media = {"back": row["index_in"], "front": row["index_out"]}
        path = element(tmp_path, recording=recording, media=media)
        (found,) = traced(
            tmp_path, path, (0, 0, -1, *row["direction"], row["wavelength_nm"], 1, "T")
        )
        assert direction(found) == pytest.approx(row["out"], abs=tolerance)


def test_reference_wave_gives_the_object_wave_and_back(tmp_path: Path) -> None:
    path = element(tmp_path, media={"back": 1.0, "front": 1.0})
    away = unit([7.0 - 10.0, -3.0 - 5.0, 100.0])
    forward, backward = traced(
        tmp_path, path, (7, -3, -1, 0, 0, 1, 532, 1, "T"), (7, -3, 0, *away.tolist(), 532, -1, "T")
    )
    assert direction(forward) == pytest.approx(away.tolist(), abs=1e-15)
    assert direction(backward) == pytest.approx([0, 0, 1], abs=1e-15)


def test_a_reversed_ray_returns(tmp_path: Path, rng: np.random.Generator) -> None:
    count = 60
    start = rng.uniform(-15, 15, (count, 3)) * [1, 1, 0]
    along = unit(rng.normal((0, 0, 2), 1, (count, 3)))
    waves = rng.uniform(450, 650, count)
    orders, sides = rng.integers(-2, 3, count), rng.choice(["T", "R"], count)
    rays = [
        (*start[i].tolist(), *along[i].tolist(), float(waves[i]), int(orders[i]), sides[i])
        for i in range(count)
    ]
    out = traced(tmp_path, LENS, *rays)
    ok = [place for place, row in enumerate(out) if row["status"] == "ok"]
    assert len(ok) > count // 2
    reverse = [
        (*rays[place][:3], *(-value for value in direction(out[place])), *rays[place][6:])
        for place in ok
    ]
    for place, row in zip(ok, traced(tmp_path, LENS, *reverse), strict=True):
        assert direction(row) == pytest.approx((-along[place]).tolist(), abs=RETURN)


def test_misses_and_evanescent_orders(tmp_path: Path) -> None:
    rays = (
        (0, 0, -1, 0, 0, -1, 532, 0, "T"),  # runs away
        (0, 0, 1, 1, 0, 0, 532, 0, "T"),  # runs along the plane
        (0, 0, 0, 1, 0, 0, 532, 0, "T"),  # lies in the plane
        (20.001, 0, -1, 0, 0, 1, 532, 0, "T"),  # beside the element
        (20, -20, -1, 0, 0, 1, 532, 0, "T"),  # on its corner
        (0, 0, 1, 0, 0, -1, 532, 0, "T"),  # from the front
        (0, 0, 0, 0, 0, 1, 532, 0, "T"),  # starts on it
        (0, 0, -1, 0, 0, 1, 532, 30, "T"),  # evanescent
    )
    found = traced(tmp_path, LENS, *rays)
    status = [row["status"] for row in found]
    assert status == [*["miss"] * 4, *["ok"] * 3, "evanescent"]
    miss, evanescent = found[0], found[-1]
    assert {miss[name] for name in ("hit_x_mm", "out_l", "out_n", "efficiency")} == {"nan"}
    assert {evanescent[name] for name in ("out_l", "out_m", "out_n")} == {"nan"}
    assert (evanescent["hit_x_mm"], evanescent["efficiency"]) == ("0.0", "0.0")
    assert direction(found[5]) == pytest.approx([0.0, 0.0, -1.0], abs=1e-15)


def test_both_sides_refract_as_snell_says(tmp_path: Path) -> None:
    path = element(tmp_path, media={"back": 1.0, "front": 1.5})
    entering, leaving, reflected = traced(
        tmp_path,
        path,
        (0, 0, -1, 0.6, 0, 0.8, 500, 0, "T"),
        (0, 0, 1, 0.6, 0, -0.8, 500, 0, "T"),
        (0, 0, 1, 0.6, 0, -0.8, 500, 0, "R"),
    )
    assert direction(entering)[0] == pytest.approx(0.4, abs=1e-15)
    assert direction(leaving)[0] == pytest.approx(0.9, abs=1e-15)
    assert direction(leaving)[2] < 0.0
    assert direction(reflected) == pytest.approx([0.6, 0, 0.8], abs=1e-15)


def test_input_comes_back_to_the_last_bit(tmp_path: Path, rng: np.random.Generator) -> None:
    rays = [
        (*rng.normal(size=6).tolist(), float(wavelength), 1, "T")
        for wavelength in rng.uniform(400, 700, 20)
    ]
    for ray, row in zip(rays, traced(tmp_path, LENS, *rays), strict=True):
        assert tuple(float(row[name]) for name in COLUMNS.split(",")[:7]) == ray[:7]
        length = math.hypot(*direction(row))
        assert row["status"] != "ok" or length == pytest.approx(1.0, abs=1e-15)


def test_efficiency_is_that_of_the_table(tmp_path: Path) -> None:
    table = {"T": {"0": 0.6, "1": 0.3}, "R": {"1": 0.05}}
    path = element(tmp_path, efficiency={"model": "constant", "table": table}, orders=[0, 1])
    rays = [(0, 0, -1, 0, 0, 1, 532, order, side) for order in (0, 1, 2) for side in "TR"]
    found = [float(row["efficiency"]) for row in traced(tmp_path, path, *rays)]
    assert found == [0.6, 0.0, 0.3, 0.05, 0.0, 0.0]


def test_no_rays_give_a_header(tmp_path: Path) -> None:
    assert traced(tmp_path, LENS) == []
    header = (tmp_path / "out.csv").read_text(encoding="utf-8")
    assert header == COLUMNS + ",hit_x_mm,hit_y_mm,out_l,out_m,out_n,status,efficiency\n"


def test_columns_in_any_order_and_spreadsheet_line_ends(tmp_path: Path) -> None:
    source, out = tmp_path / "rays.csv", tmp_path / "out.csv"
    source.write_bytes(
        b"\xef\xbb\xbfside,order,wavelength_nm,n,m,l,z_mm,y_mm,x_mm\r\nT,0,532,1,0,0,-1,3,2\r\n\r\n"
    )
    assert main(["trace", str(LENS), str(source), "--out", str(out)]) == 0
    assert out.read_text(encoding="utf-8").splitlines()[1].startswith("2.0,3.0,-1.0,0.0,0.0,1.0,53")
