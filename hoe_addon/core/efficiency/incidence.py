# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Light that meets a grating: all that an efficiency may depend on, and its polarisation.

Every vector is in the grating's own frame at the point that is hit: x along the tangential part of
the grating vector Q, z along the normal toward the front, and y = z cross x along the grooves.
Where there is no grating, x is any tangent.
"""

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import BoolArray, FloatArray, as_float, dot, unit
from ..pattern import Pattern
from ..recording import Recording

_FLAT = 1e-12
"""A tangential gradient below this, of 1, has no direction of its own."""


class Polarization(StrEnum):
    """Polarisation of the light, told by the plane of incidence (of the normal and the ray).

    At normal incidence that is the plane of x and z, across the grooves.
    """

    S = "s"
    """Electric field across the plane of incidence."""
    P = "p"
    """Electric field in the plane of incidence."""
    UNPOLARISED = "u"
    """The mean of both."""


@dataclass(frozen=True, eq=False)
class RecordedWaves:
    """The two waves of a recording at each point, in the grating's frame.

    Attributes:
        wavelength: Vacuum wavelength of the recording, metres.
        object: ``n_O s_O``, shape ``(..., 3)``.
        reference: ``n_R s_R``, shape ``(..., 3)``.
    """

    wavelength: float
    object: FloatArray
    reference: FloatArray


@dataclass(frozen=True, eq=False)
class Incidence:
    """Light that meets a grating, one entry a ray; all shapes ``(...)`` are alike.

    Attributes:
        wavelength: Vacuum wavelength, metres, shape ``(...)``.
        tangential: Tangential part of n s, the index of its medium times the unit direction of
            travel, along x and y, shape ``(..., 2)``. It is the same in every plane layer.
        from_front: Whether the light comes from z > 0, shape ``(...)``.
        index_back: Index of the medium at z < 0, shape ``(...)``.
        index_front: Index of the medium at z > 0, shape ``(...)``.
        frequency: Grating frequency, ``|tangential grad V| / lambda_0``, cycles per metre, at
            least 0; NaN where nothing is recorded; shape ``(...)``.
        place: x and y in the element's frame, metres, shape ``(..., 2)``.
        waves: The waves of the recording; None where V is given outright.
    """

    wavelength: FloatArray
    tangential: FloatArray
    from_front: BoolArray
    index_back: FloatArray
    index_front: FloatArray
    frequency: FloatArray
    place: FloatArray
    waves: RecordedWaves | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the rays."""
        return self.wavelength.shape

    @property
    def index_in(self) -> FloatArray:
        """Index of the medium that the light comes from, shape ``(...)``."""
        return np.where(self.from_front, self.index_front, self.index_back)

    @property
    def index_out(self) -> FloatArray:
        """Index of the other medium, shape ``(...)``."""
        return np.where(self.from_front, self.index_back, self.index_front)

    def shifted(self, order: float) -> FloatArray:
        """Tangential part of n' s' of an order.

        Args:
            order: Diffraction order times the frequency of its branch.

        Returns:
            Components along x and y, shape ``(..., 2)``.
        """
        along = self.tangential[..., 0] + order * self.wavelength * self.frequency
        return np.stack((along, self.tangential[..., 1]), axis=-1)

    def reversed(self, order: float, *, reflected: bool) -> "Incidence":
        """The light that leaves in an order, sent back on its own way.

        Args:
            order: Diffraction order times the frequency of its branch.
            reflected: Whether the order goes back.

        Returns:
            Its incidence; for an evanescent order no real light.
        """
        side = self.from_front if reflected else ~self.from_front
        return replace(self, tangential=-self.shifted(order), from_front=side)


def meet(
    pattern: Pattern,
    points: ArrayLike,
    draws: ArrayLike | None,
    normal: ArrayLike,
    direction: ArrayLike,
    wavelength: ArrayLike,
    indices: tuple[ArrayLike, ArrayLike],
) -> tuple[FloatArray, Incidence]:
    """Look at light in the frame of the grating that it meets.

    Args:
        pattern: What is recorded.
        points: Points that are hit, in the element's frame, metres, shape ``(..., 3)``.
        draws: Uniform numbers of extended sources, see `Pattern`.
        normal: Unit normals there, to the front, broadcastable to ``(..., 3)``.
        direction: Unit directions of travel, shape ``(..., 3)``; a ray exactly in the plane counts
            as one from the back.
        wavelength: Vacuum wavelengths, metres, broadcastable to ``(...)``.
        indices: Indices at the back and at the front, each broadcastable to ``(...)``.

    Returns:
        grad V, broadcastable to ``(..., 3)``, and the incidence.
    """
    heading, spots, colour = as_float(direction), as_float(points), as_float(wavelength)
    shape = np.broadcast_shapes(heading.shape[:-1], spots.shape[:-1], colour.shape)
    waves = pattern.waves(spots, draws) if isinstance(pattern, Recording) else None
    gradient = waves[0] - waves[1] if waves else pattern.gradient(spots, draws)
    whole = (*shape, 3)
    frame = _frame(np.broadcast_to(as_float(normal), whole), np.broadcast_to(gradient, whole))
    back, front = (np.broadcast_to(as_float(index), shape) for index in indices)
    local = _turned(frame, np.broadcast_to(heading, whole))
    from_front = local[..., 2] < 0.0
    recorded = None
    if waves is not None:
        turned = (_turned(frame, np.broadcast_to(wave, whole)) for wave in waves)
        recorded = RecordedWaves(pattern.wavelength, *turned)
    return gradient, Incidence(
        wavelength=np.broadcast_to(colour, shape),
        tangential=np.where(from_front, front, back)[..., None] * local[..., :2],
        from_front=from_front,
        index_back=back,
        index_front=front,
        frequency=np.broadcast_to(dot(frame[0], gradient), shape) / pattern.wavelength,
        place=np.broadcast_to(spots[..., :2], (*shape, 2)),
        waves=recorded,
    )


def _frame(normal: FloatArray, gradient: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return x, y and z of the grating's frame."""
    along = gradient - dot(gradient, normal)[..., None] * normal
    flat = ~(np.sum(along * along, axis=-1) > _FLAT**2)
    # Without a grating: the element's x axis laid into the tangent plane, or its y axis.
    steep = np.abs(normal[..., :1]) > np.sqrt(0.5)
    tangent = np.where(steep, (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
    tangent = tangent - dot(tangent, normal)[..., None] * normal
    x = unit(np.where(flat[..., None], tangent, along))
    return x, np.cross(normal, x), normal


def _turned(frame: tuple[FloatArray, FloatArray, FloatArray], vector: FloatArray) -> FloatArray:
    return np.stack([dot(axis, vector) for axis in frame], axis=-1)
