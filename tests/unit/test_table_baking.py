# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables made of models: collapse, refinement, the stated error, stopped work, and the cache."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency import Incidence, Polarization
from hoe_addon.core.efficiency.baking import bake
from hoe_addon.core.efficiency.node_source import NodeSource
from hoe_addon.core.errors import CancelledError, NotMadeError, SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.tables import cache
from hoe_addon.model.tables.cache import kept_table, table_for
from hoe_addon.model.tables.file import write_table
from hoe_addon.model.tables.light import TableRange, node_source, ranges
from hoe_addon.model.tables.making import bake_hologram

DOCUMENTS = Path(__file__).parents[1] / "documents"
WAYS = (Branch(0), Branch(1))
RANGES = ((380e-9, 780e-9), (-0.98, 0.98), (-0.98, 0.98), (-1e-3, 1e-3), (-1e-3, 1e-3))
TOLERANCE = 1e-3
LUCK = 1.5
"""Other random points may find a little more than those of the last measurement."""
ROUNDING = 1e-12


@dataclass(frozen=True)
class Smooth:
    """Depends on some of the coordinates, and on the polarisation by a constant."""

    colour: float = 0.0
    along: float = 0.0
    across: float = 0.0
    place: float = 0.0
    polarised: float = 0.0

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> Any:
        x, y = np.moveaxis(light.tangential / light.index_in[..., None], -1, 0)
        # Even in the direction and alike on both sides: reciprocal for the order 0.
        part = 0.5 + self.colour * np.sin(2e7 * (light.wavelength - 500e-9))
        part = part + self.along * np.cos(3.0 * x) + self.across * y**2
        part = part + self.place * np.sin(2e3 * light.place[..., 0])
        sign = {Polarization.S: 1.0, Polarization.P: -1.0}.get(polarization, 0.0)
        part = part + sign * self.polarised
        return np.stack([part if way.order else 0.9 - part for way in branches], axis=-1)


def nothing_diffracted(nodes: Any) -> Incidence:
    one = np.ones(len(nodes))
    parts = (nodes[:, 2:4], nodes[:, 0] > 0.0, one, one, 1e-3 * one, nodes[:, 4:6])
    return Incidence(nodes[:, 1], *parts)


def made(model: Any, tolerance: float = TOLERANCE, **options: Any) -> Any:
    source = NodeSource(model, WAYS, nothing_diffracted, 0.98)
    return bake(source, ("back", "front"), RANGES, tolerance, **options)


def worst(baked: Any, model: Any, rng: np.random.Generator, count: int = 4000) -> float:
    """Largest error at points that baking has not seen, within the round of real directions."""
    nodes = np.empty((count, 6))
    nodes[:, 0] = rng.integers(2, size=count)
    for axis, (low, high) in enumerate(RANGES):
        nodes[:, 1 + axis] = rng.uniform(low, high, count)
    nodes = nodes[np.hypot(nodes[:, 2], nodes[:, 3]) < 0.98]
    light = nothing_diffracted(nodes)
    return float(np.abs(baked.table.shares(WAYS, light) - model.shares(WAYS, light)).max())


@pytest.mark.parametrize(
    ("model", "kept"),
    [
        (Smooth(), ()),
        (Smooth(colour=0.2), ("wavelength",)),
        (Smooth(along=0.2), ("along",)),
        (Smooth(across=0.2), ("across",)),
        (Smooth(place=0.2), ("x",)),
        (Smooth(colour=0.1, across=0.1), ("wavelength", "across")),
        (Smooth(colour=0.2, along=0.2 * TOLERANCE), ("wavelength",)),
    ],
)
def test_only_what_matters_is_kept_and_the_error_is_true(
    rng: np.random.Generator, model: Smooth, kept: tuple[str, ...]
) -> None:
    baked = made(model)
    names = ("wavelength", "along", "across", "x", "y")
    assert baked.collapsed == tuple(name for name in names if name not in kept)
    assert baked.reached
    assert baked.rms <= baked.error <= TOLERANCE
    assert worst(baked, model, rng) <= LUCK * TOLERANCE


def test_a_little_variation_is_halved_by_the_middle(rng: np.random.Generator) -> None:
    model = Smooth(place=0.4 * TOLERANCE)
    baked = made(model)
    assert "x" in baked.collapsed
    # sin(2e3 x) runs from -0.91 to 0.91 on the element.
    assert worst(baked, model, rng) <= 0.4 * TOLERANCE
    assert 0.3 * TOLERANCE < baked.error <= 0.4 * TOLERANCE


def test_a_finer_tolerance_takes_more_nodes() -> None:
    coarse, fine = (made(Smooth(colour=0.2), tolerance) for tolerance in (1e-2, 1e-4))
    assert coarse.table.size < fine.table.size
    assert fine.error <= 1e-4 < coarse.error


def test_the_size_limit_holds_and_the_error_is_told(rng: np.random.Generator) -> None:
    model = Smooth(colour=0.2, along=0.1, across=0.1)
    baked = made(model, 1e-4, largest=4000)
    assert baked.table.size <= 4000
    assert not baked.reached
    found = worst(baked, model, rng)
    assert baked.error / LUCK <= found <= LUCK * baked.error


def test_s_against_p_is_told() -> None:
    baked = made(Smooth(colour=0.1, polarised=0.03))
    assert baked.spread == pytest.approx(0.06, abs=ROUNDING)
    assert baked.mean_spread == pytest.approx(0.06, abs=ROUNDING)
    source = NodeSource(
        Smooth(polarised=0.03), WAYS, nothing_diffracted, 0.98, polarization=Polarization.S
    )
    only_s = bake(source, ("back",), RANGES, TOLERANCE)
    assert only_s.table.values[..., 1] == pytest.approx(0.53, abs=ROUNDING)
    assert only_s.spread == pytest.approx(0.06, abs=ROUNDING)


class Step:
    """Order 1 gets what a grazing ray takes along, and nothing where it does not propagate."""

    def shares(self, branches: Sequence[Branch], light: Incidence, _: Any = None) -> Any:
        sine = light.shifted(1.0)[..., 0]
        first = 0.8 * np.sqrt(np.maximum(1.0 - sine**2, 0.0))
        return np.stack([first if way.order else 0.0 * first for way in branches], axis=-1)


def steep(nodes: Any) -> Incidence:
    light = nothing_diffracted(nodes)
    return Incidence(
        light.wavelength, light.tangential, light.from_front, light.index_back,
        light.index_front, 1e6 * np.ones(len(nodes)), light.place,
    )  # fmt: skip


def test_jumps_at_cut_offs_are_told_apart() -> None:
    source = NodeSource(Step(), WAYS, steep, 0.98)
    only = ((500e-9, 500e-9), (-0.98, 0.98), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0))
    baked = bake(source, ("back",), only, 1e-2)
    assert baked.reached
    assert baked.cutoff_error > 2e-2
    assert 0.0 < baked.cutoff_part < 0.2
    # Order 1 ends where its sine, 0.5 more, is 1. The place is narrowed, but not for ever.
    nodes = baked.table.along
    last = int(np.searchsorted(nodes, 0.5))
    assert 1.96 / 128 <= nodes[last] - nodes[last - 1] <= 1.96 / 32
    assert baked.table.size < 200


class Bad:
    """Gives too much light, or no number."""

    def __init__(self, value: float) -> None:
        self.value = value

    def shares(self, branches: Sequence[Branch], light: Incidence, _: Any = None) -> Any:
        return np.full((*light.shape, len(branches)), self.value)


@pytest.mark.parametrize("value", [np.nan, 0.7])
def test_a_model_that_is_wrong_is_named(value: float) -> None:
    with pytest.raises(SpecError, match=r"efficiency.model: must give shares that sum to at most"):
        made(Bad(value))


def test_backward_tables_hold_the_reversed_pair(rng: np.random.Generator) -> None:
    class Slanted:
        def shares(self, branches: Sequence[Branch], light: Incidence, _: Any = None) -> Any:
            x = light.tangential[..., 0]
            return np.stack([0.2 + 0.15 * x + 0.1 * light.from_front for _ in branches], axis=-1)

    source = NodeSource(Slanted(), WAYS, nothing_diffracted, 0.98)
    walked_back = replace(source, backward=True).polarised(source.polarization)
    baked = bake(walked_back, ("back", "front"), RANGES, TOLERANCE)
    nodes = np.zeros((50, 6))
    nodes[:, 0] = rng.integers(2, size=50)
    nodes[:, 1] = 500e-9
    nodes[:, 2] = rng.uniform(-0.9, 0.9, 50)
    walked = nothing_diffracted(nodes)
    expected = [
        Slanted().shares((way,), walked.reversed(way.steps, reflected=False))[:, 0] for way in WAYS
    ]
    assert baked.table.shares(WAYS, walked) == pytest.approx(np.stack(expected, -1), abs=TOLERANCE)
    assert not np.allclose(baked.table.shares(WAYS, walked), Slanted().shares(WAYS, walked))


def hologram(**parts: Any) -> HologramSpec:
    document = json.loads((DOCUMENTS / "lens.json").read_text(encoding="utf-8"))
    given = {name: part for name, part in document.items() if name != "orders"}
    return hologram_from(given | {"orders": [0, 1]} | parts)


NARROW = TableRange((450e-9 * 1e9, 650e-9 * 1e9), (-0.3, 0.3), (0.0, 0.0), ("back",))
CONSTANT = {"model": "constant", "table": {"T": {"0": 0.6, "1": 0.3}, "R": {"1": 0.05}}}


def test_a_constant_is_one_node() -> None:
    baked = bake_hologram(hologram(efficiency=CONSTANT), TOLERANCE)
    assert baked.table.values.ravel().tolist() == [0.6, 0.3, 0.05] * 2
    assert baked.error == 0.0


def test_a_kinoform_is_met(rng: np.random.Generator) -> None:
    spec = hologram()
    baked = bake_hologram(spec, TOLERANCE, NARROW)
    assert baked.reached
    assert baked.table.size < 2000
    nodes = np.zeros((500, 6))
    nodes[:, 1] = rng.uniform(450e-9, 650e-9, 500)
    nodes[:, 2] = rng.uniform(-0.3, 0.3, 500)
    light = node_source(spec, NARROW).light_at(nodes)
    ways = baked.table.branches
    exact = spec.efficiency.model().shares(ways, light)
    assert np.abs(baked.table.shares(ways, light) - exact).max() <= LUCK * TOLERANCE


def test_the_place_is_looked_at_where_the_pattern_varies() -> None:
    assert ranges(hologram(), NARROW)[3:] == ((-0.02, 0.02), (-0.02, 0.02))
    recording = {
        "wavelength_nm": 532,
        "object": {"kind": "plane", "index": 1, "direction": [0.6, 0, 0.8]},
        "reference": {"kind": "plane", "index": 1, "direction": [0, 0, 1]},
    }
    assert ranges(hologram(recording=recording), NARROW)[3:] == ((0.0, 0.0), (0.0, 0.0))


def test_orders_without_light_are_refused() -> None:
    reflected = {"model": "constant", "table": {"R": {"1": 0.5}}}
    spec = hologram(efficiency=reflected, orders=[1])
    assert bake_hologram(spec, TOLERANCE).table.branches == (Branch(1, reflected=True),)
    empty = {"model": "constant", "table": {}}
    with pytest.raises(SpecError, match="orders: the efficiency model gives light to none"):
        bake_hologram(hologram(efficiency=empty), TOLERANCE)


class Stop:
    """Stops the work at the n-th report."""

    def __init__(self, after: int) -> None:
        self.left = after

    def __call__(self, _: float) -> None:
        self.left -= 1
        if self.left < 0:
            raise CancelledError


def test_stopped_work_goes_on(tmp_path: Path) -> None:
    part = tmp_path / "part.npz"
    whole = bake_hologram(hologram(), TOLERANCE, NARROW)
    with pytest.raises(CancelledError):
        bake_hologram(hologram(), TOLERANCE, NARROW, progress=Stop(3), part=part)
    assert list(tmp_path.iterdir()) == [part]
    with np.load(part) as kept:
        assert len(kept["nodes"]) > 0
    seen: list[int] = []

    class Counting:
        def shares(self, branches: Any, light: Incidence, polarization: Any) -> Any:
            seen.append(light.wavelength.size)
            return hologram().efficiency.model().shares(branches, light, polarization)

    again = bake_hologram(hologram(), TOLERANCE, NARROW, part=part)
    assert np.array_equal(again.table.values, whole.table.values)
    source = node_source(hologram(), NARROW)
    source.model = Counting()
    with np.load(part) as kept:
        source.restore(kept["nodes"], kept["rows"])
    source.at(kept_nodes := source.state()[0])
    assert len(kept_nodes) > 0
    assert not seen


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", None])
def test_a_foreign_part_is_not_used(tmp_path: Path, content: bytes | None) -> None:
    part = tmp_path / "part.npz"
    if content is None:
        np.savez(part, key=np.array("other"), nodes=np.zeros((1, 6)), rows=np.zeros((1, 2)))
    else:
        part.write_bytes(content)
    expected = bake_hologram(hologram(), TOLERANCE, NARROW)
    found = bake_hologram(hologram(), TOLERANCE, NARROW, part=part)
    assert np.array_equal(found.table.values, expected.table.values)


@pytest.fixture
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


def counted(monkeypatch: pytest.MonkeyPatch) -> list[HologramSpec]:
    calls: list[HologramSpec] = []

    def counting(spec: HologramSpec, *rest: Any, **named: Any) -> Any:
        calls.append(spec)
        return bake_hologram(spec, *rest, **named)

    monkeypatch.setattr(cache, "bake_hologram", counting)
    return calls


@pytest.mark.usefixtures("own_cache")
def test_the_cache_makes_each_table_once(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch)
    spec = hologram(efficiency=CONSTANT)
    first, second = kept_table(spec), kept_table(spec)
    assert len(calls) == 1
    assert first.path == second.path
    assert np.array_equal(first.table.values, second.table.values)
    assert first.table.values.ravel() == pytest.approx([0.6, 0.3, 0.05] * 2, abs=1e-7)
    # What changes no share makes no new table; all else does.
    shown = CONSTANT | {"haze": {"share": 0.1, "width_deg": 1.0}}
    kept_table(hologram(efficiency=shown, name="other"))
    assert len(calls) == 1
    kept_table(spec, backward=False)
    kept_table(hologram(efficiency=CONSTANT, media={"back": 1.5, "front": 1.0}))
    kept_table(hologram(efficiency=CONSTANT | {"lookup": {"tolerance": 1e-2}}))
    assert len(calls) == 4


def test_a_damaged_file_is_made_anew(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = counted(monkeypatch)
    spec = hologram(efficiency=CONSTANT)
    path = kept_table(spec).path
    assert path.parent == own_cache
    data = path.read_bytes()
    for broken in (data[:-40], data[:-4] + b"\x00\x00\x00\x40", b"", b"no picture"):
        path.write_bytes(broken)
        assert table_for(spec).values.ravel() == pytest.approx([0.6, 0.3, 0.05] * 2, abs=1e-7)
    assert len(calls) == 5
    assert [item.suffix for item in own_cache.iterdir()] == [".exr"]


@pytest.mark.slow
def test_work_on_the_cache_can_be_stopped_and_goes_on(own_cache: Path) -> None:
    spec = hologram()
    with pytest.raises(CancelledError):
        kept_table(spec, progress=Stop(2))
    (left,) = own_cache.iterdir()
    assert left.name.endswith(".part.npz")
    steps: list[float] = []
    kept_table(spec, progress=steps.append)
    assert [path.suffix for path in own_cache.iterdir()] == [".exr"]
    for path in own_cache.iterdir():
        path.unlink()
    whole: list[float] = []
    kept_table(spec, progress=whole.append)
    assert 0 < len(steps) < len(whole)


def test_a_table_that_is_not_to_be_made(own_cache: Path) -> None:
    spec = hologram(efficiency=CONSTANT)
    with pytest.raises(NotMadeError, match=r"efficiency: needs its table, .* press Bake"):
        kept_table(spec, make=False)
    assert not list(own_cache.iterdir())
    made = kept_table(spec)
    assert np.array_equal(kept_table(spec, make=False).table.values, made.table.values)


@pytest.mark.usefixtures("own_cache")
def test_an_imported_table_is_given_as_it_is(tmp_path: Path) -> None:
    given = bake_hologram(hologram(efficiency=CONSTANT), TOLERANCE).table
    file = tmp_path / "table.npz"
    write_table(file, given)
    spec = hologram(efficiency={"model": "table", "file": str(file)}, orders=[1])
    kept = kept_table(spec, backward=False)
    assert kept.table.branches == (Branch(1), Branch(1, reflected=True))
    assert kept.table.values.ravel() == pytest.approx([0.3, 0.05] * 2, abs=1e-7)
    assert kept.error == 0.0


def test_trapped_light_has_the_share_of_its_own_reflection() -> None:
    """Beyond the critical angle order 0 is folded: its light comes from the walked ray's side."""
    sent: list[Incidence] = []

    class Watching(Smooth):
        def shares(self, branches: Any, light: Incidence, polarization: Any = None) -> Any:
            sent.append(light)
            return super().shares(branches, light)

    def behind_glass(nodes: Any) -> Incidence:
        light = nothing_diffracted(nodes)
        index = np.full(len(nodes), 1.5)
        return replace(light, tangential=1.5 * nodes[:, 2:4], index_back=index)

    source = NodeSource(Watching(), (Branch(0),), behind_glass, 0.98, backward=True)
    source.at(np.array([[0.0, 5e-7, 0.9, 0.0, 0.0, 0.0], [0.0, 5e-7, 0.3, 0.0, 0.0, 0.0]]))
    assert sent[-1].from_front.tolist() == [False, True]
    np.testing.assert_allclose(sent[-1].tangential[:, 0], [-1.35, -0.45])
