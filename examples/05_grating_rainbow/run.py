# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a grating shows a line at 546.1 nm, measured in a rendered picture.

Claim: the picture shows the lamp's line at the angle that sin(a) - sin(b) = m wavelength / period
gives for orders 1 and 2, where b is the direction of the ray between grating and lamp.
"""

import argparse
import json
import math
import sys
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.blender.api import build_device, load_device  # noqa: E402
from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.blender.scene_measure import seen_direction  # noqa: E402
from hoe_addon.cli.claims import compare, report  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402
from hoe_addon.model.document import find_device  # noqa: E402
from hoe_addon.model.scene_view import gaze_of  # noqa: E402

PRESET: str = "grating_rainbow"
LINE_NM: float = 546.1
LINES_PER_MM: float = 300.0
GRATING_MM: float = 150.0
LAMP_MM: float = 1960.0
ORDERS: tuple[int, ...] = (1, 2)
FIELD_DEG: float = 3.0
SIZE: tuple[int, int] = (120, 60)
SAMPLES: int = 64
TOLERANCE_DEG: float = 0.01
EXPECTED: Path = HERE / "expected.json"


def measure() -> dict[str, float]:
    """Render the neighbourhood of each order, with a thin lamp that gives one line.

    Returns:
        Angles in degrees by name.
    """
    forget_removed_engines()
    found: dict[str, float] = {}
    for order in ORDERS:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        spec = load_device(
            PRESET,
            [
                "room.kind=none",
                f'elements.lamp.spectrum={{"kind": "line", "centre_nm": {LINE_NM}, "fwhm_nm": 1}}',
                "elements.lamp.size_mm=[4, 40]",
                "eye.pupil_diameter_mm=0.5",
                f"eye.field_deg={FIELD_DEG}",
                f"gaze_deg=[{round(angle_deg(order))}, 0]",
                f"render.size={list(SIZE)}",
                f"render.samples={SAMPLES}",
            ],
        )
        device = build_device(bpy.context.scene, spec, find_device(PRESET).parent)
        found[f"order {order}"] = gaze_of(seen_direction(device))[0]
    return found


def angle_deg(order: int) -> float:
    """Solve the grating equation together with the geometry by bisection.

    Args:
        order: Order that the eye looks into.

    Returns:
        Angle at the eye, degrees to the right.
    """
    low, high = 0.0, math.pi / 4.0
    for _ in range(100):
        angle = (low + high) / 2.0
        leaving = math.sin(angle) - order * LINE_NM * 1e-6 * LINES_PER_MM
        # Where the ray from the eye, bent by the grating, passes the lamp.
        beside = GRATING_MM * math.tan(angle)
        beside += (LAMP_MM - GRATING_MM) * math.tan(math.asin(leaving))
        low, high = (angle, high) if beside < 0.0 else (low, angle)
    return math.degrees(low)


def expected_numbers() -> list[dict[str, object]]:
    """The grating equation.

    Returns:
        Numbers as expected.json holds them.
    """
    return [
        {
            "name": f"order {order}",
            "unit": "deg",
            "value": round(angle_deg(order), 5),
            "allowed": TOLERANCE_DEG,
        }
        for order in ORDERS
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
            "source": "grating equation sin(a) - sin(b) = m wavelength / period, with the "
            "places of eye, grating and lamp, solved by bisection",
            "generated_by": "python examples/05_grating_rainbow/run.py --renew",
            "device": PRESET,
        },
        "tolerance": {
            "reason": "0.01 degree: 0.4 of a pixel of the measured picture, mostly the noise of "
            "the edge of a lamp image that is 5 pixels wide"
        },
        "numbers": expected_numbers(),
    }
    EXPECTED.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    print(f"{EXPECTED}: written")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/05_grating_rainbow"))
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out))
