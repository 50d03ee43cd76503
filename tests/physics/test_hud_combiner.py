# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The head-up display of the presets shows its picture where the recording put it."""

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray

from hoe_addon.model.document import load_device
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_parts import DisplayElement
from hoe_addon.model.scene_view import (
    chief_ray,
    gaze_of,
    image_distance_mm,
    pass_hologram,
    rotation_of,
)

DISTANCE_MM = 10_000.0
GREEN_NM = 532.0

PROMISED = 0.01
"""What the display promises, as a share of the distance."""

DOCUMENT = 1e-6
"""The document's places have six decimals of a mm, and parallax magnifies what they lack: 1e-9 rad
at a baseline of 60 mm is 1.7e-7 of 10 m."""

HIGH_OR_WIDE = [
    [(-30, 0, 0), (30, 0, 0)],
    [(0, -15, 0), (0, 15, 0)],
    [(-30, -10, 0), (30, 10, 0)],
    [(-60, 0, 20), (0, 5, -20)],
]


@pytest.fixture(scope="module")
def scene() -> SceneSpec:
    found = load_device("hud_combiner")
    assert isinstance(found, SceneSpec)
    return found


def moved_display(scene: SceneSpec, offset_mm: tuple[float, float, float]) -> SceneSpec:
    """The scene with the display moved in its own frame."""

    def moved(element: DisplayElement) -> DisplayElement:
        place = np.asarray(element.position_mm) + rotation_of(element) @ offset_mm
        return replace(element, position_mm=tuple(place.tolist()))

    return replace(
        scene,
        elements=tuple(
            moved(item) if isinstance(item, DisplayElement) else item for item in scene.elements
        ),
    )


def seen(scene: SceneSpec, pupil: tuple[float, float, float]) -> NDArray[np.float64]:
    return chief_ray(scene, "combiner", "display", pupil, GREEN_NM, reflected=True)


def distance(scene: SceneSpec, pupils: list[tuple[float, float, float]]) -> float:
    return image_distance_mm(pupils, [seen(scene, pupil) for pupil in pupils])


def object_point(scene: SceneSpec) -> NDArray[np.float64]:
    element = scene.hologram("combiner")
    assert element.hologram.recording is not None
    local = np.asarray(element.hologram.recording.object.position_mm)
    return rotation_of(element) @ local + np.asarray(element.position_mm)


def test_the_recorded_point_is_ten_metres_from_the_eye(scene: SceneSpec) -> None:
    assert float(np.linalg.norm(object_point(scene))) == pytest.approx(DISTANCE_MM, rel=DOCUMENT)


def test_the_picture_is_ten_metres_from_two_pupils(scene: SceneSpec) -> None:
    assert distance(scene, HIGH_OR_WIDE[0]) == pytest.approx(DISTANCE_MM, rel=PROMISED)


@pytest.mark.parametrize("pupils", HIGH_OR_WIDE)
def test_every_pair_of_pupils_sees_it_at_the_recorded_point(
    scene: SceneSpec, pupils: list[tuple[float, float, float]]
) -> None:
    """The curved surface does not spoil it: two points image each other from any surface."""
    for pupil in pupils:
        wanted = object_point(scene) - pupil
        wanted /= np.linalg.norm(wanted)
        assert seen(scene, pupil) == pytest.approx(wanted, abs=DOCUMENT * 60 / DISTANCE_MM)


def test_a_display_out_of_place_would_be_noticed(scene: SceneSpec) -> None:
    """By the lens formula 1 mm at 550 mm changes the vergence of 0.1 per metre by 3 %."""
    nearer = moved_display(scene, (0.0, 0.0, 1.0))
    vergence = DISTANCE_MM / distance(nearer, HIGH_OR_WIDE[0])
    assert vergence == pytest.approx(1.0 + DISTANCE_MM / 550.0**2, rel=0.01)


def test_the_picture_stands_upright_and_its_sides_are_swapped_back(scene: SceneSpec) -> None:
    """Seen in one reflection it would be mirrored, so the display shows it mirrored."""
    display = scene.element("display")
    assert isinstance(display, DisplayElement)
    right, up = gaze_of(seen(moved_display(scene, (5.0, 5.0, 0.0)), (0, 0, 0)))
    left, down = gaze_of(seen(moved_display(scene, (-5.0, -5.0, 0.0)), (0, 0, 0)))
    assert up > down
    assert (right > left) is not display.mirrored


def test_the_plain_reflection_misses_the_display(scene: SceneSpec) -> None:
    """The glass sends the eye's ray elsewhere, so that no second picture is seen."""
    element, display = scene.hologram("combiner"), scene.element("display")
    toward = seen(scene, (0, 0, 0))[None]
    hit, _ = pass_hologram(element, np.zeros((1, 3)), toward, GREEN_NM, 1, reflected=True)
    _, plain = pass_hologram(element, np.zeros((1, 3)), toward, GREEN_NM, 0, reflected=True)
    to_display = np.asarray(display.position_mm) - hit[0]
    cosine = plain[0] @ to_display / np.linalg.norm(to_display)
    assert np.degrees(np.arccos(cosine)) == pytest.approx(15.0, abs=0.1)


@pytest.mark.parametrize("pupil", [(x, y, 0) for x in (-30, 0, 30) for y in (-15, 15)])
def test_the_whole_display_is_seen_from_the_whole_eyebox(
    scene: SceneSpec, pupil: tuple[float, float, float]
) -> None:
    display = scene.element("display")
    assert isinstance(display, DisplayElement)
    width, height = display.display.size_mm
    for x, y in ((-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)):
        right, up = gaze_of(seen(moved_display(scene, (x * width, y * height, 0.0)), pupil))
        assert abs(right) < 4.0
        assert -9.0 < up < -3.0


def test_off_the_centre_the_eyes_differ_as_the_example_says(scene: SceneSpec) -> None:
    """A corner of the picture is seen at heights that differ by 0.4 degrees."""
    corner = moved_display(scene, (-28.0, -12.0, 0.0))
    heights = [gaze_of(seen(corner, pupil))[1] for pupil in HIGH_OR_WIDE[0]]
    assert abs(heights[1] - heights[0]) == pytest.approx(0.42, abs=0.02)
