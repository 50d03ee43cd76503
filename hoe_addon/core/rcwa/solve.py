# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigorous coupled-wave analysis of a stack for many plane waves at once."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from functools import partial, reduce

import numpy as np

from ..arrays import ComplexArray, FloatArray, IntArray
from ..errors import SpecError
from ..units import m_to_nm
from .blas import one_thread
from .factorisation import SingularError
from .halfspace import HalfSpace
from .light import PlaneWaves, Solution
from .modes import LseModes, LsmModes, conical_modes, lse_modes, lsm_modes
from .runs import Kept, Run, equal_runs
from .scattering import Channel, Reference, Scatter, layer_scatter, repeated, star, uniform_scatter
from .stack import Layer, Pattern, Repeat, Stack, Uniform

type Progress = Callable[[float], None]
"""Told the share that is done, 0 to 1; it may raise `CancelledError` to stop the work."""

CLASSICAL = 1e-9
"""|beta| up to this is taken as 0: s and p then decouple, and their mixing is below 1e-9."""

MAX_HARMONICS = 2001
"""Most harmonics that may be asked for: 20 matrices of 4002 x 4002 fill 5 gigabytes."""

_CHUNK_BYTES = 64_000_000
"""Memory of the matrices of the waves that are solved for together."""
_MATRICES = 20
"""Matrices of one wave that are held at the same time."""
_CHUNK_WAVES = 256
"""More waves at a time do not make the linear algebra quicker, only Ctrl-C slower."""
_GRAZING = 1e-12
"""Light may be this far (relative) beyond grazing by rounding."""
_CHUNK_ENTRIES = 20_000
"""Unless the matrices are tiny: then this many entries of one matrix of all waves."""
THREADS_FROM = 151
"""From so many harmonics on the matrices are worth several threads."""
_DOUBLE_FROM = 5
"""Runs of fewer equal layers are joined one by one."""


def solve(
    stack: Stack,
    light: PlaneWaves,
    harmonics: int,
    progress: Progress | None = None,
    *,
    about_zero: bool = False,
) -> Solution:
    """Solve for all orders.

    The harmonics are those that lie next to the normal of the grating: so light that is sent back
    along an order meets the same ones, and the results are reciprocal to rounding however few they
    are. The order 0 is always among them.

    Args:
        stack: The layers.
        light: The waves; those of one call may differ in everything.
        harmonics: Number of harmonics, odd.
        progress: Told how far the work is.
        about_zero: Take the harmonics next to the order 0 instead, as most papers do.

    Returns:
        Amplitudes and efficiencies of both polarisations.

    Raises:
        SpecError: If the number of harmonics is even or out of range, a permittivity is missing
            or 0, or the light comes out of an absorbing half space or past its grazing angle.
        SingularError: If the permittivities of a layer cancel.
    """
    _check(stack, light, harmonics)
    count, highest = len(light), harmonics // 2
    centre = np.zeros(count, dtype=np.int64)
    if not about_zero:
        offset = np.divide(-light.along, light.step, where=light.step > 0.0, out=np.zeros(count))
        centre = np.clip(np.rint(offset), -highest, highest).astype(np.int64)
    first, last = (int(f(centre, initial=0)) for f in (np.min, np.max))
    result = Solution.empty(count, first - highest, last + highest)
    done = 0
    for chosen, conical in _chunks(light, harmonics):
        part = light.only(chosen)
        seen = stack if bool(part.from_front[0]) else stack.turned()
        problem = _Problem(seen, part, centre[chosen], highest)
        with one_thread() if harmonics < THREADS_FROM else nullcontext():
            try:
                for channel in (Channel.BOTH,) if conical else (Channel.ALONG, Channel.ACROSS):
                    problem.solve(channel)
            except SingularError as error:
                raise SingularError(f"{error}, {_at(part)}") from error
        places = centre[chosen, None] - first + np.arange(harmonics)
        for target, values in zip(result.arrays, problem.results(), strict=True):
            target[chosen[:, None], places] = values
        done += len(chosen)
        if progress is not None:
            progress(done / count)
    return result


def _check(stack: Stack, light: PlaneWaves, harmonics: int) -> None:
    if harmonics % 2 == 0 or not 1 <= harmonics <= MAX_HARMONICS:
        rule = f"must be odd and from 1 to {MAX_HARMONICS}"
        raise SpecError(f"harmonics: {rule}, got {harmonics}")
    if light.permittivity.shape[1] < stack.material_count:
        rule = f"must be given for {stack.material_count} materials"
        raise SpecError(f"permittivity: {rule}, got {light.permittivity.shape[1]}")
    for material in stack.solids:
        if not light.permittivity[:, material].all():
            raise SpecError(f"permittivity: must not be 0, got 0 for material {material}")
    ends: ComplexArray = np.where(
        light.from_front,
        light.permittivity[:, stack.front],
        light.permittivity[:, stack.back],
    )
    if np.any(ends.imag != 0.0) or np.any(ends.real <= 0.0):
        raise SpecError("permittivity: the light must come out of a lossless half space")
    size = np.hypot(light.along, light.across)
    beyond = size > np.sqrt(ends.real) * (1.0 + _GRAZING)
    if np.any(beyond):
        worst = int(np.argmax(size / np.sqrt(ends.real)))
        index = float(np.sqrt(ends[worst].real))
        raise SpecError(
            f"tangential part: must be at most the index {index:g}, got {size[worst]:g}"
        )


def _at(light: PlaneWaves) -> str:
    """Where something happens, in words."""
    first, last = (float(m_to_nm(f(light.wavelength))) for f in (np.min, np.max))
    return f"got {first:g} nm" if first == last else f"got one from {first:g} to {last:g} nm"


def _chunks(light: PlaneWaves, harmonics: int) -> list[tuple[IntArray, bool]]:
    """Waves to solve for together: one side, one mount, and no more than memory allows."""
    classical = np.abs(light.across) <= CLASSICAL
    chunks: list[tuple[IntArray, bool]] = []
    for conical in (False, True):
        size = harmonics * (2 if conical else 1)
        length = int(_CHUNK_BYTES / (16 * _MATRICES * size**2))
        length = min(max(length, 1), max(_CHUNK_WAVES, _CHUNK_ENTRIES // size**2))
        for front in (False, True):
            chosen = np.flatnonzero((classical != conical) & (light.from_front == front))
            starts = range(0, len(chosen), length)
            chunks += [(chosen[start : start + length], conical) for start in starts]
    return chunks


class _Problem:
    """One chunk of waves that come from the front of a stack."""

    def __init__(self, stack: Stack, light: PlaneWaves, centre: IntArray, highest: int) -> None:
        self._layers = stack.layers
        self._table = light.permittivity
        self._k0 = 2.0 * np.pi / light.wavelength
        orders = centre[:, None] + np.arange(-highest, highest + 1)
        self._alpha = light.along[:, None] + orders * light.step[:, None]
        flat = np.abs(light.across) <= CLASSICAL
        self._beta = np.where(flat, 0.0, light.across)
        front, back = self._table[:, stack.front], self._table[:, stack.back]
        self._reference = Reference.of(self._alpha, back, front)
        at, rest = (self._alpha, self._beta), (self._reference, highest - centre)
        self._front = HalfSpace.of(*at, front, *rest, lit=True)
        self._back = HalfSpace.of(*at, back, *rest, lit=False)
        self._up = np.zeros((*self._alpha.shape, 2, 2), dtype=np.complex128)
        self._down = np.zeros_like(self._up)

    def solve(self, channel: Channel) -> None:
        """Find the waves that leave in one channel."""
        gamma = self._back.reflection(channel)
        one = np.eye(gamma.shape[1])
        through = np.broadcast_to(one, gamma.shape)
        for part in self._parts(self._layers, channel):
            inside = np.linalg.solve(one - part.bottom @ gamma, part.down)
            gamma = part.top + part.up @ (gamma @ inside)
            through = through @ inside
        _, v = self._front.incident()
        source = _flat(2.0 * self._front.accept(v), channel)
        down = np.linalg.solve(one - self._front.reflection(channel) @ gamma, source)
        _spread(2.0 * (gamma @ down), self._up, channel)
        _spread(2.0 * (through @ down), self._down, channel)

    def _parts(self, layers: Sequence[Layer | Repeat], channel: Channel) -> Iterator[Scatter]:
        """Scattering matrices from the back to the front."""
        runs = equal_runs(layers)
        kinds = [(r.layer.pattern, r.layer.thickness) for r in runs if isinstance(r, Run)]
        known = Kept[tuple[Pattern, float], Scatter](kinds)
        # Modes do not depend on the thickness, so layers of one pattern share them.
        lse = Kept[Pattern, LseModes](pattern for pattern, _ in set(kinds))
        lsm = Kept[Pattern, LsmModes](pattern for pattern, _ in set(kinds))
        both = Kept[Pattern, tuple[LseModes, LsmModes]](pattern for pattern, _ in set(kinds))

        def make(layer: Layer) -> Scatter:
            at, pattern = (layer.pattern, self._alpha, self._table), layer.pattern
            waves = (layer.thickness * self._k0, self._beta, self._reference)
            if channel is Channel.ALONG:
                return layer_scatter(lse.get(pattern, lambda: lse_modes(*at)), None, *waves)
            if channel is Channel.ACROSS:
                return layer_scatter(None, lsm.get(pattern, lambda: lsm_modes(*at)), *waves)
            if isinstance(pattern, Uniform):
                return uniform_scatter(self._table[:, pattern.material], self._alpha, *waves)
            return layer_scatter(*both.get(pattern, lambda: conical_modes(*at)), *waves)

        for run in runs:
            if isinstance(run, Repeat):
                upward = self._parts(run.layers, channel)
                cell = reduce(lambda lower, upper: star(upper, lower), upward)
                yield _climbed(cell, run.count, run.step, 0.0)
                continue
            layer = run.layer
            part = known.get((layer.pattern, layer.thickness), partial(make, layer))
            if run.count >= _DOUBLE_FROM:
                yield _climbed(part, run.count, run.step, layer.shift)
                continue
            for place in range(run.count):
                yield part.moved(layer.shift + place * run.step)

    def results(self) -> tuple[ComplexArray, ComplexArray, FloatArray, FloatArray]:
        """Amplitudes and efficiencies, reflected and transmitted."""
        u, v = self._front.incident()
        reflected = self._front.leaving(self._up + v - u)
        transmitted = self._back.leaving(self._down)
        power = self._front.supply[:, None, None]
        return (
            reflected,
            transmitted,
            self._front.power(reflected) / power,
            self._back.power(transmitted) / power,
        )


def _climbed(part: Scatter, count: int, step: float, lowest: float) -> Scatter:
    """Copies on one another, with the shift of the lowest and the step to the next above."""
    return repeated(part, count, -step).moved(lowest + step * (count - 1))


def _flat(fields: ComplexArray, channel: Channel) -> ComplexArray:
    """Fields of shape ``(B, n, 2, J)`` as the columns of a channel, ``(B, K, J)``."""
    if channel is Channel.BOTH:
        return np.concatenate((fields[:, :, 0], fields[:, :, 1]), axis=1)
    return fields[:, :, 1] if channel is Channel.ALONG else fields[:, :, 0]


def _spread(columns: ComplexArray, fields: ComplexArray, channel: Channel) -> None:
    """Write columns of a channel, the inverse of `_flat`."""
    count = fields.shape[1]
    if channel is not Channel.ALONG:
        fields[:, :, 0] = columns[:, :count]
    if channel is not Channel.ACROSS:
        fields[:, :, 1] = columns[:, -count:]
