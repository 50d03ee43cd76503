# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rigorous model as one of the efficiency models."""

from dataclasses import replace

import numpy as np
import pytest

from hoe_addon.core import fresnel
from hoe_addon.core.arrays import ComplexArray, FloatArray
from hoe_addon.core.efficiency import EfficiencyModel, Incidence, Polarization
from hoe_addon.core.efficiency.rigorous import RigorousGrating
from hoe_addon.core.errors import CancelledError, ConvergenceError
from hoe_addon.core.orders import Branch
from hoe_addon.core.rcwa import Layer, PlaneWaves, Stack, Uniform, solve, volume_layers
from hoe_addon.core.rcwa.reliefs import binary, trapezoid

ROUNDING = 1e-11
WAYS = [Branch(0), Branch(1), Branch(-1), Branch(0, reflected=True), Branch(-2, reflected=True)]
PERIOD = 0.9e-6


def coating(wavelength: FloatArray) -> ComplexArray:
    return np.full(wavelength.shape, 3.2, dtype=np.complex128)


def stack(frequency: float, harmonics: int) -> Stack:
    """A slanted relief on a coating."""
    del frequency
    relief = trapezoid(0.3e-6, (0.0, 0.5), (0.2, 0.6), max(4, harmonics // 2), ridge=2)
    return Stack((Layer(Uniform(2), 0.1e-6), *relief))


def incidence(tangential: object, frequency: object = 1.0 / PERIOD) -> Incidence:
    """Light at 550 nm, every other ray from the front (index 1) or the back (1.5)."""
    along = np.asarray(tangential, dtype=np.float64)
    shape = along.shape[:-1]
    side = np.arange(np.prod(shape, dtype=np.int64)).reshape(shape) % 2 == 1
    return Incidence(
        wavelength=np.full(shape, 550e-9),
        tangential=along,
        from_front=side,
        index_back=np.full(shape, 1.5),
        index_front=np.ones(shape),
        frequency=np.broadcast_to(np.asarray(frequency, dtype=np.float64), shape),
        place=np.zeros((*shape, 2)),
    )


GRATING = RigorousGrating(stack, (coating,), harmonics=15)
LIGHT = incidence([[[0.2, 0.1], [-0.3, 0.2]], [[1.2, 0.0], [0.0, 0.0]]])


def test_shares_are_those_of_the_solver() -> None:
    model: EfficiencyModel = GRATING
    found = GRATING.solve(WAYS, LIGHT)
    assert found.shares.shape == (2, 2, len(WAYS), 2)
    for place in np.ndindex(2, 2):
        waves = PlaneWaves.of(
            550e-9,
            tuple(LIGHT.tangential[place]),
            PERIOD,
            [2.25, 1.0, 3.2],
            from_front=bool(LIGHT.from_front[place]),
        )
        single = solve(stack(0.0, 15), waves, 15).span(-2, 2)
        for index, way in enumerate(WAYS):
            powers = single.reflected if way.reflected else single.transmitted
            expected = powers[0, 2 + way.order]
            np.testing.assert_allclose(found.shares[*place, index], expected, atol=ROUNDING)
    s, p = (model.shares(WAYS, LIGHT, Polarization(name)) for name in "sp")
    np.testing.assert_array_equal(np.stack((s, p), axis=-1), found.shares)
    np.testing.assert_allclose(model.shares(WAYS, LIGHT), 0.5 * (s + p), atol=ROUNDING)
    assert np.isnan(found.error).all()
    assert (found.harmonics == 15).all()


def test_light_sent_back_has_the_same_shares() -> None:
    """What the walk against the light looks up: the reversed ray, the same order."""
    for way in WAYS:
        there = GRATING.shares([way], LIGHT)[..., 0]
        back = GRATING.shares([way], LIGHT.reversed(way.steps, reflected=way.reflected))[..., 0]
        np.testing.assert_allclose(back, there, atol=1e-8)


def test_evanescent_orders_and_light_that_is_none_have_no_share() -> None:
    light = incidence([[1.7, 0.0], [1.2, 0.0], [np.nan, 0.0]])
    shares = GRATING.shares([*WAYS, Branch(40)], light)
    assert not shares.any()
    beyond = GRATING.solve([Branch(0), Branch(0, reflected=True)], incidence([[1.2, 0.0]]))
    assert not beyond.shares[0, 0].any()
    assert (beyond.shares[0, 1] > 0.0).all()


def test_rays_have_their_own_frequency() -> None:
    frequencies = np.array([1.0, 1.3, 0.0, np.nan, 1.0]) / PERIOD
    light = incidence([[0.2, 0.1]] * 5, frequencies)
    together = GRATING.solve(WAYS, light)
    for index in range(5):
        chosen = slice(index, index + 1)
        single = GRATING.solve(WAYS, replace(
            incidence([[0.2, 0.1]], frequencies[chosen]), from_front=light.from_front[chosen]
        ))  # fmt: skip
        np.testing.assert_allclose(together.shares[index], single.shares[0], atol=ROUNDING)
    assert (together.error[2:4] == 0.0).all()
    # Without a grating the relief is left out, and the coating is a thin film.
    flat = together.shares[2:4]
    np.testing.assert_allclose(flat.sum(axis=1), 1.0, atol=ROUNDING)
    assert not flat[:, 1].any()
    bare = RigorousGrating(lambda *_: Stack(), harmonics=15).solve(WAYS, light)
    expected = fresnel.reflectance_s(np.sqrt(1 - (0.05 / 2.25)), 1.5, 1.0)
    assert bare.shares[2, 3, 0] == pytest.approx(float(expected), abs=ROUNDING)


def test_stacks_that_depend_on_the_frequency_are_asked_once_for_each() -> None:
    asked: list[float] = []

    def slanted(frequency: float, harmonics: int) -> Stack:
        del harmonics
        asked.append(frequency)
        return Stack(volume_layers(2e-6, 0.5 * frequency, mean=2, wave=3, plane=frequency == 0.0))

    def modulation(wavelength: FloatArray) -> ComplexArray:
        return np.full(wavelength.shape, 0.1, dtype=np.complex128)

    film = RigorousGrating(slanted, (coating, modulation), fixed=False, harmonics=7)
    frequencies = np.array([1e6, 1.2e6, 1e6, 0.0])
    shares = film.solve(WAYS, incidence([[0.2, 0.1]] * 4, frequencies)).shares
    assert sorted(asked) == [0.0, 1e6, 1.2e6]
    assert np.abs(shares[0] - shares[1]).max() > 1e-3
    total = shares.sum(axis=(1, 2))
    assert (total <= 2.0 + ROUNDING).all()


def test_other_exposures_are_not_of_this_grating() -> None:
    shares = GRATING.shares([Branch(1, frequency=1.5), Branch(0, frequency=1.5), Branch(0)], LIGHT)
    assert not shares[..., 0].any()
    np.testing.assert_array_equal(shares[..., 1], shares[..., 2])


def test_search_for_harmonics_carries_its_error() -> None:
    search = RigorousGrating(stack, (coating,), tolerance=5e-3)
    told: list[float] = []
    found = search.solve(WAYS, LIGHT, told.append)
    assert (found.error < 5e-3).all()
    assert (found.error > 0.0).all()
    best = replace(GRATING, harmonics=61).solve(WAYS, LIGHT)
    assert np.abs(found.shares - best.shares).max() < 5e-3
    assert told == sorted(told)
    assert told[-1] == 1.0
    with pytest.raises(ConvergenceError, match="may be off by"):
        replace(search, tolerance=1e-9, maximum=21).shares(WAYS, LIGHT)
    rough = replace(search, tolerance=1e-9, maximum=21, accept=True).solve(WAYS, LIGHT)
    assert (rough.error > 1e-9).all()
    assert (rough.harmonics == 21).all()


def test_work_can_be_cancelled() -> None:
    def stop(share: float) -> None:
        raise CancelledError(str(share))

    with pytest.raises(CancelledError):
        GRATING.solve(WAYS, LIGHT, stop)


def test_nothing_asked_is_nothing_answered() -> None:
    assert GRATING.shares([], LIGHT).shape == (2, 2, 0)
    none = incidence(np.zeros((0, 2)))
    assert GRATING.shares(WAYS, none).shape == (0, len(WAYS))
    assert RigorousGrating(lambda *_: Stack(binary(1e-7))).shares(WAYS, none).shape == (0, 5)
