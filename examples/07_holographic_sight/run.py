# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distance of a holographic sight's reticle, from two places of the pupil.

Claim: the directions in which two pupils 16 mm apart see the middle of the reticle meet where the
object point of the recording is, 50 m beyond the window: in numpy, and in rendered pictures.
"""

import argparse
import json
import sys
from pathlib import Path

import bpy
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.blender.api import build_device, load_device  # noqa: E402
from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.blender.scene_measure import seen_direction  # noqa: E402
from hoe_addon.cli.claims import compare, report  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402
from hoe_addon.model.document import find_device  # noqa: E402
from hoe_addon.model.scene_view import chief_ray, image_distance_mm  # noqa: E402

PRESET: str = "holographic_sight"
LASER_NM: float = 640.0
DESIGN_M: float = 50.22
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-8.0, 0.0, 0.0), (8.0, 0.0, 0.0))
FIELD_DEG: float = 0.2
SIZE: tuple[int, int] = (96, 96)
SAMPLES: int = 64
RELATIVE_TOLERANCE: float = 0.01
EXPECTED: Path = HERE / "expected.json"


def measure() -> dict[str, float]:
    """Find the distance with both engines.

    Returns:
        Distances in m by name.
    """
    forget_removed_engines()
    sight = load_device(PRESET)
    walked = [chief_ray(sight, "window", "reticle", pupil, LASER_NM) for pupil in PUPILS_MM]
    seen = [seen_from(pupil) for pupil in PUPILS_MM]
    return {
        "distance, numpy": image_distance_mm(PUPILS_MM, walked) * 1e-3,
        "distance, pictures": image_distance_mm(PUPILS_MM, seen) * 1e-3,
    }


def seen_from(pupil_mm: tuple[float, float, float]) -> np.ndarray:
    """Render a small white square in place of the reticle, and find its middle.

    Args:
        pupil_mm: Middle of the pupil.

    Returns:
        Direction from the pupil.
    """
    bpy.ops.wm.read_factory_settings(use_empty=True)
    spec = load_device(
        PRESET,
        [
            "room.kind=none",
            "elements.reticle.display.image=white",
            "elements.reticle.display.size_mm=[0.2, 0.2]",
            f"eye.position_mm={list(pupil_mm)}",
            "eye.pupil_diameter_mm=0.5",
            f"eye.field_deg={FIELD_DEG}",
            'elements.window.hologram.efficiency.table={"T": {"1": 1}, "R": {}}',
            "render.mode=preview",
            f"render.preview_wavelength_nm={LASER_NM}",
            f"render.size={list(SIZE)}",
            f"render.samples={SAMPLES}",
        ],
    )
    return seen_direction(build_device(bpy.context.scene, spec, find_device(PRESET).parent))


def expected_numbers() -> list[dict[str, object]]:
    """The design.

    Returns:
        Numbers as expected.json holds them.
    """
    return [
        {
            "name": f"distance, {engine}",
            "unit": "m",
            "value": DESIGN_M,
            "allowed": round(RELATIVE_TOLERANCE * DESIGN_M, 4),
        }
        for engine in ("numpy", "pictures")
    ]


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
            "source": "design: the object point of the recording is 50 m beyond the window, "
            "which is 0.22 m from the eye",
            "generated_by": "python examples/07_holographic_sight/run.py --renew",
            "device": PRESET,
        },
        "tolerance": {
            "reason": "1 % of the distance: 3.2e-6 rad between the two directions, a tenth of a "
            "pixel of the measured pictures"
        },
        "numbers": expected_numbers(),
    }
    EXPECTED.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(f"{EXPECTED}: written")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/07_holographic_sight"))
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out))
