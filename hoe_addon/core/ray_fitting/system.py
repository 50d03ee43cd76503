# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A chain of refracting and reflecting surfaces behind a source."""

import math
from dataclasses import dataclass

from ..errors import SpecError
from ..shapes import Conic
from ..tracer import Frame
from ..waves.plane import PlaneWave
from ..waves.point import PointSource


@dataclass(frozen=True)
class OpticalSurface:
    """One surface of a chain: a round piece of a conic of revolution.

    Attributes:
        frame: Where it lies: origin at the vertex, z along the axis.
        radius: Radius at the vertex, metres, not 0; above 0 the centre of curvature lies at +z;
            infinite for a plane.
        conic: Conic constant: 0 is a sphere, -1 a paraboloid.
        semi_diameter: Radius of the aperture, around the axis, metres, above 0.
        index_after: Index of the medium after it; None for a mirror, which has the same medium
            before and after.
    """

    frame: Frame
    radius: float
    conic: float
    semi_diameter: float
    index_after: float | None

    def __post_init__(self) -> None:
        """Check the fields; the conic checks its own."""
        edge = float(self.shape.sag(self.semi_diameter, 0.0))
        if not (math.isfinite(self.semi_diameter) and self.semi_diameter > 0.0):
            raise SpecError(f"semi_diameter: must be above 0, got {self.semi_diameter}")
        if not math.isfinite(edge):
            raise SpecError(
                "semi_diameter: must not reach beyond the sheet of the vertex, "
                f"got {self.semi_diameter}"
            )
        if self.index_after is not None and not 1.0 <= self.index_after < math.inf:
            raise SpecError(f"index_after: must be at least 1, got {self.index_after}")

    @property
    def shape(self) -> Conic:
        """The whole conic."""
        return Conic(self.radius, self.conic)


@dataclass(frozen=True)
class OpticalSystem:
    """A source and the surfaces that its rays meet, in this order, before they go free.

    Attributes:
        source: The wave that comes to the first surface. A converging one is headed to its point
            behind that surface, or would be, were there no surface.
        surfaces: At least one.
    """

    source: PlaneWave | PointSource
    surfaces: tuple[OpticalSurface, ...]

    def __post_init__(self) -> None:
        """Check the fields."""
        if not self.surfaces:
            raise SpecError("surfaces: must be at least one, got none")

    @property
    def index(self) -> float:
        """Index of the medium after the last surface."""
        return self.indices[-1]

    @property
    def indices(self) -> tuple[float, ...]:
        """Index before the first surface, and after each."""
        found = [self.source.index]
        for surface in self.surfaces:
            after = surface.index_after
            found.append(found[-1] if after is None else after)
        return tuple(found)
