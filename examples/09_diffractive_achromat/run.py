# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of a lens with a kinoform, of one without, and of the kinoform alone.

Claim: the focal lengths at the F, d and C lines, found by exact rays near the axis, are those of
the closed forms; and the kinoform has the Abbe number of diffraction, in numpy and in Cycles.
"""

import json
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import numpy as np  # noqa: E402
from msgspec.structs import replace  # noqa: E402

from hoe_addon.blender.api import load_device, trace_cycles  # noqa: E402
from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example  # noqa: E402
from hoe_addon.model.evaluate import trace  # noqa: E402
from hoe_addon.model.hologram import SideMedia  # noqa: E402
from hoe_addon.model.rays import RayTable  # noqa: E402
from hoe_addon.model.scene import SceneSpec  # noqa: E402
from hoe_addon.model.scene_lens import LensElement  # noqa: E402
from hoe_addon.model.scene_lens_walk import focal_length_mm  # noqa: E402

PRESET: str = "diffractive_achromat"
LINES_NM: dict[str, float] = {"F": 486.13, "d": 587.56, "C": 656.27}
SOURCE: str = (
    "closed forms: the lens maker's formula, V = -r^2 / (2 f) whose power goes as the wavelength, "
    "and two powers at a distance; with the Sellmeier coefficients of SCHOTT's datasheet of "
    "N-BK7; no ray and no code of the package"
)
REASON: str = (
    "in numpy 2e-6 of the value: the rays run at 0.04 mm, where spherical aberration is about "
    "5e-7; in Cycles 2e-3: directions are good to 2e-6 rad of 8 mrad, and the Abbe number needs a "
    "difference of a third of that"
)

HEIGHT_MM: float = 15.0
"""Of the rays through the kinoform alone, which turns them by 8 mrad."""

NUMPY_SHARE: float = 2e-6
CYCLES_SHARE: float = 2e-3

GLASS_B: tuple[float, ...] = (1.03961212, 0.231792344, 1.01046945)
GLASS_C_UM2: tuple[float, ...] = (0.00600069867, 0.0200179144, 103.560653)
"""N-BK7 by its maker, for the closed forms of expected.json."""


def measure() -> dict[str, float]:
    """Find all numbers by rays.

    Returns:
        Numbers by name.
    """
    lines = np.asarray(list(LINES_NM.values()))
    found: dict[str, float] = {}
    for name, orders in (("plain", {}), ("achromat", {"back": 1})):
        lengths = focal_length_mm(lens(name), lines, orders)
        for line, length in zip(LINES_NM, lengths, strict=True):
            found[f"{name} lens, f at {line}"] = float(length)
    found["kinoform's Abbe number, numpy"] = kinoform_abbe_number(trace)
    found["kinoform's Abbe number, Cycles"] = kinoform_abbe_number(trace_cycles)
    return found


def lens(name: str) -> LensElement:
    """One of the two lenses of the preset."""
    scene = load_device(PRESET)
    assert isinstance(scene, SceneSpec)
    found = scene.element(f"{name} lens")
    assert isinstance(found, LensElement)
    return found


def kinoform_abbe_number(engine: Any) -> float:
    """Abbe number of the kinoform alone, in air, by rays parallel to its axis.

    Args:
        engine: ``model.evaluate.trace`` or ``blender.api.trace_cycles``.

    Returns:
        phi_d / (phi_F - phi_C).
    """
    hologram = lens("achromat").hologram("back")
    assert hologram is not None
    rays = RayTable(
        np.tile((HEIGHT_MM, 0.0, 10.0), (3, 1)),
        np.tile((0.0, 0.0, -1.0), (3, 1)),
        np.asarray(list(LINES_NM.values())),
        np.ones(3, dtype=np.int64),
        np.zeros(3, dtype=np.bool_),
    )
    # The sine of the turn is exactly the slope of V times the wavelength ratio.
    power = -engine(replace(hologram, media=SideMedia("air", "air")), rays).direction[:, 0]
    return float(power[1] / (power[0] - power[2]))


def expected_numbers() -> list[Row]:
    """Closed forms: no ray, and no code of the package's optics."""
    scene = json.loads((HERE.parents[1] / "presets" / f"{PRESET}.json").read_text("utf-8"))
    plain, hybrid = (
        next(item for item in scene["elements"] if item["name"] == f"{name} lens")
        for name in ("plain", "achromat")
    )
    (square,) = hybrid["back"]["hologram"]["characteristic"]["coefficients"]
    rows: list[Row] = []
    for line, nm in LINES_NM.items():
        power = (index(nm) - 1.0) / -plain["front"]["radius_mm"]
        rows.append(rounded(f"plain lens, f at {line}", "mm", 1.0 / power, NUMPY_SHARE))
    for line, nm in LINES_NM.items():
        glass = (index(nm) - 1.0) / -hybrid["front"]["radius_mm"]
        kinoform = -2.0 * square * nm / LINES_NM["d"]
        power = glass + kinoform - glass * kinoform * hybrid["thickness_mm"] / index(nm)
        rows.append(rounded(f"achromat lens, f at {line}", "mm", 1.0 / power, NUMPY_SHARE))
    abbe = LINES_NM["d"] / (LINES_NM["F"] - LINES_NM["C"])
    for engine, share in (("numpy", NUMPY_SHARE), ("Cycles", CYCLES_SHARE)):
        rows.append(rounded(f"kinoform's Abbe number, {engine}", "", abbe, share))
    return rows


def rounded(name: str, unit: str, value: float, share: float) -> Row:
    """One number that may be off by a share of it."""
    return row(name, unit, round(value, 6), float(f"{abs(value) * share:.2g}"))


def index(wavelength_nm: float) -> float:
    """Index of N-BK7 by its Sellmeier formula."""
    square = (wavelength_nm * 1e-3) ** 2
    terms = (b * square / (square - c) for b, c in zip(GLASS_B, GLASS_C_UM2, strict=True))
    return (1.0 + sum(terms)) ** 0.5


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, measure, expected_numbers)

if __name__ == "__main__":
    sys.exit(EXAMPLE.run(__doc__))
