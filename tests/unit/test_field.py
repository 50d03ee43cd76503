# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the display's picture lies in the eye's picture, and where the pupils of a survey are."""

import math

import numpy as np
import pytest

from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.document import load_device
from hoe_addon.model.eyebox import PupilPosition, pupil_positions
from hoe_addon.model.field import field_degrees, field_mask, field_tangents


def device(*changes: str) -> LightGuideSpec:
    return load_device("two_hologram_ar", changes)


def test_field_of_the_preset_is_19_degrees() -> None:
    """2 atan(6.6937 / 40) and 2 atan(3.75 / 40)."""
    assert field_degrees(device()) == pytest.approx((19.0, 10.7117), abs=1e-4)


def test_field_is_that_of_the_display_in_the_focal_plane() -> None:
    spec = device("display.size_mm=[40, 20]", "lens.focal_length_mm=20")
    assert field_tangents(spec) == (1.0, 0.5)
    assert field_degrees(spec) == pytest.approx((90.0, 2.0 * math.degrees(math.atan(0.5))))


def test_mask_holds_the_pixels_whose_centre_is_inside() -> None:
    """A view of 90 degrees in 8 pixels: tangents -7/8, -5/8, ... 7/8 at the centres."""
    spec = device("eye.field_deg=90", "display.size_mm=[20, 12]", "lens.focal_length_mm=20")
    assert field_tangents(spec) == (0.5, 0.3)
    wanted = np.zeros((6, 8), dtype=np.bool_)
    wanted[2:4, 2:6] = True  # rows at +-1/8, columns at +-1/8 and +-3/8
    np.testing.assert_array_equal(field_mask(spec, 8, 6), wanted)


@pytest.mark.parametrize(("width", "height"), [(640, 480), (641, 361), (31, 97)])
def test_mask_is_symmetric_and_has_the_right_area(width: int, height: int) -> None:
    spec = device()
    mask = field_mask(spec, width, height)
    assert mask.shape == (height, width)
    np.testing.assert_array_equal(mask, mask[::-1])
    np.testing.assert_array_equal(mask, mask[:, ::-1])
    pixel = 2.0 * math.tan(math.radians(spec.eye.field_deg) / 2.0) / width
    across, up = (2.0 * tangent / pixel for tangent in field_tangents(spec))
    assert abs(mask.any(axis=0).sum() - across) <= 1.0
    assert abs(mask.any(axis=1).sum() - up) <= 1.0


def test_mask_is_full_where_the_view_is_narrower_than_the_display() -> None:
    assert field_mask(device("eye.field_deg=5"), 40, 30).all()


def test_positions_go_row_by_row_from_the_top_left() -> None:
    found = list(pupil_positions(device("eyebox.grid=[3, 2]", "eyebox.pitch_mm=[9, 2.5]")))
    assert found == [
        PupilPosition(0, 0, (-9.0, 1.25, 0.0)),
        PupilPosition(1, 0, (0.0, 1.25, 0.0)),
        PupilPosition(2, 0, (9.0, 1.25, 0.0)),
        PupilPosition(0, 1, (-9.0, -1.25, 0.0)),
        PupilPosition(1, 1, (0.0, -1.25, 0.0)),
        PupilPosition(2, 1, (9.0, -1.25, 0.0)),
    ]


def test_positions_stand_around_the_eye() -> None:
    spec = device("eye.position_mm=[1, 2, 3]", "eyebox.grid=[4, 3]")
    places = np.array([position.centre_mm for position in pupil_positions(spec)])
    np.testing.assert_allclose(places.mean(axis=0), (1.0, 2.0, 3.0), atol=1e-12)
    assert set(places[:, 2]) == {3.0}


def test_one_position_is_the_eye_itself() -> None:
    (only,) = pupil_positions(device("eyebox.grid=[1, 1]", "eye.position_mm=[1, 2, 3]"))
    assert only.centre_mm == (1.0, 2.0, 3.0)


def test_names_count_from_one_at_the_top_left() -> None:
    names = [position.name for position in pupil_positions(device())]
    assert names[0] == "row1_column1"
    assert names[5] == "row2_column3"
    assert len(set(names)) == len(names) == 9
