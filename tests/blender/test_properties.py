# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A hologram's document as properties of a material, and back."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.props import values
from hoe_addon.blender.props.sync import read_frame, read_spec, write_spec
from hoe_addon.core.errors import HoeError, SpecError
from hoe_addon.core.media import CATALOGUE
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.shading.hologram import Frame

type Make = Callable[..., Any]

FLOAT32 = 1.2e-7
"""One unit in the last place of a float32, relative: half for storing, half for the decimal."""

ROUNDED_DOWN = 2.4e-7
"""Two units: shares may have to take the next smaller float32."""

SPECS = 60
"""Random documents in one test; each takes 2 ms."""

PLANE = {"kind": "plane", "direction": [0.0, 0.6, -0.8], "index": 1.5}
INWARD = {"kind": "point", "position_mm": [1.5, -2, 30.25], "beam": "converging", "index": 1.3}
SELLMEIER = {
    "sellmeier": {
        "a": 1.1,
        "b": [1.03961, 0.231792, 1.01047],
        "c_um2": [0.00600070, 0.0200179, 103.561],
    }
}
SHARES = {
    "model": "constant",
    "table": {"T": {"0": 0.6, "-1": 0.3}, "R": {"1": 0.05}},
    "total_internal_reflection": True,
}

CHANGES: dict[str, dict[str, Any]] = {
    "as it is": {},
    "constant shares": {"efficiency": SHARES, "orders": [1, 0, -1]},
    "no light": {"efficiency": {"model": "constant", "table": {}}, "orders": [3]},
    "sellmeier": {"media": {"back": SELLMEIER, "front": "fused silica"}},
    "planes": {"recording": {"wavelength_nm": 632.8, "object": PLANE, "reference": PLANE}},
    "points": {"recording": {"wavelength_nm": 457.9, "object": INWARD, "reference": INWARD}},
    "small": {"surface": {"shape": "plane", "size_mm": [0.01, 123.456]}},
    "continuous": {
        "efficiency": {
            "model": "kinoform",
            "levels": 0,
            "design_wavelength_nm": 550.5,
            "relief": SELLMEIER,
            "total_internal_reflection": True,
        }
    },
}


def leaves(document: object, path: str = "") -> Iterator[tuple[str, object]]:
    """Every value of a document with its path."""
    if isinstance(document, dict):
        for name, item in document.items():
            yield from leaves(item, f"{path}.{name}")
    elif isinstance(document, list):
        for place, item in enumerate(document):
            yield from leaves(item, f"{path}[{place}]")
    else:
        yield path, document


def random_document(rng: np.random.Generator, digits: int | None) -> dict[str, Any]:
    """Any valid hologram, its numbers with this many digits, or all of a float64."""

    def number(low: float, high: float) -> float:
        value = float(rng.uniform(low, high))
        return value if digits is None else float(f"{value:.{digits}g}")

    def triple(low: float, high: float) -> list[float]:
        return [number(low, high) for _ in range(3)]

    def medium() -> Any:
        terms = {"b": triple(0.1, 1.5), "c_um2": triple(0.001, 0.02), "a": number(1.0, 2.0)}
        choices = [number(1.1, 2.5), str(rng.choice(list(CATALOGUE)[1:])), {"sellmeier": terms}]
        return choices[rng.integers(3)]

    def wave() -> dict[str, Any]:
        if rng.random() < 0.5:
            return {"kind": "plane", "direction": triple(0.01, 1.0), "index": number(1.0, 2.0)}
        beam = str(rng.choice(["diverging", "converging"]))
        point = [*triple(-900.0, 900.0)[:2], -number(0.5, 500.0)]
        return {"kind": "point", "position_mm": point, "beam": beam, "index": number(1.0, 2.0)}

    orders = [int(order) for order in rng.permutation(np.arange(-4, 5))[: rng.integers(1, 6)]]
    if rng.random() < 0.5:
        efficiency: dict[str, Any] = {
            "model": "kinoform",
            "levels": int(rng.choice([0, 2, 3, 16])),
            "design_wavelength_nm": number(400.0, 900.0),
            "relief": medium(),
        }
    else:
        shares = {str(order): number(0.01, 1.0 / len(orders)) for order in orders}
        back = {order: shares.pop(order) for order in list(shares) if rng.random() < 0.3}
        efficiency = {"model": "constant", "table": {"T": shares, "R": back}}
    efficiency["total_internal_reflection"] = bool(rng.random() < 0.5)
    return {
        "schema": 1,
        "name": "random",
        "surface": {"shape": "plane", "size_mm": triple(1.0, 80.0)[:2]},
        "media": {"back": medium(), "front": medium()},
        "recording": {
            "wavelength_nm": number(400.0, 1600.0),
            "object": wave(),
            "reference": wave(),
        },
        "efficiency": efficiency,
        "orders": orders,
    }


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_round_trip(make_material: Make, lens: dict[str, Any], change: dict[str, Any]) -> None:
    spec = hologram_from(lens | change)
    back = read_spec(make_material(lens | change))
    assert back == spec
    assert to_document(back) == to_document(spec)


def test_random_round_trip_with_seven_digits(registered: Any, rng: np.random.Generator) -> None:
    material = bpy.data.materials.new("random")
    for _ in range(SPECS):
        spec = hologram_from(random_document(rng, digits=7))
        write_spec(material, spec)
        assert read_spec(material) == spec


def test_random_round_trip_with_all_digits(registered: Any, rng: np.random.Generator) -> None:
    material = bpy.data.materials.new("random")
    for _ in range(SPECS):
        spec = hologram_from(random_document(rng, digits=None))
        write_spec(material, spec)
        was, came = dict(leaves(to_document(spec))), dict(leaves(to_document(read_spec(material))))
        assert was.keys() == came.keys()
        for path, value in was.items():
            if isinstance(value, float):
                tolerance = ROUNDED_DOWN if ".table." in path else FLOAT32
                assert came[path] == pytest.approx(value, rel=tolerance, abs=0.0), path
            else:
                assert came[path] == value, path


def test_shares_that_sum_to_one_stay_valid(make_material: Make, lens: dict[str, Any]) -> None:
    """A third as float32 is above a third: three of them would give away more than all light."""
    thirds = {"model": "constant", "table": {"T": {str(order): 1 / 3 for order in range(3)}}}
    spec = read_spec(make_material(lens | {"efficiency": thirds, "orders": [0, 1, 2]}))
    shares = spec.efficiency.table.T.values()
    assert all(1 / 3 * (1 - ROUNDED_DOWN) < share <= 1 / 3 for share in shares)


def test_frame_round_trip(make_material: Make, lens: dict[str, Any]) -> None:
    frame = Frame((1.5, -2.25, 0.1), (-0.6, 0.8, 0.0), (0.8, 0.6, 0.0))
    material = make_material(lens, frame, 0.001)
    assert read_frame(material) == frame
    assert values.number(material.hologram, "units_per_mm") == 0.001


def test_frame_must_be_orthonormal(make_material: Make, lens: dict[str, Any]) -> None:
    material = make_material(lens)
    material.hologram.frame.x = (0.0, 0.5, 0.0)
    with pytest.raises(SpecError, match=r"^frame: must have two unit axes at a right angle, got "):
        read_frame(material)


def test_survives_a_file(make_material: Make, lens: dict[str, Any], tmp_path: Path) -> None:
    document = lens | CHANGES["constant shares"] | CHANGES["sellmeier"]
    frame = Frame((1.5, -2.25, 0.1), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))
    make_material(document, frame).use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "lens.blend"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert "lens" not in bpy.data.materials
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "lens.blend"))
    material = bpy.data.materials["lens"]
    assert read_spec(material) == hologram_from(document)
    assert read_frame(material) == frame
    assert material.hologram.is_property_set("schema")


def test_appended_material(make_material: Make, lens: dict[str, Any], tmp_path: Path) -> None:
    make_material(lens).use_fake_user = True
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "lens.blend"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "lens.blend")) as (_, wanted):
        wanted.materials = ["lens"]
    assert read_spec(wanted.materials[0]) == hologram_from(lens)


def test_copy_is_independent(make_material: Make, lens: dict[str, Any]) -> None:
    material = make_material(lens)
    copy = material.copy()
    assert read_spec(copy) == hologram_from(lens | {"name": copy.name})
    copy.hologram.recording.wavelength_nm = 600.0
    copy.hologram.orders.clear()
    assert read_spec(material) == hologram_from(lens)


def test_writing_leaves_nothing_of_the_last_one(make_material: Make, lens: dict[str, Any]) -> None:
    material = make_material(lens | CHANGES["constant shares"] | CHANGES["points"])
    write_spec(material, hologram_from(lens))
    assert read_spec(material) == hologram_from(lens)
    assert len(material.hologram.efficiency.shares) == 0
    assert not material.hologram.recording.reference.is_property_set("position_mm")


def test_errors_name_the_property(make_material: Make, lens: dict[str, Any]) -> None:
    material = make_material(lens | CHANGES["constant shares"])
    hologram = material.hologram
    hologram.recording.reference.direction = (0.0, 0.0, 0.0)
    with pytest.raises(SpecError, match=r"^recording\.reference\.direction: must not have zero"):
        read_spec(material)
    hologram.recording.reference.direction = (0.0, 0.0, 1.0)
    hologram.efficiency.shares.add().share = 0.25
    with pytest.raises(SpecError, match=r"^efficiency\.table\.T\.0: stands twice, got 0\.25$"):
        read_spec(material)


def test_no_number_is_changed_silently(make_material: Make, lens: dict[str, Any]) -> None:
    """A material's size has a least value; a document may go below it."""
    tiny = hologram_from(lens | {"surface": {"shape": "plane", "size_mm": [1e-9, 1]}})
    with pytest.raises(
        SpecError, match=r"^surface\.size_mm: is outside what a material can hold, got "
    ):
        write_spec(bpy.data.materials.new("lens"), tiny)


def test_not_a_hologram(registered: Any) -> None:
    with pytest.raises(SpecError, match=r"^material plain: is not a hologram$"):
        read_spec(bpy.data.materials.new("plain"))


def test_without_registration(clean_scene: Any) -> None:
    with pytest.raises(HoeError, match=r"call hoe_addon\.register"):
        read_spec(bpy.data.materials.new("plain"))
