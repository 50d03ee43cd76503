# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look through a three-hologram light guide, and check its luminance at five pupils.

Claim: Cycles, which walks light backward from the eye, and a forward walk in numpy from the
display agree about a white picture in the middle of the eyebox and at its four sides: expander and
out-coupler have replicated the pupil in both dimensions.
"""

import argparse
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import bpy  # noqa: E402

from hoe_addon.blender.api import build_device, load_device  # noqa: E402
from hoe_addon.blender.eyebox import fields_at  # noqa: E402
from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.cli.claims import Claim, report  # noqa: E402
from hoe_addon.files import writable_folder, write_text  # noqa: E402
from hoe_addon.model.device_walk import eyebox_luminance  # noqa: E402
from hoe_addon.model.document import find_device  # noqa: E402
from hoe_addon.model.eyebox import PupilPosition  # noqa: E402

PRESET: str = "three_hologram_ar"
PUPILS_MM: tuple[tuple[float, float, float], ...] = (
    (0.0, 0.0, 0.0),
    (-5.0, 0.0, 0.0),
    (5.0, 0.0, 0.0),
    (0.0, 3.5, 0.0),
    (0.0, -3.5, 0.0),
)
SAMPLES: int = 96
EXPECTED: Path = HERE / "expected.json"

WALK_RAYS: int = 100_000
WALK_SEED: int = 1
WEIGHT_CUT: float = 1e-5
RELATIVE_TOLERANCE: float = 0.05
STANDARD_ERRORS: float = 3.0


def main(output: Path, samples: int) -> int:
    """Measure and compare.

    Args:
        output: Folder for numbers.json.
        samples: Samples per cell of the measurement, at least 4.

    Returns:
        0 if every luminance is as expected, else 1.
    """
    forget_removed_engines()
    folder = writable_folder(output)
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    device = build_device(bpy.context.scene, load_device(PRESET), find_device(PRESET).parent)
    rows = expected["pupils"]
    places = [PupilPosition(n, 0, tuple(row["position_mm"])) for n, row in enumerate(rows)]
    claims: list[Claim] = []
    for row, field in zip(rows, fields_at(device, places, samples), strict=True):
        x, y, _ = row["position_mm"]
        allowed = expected["tolerance"]["relative"] * row["mean_cd_m2"]
        allowed += expected["tolerance"]["standard_errors"] * field.standard_error_cd_m2
        claims.append(
            Claim(
                f"pupil at {x:g}, {y:g} mm", "cd/m2", row["mean_cd_m2"], field.mean_cd_m2, allowed
            )
        )
    return report(claims, folder / "numbers.json")


def renew() -> int:
    """Write expected.json by a forward walk in numpy, which shares no code with Cycles."""
    walk = eyebox_luminance(
        load_device(PRESET), PUPILS_MM, rays=WALK_RAYS, seed=WALK_SEED, weight_cut=WEIGHT_CUT
    )
    document = {
        "provenance": {
            "source": "hoe_addon.model.device_walk.eyebox_luminance: rays from the display "
            "forward to the pupil, numpy, float64, without Cycles",
            "generated_by": "python examples/03_three_hologram_ar/run.py --renew",
            "device": PRESET,
            "rays": WALK_RAYS,
            "seed": WALK_SEED,
            "digits": "means to 0.1 cd/m2, standard errors to 0.01 cd/m2",
        },
        "tolerance": {
            "relative": RELATIVE_TOLERANCE,
            "standard_errors": STANDARD_ERRORS,
            "reason": "the two engines are promised to agree within 5 %; on top of it the noise "
            "of the render, so that few samples are enough",
        },
        "pupils": [
            {
                "position_mm": list(position),
                "mean_cd_m2": round(float(mean), 1),
                "standard_error_cd_m2": round(float(error), 2),
            }
            for position, mean, error in zip(
                PUPILS_MM, walk.mean_cd_m2, walk.error_cd_m2, strict=True
            )
        ],
    }
    write_text(EXPECTED, (json.dumps(document, indent=2), "\n"))
    print(f"{EXPECTED}: written")
    return 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/03_three_hologram_ar"))
    parser.add_argument("--samples", type=int, default=SAMPLES)
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out, arguments.samples))
