# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour: the observer, the matrices and white points, beside colour-science."""

import colour as colour_science
import numpy as np
import pytest

from hoe_addon.core import colour, quadrature, spectrum
from hoe_addon.core.errors import SpecError

OBSERVER = "CIE 1931 2 Degree Standard Observer"
CMFS = colour_science.MSDS_CMFS[OBSERVER]
# Both sides interpolate the same doubles; only the unit's rounding differs.
ROUNDING = 1e-12
# BT.709 gives its white to four decimals, D65's own is (0.31272, 0.32903).
REC709_WHITE_DIGITS = 4e-4


def test_observer_matches_colour_science(rng: np.random.Generator) -> None:
    at_nm = rng.uniform(360.0, 830.0, 1000)
    expected = np.stack(
        [np.interp(at_nm, CMFS.wavelengths, CMFS.values[:, i]) for i in range(3)], axis=-1
    )
    assert colour.xyz_bar(at_nm / 1e9) == pytest.approx(expected, abs=ROUNDING * 1e3)
    assert np.array_equal(colour.xyz_bar(CMFS.wavelengths / 1e9), CMFS.values)


def test_observer_is_blind_outside() -> None:
    assert np.all(colour.xyz_bar([200e-9, 359.99e-9, 830.01e-9, 2e-6]) == 0.0)
    assert colour.xyz_bar(np.full((2, 4), 5e-7)).shape == (2, 4, 3)


def test_matrix_matches_colour_science() -> None:
    space = colour_science.RGB_COLOURSPACES["ITU-R BT.709"]
    derived = colour_science.normalised_primary_matrix(space.primaries, space.whitepoint)
    np.testing.assert_allclose(colour.LINEAR_REC709_TO_XYZ, derived, rtol=0, atol=ROUNDING)
    assert colour.XYZ_TO_LINEAR_REC709 @ derived == pytest.approx(np.eye(3), abs=ROUNDING)


def test_luminance_weights() -> None:
    assert np.sum(colour.LUMINANCE_WEIGHTS) == pytest.approx(1.0, abs=ROUNDING)
    # BT.709's own weights, four decimals.
    np.testing.assert_allclose(colour.LUMINANCE_WEIGHTS, [0.2126, 0.7152, 0.0722], atol=5e-5)


@pytest.mark.parametrize(
    ("name", "xy", "tolerance"),
    # CIE 015:2018, table of the standard illuminants, from sums at 5 nm: the integrals at 1 nm
    # differ in the fifth decimal. E is 1/3 by definition, which the rounded observer misses.
    [
        ("D65", (0.31272, 0.32903), 1.5e-5),
        ("A", (0.44758, 0.40745), 1.5e-5),
        ("E", (1 / 3, 1 / 3), 5e-5),
    ],
)
def test_white_points(name: str, xy: tuple[float, float], tolerance: float) -> None:
    white = colour.white_point(name)
    assert white[1] == 1.0
    assert white[:2] / white.sum() == pytest.approx(xy, abs=tolerance)


@pytest.mark.parametrize("name", ["D65", "A", "E"])
def test_xyz_matches_colour_science(name: str) -> None:
    own = spectrum.illuminant(name)
    nm = np.arange(360, 831)
    power = colour_science.SpectralDistribution(own(nm / 1e9), nm)
    expected = colour_science.colorimetry.msds_to_XYZ_integration(
        np.atleast_2d(power.values), CMFS, k=1, shape=CMFS.shape
    )[0]
    # A sum at 1 nm against the exact integral of the same straight lines.
    assert colour.xyz_of(own) == pytest.approx(expected, rel=2e-5)


def test_xyz_of_narrow_line_is_the_observer() -> None:
    # The width is far below the table's 1 nm, the line lies off its nodes.
    line = spectrum.line(532.3e-9, 1e-12)
    area_nm = np.trapezoid(line.power, line.wavelength) * 1e9
    assert colour.xyz_of(line) / area_nm == pytest.approx(colour.xyz_bar(532.3e-9), rel=1e-6)


def test_white_is_neutral() -> None:
    rgb = colour.XYZ_TO_LINEAR_REC709 @ colour.white_point("D65")
    assert rgb == pytest.approx(np.ones(3), abs=REC709_WHITE_DIGITS)


def test_rgb_bar_is_the_rotated_observer(rng: np.random.Generator) -> None:
    at = rng.uniform(360e-9, 830e-9, 50)
    back = colour.linear_rgb_bar(at) @ colour.LINEAR_REC709_TO_XYZ.T
    assert back == pytest.approx(colour.xyz_bar(at), abs=ROUNDING)


def test_uv_prime(rng: np.random.Generator) -> None:
    xyz = rng.uniform(0.1, 1.0, (20, 3))
    expected = colour_science.xy_to_Luv_uv(colour_science.XYZ_to_xy(xyz))
    assert colour.uv_prime(xyz) == pytest.approx(expected, abs=ROUNDING)
    assert np.all(np.isnan(colour.uv_prime(np.zeros(3))))


@pytest.mark.parametrize("name", spectrum.DISPLAY_PRIMARIES)
@pytest.mark.parametrize("white", ["D65", "E"])
def test_white_balance(name: str, white: str) -> None:
    primaries = spectrum.display_primaries(name)
    shares = colour.white_balance(primaries, white)
    parts = [colour.xyz_of(p) / colour.xyz_of(p)[1] for p in primaries]
    assert np.sum(shares) == pytest.approx(1.0, abs=ROUNDING)
    assert shares @ np.array(parts) == pytest.approx(colour.white_point(white), abs=ROUNDING)


def test_white_balance_refuses() -> None:
    def line(nm: float) -> spectrum.Spectrum:
        return spectrum.line(nm / 1e9, 1e-9, f"line {nm}")

    with pytest.raises(SpecError, match="must be 3, got 2"):
        colour.white_balance([line(465), line(532)])
    with pytest.raises(SpecError, match="line 900 has no visible power"):
        colour.white_balance([line(465), line(532), line(900)])
    with pytest.raises(SpecError, match="white D65 is outside their gamut"):
        colour.white_balance([line(625), line(532), line(560)])
    with pytest.raises(SpecError, match="three different colours"):
        colour.white_balance([line(625), line(532), line(532)])


def test_quadrature_is_exact_for_cubics(rng: np.random.Generator) -> None:
    edges = np.sort(rng.uniform(-1.0, 1.0, 6))
    points, weights = quadrature.gauss_points(edges)
    expected = (edges[-1] ** 4 - edges[0] ** 4) / 4.0
    assert np.sum(weights * points**3) == pytest.approx(expected, abs=ROUNDING)


def test_hat_integrals_sum_to_the_integral(rng: np.random.Generator) -> None:
    nodes = np.sort(rng.uniform(0.0, 1.0, 9))
    result = quadrature.hat_integrals(lambda x: (x**2)[..., None], nodes, np.array([]))
    assert np.sum(result) == pytest.approx((nodes[-1] ** 3 - nodes[0] ** 3) / 3.0, abs=ROUNDING)
    ones = quadrature.hat_integrals(lambda x: np.ones((*x.shape, 1)), nodes, np.array([0.5, 2.0]))
    assert ones[:, 0] == pytest.approx(quadrature.hat_areas(nodes), abs=ROUNDING)
