# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A kinoform takes the colour out of a lens: exact rays near the axis against closed forms.

References:
    T. Stone, N. George (1988), "Hybrid diffractive-refractive lenses and achromats", Appl. Opt.
    27(14), 2960-2971, doi:10.1364/AO.27.002960: a diffractive lens has the power
    lambda / (lambda_0 f) and so the Abbe number lambda_d / (lambda_F - lambda_C).
"""

import numpy as np
import pytest
from msgspec.structs import replace

from hoe_addon.core.media import by_name
from hoe_addon.model.document import load_device
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_lens import LensElement
from hoe_addon.model.scene_lens_walk import focal_length_mm

F_NM, D_NM, C_NM = 486.13, 587.56, 656.27
LINES_NM = np.array((F_NM, D_NM, C_NM))
ABBE_OF_DIFFRACTION = D_NM / (F_NM - C_NM)
ORDERS = {"back": 1}

NEAR_AXIS = 2e-6
"""The rays run at 0.04 mm: spherical aberration is of the order of (0.04 / 54)^2 = 5e-7."""


def lens(name: str) -> LensElement:
    scene = load_device("diffractive_achromat")
    assert isinstance(scene, SceneSpec)
    found = scene.element(name)
    assert isinstance(found, LensElement)
    return found


def glass_power(of: LensElement) -> np.ndarray:
    """Power of the curved front, per mm, at the three lines."""
    assert of.front.radius_mm is not None
    index = by_name(str(of.medium)).index(LINES_NM * 1e-9)
    return (index - 1.0) / -of.front.radius_mm


def kinoform_power(of: LensElement) -> np.ndarray:
    """Power of the kinoform, per mm: V = -r^2 / (2 f), and the power goes as the wavelength."""
    assert of.back.hologram is not None
    function = of.back.hologram.characteristic
    (square,) = function.coefficients
    return -2.0 * square * LINES_NM / function.wavelength_nm


def test_plain_lens_has_the_focal_length_of_its_curved_face() -> None:
    plain = lens("plain lens")
    assert focal_length_mm(plain, LINES_NM) == pytest.approx(1 / glass_power(plain), rel=NEAR_AXIS)


def test_plain_lens_has_the_colour_of_its_glass() -> None:
    """(phi_F - phi_C) / phi_d = 1 / V, with the maker's Abbe number of N-BK7."""
    power = 1.0 / focal_length_mm(lens("plain lens"), LINES_NM)
    assert power[1] / (power[0] - power[2]) == pytest.approx(64.17, abs=0.01)


def test_kinoform_alone_has_the_abbe_number_of_diffraction() -> None:
    hybrid = lens("achromat lens")
    flat = replace(hybrid, front=replace(hybrid.front, radius_mm=None), medium="air")
    power = 1.0 / focal_length_mm(flat, LINES_NM, ORDERS)
    assert power == pytest.approx(kinoform_power(hybrid), rel=NEAR_AXIS)
    assert abs(ABBE_OF_DIFFRACTION + 3.453) < 5e-4
    assert power[1] / (power[0] - power[2]) == pytest.approx(ABBE_OF_DIFFRACTION, abs=5e-5)


def test_both_together_have_the_focal_lengths_of_two_thin_powers_apart() -> None:
    hybrid = lens("achromat lens")
    glass, kinoform = glass_power(hybrid), kinoform_power(hybrid)
    apart = hybrid.thickness_mm / by_name(str(hybrid.medium)).index(LINES_NM * 1e-9)
    closed = 1.0 / (glass + kinoform - glass * kinoform * apart)
    assert focal_length_mm(hybrid, LINES_NM, ORDERS) == pytest.approx(closed, rel=NEAR_AXIS)


def test_the_kinoform_brings_both_ends_of_the_spectrum_together() -> None:
    plain = focal_length_mm(lens("plain lens"), LINES_NM)
    mended = focal_length_mm(lens("achromat lens"), LINES_NM, ORDERS)
    assert plain[1] == pytest.approx(100.0, rel=1e-5)
    assert mended[1] == pytest.approx(100.0, rel=1e-5)
    assert plain[2] - plain[0] == pytest.approx(100.0 / 64.17, rel=0.01)
    # The radius has four decimals and the coefficient seven digits.
    assert abs(mended[2] - mended[0]) < 1e-4
    # What is left: a secondary spectrum ten times smaller, of the other sign than glass pairs have.
    assert mended[1] - mended[0] == pytest.approx(0.142, abs=0.001)


def test_without_the_kinoform_the_colour_is_back() -> None:
    hybrid = lens("achromat lens")
    straight = focal_length_mm(hybrid, LINES_NM, {"back": 0})
    assert straight[2] - straight[0] > 1.5


def test_share_of_the_kinoform_follows_from_the_two_abbe_numbers() -> None:
    """For thin lenses in contact it is V_d / (V_d - V_glass); the thickness adds 4 % to it."""
    hybrid = lens("achromat lens")
    share = kinoform_power(hybrid)[1] * 100.0
    thin = ABBE_OF_DIFFRACTION / (ABBE_OF_DIFFRACTION - 64.17)
    assert thin == pytest.approx(0.0511, abs=1e-4)
    assert share == pytest.approx(thin, rel=0.05)
