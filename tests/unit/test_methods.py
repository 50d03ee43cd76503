# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The published way to trace stays selectable; wavelengths are drawn as the settings say."""

import argparse

import numpy as np
import pytest

from hoe_addon.cli.picture_options import add_picture_options, assignments
from hoe_addon.core.colour import LUMINANCE_WEIGHTS
from hoe_addon.core.errors import SpecError
from hoe_addon.core.fixed_lines import fixed_lines
from hoe_addon.core.spectrum import display_primaries, illuminant, line
from hoe_addon.model.document import load_device
from hoe_addon.model.wavelengths import display_weights, samplings


def render_of(*options: str):
    parser = argparse.ArgumentParser()
    add_picture_options(parser)
    args = parser.parse_args(["two_hologram_ar", "--out", "out", *options])
    return load_device(args.device, assignments(args)).render


def test_method_sets_what_goes_together_and_options_of_their_own_win() -> None:
    published = render_of("--method", "published")
    assert published.wavelengths == "uniform"
    assert published.order_selection == "significance"
    assert published.effects == ("all",)
    assert render_of("--method", "published", "--effects", "+haze").effects == ("+haze",)
    assert render_of("--method", "guided") == render_of()


def test_guided_scene_keeps_three_distributions_and_published_one() -> None:
    spec = load_device("two_hologram_ar")
    spectra, weights = spec.display.spectra(), display_weights(spec.display)
    assert np.isclose(sum(weights), 1.0)
    assert weights[1] > weights[0] > weights[2]  # white is mostly green light
    guided = samplings(spec.render, spectra, weights)
    (uniform,) = samplings(render_of("--method", "published"), spectra, weights)
    assert len(guided) == 3
    at = np.array([400e-9, 500e-9, 650e-9])
    np.testing.assert_allclose(uniform.density(at), 1.0 / 400e-9, rtol=1e-9)
    daylight, emitters = guided[1:]
    # Red LED light, and a place between two primaries.
    assert emitters.density(625e-9) > 2.0 * daylight.density(625e-9)
    assert emitters.density(575e-9) < 0.5 * daylight.density(575e-9)


@pytest.mark.parametrize("count", [1, 3, 9])
def test_fixed_lines_keep_white_and_luminance(count: int) -> None:
    """The mean of the filter is white, that of filter and emission has the luminance 1."""
    lines = np.linspace(450e-9, 620e-9, count)
    used = fixed_lines(lines.tolist())
    tables = used.shader_tables((*display_primaries("led_rgb"), illuminant("D65")))
    mean = np.mean(0.5 * (tables.filter_rgb[1:] + tables.filter_rgb[:-1]), axis=0)
    np.testing.assert_allclose(mean, 1.0, rtol=1e-12)
    seen = used.mean_rgb(tables.emission)
    np.testing.assert_allclose(seen @ LUMINANCE_WEIGHTS, 1.0, rtol=1e-12)
    np.testing.assert_allclose(seen[3], 1.0, rtol=0.02)  # daylight; runs of nodes are not equal
    drawn = used.wavelength(np.linspace(0.0, 1.0, 10_001))
    on_a_line = np.isclose(drawn[:, None], lines, rtol=0.0, atol=1e-15).any(axis=1)
    assert on_a_line.mean() >= 1.0 - 1.1 * (count - 1) / 512


@pytest.mark.parametrize("lines", [[], [500e-9, 500e-9], [300e-9], [900e-9, 500e-9]])
def test_fixed_lines_refuse_what_is_no_line(lines: list[float]) -> None:
    with pytest.raises(SpecError, match="different wavelengths within 360-830 nm"):
        fixed_lines(lines)


def test_fixed_lines_refuse_an_unseen_emitter_and_have_no_density() -> None:
    used = fixed_lines([500e-9, 600e-9])
    with pytest.raises(SpecError, match="no visible power"):
        used.emission(line(1500e-9, 1e-9))
    with pytest.raises(SpecError, match="no density"):
        used.density(500e-9)
