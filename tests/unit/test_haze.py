# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Haze: the published share of roughness, the lobe, its symmetry, and what documents may say."""

from typing import Any

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.haze import rough_share, scattered
from hoe_addon.model.document import hologram_from

DRAWS = 200_000
SIGMAS = 5.0
"""Standard deviations of a mean that a test with a fixed seed may be off."""

ROUNDING = 1e-12


def test_share_is_the_published_one() -> None:
    """Bennett and Porteus (1961): 1 - exp(-(4 pi sigma / lambda)^2) at normal incidence in air."""
    found = rough_share(10e-9, 500e-9, 1.0, 1.0, reflected=True)
    assert found == pytest.approx(1.0 - np.exp(-((4.0 * np.pi / 50.0) ** 2)), rel=ROUNDING)
    # Transmitted, the phase of a height is that of the difference of the indices.
    found = rough_share(10e-9, 500e-9, 1.0, 1.5, reflected=False)
    assert found == pytest.approx(1.0 - np.exp(-((2.0 * np.pi * 0.5 / 50.0) ** 2)), rel=ROUNDING)


def test_share_keeps_its_digits_and_limits() -> None:
    phase = 4.0 * np.pi * 1e-12 / 500e-9
    assert rough_share(1e-12, 500e-9, 1.0, 1.0, reflected=True) == pytest.approx(phase**2, rel=1e-9)
    assert rough_share(0.0, 500e-9, 1.0, 1.0, reflected=True) == 0.0
    assert rough_share(1e-5, 500e-9, 1.0, 1.0, reflected=True) == 1.0
    assert rough_share(1e-8, 500e-9, 1.2, 1.2, reflected=False) == 0.0


def test_share_of_a_ray_and_its_reverse_are_alike() -> None:
    for reflected in (False, True):
        there = rough_share(2e-8, 600e-9, 0.7, 1.4, reflected=reflected)
        back = rough_share(2e-8, 600e-9, 1.4, 0.7, reflected=reflected)
        assert there == back > 0.0


@pytest.mark.parametrize("normal", [(0.0, 0.0, 1.0), (0.6, 0.0, -0.8), (0.99, 0.1, 0.1)])
def test_lobe_has_the_width_that_is_asked_for(
    rng: np.random.Generator, normal: tuple[float, float, float]
) -> None:
    """Moments of the two cosines; directions stay unit vectors on their own side."""
    upward = np.array(normal) / np.linalg.norm(normal)
    sideways = np.cross(upward, (0.0, 1.0, 0.0))
    order = 0.9 * upward + np.sqrt(1.0 - 0.81) * sideways / np.linalg.norm(sideways)
    sine = 0.02
    found = scattered(np.tile(order, (DRAWS, 1)), upward, sine, 1.0, rng.random((DRAWS, 3)))
    assert np.max(np.abs(np.linalg.norm(found, axis=1) - 1.0)) < ROUNDING
    assert np.all(found @ upward > 0.0)
    x = np.cross(upward, order)
    x /= np.linalg.norm(x)
    for axis in (x, np.cross(upward, x)):
        offset = (found - order) @ axis
        assert abs(offset.mean()) < SIGMAS * sine / np.sqrt(DRAWS)
        assert abs(offset.std() / sine - 1.0) < SIGMAS / np.sqrt(2.0 * DRAWS)


def test_share_of_the_rays_is_scattered(rng: np.random.Generator) -> None:
    order = np.tile((0.0, 0.6, -0.8), (DRAWS, 1))
    found = scattered(order, (0.0, 0.0, 1.0), 0.01, 0.25, rng.random((DRAWS, 3)))
    moved = np.any(found != order, axis=1)
    assert abs(moved.mean() - 0.25) < SIGMAS * np.sqrt(0.25 * 0.75 / DRAWS)
    assert np.all(found[:, 2] < 0.0)


def test_light_that_would_be_evanescent_keeps_its_direction(rng: np.random.Generator) -> None:
    cosine = 0.05
    order = np.tile((np.sqrt(1.0 - cosine**2), 0.0, cosine), (DRAWS, 1))
    found = scattered(order, (0.0, 0.0, 1.0), 0.1, 1.0, rng.random((DRAWS, 3)))
    kept = np.all(found == order, axis=1)
    assert np.all(np.isfinite(found))
    assert 0.3 < kept.mean() < 0.7


def test_light_is_scattered_as_much_one_way_as_the_other(rng: np.random.Generator) -> None:
    """Between two small sets of directions, one near grazing: equal currents (reciprocity)."""
    ends = np.array(((0.55, 0.0), (0.75, 0.1)))
    currents: list[float] = []
    for start, end in (ends, ends[::-1]):
        order = np.array((*start, np.sqrt(1.0 - start @ start)))
        found = scattered(np.tile(order, (DRAWS, 1)), (0, 0, 1), 0.15, 1.0, rng.random((DRAWS, 3)))
        currents.append(np.mean(np.max(np.abs(found[:, :2] - end), axis=1) < 0.05))
    assert min(currents) > 0.01
    spread = np.sqrt(sum(currents) / DRAWS)
    assert abs(currents[0] - currents[1]) < SIGMAS * spread


def _hologram(haze: Any) -> Any:
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {},
            "recording": {
                "wavelength_nm": 532,
                "object": {"kind": "plane", "direction": [0.3, 0.1, 0.949]},
                "reference": {"kind": "plane", "direction": [0, 0, 1]},
            },
            "efficiency": {"model": "constant", "table": {"T": {"1": 1.0}}, "haze": haze},
            "orders": [1],
        }
    )


def test_documents_say_share_or_roughness() -> None:
    assert _hologram(None).efficiency.haze is None
    assert _hologram({"share": 0.1, "width_deg": 2}).efficiency.haze.share == 0.1
    assert _hologram({"roughness_nm": 5, "width_deg": 2}).efficiency.haze.roughness_nm == 5.0


@pytest.mark.parametrize(
    ("haze", "words"),
    [
        ({"width_deg": 2}, "efficiency.haze.share: must be given, or roughness_nm instead"),
        ({"share": 0.1, "roughness_nm": 5, "width_deg": 2}, "roughness_nm: must be left out"),
        ({"share": 1.1, "width_deg": 2}, "efficiency.haze.share: must be at most 1, got 1.1"),
        ({"share": -0.1, "width_deg": 2}, "efficiency.haze.share: must be at least 0"),
        ({"share": 0.1, "width_deg": 0}, "efficiency.haze.width_deg: must be above 0"),
        ({"share": 0.1, "width_deg": 31}, "efficiency.haze.width_deg: must be at most 30"),
        ({"roughness_nm": -1, "width_deg": 2}, "efficiency.haze.roughness_nm: must be at least 0"),
        ({"share": 0.1}, "width_deg"),
    ],
)
def test_bad_haze_is_told(haze: dict[str, Any], words: str) -> None:
    with pytest.raises(SpecError, match=r"^[^\n]*$") as caught:
        _hologram(haze)
    assert words in str(caught.value)
