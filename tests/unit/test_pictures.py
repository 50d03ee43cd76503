# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Built-in pictures: shapes and ranges, and angles that can be measured on them."""

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.device_parts import BUILT_IN_IMAGES
from hoe_addon.shading.canvas import Canvas
from hoe_addon.shading.pictures import FIELD_DEG, built_in, dot_centres

CENTROID_PIXELS = 0.02
"""A dot is meant for measuring angles well below a pixel."""

FLOAT32 = 1e-6

SIZES = [(960, 540), (320, 180), (641, 363), (1280, 1024)]


def _place(angle_deg: float, field_deg: float, pixels: int) -> float:
    """Pixel coordinate, from the left edge, of an angle on a display in a focal plane."""
    fraction = np.tan(np.radians(angle_deg)) / np.tan(np.radians(field_deg / 2.0))
    return 0.5 * pixels * (1.0 + fraction)


@pytest.mark.parametrize("name", BUILT_IN_IMAGES)
@pytest.mark.parametrize(("width", "height"), [*SIZES, (16, 9), (1, 1)])
def test_shape_and_range(name: str, width: int, height: int) -> None:
    picture = built_in(name, width, height)
    assert picture.shape == (height, width, 3)
    assert picture.dtype == np.float32
    assert np.all((picture >= 0.0) & (picture <= 1.0))
    assert picture.max() > 0.0


@pytest.mark.parametrize("name", BUILT_IN_IMAGES)
def test_same_arguments_same_pixels(name: str) -> None:
    assert built_in(name, 320, 180).tobytes() == built_in(name, 320, 180).tobytes()


def test_white_is_full_drive_everywhere() -> None:
    assert np.all(built_in("white", 7, 5) == 1.0)


@pytest.mark.parametrize("name", ["", "Chart", "photo.png"])
def test_unknown_name_is_told_the_names(name: str) -> None:
    with pytest.raises(
        SpecError, match=r"image: must be one of chart, white, dots, bars, reticle, speed, got"
    ):
        built_in(name, 16, 9)


def test_dot_centres_are_a_symmetric_grid() -> None:
    centres = dot_centres()
    assert centres.shape == (45, 2)
    assert centres[0] == pytest.approx((-0.45, 0.45))
    assert centres[8] == pytest.approx((0.45, 0.45))
    np.testing.assert_allclose(centres, -centres[::-1], atol=1e-15)


@pytest.mark.parametrize(("width", "height"), SIZES)
def test_dots_lie_where_they_are_said_to_lie(width: int, height: int) -> None:
    picture = built_in("dots", width, height)
    assert np.all(picture == picture[..., :1])
    x = (np.arange(width) + 0.5) / width - 0.5
    y = 0.5 - (np.arange(height) + 0.5) / height
    half = 0.02
    for centre in dot_centres():
        columns = np.abs(x - centre[0]) < half
        rows = np.abs(y - centre[1]) < half * width / height
        dot = picture[np.ix_(rows, columns)][..., 0].astype(float)
        found = (dot.sum(axis=0) @ x[columns], dot.sum(axis=1) @ y[rows]) / dot.sum()
        assert np.abs((found - centre) * (width, height)).max() < CENTROID_PIXELS
        assert dot.max() == 1.0


def test_dots_are_alone_on_black() -> None:
    picture = built_in("dots", 960, 540)
    assert np.count_nonzero(picture[..., 0]) / picture[..., 0].size < 0.01


def test_chart_has_all_patches_in_full_colour() -> None:
    colours = {tuple(c) for c in built_in("chart", 960, 540).reshape(-1, 3).tolist()}
    assert {(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 1, 1), (1, 0, 1), (1, 1, 0), (1, 1, 1)} <= colours


def test_chart_is_mostly_transparent() -> None:
    picture = built_in("chart", 960, 540)
    assert np.count_nonzero(picture.max(axis=-1)) < 0.25 * picture[..., 0].size


def test_chart_frame_is_the_border_of_the_field() -> None:
    picture = built_in("chart", 960, 540)
    for edge in (picture[0], picture[-1], picture[:, 0], picture[:, -1]):
        assert edge[..., 1].min() > 0.5


@pytest.mark.parametrize("field", [FIELD_DEG, (30.0, 17.0), (40.0, 22.5)])
def test_chart_ticks_are_true_angles(field: tuple[float, float]) -> None:
    width = 1920
    line = built_in("chart", width, 1080, field)[14, :, 1].astype(float)
    x = np.arange(width) + 0.5
    for degree in (-8, -5, 0, 3, 7):
        expected = _place(degree, field[0], width)
        near = np.abs(x - expected) < 12
        found = line[near] @ x[near] / line[near].sum()
        assert found == pytest.approx(expected, abs=CENTROID_PIXELS)


@pytest.mark.parametrize("cycles", [2, 4, 6])
def test_chart_bars_have_their_frequency(cycles: int) -> None:
    width, height = 1920, 1080
    picture = built_in("chart", width, height)
    row = {2: 1.3, 4: -0.45, 6: -2.2}[cycles]
    y = height - _place(row, FIELD_DEG[1], height)
    line = picture[round(y), :, 0].astype(float)
    left, right = (round(_place(angle, FIELD_DEG[0], width)) for angle in (-7.1, -5.45))
    edges = np.flatnonzero(np.diff(line[left:right] > 0.5))
    period = (edges[-2] - edges[0]) / (len(edges) // 2 - 1)
    # One unit on the chart is the tangent in degrees: the value of one degree at the centre.
    per_degree = width / (2.0 * np.degrees(np.tan(np.radians(FIELD_DEG[0] / 2.0))))
    assert len(edges) == 2 * round(1.5 * cycles)
    assert period == pytest.approx(per_degree / cycles, abs=0.5)


def test_rectangle_covers_its_exact_area() -> None:
    canvas = Canvas(10, 6, (10.0, 6.0))
    canvas.rectangle((-2.3, -1.25), (1.4, 0.5))
    canvas.paint((1.0, 0.5, 0.0))
    total = canvas.pixels.sum(axis=(0, 1))
    np.testing.assert_allclose(total, np.asarray((1.0, 0.5, 0.0)) * 3.7 * 1.75, atol=FLOAT32)


def test_what_lies_outside_is_left_out() -> None:
    canvas = Canvas(10, 6, (10.0, 6.0))
    canvas.disk((40.0, 0.0), 3.0)
    canvas.rectangle((6.0, 6.0), (8.0, 8.0))
    canvas.paint((1.0, 1.0, 1.0))
    assert not canvas.pixels.any()


def test_chart_without_a_field_has_no_angles() -> None:
    labelled, plain = built_in("chart", 640, 360), built_in("chart", 640, 360, None)
    only_labelled = (labelled.max(axis=2) > 0.5) & (plain.max(axis=2) == 0.0)
    assert np.count_nonzero(only_labelled) > 100
    assert not ((plain.max(axis=2) > 0.5) & (labelled.max(axis=2) == 0.0)).any()


@pytest.mark.parametrize("field_deg", [(1e-5, 1e-5), (1e-3, 170.0)])
def test_chart_of_any_field_has_its_label(field_deg: tuple[float, float]) -> None:
    """A display far away fills a field that is written with a power of ten."""
    assert np.isfinite(built_in("chart", 32, 18, field_deg)).all()
