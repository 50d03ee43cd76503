# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording of a hologram by two waves, and the grating vector that it leaves."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray, as_float, unit
from .errors import SpecError


def _vector(field: str, values: Sequence[float]) -> tuple[float, float, float]:
    """Return three finite floats, or raise SpecError that names the field."""
    numbers = tuple(float(value) for value in values)
    if len(numbers) != 3 or not all(math.isfinite(number) for number in numbers):
        raise SpecError(f"{field}: must be three finite numbers, got {list(numbers)}")
    return (numbers[0], numbers[1], numbers[2])


def _check_index(index: float) -> None:
    """Raise SpecError unless the refractive index is finite and at least 1."""
    if not (math.isfinite(index) and index >= 1.0):
        raise SpecError(f"index: must be at least 1, got {index}")


@dataclass(frozen=True)
class PlaneWave:
    """A plane recording wave.

    Attributes:
        direction: Direction of propagation, any length but zero.
        index: Refractive index of the medium that the wave comes through, at least 1.
    """

    direction: tuple[float, float, float]
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check the fields."""
        direction = _vector("direction", self.direction)
        object.__setattr__(self, "direction", direction)
        if not any(direction):
            raise SpecError(f"direction: must not have zero length, got {list(direction)}")
        _check_index(self.index)


@dataclass(frozen=True)
class PointSource:
    """A spherical recording wave, diverging from or converging toward a point.

    Attributes:
        position: The point, metres.
        converging: True when the wave travels toward the point.
        index: Refractive index of the medium that the wave comes through, at least 1.
    """

    position: tuple[float, float, float]
    converging: bool = False
    index: float = 1.0

    def __post_init__(self) -> None:
        """Check the fields."""
        object.__setattr__(self, "position", _vector("position", self.position))
        _check_index(self.index)


type Wave = PlaneWave | PointSource


@dataclass(frozen=True)
class Recording:
    """Two waves and the wavelength that record a hologram.

    Attributes:
        object: Object wave, the one that order +1 gives back.
        reference: Reference wave, the one that reads out.
        wavelength: Vacuum wavelength of the recording, metres, above 0.
    """

    object: Wave
    reference: Wave
    wavelength: float

    def __post_init__(self) -> None:
        """Check the fields."""
        if not (math.isfinite(self.wavelength) and self.wavelength > 0.0):
            raise SpecError(f"wavelength: must be above 0, got {self.wavelength}")


def propagation_direction(wave: Wave, points: ArrayLike) -> FloatArray:
    """Return the direction in which a recording wave travels at each point.

    Args:
        wave: The recording wave.
        points: Points in metres, in the frame of the wave, shape ``(..., 3)``.

    Returns:
        Unit vectors, shape ``(..., 3)``. NaN where a point coincides with the source: no
        direction exists there, and the ray law answers with ``Status.UNDEFINED``.
    """
    places = as_float(points)
    if isinstance(wave, PlaneWave):
        return np.broadcast_to(unit(wave.direction), places.shape)
    away = unit(places - as_float(wave.position))
    return -away if wave.converging else away


def characteristic_gradient(recording: Recording, points: ArrayLike) -> FloatArray:
    """Return the gradient of the characteristic function V_O - V_R at each point.

    Args:
        recording: The two waves and their media.
        points: Points in metres, in the frame of the recording, shape ``(..., 3)``.

    Returns:
        ``n_O s_O - n_R s_R``, shape ``(..., 3)``, without dimension. Divided by the recording
        wavelength it is the grating vector in cycles per metre. NaN where a point coincides
        with one of the two sources.

    References:
        Welford (1975), "A vector raytracing equation for hologram lenses of arbitrary shape",
        Opt. Commun. 14(3), 322-323.
    """
    object_part = recording.object.index * propagation_direction(recording.object, points)
    reference = recording.reference
    return object_part - reference.index * propagation_direction(reference, points)
