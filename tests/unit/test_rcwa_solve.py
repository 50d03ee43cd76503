# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rigorous solver as a program: batches, shared work, limits, convergence and bad input."""

import sys
from collections.abc import Sequence

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from hoe_addon.cli.bench_rcwa import RcwaSpeed, rcwa_lines
from hoe_addon.core.errors import CancelledError, ConvergenceError, SpecError
from hoe_addon.core.rcwa import (
    Lamellar,
    Layer,
    PlaneWaves,
    Repeat,
    SingularError,
    Solution,
    Stack,
    Uniform,
    blas,
    converge,
    solve,
)
from hoe_addon.core.rcwa.reliefs import binary, trapezoid, triangle
from hoe_addon.core.rcwa.runs import Run, equal_runs

ROUNDING = 1e-11
"""The same sums in another order."""

TABLE = [2.25, 1.0, 4.0, 6.0 + 0.2j]


def mixed_light(rng: np.random.Generator, count: int = 12) -> PlaneWaves:
    """Waves that differ in everything: side, mount, wavelength, period and material."""
    across = 0.5 * rng.random(count)
    across[::3] = 0.0
    table = np.array(TABLE) * (1.0 + 0.1 * rng.random((count, 1)))
    return PlaneWaves.of(
        0.5 + rng.random(count),
        (rng.random(count) - 0.5, across),
        0.8 + rng.random(count),
        table,
        from_front=rng.random(count) < 0.5,
    )


def assert_same(first: Solution, second: Solution) -> None:
    ends = (
        min(first.orders[0], second.orders[0]),
        max(first.orders[-1], second.orders[-1]),
    )
    for one, two in zip(first.span(*ends).arrays, second.span(*ends).arrays, strict=True):
        np.testing.assert_allclose(one, two, atol=ROUNDING)


def stack() -> Stack:
    layers = (*binary(0.3, 0.4, ridge=3), Layer(Uniform(2), 0.2))
    return Stack((*layers, *trapezoid(0.4, (0.0, 0.5), (0.3, 0.6), 4, ridge=2)))


def test_a_batch_is_its_single_waves(rng: np.random.Generator) -> None:
    light = mixed_light(rng)
    together = solve(stack(), light, 11)
    for index in range(len(light)):
        chosen = np.array([index])
        assert_same(together.only(chosen), solve(stack(), light.only(chosen), 11))


def test_chunks_do_not_matter(rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch) -> None:
    module = sys.modules[solve.__module__]
    light = mixed_light(rng)
    whole = solve(stack(), light, 11)
    told: list[float] = []
    monkeypatch.setattr(module, "_CHUNK_BYTES", 2 * 16 * 20 * 22**2)
    assert_same(whole, solve(stack(), light, 11, told.append))
    assert len(told) > 4
    assert told == sorted(told)
    assert told[-1] == 1.0


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6, 7, 13, 32])
def test_moved_copies_are_joined_by_doubling(rng: np.random.Generator, count: int) -> None:
    """Equal layers as one pattern object, against the same layers as objects of their own."""
    walls = np.array([0.1, 0.35, 0.7])
    shared = Lamellar(walls, (0, 2, 3))
    places = [0.93 + 0.07 * k for k in range(count)]
    light = mixed_light(rng)
    one = Stack([Layer(shared, 0.05, x) for x in places])
    each = Stack([Layer(Lamellar(walls.copy(), (0, 2, 3)), 0.05, x) for x in places])
    assert len(equal_runs(one.layers)) == 1
    assert len(equal_runs(each.layers)) == count
    assert_same(solve(one, light, 7), solve(each, light, 7))


def test_a_shift_by_whole_periods_is_none() -> None:
    shared = Lamellar(np.array([0.1, 0.6]), (0, 1))
    layers = [Layer(shared, 0.05, (0.9 + 0.3 * k) % 1.0) for k in range(6)]
    (run,) = equal_runs(layers)
    assert isinstance(run, Run)
    assert run.count == 6


def test_repeated_layers_are_those_layers_again_and_again(rng: np.random.Generator) -> None:
    cell = (*binary(0.1, 0.4, ridge=3), Layer(Uniform(2), 0.05), *triangle(0.1, 3, 0.8, ridge=2))
    light = mixed_light(rng)
    assert_same(
        solve(Stack([Repeat(cell, 5)]), light, 7), solve(Stack([*cell, *cell * 4]), light, 7)
    )


@pytest.mark.parametrize("count", [1, 2, 5, 8])
def test_repeated_layers_may_climb_along_x(rng: np.random.Generator, count: int) -> None:
    """Seen from both sides: the light comes from the back and from the front."""
    first, second = Lamellar(np.array([0.1, 0.4]), (0, 2)), Lamellar(np.array([0.2, 0.3]), (1, 3))
    cell, step, light = (Layer(first, 0.1, 0.2), Layer(second, 0.05)), 0.13, mixed_light(rng)
    each = [Layer(x.pattern, x.thickness, x.shift + step * k) for k in range(count) for x in cell]
    one = solve(Stack([Repeat(cell, count, step)]), light, 7)
    assert_same(one, solve(Stack(each), light, 7))


def test_layers_without_thickness_are_nothing(rng: np.random.Generator) -> None:
    light = mixed_light(rng)
    layers: Sequence[Layer] = binary(0.3, 0.4, ridge=3)
    more = [Layer(Uniform(2), 0.0), *layers, Layer(layers[0].pattern, 0.0, 0.3)]
    assert_same(solve(Stack(more), light, 7), solve(Stack(layers), light, 7))


def test_a_shift_of_all_is_a_phase_of_the_orders(rng: np.random.Generator) -> None:
    light, move = mixed_light(rng), 0.23
    still = solve(Stack(binary(0.3, 0.4, ridge=3)), light, 7)
    (layer,) = binary(0.3, 0.4, ridge=3)
    moved = solve(Stack([Layer(layer.pattern, layer.thickness, move)]), light, 7)
    turn = np.exp(-2j * np.pi * move * still.orders)[None, :, None, None]
    np.testing.assert_allclose(moved.reflected_jones, still.reflected_jones * turn, atol=ROUNDING)
    np.testing.assert_allclose(
        moved.transmitted_jones, still.transmitted_jones * turn, atol=ROUNDING
    )


def test_order_plus_one_turns_light_toward_plus_x() -> None:
    """A blazed relief, higher toward +x, on the back: it is a prism that bends toward +x."""
    light = PlaneWaves.of(1.0, (0.0, 0.0), 6.0, [2.25, 1.0])
    found = solve(Stack(triangle(2.0, 40, 1.0)), light, 41)
    powers = found.transmitted[0].mean(axis=1)
    assert found.orders[np.argmax(powers)] == 1
    assert powers.max() > 0.6


def test_cancelled_work_stops(rng: np.random.Generator) -> None:
    def stop(share: float) -> None:
        raise CancelledError(f"{share}")

    with pytest.raises(CancelledError):
        solve(stack(), mixed_light(rng), 5, stop)
    with pytest.raises(CancelledError):
        converge(lambda _: stack(), mixed_light(rng), 1, 1e-3, progress=stop)


def test_convergence_keeps_its_promise() -> None:
    """The error that is told bounds the distance from a far better result."""
    relief = Stack(binary(0.5))
    light = PlaneWaves.of(1.0, (np.linspace(-0.9, 0.9, 7), 0.1), 1.3, [4.0, 1.0], from_front=True)
    best = solve(relief, light, 201).span(-2, 2)
    counts: list[int] = []
    for tolerance in (1e-2, 1e-3, 1e-4):
        found = converge(lambda _: relief, light, 2, tolerance)
        assert np.all(found.error < tolerance)
        distance = np.maximum(
            np.abs(found.solution.reflected - best.reflected),
            np.abs(found.solution.transmitted - best.transmitted),
        )
        assert np.all(distance.max(axis=(1, 2)) < found.error)
        counts.append(int(found.harmonics.max()))
    assert counts == sorted(set(counts))


def test_convergence_keeps_its_promise_where_it_is_slow() -> None:
    """Slanted walls in p light: the error falls as 1 / n and is about twice the last step."""

    def slanted(harmonics: int) -> Stack:
        return Stack(trapezoid(0.5, (0.0, 0.4), (0.5, 0.9), max(16, harmonics)))

    light = PlaneWaves.of(0.532, (0.3, 0.0), 0.7, [3.24, 1.0])
    best = solve(slanted(301), light, 301).span(-2, 2)
    found = converge(slanted, light, 2, 1e-2)
    distance = max(
        np.abs(found.solution.reflected - best.reflected).max(),
        np.abs(found.solution.transmitted - best.transmitted).max(),
    )
    assert 0.5 * found.error[0] < distance < found.error[0] < 1e-2


def test_what_will_not_converge_ends_early() -> None:
    """A metal in p light, of steps that do not fall: the last tries would take most of the time."""
    asked: list[int] = []
    light = PlaneWaves.of(
        0.532, (0.26, 0.0), 0.8, [2.25, 1.0, (0.05 + 3.3j) ** 2], from_front=False
    )

    def structure(harmonics: int) -> Stack:
        asked.append(harmonics)
        return Stack(triangle(0.3, max(16, harmonics), 1.0, ridge=2))

    with pytest.raises(ConvergenceError, match=r"may be off by \S+ at \d+ harmonics"):
        converge(structure, light, 1, 1e-3, maximum=129)
    assert 19 < max(asked) < 129


@pytest.mark.parametrize("mean", [0.0, 1e-15])
def test_permittivities_that_cancel_are_named(mean: float) -> None:
    metal = Stack(binary(0.4e-6, 0.5, ridge=2))
    light = PlaneWaves.of(532e-9, (0.26, 0.0), 0.8e-6, [2.25, 1.0, mean - 1.0])
    rule = "harmonics: the permittivities of a layer average to zero with 21 of them; .* 532 nm$"
    with pytest.raises(SingularError, match=rule):
        solve(metal, light, 21)


def test_one_small_step_is_no_convergence() -> None:
    """Slices that come in only later: the first two results agree by chance."""
    asked: list[int] = []

    def structure(harmonics: int) -> Stack:
        asked.append(harmonics)
        return Stack(binary(0.5 if harmonics > 15 else 1e-9))

    light = PlaneWaves.of(1.0, (0.3, 0.0), 1.3, [4.0, 1.0], from_front=True)
    found = converge(structure, light, 2, 1e-2)
    assert sorted({n for n in asked if n > 1})[:2] == [9, 13]
    exact = solve(Stack(binary(0.5)), light, 101).span(-2, 2)
    np.testing.assert_allclose(found.solution.transmitted, exact.transmitted, atol=1e-2)


def test_what_does_not_converge_says_so() -> None:
    metal = Stack(binary(0.5, ridge=2))
    light = PlaneWaves.of(1.0, (0.3, 0.0), 1.3, [4.0, 1.0, (0.2 + 6.0j) ** 2], from_front=True)
    rule = (
        r"must bring the result to 1e-09, but it may be off by \S+ at \d+ harmonics, .*number, or"
    )
    with pytest.raises(ConvergenceError, match=rule):
        converge(lambda _: metal, light, 1, 1e-9, maximum=41)
    found = converge(lambda _: metal, light, 1, 1e-9, maximum=41, accept=True)
    assert 1e-9 < found.error[0] < 0.1
    assert found.harmonics[0] == 41
    with pytest.raises(ConvergenceError, match=r"81 orders .* maximum 41 of auto; give harmon"):
        wide = PlaneWaves.of(1.0, (0.0, 0.0), 20.0, [4.0, 1.0])
        converge(lambda _: metal, wide, 1, 1e-3, maximum=41)


@pytest.mark.parametrize("tolerance", [0.0, -1.0, 1.0, float("nan")])
def test_tolerances_out_of_range(tolerance: float) -> None:
    light = PlaneWaves.of(1.0, (0.3, 0.0), 1.3, TABLE)
    with pytest.raises(SpecError, match="tolerance: must be above 0 and below 1, got"):
        converge(lambda _: stack(), light, 1, tolerance)


@pytest.mark.parametrize(
    ("changes", "harmonics", "message"),
    [
        ({}, 4, "harmonics: must be odd and from 1 to 2001, got 4"),
        ({}, -1, "harmonics: must be odd and from 1 to 2001, got -1"),
        ({"permittivity": [2.25, 1.0]}, 5, "permittivity: must be given for 4 materials, got 2"),
        ({"permittivity": [2.25 + 1j, 1, 2, 2]}, 5, "must come out of a lossless half space"),
        ({"permittivity": [-2.25, 1, 2, 2]}, 5, "must come out of a lossless half space"),
        ({"permittivity": [2.25, 1, 0, 2]}, 5, "permittivity: must not be 0, got 0 for material 2"),
        ({"tangential": (1.6, 0.0)}, 5, "tangential part: must be at most the index 1.5, got 1.6"),
        ({"tangential": (float("nan"), 0.0)}, 5, "direction and permittivity: must be finite"),
        ({"wavelength": 0.0}, 5, "wavelength and period: must be above 0"),
        ({"period": -1.0}, 5, "wavelength and period: must be above 0"),
    ],
)
def test_bad_light(changes: dict[str, object], harmonics: int, message: str) -> None:
    good = {"wavelength": 1.0, "tangential": (0.2, 0.0), "period": 1.0, "permittivity": TABLE}
    with pytest.raises(SpecError, match=message):
        solve(stack(), PlaneWaves.of(**(good | changes)), harmonics)  # pyright: ignore[reportArgumentType]


def test_orders_that_are_not_there() -> None:
    found = solve(Stack(binary(0.5)), PlaneWaves.of(1.0, (0.2, 0.0), 1.0, TABLE), 5)
    with pytest.raises(SpecError, match="order: must be from -2 to 2, got 3"):
        found.place(3)
    wide = found.span(-4, 4)
    assert wide.transmitted.shape == (1, 9, 2)
    assert not wide.transmitted[:, [0, 1, 7, 8]].any()


def test_linear_algebra_keeps_to_one_thread_and_gives_the_others_back() -> None:
    def threads() -> list[int]:
        return [each["num_threads"] for each in threadpool_info() if each["user_api"] == "blas"]

    before = threads()
    if not before:
        pytest.skip("numpy's linear algebra has no threads to limit")
    with blas.one_thread():
        assert set(threads()) == {1}
    assert threads() == before


def test_lines_of_the_benchmark() -> None:
    lines = rcwa_lines([RcwaSpeed("1 layer", 2.0, 9.0)])
    assert "31 wavelengths x 64 angles x s and p, 21 harmonics" in lines[0]
    assert lines[2].split() == ["1", "layer", "2.00", "9.0", "4.50"]
