# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Focal length of a holographic lens at three wavelengths, in numpy and in Cycles.

Claim: a lens recorded with a point at f and a plane wave of wavelength l0 has the focal length
f l0 / l at the wavelength l. Rays parallel to the axis are sent through it near its middle.
"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.blender.pictures.trace import trace_cycles  # noqa: E402
from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.model.document import load_device  # noqa: E402
from hoe_addon.model.evaluate import trace  # noqa: E402
from hoe_addon.model.scene_view import TraceEngine, pass_hologram  # noqa: E402

PRESET: str = "point_lens"
ELEMENT: str = "lens"
WAVELENGTHS_NM: tuple[float, ...] = (460.0, 532.0, 630.0)
RECORDED_NM: float = 532.0
RECORDED_MM: float = 100.0
HEIGHT_MM: float = 2.0
RELATIVE_TOLERANCE: float = 1e-3
SOURCE: str = "closed form f = 100 mm x 532 nm / wavelength, paraxial"
REASON: str = (
    "0.1 %: at 2 mm from the axis the spherical aberration of another wavelength is 0.02 %, and "
    "2e-6 rad, what float32 can hold, is 0.01 % of the slope"
)


def measure() -> dict[str, float]:
    """Find the focal lengths with both engines.

    Returns:
        Focal lengths in mm by name.
    """
    return {
        f"f({wavelength:g} nm), {name}": focal_length_mm(wavelength, engine)
        for name, engine in (("numpy", trace), ("Cycles", trace_cycles))
        for wavelength in WAVELENGTHS_NM
    }


def focal_length_mm(wavelength_nm: float, engine: TraceEngine) -> float:
    """Send four rays parallel to the axis, and see where they cross it.

    Args:
        wavelength_nm: Vacuum wavelength.
        engine: What traces the rays.

    Returns:
        Mean distance from the lens to the crossing, mm.
    """
    lens = load_device(PRESET).hologram(ELEMENT)
    around = HEIGHT_MM * np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]])
    start = around + np.array(lens.position_mm) - (0.0, 0.0, 50.0)
    heading = np.tile((0.0, 0.0, 1.0), (4, 1))
    hit, onward = pass_hologram(lens, start, heading, wavelength_nm, 1, engine=engine)
    inward = -np.sum(onward * around, axis=1) / HEIGHT_MM
    return float(np.mean(np.linalg.norm(hit[:, :2], axis=1) * onward[:, 2] / inward))


def expected_numbers() -> list[Row]:
    """The closed form."""
    focal_mm = {nm: RECORDED_MM * RECORDED_NM / nm for nm in WAVELENGTHS_NM}
    return [
        row(f"f({nm:g} nm), {name}", "mm", round(f, 4), round(RELATIVE_TOLERANCE * f, 4))
        for name in ("numpy", "Cycles")
        for nm, f in focal_mm.items()
    ]


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
