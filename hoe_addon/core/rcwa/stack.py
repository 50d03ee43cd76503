# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a one-dimensional grating is made of: layers between two half spaces.

x runs along the grating vector and is counted in periods; z runs from the back to the front, in
metres. Materials are named by their place in a list, so that one geometry serves all wavelengths:
the permittivities come with the light.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import ComplexArray, FloatArray
from ..errors import SpecError

BACK = 0
"""Material of the half space z < 0."""
FRONT = 1
"""Material of the half space beyond the last layer."""


@dataclass(frozen=True, eq=False)
class Uniform:
    """A layer of one material.

    Attributes:
        material: Place of the material in the list.
    """

    material: int

    @property
    def materials(self) -> tuple[int, ...]:
        """All materials of the layer."""
        return (self.material,)

    @property
    def varies(self) -> bool:
        """Whether anything changes along x."""
        return False


@dataclass(frozen=True, eq=False)
class Lamellar:
    """Walls along z between stretches of one material each.

    Attributes:
        walls: Where the stretches begin, in periods, ascending, within one period; shape ``(J,)``.
        materials: Material from each wall to the next; the last one reaches round to the first.
    """

    walls: FloatArray
    materials: tuple[int, ...]

    def __post_init__(self) -> None:
        """Check the walls."""
        count = len(self.materials)
        if self.walls.shape != (count,) or count < 2:
            raise SpecError(f"walls: must be one for each of 2 or more materials, got {count}")
        steps = np.diff(self.walls, append=self.walls[0] + 1.0)
        if not np.all(np.isfinite(self.walls)) or np.any(steps < 0.0):
            raise SpecError("walls: must ascend within one period")

    @property
    def varies(self) -> bool:
        """Whether anything changes along x."""
        return True

    def coefficients(self, highest: int) -> ComplexArray:
        """Fourier coefficients of the share of each stretch.

        Args:
            highest: Highest harmonic H.

        Returns:
            Coefficients of ``exp(2 pi i m x)`` for m = -H .. H, shape ``(J, 2 H + 1)``.
        """
        order = np.arange(-highest, highest + 1)
        begin, end = self.walls, np.append(self.walls[1:], self.walls[0] + 1.0)
        width, middle = (end - begin)[:, None], 0.5 * (begin + end)[:, None]
        turn: ComplexArray = np.exp(-2j * np.pi * order * middle)
        return turn * width * np.sinc(order * width)


@dataclass(frozen=True, eq=False)
class Smooth:
    """A permittivity without jumps: a sum of materials' permittivities times Fourier series.

    Attributes:
        materials: Materials of the sum. One may be a mere number, such as the amplitude of a wave.
        series: Fourier coefficients of each, for m = -H .. H, shape ``(J, 2 H + 1)``.
    """

    materials: tuple[int, ...]
    series: ComplexArray

    @property
    def varies(self) -> bool:
        """Whether anything changes along x."""
        return self.series.shape[1] > 1

    def coefficients(self, highest: int) -> ComplexArray:
        """Fourier coefficients as of `Lamellar.coefficients`, cut or filled with zeros."""
        own = self.series.shape[1] // 2
        result = np.zeros((len(self.materials), 2 * highest + 1), dtype=np.complex128)
        kept = min(own, highest)
        result[:, highest - kept : highest + kept + 1] = self.series[:, own - kept : own + kept + 1]
        return result


type Pattern = Uniform | Lamellar | Smooth


@dataclass(frozen=True, eq=False)
class Layer:
    """One layer. Layers that share one pattern object share its eigenproblem.

    Attributes:
        pattern: What the layer is along x.
        thickness: Metres, at least 0.
        shift: How far the pattern is moved toward +x, in periods.
    """

    pattern: Pattern
    thickness: float
    shift: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        if not (np.isfinite(self.thickness) and self.thickness >= 0.0):
            raise SpecError(f"thickness: must be at least 0, got {self.thickness}")
        if not np.isfinite(self.shift):
            raise SpecError(f"shift: must be finite, got {self.shift}")

    @property
    def materials(self) -> tuple[int, ...]:
        """All materials of the layer."""
        return self.pattern.materials

    @property
    def solids(self) -> tuple[int, ...]:
        """Materials that fill a place, so that their permittivity cannot be 0."""
        return () if isinstance(self.pattern, Smooth) else self.materials

    def turned(self) -> "Layer":
        """The layer seen from the other side."""
        return self

    def plane_part(self) -> "tuple[Layer, ...]":
        """The layer if it does not vary along x."""
        return () if self.pattern.varies else (self,)


@dataclass(frozen=True, eq=False)
class Repeat:
    """Layers that follow one another many times; joined by doubling.

    Attributes:
        layers: From the back to the front.
        count: How many times, at least 1.
        step: How far each copy is moved toward +x against the one behind it, in periods.
    """

    layers: tuple[Layer, ...]
    count: int
    step: float = 0.0

    def __post_init__(self) -> None:
        """Check the numbers."""
        if self.count < 1 or not self.layers:
            raise SpecError(f"count: must be at least 1 of at least 1 layer, got {self.count}")
        if not np.isfinite(self.step):
            raise SpecError(f"step: must be finite, got {self.step}")

    @property
    def materials(self) -> tuple[int, ...]:
        """All materials of the layers."""
        return tuple(material for layer in self.layers for material in layer.materials)

    @property
    def solids(self) -> tuple[int, ...]:
        """Materials that fill a place, so that their permittivity cannot be 0."""
        return tuple(material for layer in self.layers for material in layer.solids)

    def turned(self) -> "Repeat":
        """The same layers seen from the other side."""
        far = self.step * (self.count - 1)
        layers = (Layer(x.pattern, x.thickness, x.shift + far) for x in reversed(self.layers))
        return Repeat(tuple(layers), self.count, -self.step)

    def plane_part(self) -> "tuple[Repeat, ...]":
        """The layers that do not vary along x, as often."""
        plane = tuple(layer for layer in self.layers if layer.plane_part())
        return (Repeat(plane, self.count, self.step),) if plane else ()


@dataclass(frozen=True, eq=False)
class Stack:
    """All layers from the back to the front, and the two half spaces.

    Attributes:
        layers: From the back to the front.
        back: Material of the half space behind.
        front: Material of the half space before.
    """

    layers: Sequence[Layer | Repeat] = ()
    back: int = BACK
    front: int = FRONT

    @property
    def material_count(self) -> int:
        """How many permittivities the light has to bring."""
        used = {self.back, self.front}
        for layer in self.layers:
            used.update(layer.materials)
        return max(used) + 1

    @property
    def solids(self) -> tuple[int, ...]:
        """Materials that fill a place, so that their permittivity cannot be 0; ascending."""
        return tuple(sorted({self.back, self.front}.union(*(x.solids for x in self.layers))))

    def plane_part(self) -> "Stack":
        """The layers that do not vary along x, closed up."""
        plane = tuple(part for layer in self.layers for part in layer.plane_part())
        return Stack(plane, self.back, self.front)

    def turned(self) -> "Stack":
        """The same stack seen from the other side: z runs backward, x stays."""
        layers = tuple(layer.turned() for layer in reversed(self.layers))
        return Stack(layers, back=self.front, front=self.back)
