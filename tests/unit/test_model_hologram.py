# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Specs of holograms: what may stand in them, in JSON and in Python."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from hoe_addon.core.characteristic import LinearGrating
from hoe_addon.core.efficiency import Incidence, meet
from hoe_addon.core.errors import SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.core.waves import PlaneWave, PointSource
from hoe_addon.model.convert import recording_from
from hoe_addon.model.document import dump, hologram_from, load_hologram, to_document
from hoe_addon.model.efficiency import ConstantSpec, KinoformSpec, ShareTable
from hoe_addon.model.hologram import HologramSpec, SideMedia
from hoe_addon.model.medium import SellmeierMedium, SellmeierTerms, medium_from
from hoe_addon.model.reading import parse_json
from hoe_addon.model.recording import RecordingSpec
from hoe_addon.model.surface import PlaneSurface
from hoe_addon.model.waves import PlaneWaveSpec, PointSourceSpec

LENS = Path(__file__).parents[1] / "documents" / "lens.json"


def lens() -> dict[str, Any]:
    return json.loads(LENS.read_text(encoding="utf-8"))


def changed(path: str, value: object) -> dict[str, Any]:
    """The lens with one field set; ``...`` takes the field away."""
    document = lens()
    here: Any = document
    *parents, last = (int(step) if step.isdigit() else step for step in path.split("."))
    for step in parents:
        here = here[step]
    if value is ...:
        del here[last]
    else:
        here[last] = value
    return document


def constant(transmitted: dict[str, Any], reflected: dict[str, Any] | None = None) -> Any:
    return {"model": "constant", "table": {"T": transmitted, "R": reflected or {}}}


BROKEN = [
    ("foo", 1, "foo: is not a field here (known: schema, name,"),
    ("recording.foo", 1, "recording.foo: is not a field here (known: wavelength_nm, object,"),
    ("recording.object.foo", 1, "recording.object.foo: is not a field here (known: kind, pos"),
    ("schema", ..., "schema: is missing"),
    (
        "schema",
        2,
        "schema: must be at most 1, the newest that this add-on knows (update it), got 2",
    ),
    ("schema", "1", 'schema: must be 1, the version of this program, got "1"'),
    ("schema", True, "schema: must be 1, the version of this program, got true"),
    ("name", "", 'name: must not be empty, got ""'),
    ("name", 7, "name: must be a text, got 7"),
    ("surface.shape", ..., "surface.shape: is missing"),
    (
        "surface.shape",
        "torus",
        'surface.shape: must be one of plane, sphere, conic, cylinder, asphere, mesh, got "torus"',
    ),
    ("surface.size_mm.1", 0, "surface.size_mm[1]: must be above 0, got 0"),
    ("surface.size_mm", [1], "surface.size_mm: must be a list of length 2, got [1]"),
    ("surface.size_mm.0", True, "surface.size_mm[0]: must be a number, got true"),
    ("media.front", 0.9, "media.front: must be at least 1, got 0.9"),
    ("media.front", "glass", "media.front: must be one of air, fused silica,"),
    ("media.front", None, "media.front: must be a number, a text or an object, got null"),
    ("recording.wavelength_nm", 199.9, "recording.wavelength_nm: must be from 200 to 20000 nm"),
    ("recording.wavelength_nm", 20001, "recording.wavelength_nm: must be from 200 to 20000 nm"),
    ("recording.wavelength_nm", "532", 'recording.wavelength_nm: must be a number, got "532"'),
    ("recording.object.kind", ..., "recording.object.kind: is missing"),
    (
        "recording.object.kind",
        "x",
        "recording.object.kind: must be one of plane, point, window, astigmatic, extended, system, "
        'got "x"',
    ),
    ("recording.object.beam", "x", "recording.object.beam: must be one of converging, diverging"),
    ("recording.object.position_mm.2", 0, "recording.object.position_mm: must not lie on the su"),
    ("recording.object.position_mm.2", 1e-10, "recording.object.position_mm: must not lie on"),
    ("recording.object.position_mm.2", "a", "recording.object.position_mm[2]: must be a number,"),
    ("recording.object.index", 0.5, "recording.object.index: must be at least 1, got 0.5"),
    ("recording.reference.direction", [0, 0, 0], "recording.reference.direction: must not have "),
    (
        "efficiency.model",
        "magic",
        'efficiency.model: must be one of kinoform, constant, kogelnik, rcwa, table, got "ma',
    ),
    ("efficiency.levels", 1, "efficiency.levels: must be 0 (continuous) or at least 2, got 1"),
    ("efficiency.levels", -4, "efficiency.levels: must be from 0 to 1000000, got -4"),
    ("efficiency.levels", 2.5, "efficiency.levels: must be a whole number, got 2.5"),
    ("efficiency.design_wavelength_nm", 10, "efficiency.design_wavelength_nm: must be from 200"),
    ("efficiency.relief", "air", "efficiency.relief: must have an index above 1 at the design"),
    ("efficiency.total_internal_reflection", 1, "efficiency.total_internal_reflection: must be t"),
    ("efficiency", constant({"0": 0.6, "1": 0.5}), "efficiency.table: efficiencies must sum to at"),
    ("efficiency", constant({"0": 0.6}, {"0": 0.5}), "efficiency.table: efficiencies must sum to"),
    ("efficiency", constant({"0": -0.1}), "efficiency.table.T.0: must be at least 0, got -0.1"),
    ("efficiency", constant({"0": 0.1, "1": "a"}), "efficiency.table.T.1: must be a number, got "),
    ("efficiency", constant({"+1": 0.1}), "efficiency.table.T: order must be a whole number fro"),
    ("efficiency", constant({"101": 0.1}), "efficiency.table.T: order must be a whole number fro"),
    ("efficiency", constant({}, {"7": 0.1}), "efficiency.table.R.7: order is not listed in order"),
    ("orders", ..., "orders: is missing"),
    ("orders", [], "orders: must be a list of length at least 1, got []"),
    ("orders", [1, 0, 1], "orders: must list each order once, got 1"),
    ("orders", [0, 0.5], "orders[1]: must be a whole number, got 0.5"),
    ("orders", [101], "orders[0]: must be from -100 to 100, got 101"),
    ("orders", list(range(31)), "orders: must list at most 30, got 31"),
]


@pytest.mark.parametrize(("path", "value", "message"), BROKEN)
def test_each_rule_names_field_and_value(path: str, value: object, message: str) -> None:
    with pytest.raises(SpecError) as caught:
        hologram_from(changed(path, value))
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("recording.object.position_mm", [30, 0, 0]),  # on the plane, beside the element
        ("recording.object.position_mm.2", 1e-6),
        ("recording.wavelength_nm", 200),
        ("recording.wavelength_nm", 20000),
        ("efficiency.levels", 0),
        ("efficiency.levels", 2),
        ("efficiency", constant({"0": 0.7, "1": 0.2}, {"1": 0.1})),
        ("efficiency", constant({"0": 0.1, "-1": 0.9 + 0.5e-9})),
        ("media.back", {"sellmeier": {"b": [1, 0, 0], "c_um2": [0.01, 0, 0]}}),
        ("orders", list(range(-15, 15))),
    ],
)
def test_edges_of_the_rules_are_inside(path: str, value: object) -> None:
    spec = hologram_from(changed(path, value))
    assert hologram_from(to_document(spec)) == spec


def test_table_gives_the_orders_where_they_are_left_out() -> None:
    document = changed("orders", ...)
    document["efficiency"] = constant({"2": 0.1, "0": 0.5}, {"-1": 0.2})
    assert hologram_from(document).orders == (-1, 0, 2)


def test_round_trip_keeps_every_number() -> None:
    document = changed("recording.reference.direction", [0.1, -0.0, 3e-7])
    document["recording"]["wavelength_nm"] = 532.0000000000001
    spec = hologram_from(document)
    again = hologram_from(parse_json(dump(spec)))
    assert again == spec
    assert again.recording.wavelength_nm == 532.0000000000001
    assert spec.recording.reference == PlaneWaveSpec((0.1, -0.0, 3e-7))
    assert dump(again) == dump(spec)


def test_file_and_written_document_agree() -> None:
    written = to_document(load_hologram(LENS))
    assert written.pop("schema") == 1
    expected = lens()
    expected.pop("schema")
    assert holds(written, expected)
    assert written["efficiency"]["total_internal_reflection"] is False
    assert written["surface"]["outline"] == "rectangle"


def holds(written: object, given: object) -> bool:
    """Whether all that is given is written alike; defaults may stand beside it."""
    if not isinstance(given, dict):
        return written == given
    assert isinstance(written, dict)
    return all(name in written and holds(written[name], item) for name, item in given.items())


def test_random_documents_round_trip(rng: np.random.Generator) -> None:
    for _ in range(50):
        document = lens()
        document["recording"]["object"]["position_mm"] = rng.normal(0, 1e3, 3).tolist()
        document["recording"]["reference"]["direction"] = rng.normal(size=3).tolist()
        document["media"]["back"] = float(rng.uniform(1, 4))
        shares = rng.dirichlet(np.ones(4)).tolist()
        orders = rng.permutation(np.arange(-10, 11))[:4].tolist()
        table = {str(order): share for order, share in zip(orders, shares, strict=True)}
        document["efficiency"] = constant(table)
        document["orders"] = orders
        spec = hologram_from(copy.deepcopy(document))
        assert hologram_from(parse_json(dump(spec))) == spec
        assert to_document(spec)["efficiency"]["table"]["T"] == table


def waves() -> dict[str, Any]:
    return {
        "wavelength_nm": 532,
        "object": PointSourceSpec([10, 5, -100]),  # pyright: ignore[reportArgumentType]
        "reference": PlaneWaveSpec(np.array([0, 0, 2])),  # pyright: ignore[reportArgumentType]
    }


def test_python_gets_plain_numbers() -> None:
    recording = RecordingSpec(**waves())
    assert recording.object == PointSourceSpec((10.0, 5.0, -100.0))
    assert json.loads(dump(recording))["reference"]["direction"] == [0, 0, 2]


def test_python_is_checked_like_json() -> None:
    surface, media = PlaneSurface((40, 40)), SideMedia()
    kinoform = KinoformSpec(8, 532, 1.5)
    with pytest.raises(SpecError, match=r"^index: must be at least 1, got 0\.5$"):
        PlaneWaveSpec((0, 0, 1), 0.5)
    with pytest.raises(SpecError, match=r"^direction\[1\]: must be a finite number, got NaN$"):
        PlaneWaveSpec((0, float("nan"), 1))
    with pytest.raises(SpecError, match=r"^table: efficiencies must sum to at most 1, got 1\.5$"):
        ConstantSpec(ShareTable({"0": 1.0}, {"0": 0.5}))
    with pytest.raises(SpecError, match=r"^recording: must be a RecordingSpec"):
        HologramSpec(
            name="a",
            surface=surface,
            media=media,
            recording={},  # pyright: ignore[reportArgumentType]
            efficiency=kinoform,
        )
    with pytest.raises(SpecError, match=r"^media\.back: must have an index of at least 1 at 532"):
        HologramSpec(
            name="a",
            surface=surface,
            media=SideMedia(back=SellmeierMedium(SellmeierTerms((-1, 0, 0), (0.01, 0, 0)))),
            recording=RecordingSpec(**waves()),
            efficiency=kinoform,
            orders=(0,),
        )


def test_recording_in_metres() -> None:
    recording = recording_from(load_hologram(LENS).recording)
    assert recording.object == PointSource((0.01, 0.005, -0.1), converging=False, index=1.0)
    assert recording.reference == PlaneWave((0.0, 0.0, 1.0), index=1.0)
    assert recording.wavelength == 532e-9


def test_media_by_number_name_and_terms() -> None:
    silica = medium_from("fused silica")
    own = medium_from(SellmeierMedium(SellmeierTerms(silica.b, silica.c_um2)))
    assert own.index(589e-9) == silica.index(589e-9)
    assert medium_from(1.7).index(589e-9) == 1.7


def straight(wavelength: ArrayLike) -> Incidence:
    """Light along the normal of a grating in air."""
    pattern, up = LinearGrating((0.1, 0.0)), (0.0, 0.0, 1.0)
    return meet(pattern, np.zeros(3), None, up, up, wavelength, (1.0, 1.0))[1]


def test_constant_shares_by_branch() -> None:
    spec = ConstantSpec(ShareTable({"0": 0.6, "1": 0.3}, {"1": 0.05}))
    ways = spec.branches((0, 1, 2), 532.0)
    assert ways == (Branch(0), Branch(1), Branch(1, reflected=True))
    shares = spec.model().shares((*ways, Branch(2)), straight(np.full((2, 3), 5e-7)))
    assert shares.shape == (2, 3, 4)
    assert shares[1, 2].tolist() == [0.6, 0.3, 0.05, 0.0]


def test_kinoform_reflects_nothing() -> None:
    spec = KinoformSpec(0, 550, 1.5)
    ways = spec.branches((0, 1), 532.0)
    assert ways == (Branch(0), Branch(1))
    shares = spec.model().shares((*ways, Branch(1, reflected=True)), straight(550e-9))
    assert shares == pytest.approx([0.0, 1.0, 0.0], abs=1e-15)
