# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed of rigorous coupled-wave analysis, for ``bench``."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

WAVELENGTHS, ANGLES = 31, 64
HARMONICS, SLICES = 21, 20
_SAMPLE = 8
"""The plain loop solves one wave in so many and is scaled up."""


@dataclass(frozen=True)
class RcwaSpeed:
    """How long one table of 31 wavelengths x 64 angles x s and p with 21 harmonics takes.

    Attributes:
        name: What the grating is.
        seconds: All waves in one call, by the clock.
        loop_seconds: A plain loop over calls with one wave each, by the clock.
    """

    name: str
    seconds: float
    loop_seconds: float

    @property
    def ratio(self) -> float:
        """How many times quicker one call is than the loop."""
        return self.loop_seconds / self.seconds


def measure_rcwa(progress: Callable[[float], None] | None = None) -> list[RcwaSpeed]:
    """Solve the tables of one layer and of a slanted relief, in classical and in conical mount.

    Args:
        progress: Told the share that is done; it may raise to stop.

    Returns:
        One entry a table.
    """
    import numpy as np

    from ..core.rcwa import PlaneWaves, Stack, solve
    from ..core.rcwa.reliefs import binary, trapezoid
    from ..core.units import NM, UM

    colours = np.repeat(np.linspace(400.0, 700.0, WAVELENGTHS), ANGLES) * NM
    sines = np.tile(np.sin(np.radians(np.linspace(-60.0, 60.0, ANGLES))), WAVELENGTHS)
    reliefs = {
        "1 layer": Stack(binary(0.5 * UM)),
        f"{SLICES} slices, slanted": Stack(trapezoid(0.5 * UM, (0.0, 0.5), (0.4, 0.9), SLICES)),
    }
    cases = [
        (f"{name}, {mount}", stack, across)
        for mount, across in (("in plane", 0.0), ("conical", 0.2))
        for name, stack in reliefs.items()
    ]
    speeds: list[RcwaSpeed] = []
    for name, stack, across in cases:
        light = PlaneWaves.of(colours, (sines, across), 1.0 * UM, [2.25, 1.0], from_front=True)
        start = time.perf_counter()
        solve(stack, light, HARMONICS)
        middle = time.perf_counter()
        chosen = range(0, len(light), _SAMPLE)
        for index in chosen:
            solve(stack, light.only(np.array([index])), HARMONICS)
        loop = (time.perf_counter() - middle) * len(light) / len(chosen)
        speeds.append(RcwaSpeed(name, middle - start, loop))
        if progress is not None:
            progress(len(speeds) / len(cases))
    return speeds


def rcwa_lines(speeds: Sequence[RcwaSpeed]) -> list[str]:
    """Lines of a table of the speeds.

    Args:
        speeds: As measured.

    Returns:
        A heading, then a line for each.
    """
    what = f"rigorous table, {WAVELENGTHS} wavelengths x {ANGLES} angles x s and p"
    lines = [f"{what}, {HARMONICS} harmonics", f"{'':30}  {'s':>7}  {'loop s':>7}  {'ratio':>6}"]
    lines += [
        f"{x.name:30}  {x.seconds:7.2f}  {x.loop_seconds:7.1f}  {x.ratio:6.2f}" for x in speeds
    ]
    return lines
