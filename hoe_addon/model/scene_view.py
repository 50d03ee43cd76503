# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an eye sees things in a scene: directions of gaze, chief rays, and virtual images.

All places and directions are in the frame of the scene: x right, y up, z toward the viewer, mm.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray, as_float
from ..core.errors import SpecError
from .evaluate import trace
from .hologram import HologramSpec
from .rays import RayTable, TraceResult
from .scene import SceneSpec
from .scene_parts import ElementSpec, HologramElement

type TraceEngine = Callable[[HologramSpec, RayTable], TraceResult]
"""``model.evaluate.trace``, or another engine with the same arguments."""

_STEP = 1e-6
"""Change of direction for the derivatives of a chief ray."""

_ROUNDS = 30
_CLOSE_MM = 1e-9


def gaze_direction(gaze_deg: tuple[float, float]) -> FloatArray:
    """Direction of a gaze.

    Args:
        gaze_deg: Degrees to the right, and degrees up.

    Returns:
        Unit vector, shape ``(3,)``.
    """
    right, up = np.radians(gaze_deg)
    return np.array([np.cos(up) * np.sin(right), np.sin(up), -np.cos(up) * np.cos(right)])


def gaze_of(direction: ArrayLike) -> tuple[float, float]:
    """Gaze of a direction.

    Args:
        direction: Vector of any length, shape ``(3,)``.

    Returns:
        Degrees to the right, and degrees up.
    """
    x, y, z = as_float(direction) / np.linalg.norm(direction)
    return math.degrees(math.atan2(x, -z)), math.degrees(math.asin(y))


def rotation_of(element: ElementSpec) -> FloatArray:
    """Rotation of an element's frame.

    Args:
        element: The element.

    Returns:
        Matrix from its frame to that of the scene, shape ``(3, 3)``.
    """
    matrix = np.eye(3)
    for axis, angle in enumerate(np.radians(element.rotation_deg)):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[first, first] = turn[second, second] = np.cos(angle)
        turn[second, first] = np.sin(angle)
        turn[first, second] = -np.sin(angle)
        matrix = turn @ matrix
    return matrix


def pass_hologram(
    element: HologramElement,
    start_mm: ArrayLike,
    direction: ArrayLike,
    wavelength_nm: ArrayLike,
    order: int,
    *,
    reflected: bool = False,
    engine: TraceEngine = trace,
) -> tuple[FloatArray, FloatArray]:
    """Send rays through one hologram of a scene.

    Args:
        element: The hologram.
        start_mm: Where the rays start, mm, shape ``(n, 3)``.
        direction: Unit directions of travel, shape ``(n, 3)``.
        wavelength_nm: Vacuum wavelengths, nm, broadcastable to ``(n,)``.
        order: Order that they take.
        reflected: Whether they come back on the same side.
        engine: What traces them.

    Returns:
        Hit points in mm and unit directions, each of shape ``(n, 3)``; NaN where no ray goes on.
    """
    turn, origin = rotation_of(element), as_float(element.position_mm)
    count = len(as_float(start_mm))
    result = engine(
        element.hologram,
        RayTable(
            (as_float(start_mm) - origin) @ turn,
            as_float(direction) @ turn,
            np.broadcast_to(as_float(wavelength_nm), (count,)).copy(),
            np.full(count, order),
            np.full(count, reflected),
        ),
    )
    return result.hit_mm @ turn.T + origin, result.direction @ turn.T


def chief_ray(
    scene: SceneSpec,
    hologram: str,
    seen: str,
    pupil_mm: ArrayLike,
    wavelength_nm: float,
    *,
    reflected: bool = False,
) -> FloatArray:
    """Find the direction in which an eye sees the middle of an element through a hologram.

    Rays are walked backward from the pupil through order +1 and aimed by Newton's method, in
    double precision.

    Args:
        scene: The scene.
        hologram: Name of the hologram.
        seen: Name of the element that is seen; its middle is the origin of its frame.
        pupil_mm: Middle of the pupil, mm, shape ``(3,)``.
        wavelength_nm: Vacuum wavelength.
        reflected: Whether the hologram reflects.

    Returns:
        Unit vector from the pupil, shape ``(3,)``.

    Raises:
        SpecError: No ray gets there.
    """
    element, target = scene.hologram(hologram), scene.element(seen)
    plane, pupil = rotation_of(target), as_float(pupil_mm)

    def missed_by(aim: FloatArray) -> FloatArray:
        """Where rays of some slopes meet the plane of the target, shape (n, 2)."""
        heading = np.concatenate([aim, -np.ones((len(aim), 1))], axis=1)
        heading /= np.linalg.norm(heading, axis=1, keepdims=True)
        start = np.broadcast_to(pupil, heading.shape)
        hit, onward = pass_hologram(element, start, heading, wavelength_nm, 1, reflected=reflected)
        local = (hit - as_float(target.position_mm)) @ plane
        along = onward @ plane
        return local[:, :2] - along[:, :2] * (local[:, 2:] / along[:, 2:])

    toward = as_float(element.position_mm) - pupil
    with np.errstate(divide="ignore", invalid="ignore"):  # nothing aims at what stands beside it
        aim: FloatArray = as_float(toward[:2] / -toward[2])
    for _ in range(_ROUNDS):
        missed = missed_by(aim + _STEP * np.array([[0, 0], [1, 0], [0, 1]]))
        if not np.all(np.isfinite(missed)):
            break
        if float(np.max(np.abs(missed[0]))) < _CLOSE_MM:
            return np.array([*aim, -1.0]) / math.sqrt(1.0 + float(aim @ aim))
        slope = as_float((missed[1:] - missed[0]).T / _STEP)
        aim = as_float(aim - as_float(np.linalg.solve(slope, as_float(missed[0]))))
    raise SpecError(f"{seen}: no ray from the pupil gets there through {hologram}")


def image_distance_mm(pupils_mm: ArrayLike, directions: ArrayLike) -> float:
    """Distance of the point that is seen in two directions from two pupils.

    Args:
        pupils_mm: Middles of two pupils, mm, shape ``(2, 3)``.
        directions: Unit vectors from each, shape ``(2, 3)``.

    Returns:
        Distance in mm from between the pupils, along the mean direction, of the point where the
        two lines come nearest to each other; negative behind the eye, infinite where they are
        parallel.
    """
    (first, second), (a, b) = as_float(pupils_mm), as_float(directions)
    apart = second - first
    # Along |cross|, which keeps its digits for lines that are all but parallel.
    normal = np.cross(a, b)
    square = float(normal @ normal)
    if square == 0.0:
        return math.inf
    on_first = float(np.cross(apart, b) @ normal) / square
    on_second = float(np.cross(apart, a) @ normal) / square
    middle = (first + on_first * a + second + on_second * b) / 2.0
    onward = as_float(np.add(a, b))
    return float((middle - (first + second) / 2.0) @ onward) / float(np.linalg.norm(onward))
