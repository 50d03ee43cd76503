# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Units and media: published indices, limits, messages."""

import json
from pathlib import Path

import numpy as np
import pytest

from hoe_addon.core import media, units
from hoe_addon.core.errors import SpecError

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "reference" / "media.json").read_text(encoding="utf-8")
)
# One unit of the last digit: half of it is the source's rounding, half is for its formula, which
# a maker fits to its own table.
DIGIT = 1.0
# Accuracy of the prism measurements behind the polymers' indices, as their authors give it.
POLYMER_ACCURACY = 1e-3


@pytest.mark.parametrize("name", REFERENCE["media"])
def test_index_at_spectral_lines(name: str) -> None:
    entry = REFERENCE["media"][name]
    tolerance = max(DIGIT * 10.0 ** -entry["digits"], POLYMER_ACCURACY * (entry["digits"] == 3))
    for line, expected in entry["index"].items():
        index = media.by_name(name).index(REFERENCE["lines_nm"][line] * units.NM)
        assert index == pytest.approx(expected, abs=tolerance), line


@pytest.mark.parametrize("name", [n for n, e in REFERENCE["media"].items() if "abbe" in e])
def test_abbe_number(name: str) -> None:
    entry = REFERENCE["media"][name]
    lines = REFERENCE["lines_nm"]
    f, d, c = (float(media.by_name(name).index(lines[x] * units.NM)) for x in "FdC")
    tolerance = DIGIT * 10.0 ** -entry["abbe_digits"]
    assert (d - 1.0) / (f - c) == pytest.approx(entry["abbe"], abs=tolerance)


def test_every_medium_but_air_has_reference() -> None:
    assert set(media.CATALOGUE) - set(REFERENCE["media"]) == {"air"}


def test_air_is_exactly_one(rng: np.random.Generator) -> None:
    assert np.all(media.by_name("air").index(rng.uniform(2e-7, 2e-5, 100)) == 1.0)


def test_constant_gives_the_number_back(rng: np.random.Generator) -> None:
    for value in rng.uniform(1.0, 4.0, 200):
        assert media.constant(value).index(532e-9) == value


def test_index_keeps_shape() -> None:
    glass = media.by_name("N-BK7")
    assert glass.index(532e-9).shape == ()
    assert glass.index(np.full((2, 3), 532e-9)).shape == (2, 3)


@pytest.mark.parametrize("name", media.CATALOGUE)
def test_normal_dispersion_in_the_visible(name: str) -> None:
    index = media.by_name(name).index(np.linspace(360e-9, 830e-9, 200))
    assert np.all(np.diff(index) < 0.0) or name == "air"
    assert np.all((index >= 1.0) & (index < 2.1))


@pytest.mark.parametrize("wavelength", [0.115e-6, 9.5e-6, 0.0, -5e-7, float("nan"), float("inf")])
def test_no_index_is_an_error(wavelength: float) -> None:
    with pytest.raises(SpecError, match=r"medium fused silica: .* nm"):
        media.by_name("fused silica").index(np.array([532e-9, wavelength]))


@pytest.mark.parametrize("index", [0.99, 0.0, -1.5, float("nan"), float("inf")])
def test_constant_refuses(index: float) -> None:
    with pytest.raises(SpecError, match="index: must be a finite number of at least 1"):
        media.constant(index)


def test_unknown_name_lists_the_known() -> None:
    with pytest.raises(SpecError, match=r"N-BK7.*got 'BK8'"):
        media.by_name("BK8")


def test_nm_to_m_is_the_nearest_double() -> None:
    for nm in range(200, 20001, 7):
        assert units.nm_to_m(float(nm)) == float(f"{nm}e-9")


def test_units_round_trip(rng: np.random.Generator) -> None:
    values = rng.uniform(0.1, 2e4, 1000)
    # Two roundings, one each way.
    np.testing.assert_allclose(units.m_to_nm(units.nm_to_m(values)), values, rtol=3e-16)
    np.testing.assert_allclose(units.m_to_mm(units.mm_to_m(values)), values, rtol=3e-16)
    assert units.mm_to_m(1.0) == units.MM
    assert units.m_to_nm(units.UM) == pytest.approx(1000.0)
