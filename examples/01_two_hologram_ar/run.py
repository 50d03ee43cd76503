# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look through a two-hologram light guide, and check its luminance at three pupils.

Claim: Cycles, which walks light backward from the eye, and a forward walk in numpy from the
display give the same luminance of a white picture, at both ends of the eyebox and in the middle.
"""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import bpy  # noqa: E402

from hoe_addon.blender.api import build_device, load_device, render_view, save_view  # noqa: E402
from hoe_addon.blender.eyebox import FieldLuminance, fields_at  # noqa: E402
from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.files import writable_folder, write_text  # noqa: E402
from hoe_addon.model.device_walk import eyebox_luminance  # noqa: E402
from hoe_addon.model.document import find_device  # noqa: E402
from hoe_addon.model.eyebox import PupilPosition  # noqa: E402

PRESET: str = "two_hologram_ar"
SIZE: tuple[int, int] = (160, 120)
SAMPLES: int = 64
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-9, 0, 0), (0, 0, 0), (9, 0, 0))
EXPECTED: Path = HERE / "expected.json"

WALK_RAYS: int = 400_000
WALK_SEED: int = 1
RELATIVE_TOLERANCE: float = 0.05
STANDARD_ERRORS: float = 3.0


def main(output: Path, samples: int) -> int:
    """Render, measure and compare.

    Args:
        output: Folder for view.exr, view.png, view.blend, metrics.json and luminance.json.
        samples: Samples per pixel of the view and per cell of the measurement, at least 4.

    Returns:
        0 if every luminance is as expected, else 1.
    """
    forget_removed_engines()
    folder = writable_folder(output)
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    spec = load_device(PRESET, [f"render.size={list(SIZE)}", f"render.samples={samples}"])
    device = build_device(bpy.context.scene, spec, find_device(PRESET).parent)
    save_view(device, render_view(device), folder, clean=True)

    rows = expected["pupils"]
    places = [PupilPosition(n, 0, tuple(row["position_mm"])) for n, row in enumerate(rows)]
    found = fields_at(device, places, samples)
    report = [
        compare(row, field, expected["tolerance"]) for row, field in zip(rows, found, strict=True)
    ]
    write_text(folder / "luminance.json", (json.dumps(report, indent=2), "\n"))
    show(report)
    print(f"{folder}: view.exr, view.png, view.blend, metrics.json, luminance.json")
    return 0 if all(row["as_expected"] for row in report) else 1


def compare(
    expected: dict[str, Any], found: FieldLuminance, tolerance: dict[str, Any]
) -> dict[str, Any]:
    """Set a measured luminance beside the expected one.

    Args:
        expected: One pupil of expected.json.
        found: What Cycles shows there.
        tolerance: How far they may be apart.

    Returns:
        Both, and whether they agree, in cd/m^2.
    """
    wanted = expected["mean_cd_m2"]
    allowed = (
        tolerance["relative"] * wanted + tolerance["standard_errors"] * found.standard_error_cd_m2
    )
    return {
        "position_mm": expected["position_mm"],
        "expected_cd_m2": wanted,
        "cycles_cd_m2": found.mean_cd_m2,
        "cycles_standard_error_cd_m2": found.standard_error_cd_m2,
        "allowed_cd_m2": allowed,
        "as_expected": abs(found.mean_cd_m2 - wanted) <= allowed,
    }


def show(report: list[dict[str, Any]]) -> None:
    """Print the comparison as a table."""
    print("white display, mean over its field")
    print("pupil x    numpy walk    Cycles (standard error)    difference    allowed")
    print("     mm         cd/m2                      cd/m2         cd/m2      cd/m2")
    for row in report:
        error = f"({row['cycles_standard_error_cd_m2']:.2f})"
        difference = row["cycles_cd_m2"] - row["expected_cd_m2"]
        verdict = "" if row["as_expected"] else "  NOT AS EXPECTED"
        print(
            f"{row['position_mm'][0]:7.1f}{row['expected_cd_m2']:14.1f}"
            f"{row['cycles_cd_m2']:18.2f} {error:>8}"
            f"{difference:+14.2f}{row['allowed_cd_m2']:11.2f}{verdict}"
        )


def renew() -> int:
    """Write expected.json by a forward walk in numpy, which shares no code with Cycles."""
    walk = eyebox_luminance(load_device(PRESET), PUPILS_MM, rays=WALK_RAYS, seed=WALK_SEED)
    document = {
        "provenance": {
            "source": "hoe_addon.model.device_walk.eyebox_luminance: rays from the display "
            "forward to the pupil, numpy, float64, without Cycles",
            "generated_by": "python examples/01_two_hologram_ar/run.py --renew",
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
    parser.add_argument("--out", type=Path, default=Path("out/01_two_hologram_ar"))
    parser.add_argument("--samples", type=int, default=SAMPLES)
    parser.add_argument("--renew", action="store_true", help="write expected.json anew")
    arguments = parser.parse_args()
    sys.exit(renew() if arguments.renew else main(arguments.out, arguments.samples))
