# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Two-wave theory: published values, energy, closed forms, the equations themselves, extremes."""

import json
from pathlib import Path

import mpmath
import numpy as np
import pytest

from hoe_addon.core.efficiency import kogelnik

REFERENCE = json.loads(
    (Path(__file__).parents[1] / "reference" / "kogelnik.json").read_text(encoding="utf-8")
)
PRINTED = 1e-5
"""Five printed digits; half a digit would do, were the Bragg angle not rounded too."""
EXACT = 1e-12
"""Some thousand roundings of double precision: phases of some hundred rad lose three digits."""
COUNT = 4000


def shares(
    angle: float, grating: np.ndarray, thickness: float, wavelength: float, *, tm: bool
) -> tuple[float, float]:
    index = REFERENCE["index"]
    beta = 2.0 * np.pi * index / wavelength
    rho = beta * np.array([np.sin(angle), 0.0, np.cos(angle)])
    sigma = rho + grating
    coupled = kogelnik.coupling(wavelength, REFERENCE["modulation"])
    if tm:
        coupled = coupled * kogelnik.polarization_factor(rho, sigma)
    theta = kogelnik.dephasing(rho, grating, beta)
    found = kogelnik.efficiencies(rho[2] / beta, sigma[2] / beta, theta, coupled, 0.0, thickness)
    return float(found[0]), float(found[1])


@pytest.mark.parametrize("row", REFERENCE["transmission"]["rows"])
def test_published_transmission(row: dict[str, float]) -> None:
    case = REFERENCE["transmission"]
    angle = np.radians(case["bragg_deg"] + row["off_bragg_deg"])
    grating = np.array([-2.0 * np.pi / (case["period_um"] * 1e-6), 0.0, 0.0])
    for name in ("te", "tm"):
        wave, rest = shares(angle, grating, case["thickness_um"] * 1e-6, 532e-9, tm=name == "tm")
        assert wave == pytest.approx(row[name], abs=PRINTED)
        assert wave + rest == pytest.approx(1.0, abs=EXACT)


@pytest.mark.parametrize("row", REFERENCE["reflection"]["rows"])
def test_published_reflection(row: dict[str, float]) -> None:
    case = REFERENCE["reflection"]
    period = REFERENCE["recorded_nm"] * 1e-9 / (2.0 * REFERENCE["index"])
    grating = np.array([0.0, 0.0, -2.0 * np.pi / period])
    for tm in (False, True):
        wave, rest = shares(
            0.0, grating, case["thickness_um"] * 1e-6, row["wavelength_nm"] * 1e-9, tm=tm
        )
        assert wave == pytest.approx(row["te"], abs=PRINTED)
        assert wave + rest == pytest.approx(1.0, abs=EXACT)


def random_layers(rng: np.random.Generator, sign: float) -> dict[str, np.ndarray]:
    """Layers from thin to very thick, from no to strong coupling, on and far off Bragg."""
    return {
        "cos_light": rng.uniform(0.05, 1.0, COUNT),
        "cos_diffracted": sign * rng.uniform(0.02, 1.3, COUNT),
        "mismatch": rng.choice([0.0, 1.0, -1.0], COUNT) * 10.0 ** rng.uniform(2.0, 6.5, COUNT),
        "coupled": rng.choice([0.0, 1.0], COUNT, p=[0.1, 0.9]) * 10.0 ** rng.uniform(2, 6, COUNT),
        "thickness": 10.0 ** rng.uniform(-7.0, -4.0, COUNT),
    }


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_without_loss_nothing_is_lost(sign: float, rng: np.random.Generator) -> None:
    wave, rest = kogelnik.efficiencies(**random_layers(rng, sign), absorption=0.0)
    assert wave.max() > 0.99
    np.testing.assert_allclose(wave + rest, 1.0, rtol=0.0, atol=EXACT)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_closed_forms_without_loss(sign: float, rng: np.random.Generator) -> None:
    """In nu and xi, as the paper writes them: eq. (43), and its like for reflection."""
    layer = random_layers(rng, sign)
    wave, _ = kogelnik.efficiencies(**layer, absorption=0.0)
    c_r, c_s = layer["cos_light"], layer["cos_diffracted"]
    nu = layer["coupled"] * layer["thickness"] / np.sqrt(c_r * np.abs(c_s))
    xi = layer["mismatch"] * layer["thickness"] / (2.0 * c_s)
    known = nu > 0.0
    nu, xi = nu[known], xi[known]
    if sign > 0.0:
        expected = np.sin(np.hypot(nu, xi)) ** 2 / (1.0 + (xi / nu) ** 2)
    else:
        root = np.sqrt((nu - xi) * (nu + xi) + 0j)
        # Beyond 300 the share is 1 anyway.
        sine = np.sinh(np.minimum(root.real, 300.0) + 1j * root.imag) ** 2
        expected = 1.0 / (1.0 + ((1.0 - (xi / nu) ** 2) / sine).real)
    np.testing.assert_allclose(wave[known], expected, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_absorption_takes_and_never_gives(sign: float, rng: np.random.Generator) -> None:
    layer = random_layers(rng, sign)
    loss = 10.0 ** rng.uniform(1.0, 5.0, COUNT)
    layer["coupled"] = layer["coupled"] + 0.5j * loss * rng.uniform(0.0, 1.0, COUNT)
    wave, rest = kogelnik.efficiencies(**layer, absorption=loss)
    assert (wave >= 0.0).all()
    assert (rest >= 0.0).all()
    # Off Bragg in K-vector closure |c_S| may exceed 1, which two-wave theory keeps passive.
    assert (wave + rest <= 1.0 + EXACT).all()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_amplitudes_solve_the_coupled_equations(sign: float, rng: np.random.Generator) -> None:
    """Eqs. (21) and (22) by the exponential of their matrix to 30 digits."""
    for _ in range(40):
        c_r, c_s = rng.uniform(0.2, 1.0), sign * rng.uniform(0.2, 1.0)
        depth, theta = 1e-5, rng.normal() * 3e5
        loss = rng.uniform(0.0, 3e4)
        kappa = rng.uniform(0.0, 3e5) + 0.5j * loss * rng.uniform()
        with mpmath.workdps(30):
            matrix = mpmath.matrix(
                [
                    [-loss / c_r, 1j * kappa / c_r],
                    [1j * kappa / c_s, -(loss - 1j * theta) / c_s],
                ]
            )
            grown = mpmath.expm(matrix * depth)
            start = mpmath.mpc(0) if sign > 0.0 else -grown[1, 0] / grown[1, 1]
            through = grown[0, 0] + grown[0, 1] * start
            diffracted = grown[1, 0] if sign > 0.0 else start
        found = kogelnik.amplitudes(c_r, c_s, theta, kappa, loss, depth)
        np.testing.assert_allclose(found, [complex(through), complex(diffracted)], atol=1e-12)


def test_pure_absorption_gratings_reach_the_published_limits() -> None:
    """Kogelnik's limits for the deepest modulation, alpha_1 = alpha: 3.7 % and 7.2 %."""
    depth = 1e-5
    loss = np.linspace(0.0, 40.0, 40001)[1:] / depth
    coupled = kogelnik.coupling(532e-9, 0.0, loss)
    passed, _ = kogelnik.efficiencies(1.0, 1.0, 0.0, coupled, loss, depth)
    back, _ = kogelnik.efficiencies(1.0, -1.0, 0.0, coupled, loss, depth)
    assert passed.max() == pytest.approx(1.0 / 27.0, abs=1e-8)
    assert loss[passed.argmax()] * depth == pytest.approx(np.log(3.0), abs=1e-3)
    assert back[-1] == pytest.approx((2.0 - np.sqrt(3.0)) ** 2, abs=1e-12)


@pytest.mark.filterwarnings("error")
def test_extremes_stay_finite() -> None:
    cosines = np.array([1.0, 1e-3, 1e-9, 0.0])
    slants = np.array([1.0, 1e-9, 0.0, -1e-9, -1.0])
    values = np.array([0.0, 1e-30, 1.0, 1e5, 1e9])
    axes = np.meshgrid(cosines, slants, values, values, values, [0.0, 1e-9, 1e-3, 1.0])
    for wave in (*kogelnik.efficiencies(*axes), *kogelnik.amplitudes(*axes)):
        assert np.isfinite(wave).all()
    strong = kogelnik.efficiencies(1.0, -1.0, 0.0, 1e9, 0.0, 1.0)
    assert [float(share) for share in strong] == [1.0, 0.0]


def test_continuous_through_no_coupling_and_the_band_edge() -> None:
    """Where cosh and sinh change into cos and sin nothing jumps."""
    steps = np.linspace(-1e-6, 1e-6, 2001)
    edge = 2e5 * (1.0 + steps)
    wave, rest = kogelnik.efficiencies(1.0, -1.0, edge, 1e5, 0.0, 2e-5)
    assert wave[1000] == pytest.approx(4.0 / 5.0, abs=1e-12)  # nu^2 / (1 + nu^2), nu = 2
    assert np.abs(np.diff(wave, 2)).max() < 1e-13
    np.testing.assert_allclose(wave + rest, 1.0, atol=EXACT)
    weak, _ = kogelnik.efficiencies(1.0, [1.0, -1.0], 0.0, 1e-3, 0.0, 1e-5)
    np.testing.assert_allclose(weak, 1e-16, rtol=1e-12)


def test_any_shape_and_nan() -> None:
    wave, rest = kogelnik.efficiencies(1.0, np.full((2, 3, 1), -1.0), 0.0, 1e5, 0.0, 1e-5)
    assert wave.shape == rest.shape == (2, 3, 1)
    assert np.isnan(kogelnik.efficiencies(1.0, 1.0, np.nan, 1e5, 0.0, 1e-5)).all()
