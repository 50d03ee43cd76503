# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every kind of recording wave: its gradient is that of its eikonal, and read-out gives it back."""

import itertools
import json
from pathlib import Path

import msgspec
import numpy as np
import pytest

from hoe_addon.core.ray_law import Status, diffract
from hoe_addon.core.recording import Recording
from hoe_addon.core.waves import Wave
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.waves import WAVES, WaveSpec

READ_OUT = 1e-12
"""Asked for; the ray law and the waves lose a few roundings of 1e-16 each."""

DERIVATIVE = 1e-7
"""Central differences over 3 um of waves with radii of 45 mm and more: 1e-9, and rounding."""

POINTS = 1000
STEP = 3e-6
WAVELENGTH = 532e-9
AXIS = (0.0, 0.0, 1.0)
DOCUMENTS = json.loads(
    (Path(__file__).parents[1] / "documents" / "waves.json").read_text(encoding="utf-8")
)
"""Waves of every kind that travel toward +z at a hologram of 20 mm in the plane z = 0."""


def wave(name: str) -> Wave:
    return wave_from(msgspec.convert(DOCUMENTS[name], WaveSpec))


def drawn(source: Wave, rng: np.random.Generator) -> np.ndarray:
    return rng.random((POINTS, source.draws))


@pytest.fixture
def points(rng: np.random.Generator) -> np.ndarray:
    return np.column_stack([rng.uniform(-0.01, 0.01, (POINTS, 2)), np.zeros(POINTS)])


def test_every_kind_is_here() -> None:
    kinds = {kind.__struct_config__.tag for kind in WAVES}
    assert kinds - {"system"} == {document["kind"] for document in DOCUMENTS.values()}


@pytest.mark.parametrize("name", DOCUMENTS)
def test_gradient_is_the_derivative_of_the_eikonal(
    name: str, points: np.ndarray, rng: np.random.Generator
) -> None:
    source = wave(name)
    draws = drawn(source, rng)
    # Off the plane, too; a place on a window's face could step into the window.
    places = points + np.array([0.0, 0.0, 1e-4])
    numeric = np.stack(
        [
            source.eikonal(places + step, draws) - source.eikonal(places - step, draws)
            for step in STEP * np.eye(3)
        ],
        axis=-1,
    ) / (2.0 * STEP)
    gradient = source.gradient(places, draws)
    np.testing.assert_allclose(gradient, numeric, rtol=0, atol=DERIVATIVE)
    np.testing.assert_allclose(np.linalg.norm(gradient, axis=1), source.index, rtol=1e-14)


@pytest.mark.parametrize(("name_o", "name_r"), list(itertools.product(DOCUMENTS, repeat=2)))
def test_read_out_gives_the_object_wave_and_order_minus_one_the_reverse(
    name_o: str, name_r: str, points: np.ndarray, rng: np.random.Generator
) -> None:
    wave_o, wave_r = wave(name_o), wave(name_r)
    recording = Recording(wave_o, wave_r, WAVELENGTH)
    draws = rng.random((POINTS, recording.draws))
    s_o = wave_o.gradient(points, draws[:, : wave_o.draws]) / wave_o.index
    s_r = wave_r.gradient(points, draws[:, wave_o.draws :]) / wave_r.index
    gradient = recording.gradient(points, draws)
    assert np.isfinite(gradient).all()
    for order, s_in, n_in, s_out, n_out in (
        (1, s_r, wave_r.index, s_o, wave_o.index),
        (-1, s_o, wave_o.index, s_r, wave_r.index),
    ):
        found, status = diffract(s_in, AXIS, gradient, order, 1.0, n_in, n_out, False)
        assert (status == Status.OK).all()
        np.testing.assert_allclose(found, s_out, rtol=0, atol=READ_OUT)


@pytest.mark.parametrize("name", [n for n, d in DOCUMENTS.items() if d.get("index", 1.0) == 1.0])
def test_read_out_of_a_reflection_hologram(
    name: str, points: np.ndarray, rng: np.random.Generator
) -> None:
    """The reference comes from the other side: the object wave is the reflected order."""
    wave_o = wave(name)
    wave_r = wave_from(msgspec.convert({"kind": "point", "position_mm": [5, 8, 90]}, WaveSpec))
    recording = Recording(wave_o, wave_r, WAVELENGTH)
    draws = drawn(wave_o, rng)
    s_o, s_r = wave_o.gradient(points, draws), wave_r.gradient(points)
    gradient = recording.gradient(points, draws)
    found, _ = diffract(s_r, AXIS, gradient, 1, 1.0, 1.0, 1.0, True)
    np.testing.assert_allclose(found, s_o, rtol=0, atol=READ_OUT)
    back, _ = diffract(s_o, AXIS, gradient, -1, 1.0, 1.0, 1.0, True)
    np.testing.assert_allclose(back, s_r, rtol=0, atol=READ_OUT)


def test_function_of_a_recording_is_that_of_its_gradient(
    points: np.ndarray, rng: np.random.Generator
) -> None:
    """Object and reference take their own numbers, in that order."""
    recording = Recording(wave("disc"), wave("mesh"), WAVELENGTH)
    assert recording.draws == 5
    draws = rng.random((POINTS, 5))
    numeric = np.stack(
        [
            recording.function(points + step, draws) - recording.function(points - step, draws)
            for step in STEP * np.eye(3)
        ],
        axis=-1,
    ) / (2.0 * STEP)
    gradient = recording.gradient(points, draws)
    np.testing.assert_allclose(gradient, numeric, rtol=0, atol=DERIVATIVE)


STAR_RAYS = 20_000
CELLS = 10
STAR_SIGMA = 4.5
"""Standard deviations of chi-square; a fixed seed, 1e-5 of others would fail."""


@pytest.mark.parametrize("role", ["object", "reference"])
def test_star_is_blurred_by_the_shape_of_the_source(role: str, rng: np.random.Generator) -> None:
    """A plane wave on one small region: its rays, taken back to the disc, cover it evenly."""
    disc, plane = wave("disc"), wave("plane")
    roles = (
        {"object": disc, "reference": plane}
        if role == "object"
        else {"object": plane, "reference": disc}
    )
    recording = Recording(**roles, wavelength=WAVELENGTH)
    points = np.column_stack([rng.uniform(-1e-4, 1e-4, (STAR_RAYS, 2)), np.zeros(STAR_RAYS)])
    gradient = recording.gradient(points, rng.random((STAR_RAYS, recording.draws)))
    order = 1 if role == "object" else -1
    travel = plane.gradient(points)
    found, _ = diffract(travel, AXIS, gradient, order, 1.0, 1.0, 1.0, False)
    shape = disc.shape
    normal = np.cross(shape.x, shape.y)
    away = np.array(shape.centre) - points
    source = points + found * (away @ normal / (found @ normal))[:, None] - np.array(shape.centre)
    a, b = (source @ np.array(axis) / np.dot(axis, axis) for axis in (shape.x, shape.y))
    squared = a**2 + b**2
    assert squared.max() < 1.0 + 1e-9
    counts, *_ = np.histogram2d(
        squared, np.arctan2(b, a), bins=CELLS, range=[[0, 1], [-np.pi, np.pi]]
    )
    expected = STAR_RAYS / CELLS**2
    chi_square = np.sum((counts - expected) ** 2) / expected
    freedom = CELLS**2 - 1
    assert abs(chi_square - freedom) < STAR_SIGMA * np.sqrt(2.0 * freedom)
