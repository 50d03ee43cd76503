# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Focal length of a holographic lens at three wavelengths, in numpy and in Cycles.

Claim: a lens recorded with a point at f and a plane wave of wavelength l0 has the focal length
f l0 / l at the wavelength l. Rays parallel to the axis are sent through it near its middle.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.blender.trace import trace_cycles  # noqa: E402
from hoe_addon.cli.claims import compare, report  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402
from hoe_addon.model.document import load_device  # noqa: E402
from hoe_addon.model.evaluate import trace  # noqa: E402
from hoe_addon.model.scene_view import TraceEngine, pass_hologram  # noqa: E402

PRESET: str = "point_lens"
ELEMENT: str = "lens"
WAVELENGTHS_NM: tuple[float, ...] = (460.0, 532.0, 630.0)
RECORDED_NM: float = 532.0
RECORDED_MM: float = 100.0
HEIGHT_MM: float = 2.0
EXPECTED: Path = HERE / "expected.json"
RELATIVE_TOLERANCE: float = 1e-3


def measure() -> dict[str, float]:
    """Find the focal lengths with both engines.

    Returns:
        Focal lengths in mm by name.
    """
    forget_removed_engines()
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


def expected_numbers() -> list[dict[str, object]]:
    """The closed form.

    Returns:
        Numbers as expected.json holds them.
    """
    numbers: list[dict[str, object]] = []
    for engine in ("numpy", "Cycles"):
        for wavelength in WAVELENGTHS_NM:
            focal = RECORDED_MM * RECORDED_NM / wavelength
            numbers.append(
                {
                    "name": f"f({wavelength:g} nm), {engine}",
                    "unit": "mm",
                    "value": round(focal, 4),
                    "allowed": round(RELATIVE_TOLERANCE * focal, 4),
                }
            )
    return numbers


def main(output: Path) -> int:
    """Measure and compare.

    Args:
        output: Folder for numbers.json.

    Returns:
        0 if every number is as expected, else 1.
    """
    folder = writable_folder(output)
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))
    return report(compare(expected, measure()), folder / "numbers.json")


def renew() -> int:
    """Write expected.json by formulas that share nothing with the add-on."""
    document = {
        "provenance": {
            "source": "closed form f = 100 mm x 532 nm / wavelength, paraxial",
            "generated_by": "python examples/04_point_lens/run.py --renew",
            "device": PRESET,
        },
        "tolerance": {
            "reason": "0.1 %: at 2 mm from the axis the spherical aberration of another "
            "wavelength is 0.02 %, and 2e-6 rad, what float32 can hold, is 0.01 % of "
            "the slope"
        },
        "numbers": expected_numbers(),
    }
    EXPECTED.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(f"{EXPECTED}: written")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/04_point_lens"))
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out))
