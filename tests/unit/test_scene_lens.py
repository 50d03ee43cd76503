# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A lens of a scene document, and exact rays through it."""

from typing import Any

import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.document import device_from, to_document
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_lens import LensElement
from hoe_addon.model.scene_lens_walk import focal_length_mm, through_lens

ROUNDING = 1e-12

KINOFORM = {
    "characteristic": {"kind": "even_radial", "wavelength_nm": 550, "coefficients": [-2.0]},
    "efficiency": {"model": "kinoform", "levels": 0, "design_wavelength_nm": 550, "relief": 1.5},
    "orders": [0, 1],
}


def document(**changes: Any) -> dict[str, Any]:
    lens = {"kind": "lens", "name": "lens", "position_mm": [0, 0, -100], "medium": 1.5}
    return {
        "kind": "scene",
        "schema": 1,
        "name": "test",
        "title": "test",
        "elements": [{**lens, "diameter_mm": 40, "thickness_mm": 8, **changes}],
        "eye": {"pupil_diameter_mm": 2, "field_deg": 20},
        "room": {"kind": "none", "luminance_cd_m2": 0},
        "render": {},
    }


def lens(**changes: Any) -> LensElement:
    scene = device_from(document(**changes))
    assert isinstance(scene, SceneSpec)
    found = scene.element("lens")
    assert isinstance(found, LensElement)
    return found


def test_lens_reads_back_from_its_own_document() -> None:
    scene = device_from(document(front={"radius_mm": -60}, back={"hologram": KINOFORM}))
    assert device_from(to_document(scene)) == scene


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"front": {"radius_mm": 0}}, r"front\.radius_mm: must not be 0, got 0"),
        (
            {"front": {"radius_mm": 20}},
            r"front\.radius_mm: must be large enough for a diameter of 40 mm, got 20",
        ),
        (
            {"back": {"radius_mm": 28, "conic": 1}},
            r"back\.radius_mm: must be large enough for a diameter of 40 mm, got 28",
        ),
        ({"front": {"radius_mm": -25}}, r"thickness_mm: must be more by 2\.0\d*: the faces meet"),
        ({"thickness_mm": 0}, r"thickness_mm: must be above 0"),
        ({"diameter_mm": -1}, r"diameter_mm: must be above 0"),
        ({"medium": "glas"}, r"medium: must be one of"),
        ({"medium": 0.5}, r"medium: must be at least 1"),
        ({"outside": "vacuum"}, r"outside: must be one of"),
        ({"front": {"radius": -60}}, r"front\.radius: "),
        (
            {"back": {"hologram": {**KINOFORM, "characteristic": None}}},
            r"back\.hologram\.recording: must be given, or characteristic instead",
        ),
        (
            {"back": {"hologram": {**KINOFORM, "orders": [1, 1]}}},
            r"back\.hologram\.orders: must list each order once",
        ),
    ],
)
def test_bad_lens_is_refused_where_the_mistake_is(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError, match=r"^elements\[0\] \(lens\)\." + message):
        device_from(document(**changes))


def test_faces_may_not_meet_between_axis_and_rim() -> None:
    """They are 0.1 mm apart on the axis and 0.6 mm at the rim, but cross between."""
    front, back = {"radius_mm": 60, "conic": 4}, {"radius_mm": 45, "conic": -8}
    apart = lens(thickness_mm=0.3, front=front, back=back)
    rim = np.asarray(20.0)
    assert apart.sag_mm("front", rim) - apart.sag_mm("back", rim) > 0.5
    with pytest.raises(SpecError, match="the faces meet"):
        lens(thickness_mm=0.1, front=front, back=back)


def test_faces_are_where_the_radii_put_them() -> None:
    biconvex = lens(front={"radius_mm": -50}, back={"radius_mm": 80})
    sag = 50.0 - np.sqrt(50.0**2 - 20.0**2), 80.0 - np.sqrt(80.0**2 - 20.0**2)
    height = np.array((0.0, 20.0))
    assert biconvex.sag_mm("front", height) == pytest.approx([4.0, 4.0 - sag[0]], abs=ROUNDING)
    assert biconvex.sag_mm("back", height) == pytest.approx([-4.0, -4.0 + sag[1]], abs=ROUNDING)


def test_hologram_has_the_media_of_its_face() -> None:
    both = lens(
        outside="air", medium="N-BK7", front={"hologram": KINOFORM}, back={"hologram": KINOFORM}
    )
    front, back = both.hologram("front"), both.hologram("back")
    assert front is not None
    assert back is not None
    assert (front.media.back, front.media.front) == ("N-BK7", "air")
    assert (back.media.back, back.media.front) == ("air", "N-BK7")
    assert lens().hologram("front") is None


def test_plane_plate_shifts_rays_and_keeps_their_direction() -> None:
    plate = lens()
    sine = 0.3
    ray = np.array([[sine, 0.0, -np.sqrt(1.0 - sine**2)]])
    place, left = through_lens(plate, [[0.0, 0.0, 20.0]], ray, 550.0)
    assert left == pytest.approx(ray, abs=ROUNDING)
    inside = (sine / 1.5) / np.sqrt(1.0 - (sine / 1.5) ** 2)
    wanted = 16.0 * sine / np.sqrt(1.0 - sine**2) + 8.0 * inside
    assert place == pytest.approx(np.array([[wanted, 0.0, -4.0]]), abs=ROUNDING)


def test_ball_keeps_the_invariant_of_refraction() -> None:
    """In a nearly full sphere n h is the same in and out, h being the distance from its centre."""
    ball = lens(
        diameter_mm=18.0, thickness_mm=20.0, front={"radius_mm": -10}, back={"radius_mm": 10}
    )
    start, heading = np.array([[3.0, 1.0, 40.0]]), np.array([[0.0, 0.0, -1.0]])
    place, left = through_lens(ball, start, heading, 550.0)
    before, after = np.cross(start, heading), np.cross(place, left)
    assert after == pytest.approx(before, abs=1e-11)
    # A sphere turns a ray by twice the difference of the two angles.
    height = np.hypot(3.0, 1.0)
    turn = 2.0 * (np.arcsin(height / 10.0) - np.arcsin(height / 15.0))
    assert np.arccos(float(left[0] @ heading[0])) == pytest.approx(turn, abs=1e-12)


def test_rays_come_back_the_way_they_went(rng: np.random.Generator) -> None:
    hybrid = lens(front={"radius_mm": -60, "conic": -0.5}, back={"hologram": KINOFORM})
    count = 200
    start = np.column_stack((rng.uniform(-8, 8, (count, 2)), np.full(count, 30.0)))
    heading = np.column_stack((rng.uniform(-0.1, 0.1, (count, 2)), np.full(count, -1.0)))
    heading /= np.linalg.norm(heading, axis=1, keepdims=True)
    wavelength = rng.uniform(430.0, 680.0, count)
    place, left = through_lens(hybrid, start, heading, wavelength, {"back": 1})
    assert np.all(np.isfinite(left))
    back, turned = through_lens(hybrid, place + 5.0 * left, -left, wavelength, {"back": 1})
    assert turned == pytest.approx(-heading, abs=1e-12)
    missed = np.cross(back - start, heading)
    assert missed == pytest.approx(np.zeros((count, 3)), abs=1e-10)


def test_ray_beside_the_lens_is_lost() -> None:
    beside = through_lens(lens(), [[21.0, 0.0, 10.0]], [[0.0, 0.0, -1.0]], 550.0)
    assert np.all(np.isnan(beside))


@pytest.mark.parametrize("side", ["front", "back"])
def test_focal_length_is_that_of_the_thick_lens(side: str) -> None:
    """The maker's formula, whichever face is curved, and with both."""
    radius = -60.0 if side == "front" else 60.0
    one = lens(**{side: {"radius_mm": radius}})
    assert focal_length_mm(one, 550.0)[0] == pytest.approx(120.0, rel=2e-6)
    two = lens(front={"radius_mm": -60}, back={"radius_mm": 60})
    power = 2.0 / 120.0 - 8.0 / 1.5 / 120.0**2
    assert focal_length_mm(two, 550.0)[0] == pytest.approx(1.0 / power, rel=2e-6)
