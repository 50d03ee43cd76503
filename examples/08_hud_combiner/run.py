# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distance of a head-up display's picture, from two places of the eye.

Claim: the directions in which two pupils 60 mm apart see the middle of the display meet 10 m ahead,
where the recording put it: in numpy, and in pictures rendered through the curved windshield.
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

PRESET: str = "hud_combiner"
GREEN_NM: float = 532.0
DESIGN_M: float = 10.0
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-30.0, 0.0, 0.0), (30.0, 0.0, 0.0))
GAZE_DEG: tuple[float, float] = (0.0, -5.0)
FIELD_DEG: float = 0.8
SIZE: tuple[int, int] = (160, 120)
SAMPLES: int = 16
RELATIVE_TOLERANCE: float = 0.01
EXPECTED: Path = HERE / "expected.json"


def measure() -> dict[str, float]:
    """Find the distance with both engines.

    Returns:
        Distances in m by name.
    """
    forget_removed_engines()
    hud = load_device(PRESET)
    walked = [
        chief_ray(hud, "combiner", "display", pupil, GREEN_NM, reflected=True)
        for pupil in PUPILS_MM
    ]
    seen = [seen_from(pupil) for pupil in PUPILS_MM]
    return {
        "distance, numpy": image_distance_mm(PUPILS_MM, walked) * 1e-3,
        "distance, pictures": image_distance_mm(PUPILS_MM, seen) * 1e-3,
    }


def seen_from(pupil_mm: tuple[float, float, float]) -> np.ndarray:
    """Render a small white square in the middle of the display, and find where it is seen.

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
            "elements.display.display.image=white",
            "elements.display.display.size_mm=[0.2, 0.2]",
            f"eye.position_mm={list(pupil_mm)}",
            "eye.pupil_diameter_mm=0.5",
            f"eye.field_deg={FIELD_DEG}",
            f"gaze_deg={list(GAZE_DEG)}",
            'elements.combiner.hologram.efficiency.table={"T": {}, "R": {"1": 1}}',
            "render.mode=preview",
            f"render.preview_wavelength_nm={GREEN_NM}",
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
    """Write expected.json by the design alone."""
    document = {
        "provenance": {
            "source": "design: the object point of the recording is 10 m from the middle of the "
            "eyebox; no ray is needed to know it",
            "generated_by": "python examples/08_hud_combiner/run.py --renew",
            "device": PRESET,
        },
        "tolerance": {
            "reason": "1 % of the distance: 6e-5 rad between the two directions, seven tenths of a "
            "pixel of the measured pictures"
        },
        "numbers": expected_numbers(),
    }
    EXPECTED.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(f"{EXPECTED}: written")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/08_hud_combiner"))
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out))
