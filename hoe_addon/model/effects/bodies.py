# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a ray can meet in a document: bodies in frames of their own, in mm."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ...core.arrays import BoolArray, FloatArray, IntArray
from ...core.media import Medium
from ..hologram import HologramSpec

type Distance = Callable[[FloatArray, FloatArray], FloatArray]
"""From starts and unit directions, each ``(n, 3)``, to distances ``(n,)``; inf for a miss."""

type Covers = Callable[[FloatArray], BoolArray]
"""From points ``(n, 3)`` to whether a body is there."""

AHEAD_MM = 1e-6
"""Nearer than this nothing is met."""


@dataclass(frozen=True, eq=False)
class Face:
    """A bare face of a dielectric.

    Attributes:
        normal: From points ``(n, 3)`` in mm to unit normals toward the front.
        back: Medium at z < 0.
        front: Medium at z > 0.
    """

    normal: Callable[[FloatArray], FloatArray]
    back: Medium
    front: Medium


@dataclass(frozen=True, eq=False)
class Body:
    """Anything that a ray can meet.

    Attributes:
        name: Name of the element.
        turn: Rotation from its frame to that of the document, shape ``(3, 3)``.
        origin: Where its frame is, mm, shape ``(3,)``.
        distance: Where rays meet it, in its frame.
        flat: Whether a ray that leaves it can not meet it again.
        hologram: The hologram that it is, if any.
        face: The bare face that it is, if any.
        reflectance: Of a matte body; 0 for a black one, and for an emitter.
        emits: From points and directions of the walk, in its frame, to whether light comes from
            there; None for what gives no light.
    """

    name: str
    turn: FloatArray
    origin: FloatArray
    distance: Distance
    flat: bool = True
    hologram: HologramSpec | None = None
    face: Face | None = None
    reflectance: float = 0.0
    emits: Callable[[FloatArray, FloatArray], BoolArray] | None = None

    @property
    def passes(self) -> bool:
        """Whether light goes on from it."""
        return self.hologram is not None or self.face is not None

    def local(self, points: FloatArray, ways: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Turn points and directions into its frame."""
        return (points - self.origin) @ self.turn, ways @ self.turn


def nearest(
    bodies: tuple[Body, ...], start: FloatArray, way: FloatArray, left: IntArray
) -> tuple[IntArray, FloatArray]:
    """Find what rays meet first.

    Args:
        bodies: All bodies.
        start: Where the rays start, mm, shape ``(n, 3)``.
        way: Unit directions, shape ``(n, 3)``.
        left: Number of the body that each ray just left, or -1, shape ``(n,)``.

    Returns:
        Numbers of the bodies, -1 for none, and distances in mm, each of shape ``(n,)``.
    """
    which = np.full(len(start), -1, dtype=np.int64)
    closest = np.full(len(start), np.inf)
    for number, body in enumerate(bodies):
        far = body.distance(*body.local(start, way))
        again = (left == number) & body.flat
        far = np.where((far > AHEAD_MM) & ~again, far, np.inf)
        which = np.where(far < closest, number, which)
        closest = np.minimum(closest, far)
    return which, closest


def on_plane(covers: Covers, z: float = 0.0) -> Distance:
    """Meet a part of a plane.

    Args:
        covers: Which points of the plane belong to it.
        z: Where the plane is.

    Returns:
        The distances.
    """

    def distance(start: FloatArray, way: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):
            far = (z - start[:, 2]) / way[:, 2]
            met = start + far[:, None] * way
        far = np.where(np.isfinite(far), far, np.inf)
        return np.where(covers(np.where(np.isfinite(met), met, np.inf)), far, np.inf)

    return distance


def rectangle(width: float, height: float) -> Covers:
    """A rectangle around the origin."""
    return lambda p: (np.abs(p[:, 0]) <= width / 2) & (np.abs(p[:, 1]) <= height / 2)


def ellipse(width: float, height: float) -> Covers:
    """An ellipse around the origin."""
    return lambda p: np.hypot(p[:, 0] / (width / 2), p[:, 1] / (height / 2)) <= 1.0


def box(size: tuple[float, float, float]) -> Distance:
    """Meet a box around the origin."""
    half = np.asarray(size) / 2.0

    def distance(start: FloatArray, way: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore", invalid="ignore"):
            sides = (np.stack((-half, half))[:, None, :] - start) / way
        sides = np.where(np.isnan(sides), -np.inf, sides)
        enters, leaves = sides.min(axis=0).max(axis=1), sides.max(axis=0).min(axis=1)
        return _first(enters, leaves)

    return distance


def cylinder(size: tuple[float, float, float], axis: int = 2) -> Distance:
    """Meet a cylinder around the origin.

    Args:
        size: Extent along x, y and z.
        axis: Along which it is straight.

    Returns:
        The distances.
    """
    half = np.asarray(size) / 2.0
    round_ = [each for each in range(3) if each != axis]

    def distance(start: FloatArray, way: FloatArray) -> FloatArray:
        tube = _ball(start[:, round_] / half[round_], way[:, round_] / half[round_])
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = (np.array([[-half[axis]], [half[axis]]]) - start[:, axis]) / way[:, axis]
        ends = np.where(np.isnan(ends), -np.inf, ends)
        enters = np.maximum(tube[0], ends.min(axis=0))
        return _first(enters, np.minimum(tube[1], ends.max(axis=0)))

    return distance


def ellipsoid(size: tuple[float, float, float]) -> Distance:
    """Meet an ellipsoid around the origin."""
    half = np.asarray(size) / 2.0
    return lambda start, way: _first(*_ball(start / half, way / half))


def _ball(start: FloatArray, way: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Where rays of any speed enter and leave the unit ball."""
    speed = np.sum(way * way, axis=1)
    along = np.sum(start * way, axis=1)
    root = along**2 - speed * (np.sum(start * start, axis=1) - 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.sqrt(root)
        enters, leaves = (-along - reach) / speed, (-along + reach) / speed
    miss = ~(root >= 0.0) | (speed == 0.0)
    return np.where(miss, np.inf, enters), np.where(miss, -np.inf, leaves)


def _first(enters: FloatArray, leaves: FloatArray) -> FloatArray:
    """The first of two crossings that lies ahead."""
    hit = enters <= leaves
    first = np.where(enters > AHEAD_MM, enters, leaves)
    return np.where(hit & (first > AHEAD_MM), first, np.inf)
