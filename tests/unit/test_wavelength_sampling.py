# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelength sampling: distribution, mean of the filter, luminance and colour of emitters."""

import numpy as np
import pytest

from hoe_addon.core import colour, spectrum
from hoe_addon.core import wavelength_sampling as sampling
from hoe_addon.core.errors import SpecError

ROUNDING = 1e-12
# What the eye cannot tell: a just noticeable difference is about 4e-3.
COLOUR_ERROR = 1e-3
# Measured below 8e-5 for primaries that the sampling knows; twice that, so that a change shows.
KNOWN_COLOUR_ERROR = 1.6e-4
# Stated for single lines in the render.
LINE_ERROR = 0.01
# Measured 1.2e-3 in blue, which has little luminance for its colour; half a step of 8 bits is 2e-3.
WHITE_ERROR = 2e-3
LINES_NM = (460.0, 532.0, 590.0, 630.0)
SETS = tuple(spectrum.DISPLAY_PRIMARIES)


def chromaticity_error(rgb: np.ndarray, made: spectrum.Spectrum) -> float:
    """Distance in u'v' between a rendered colour and that of the spectrum."""
    rendered = colour.uv_prime(colour.LINEAR_REC709_TO_XYZ @ rgb)
    return float(np.linalg.norm(rendered - colour.uv_prime(colour.xyz_of(made))))


def dense_mean(tables: sampling.SpectralTables, values: np.ndarray) -> np.ndarray:
    """Mean over t of filter times values, looked up in the way of a shader, at even t."""
    count = 400 * (tables.wavelength_nm.size - 1)
    t = (np.arange(count) + 0.5) / count
    nodes = np.linspace(0.0, 1.0, tables.wavelength_nm.size)
    look_up = [np.interp(t, nodes, tables.filter_rgb[:, i]) for i in range(3)]
    return np.mean(np.stack(look_up, axis=-1) * np.interp(t, nodes, values)[:, None], axis=0)


@pytest.fixture(params=[*SETS, "daylight", "uniform"])
def made(request: pytest.FixtureRequest) -> sampling.WavelengthSampling:
    if request.param == "daylight":
        return sampling.by_significance()
    if request.param == "uniform":
        return sampling.uniform(380e-9, 780e-9)
    return sampling.by_significance(spectrum.display_primaries(request.param))


def test_density_is_that_of_the_drawn_wavelengths(made, rng: np.random.Generator) -> None:
    nodes = made.wavelength_nodes
    edges = np.linspace(nodes[0], nodes[-1], 41)
    fine = np.union1d(edges, nodes)
    middle = 0.5 * (fine[1:] + fine[:-1])
    mass = made.density(middle) * np.diff(fine)
    assert np.sum(mass) == pytest.approx(1.0, abs=ROUNDING)
    expected = np.histogram(middle, edges, weights=mass)[0]
    count = 100_000
    drawn = np.histogram(made.wavelength(rng.random(count)), edges)[0]
    # Five standard deviations of a binomial count, and one for the emptiest bins.
    assert np.all(np.abs(drawn - count * expected) <= 5.0 * np.sqrt(count * expected) + 1.0)


def test_wavelength_at_nodes(made) -> None:
    t = np.arange(made.cells + 1) / made.cells
    assert made.wavelength(t) == pytest.approx(made.wavelength_nodes, rel=ROUNDING)
    assert made.wavelength([-1.0, 2.0]) == pytest.approx(made.wavelength_nodes[[0, -1]])
    assert np.all(made.density([100e-9, 2e-6]) == 0.0)


def test_white_is_unchanged(made) -> None:
    w = made.filter_rgb
    assert np.mean(0.5 * (w[1:] + w[:-1]), axis=0) == pytest.approx(np.ones(3), abs=ROUNDING)
    assert made.mean_rgb(np.ones(made.cells + 1)) == pytest.approx(np.ones(3), abs=ROUNDING)


@pytest.mark.parametrize("name", SETS)
@pytest.mark.parametrize("cells", [256, 512])
def test_known_primaries_have_their_luminance_and_colour(name: str, cells: int) -> None:
    primaries = spectrum.display_primaries(name)
    tables_of = sampling.by_significance(primaries, cells=cells)
    limit = KNOWN_COLOUR_ERROR if cells == 512 else COLOUR_ERROR
    for primary in primaries:
        rgb = tables_of.mean_rgb(tables_of.emission(primary))
        assert rgb @ colour.LUMINANCE_WEIGHTS == pytest.approx(1.0, abs=ROUNDING)
        assert chromaticity_error(rgb, primary) < limit


def test_illuminants_have_their_colour(made) -> None:
    for name in ("D65", "A", "E"):
        light = spectrum.illuminant(name)
        assert chromaticity_error(made.mean_rgb(made.emission(light)), light) < KNOWN_COLOUR_ERROR


@pytest.mark.parametrize("nm", LINES_NM)
@pytest.mark.parametrize("fwhm", [1e-9, 1e-11])
def test_lines_have_their_colour_known_or_not(made, nm: float, fwhm: float) -> None:
    line = spectrum.line(nm / 1e9, fwhm)
    expected = colour.linear_rgb_bar(nm / 1e9) / colour.xyz_bar(nm / 1e9)[1]
    for used in (made, sampling.by_significance([line])):
        rgb = used.mean_rgb(used.emission(line))
        assert rgb == pytest.approx(expected, abs=LINE_ERROR * np.max(np.abs(expected)))
        assert chromaticity_error(rgb, line) < COLOUR_ERROR


def test_tables_as_a_shader_reads_them() -> None:
    primaries = spectrum.display_primaries("led_rgb")
    used = sampling.by_significance(primaries)
    tables = used.shader_tables(primaries)
    assert tables.wavelength_nm.shape == (513,)
    assert tables.filter_rgb.shape == (513, 3)
    assert tables.emission.shape == (3, 513)
    assert np.all(tables.emission >= 0.0)
    assert used.shader_tables().emission.shape == (0, 513)
    for row, primary in zip(tables.emission, primaries, strict=True):
        # The midpoint rule with 400 points in a cell.
        assert dense_mean(tables, row) == pytest.approx(
            used.mean_rgb(used.emission(primary)), abs=1e-5
        )


def test_balanced_primaries_make_white() -> None:
    for name in SETS:
        primaries = spectrum.display_primaries(name)
        used = sampling.by_significance(primaries)
        emission = colour.white_balance(primaries) @ used.shader_tables(primaries).emission
        assert used.mean_rgb(emission) == pytest.approx(np.ones(3), abs=WHITE_ERROR)


def test_lines_draw_most_samples() -> None:
    """Half of the samples are for three lasers, less what rounds off the density beside them."""
    lasers = spectrum.display_primaries("laser_rgb")
    t = np.linspace(0.0, 1.0, 10_001)
    drawn = sampling.by_significance(lasers).wavelength(t)
    near = np.any([np.abs(drawn - nm / 1e9) < 1e-9 for nm in (465, 532, 625)], axis=0)
    assert np.mean(near) > 0.4


def test_cells_change_width_gently(made) -> None:
    width = np.diff(made.wavelength_nodes)
    assert np.max(np.abs(np.diff(np.log(width)))) < np.log(1.4)
    span = made.wavelength_nodes[-1] - made.wavelength_nodes[0]
    # The widest wanted cell is 8 mean cells; the normalisation may only widen it a little.
    assert np.max(width) < 10.0 * span / made.cells


def test_few_cells_still_conserve_white_and_luminance() -> None:
    lasers = spectrum.display_primaries("laser_rgb")
    used = sampling.by_significance(lasers, cells=4)
    assert used.mean_rgb(np.ones(5)) == pytest.approx(np.ones(3), abs=ROUNDING)
    for laser in lasers:
        luminance = used.mean_rgb(used.emission(laser)) @ colour.LUMINANCE_WEIGHTS
        assert luminance == pytest.approx(1.0, abs=ROUNDING)


def test_spectrum_that_is_partly_invisible() -> None:
    broad = spectrum.tabulated([200e-9, 2000e-9], [1.0, 1.0])
    used = sampling.by_significance([broad])
    assert chromaticity_error(used.mean_rgb(used.emission(broad)), broad) < COLOUR_ERROR


@pytest.mark.parametrize("nm", [300.0, 900.0])
def test_invisible_spectrum(nm: float) -> None:
    line = spectrum.line(nm / 1e9, 1e-9, "pump")
    with pytest.raises(SpecError, match="pump: has no visible power"):
        sampling.by_significance().emission(line)
    with pytest.raises(SpecError, match="pump: has no visible power"):
        sampling.by_significance([line])


def test_black_spectrum() -> None:
    black = spectrum.tabulated([400e-9, 700e-9], [0.0, 0.0], "off")
    with pytest.raises(SpecError, match="off: has no visible power"):
        sampling.by_significance().emission(black)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: sampling.uniform(500e-9, 600e-9), "must reach from 400 to 700 nm"),
        (lambda: sampling.uniform(300e-9, 800e-9), "stay within 360-830 nm"),
        (lambda: sampling.uniform(380e-9, 780e-9, 0), "cells: must be at least 1"),
        (lambda: sampling.uniform(float("nan"), 780e-9), "sampling.wavelength"),
        (lambda: sampling.by_significance(span=(780e-9, 380e-9)), "sampling.wavelength"),
        (lambda: sampling.by_significance(floor=0.0), "floor: must be above 0"),
        (lambda: sampling.by_significance(floor=1.1), "floor"),
        (lambda: sampling.by_significance(cells=0), "cells"),
        (
            lambda: sampling.WavelengthSampling(np.array([380e-9, 780e-9, 600e-9])),
            "nodes that increase",
        ),
    ],
)
def test_bad_input(make, message: str) -> None:
    with pytest.raises(SpecError, match=message):
        make()
