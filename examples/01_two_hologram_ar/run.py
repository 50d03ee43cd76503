# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look through a two-hologram light guide, and check its luminance at three pupils.

Claim: Cycles, which walks light backward from the eye, and a forward walk in numpy from the
display give the same luminance of a white picture, at both ends of the eyebox and in the middle.
"""

import json
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.blender.api import render_view, save_view  # noqa: E402
from hoe_addon.cli.example import read_arguments, read_expected, write_expected  # noqa: E402
from hoe_addon.cli.example_scene import opened  # noqa: E402
from hoe_addon.cli.luminance_example import ForwardWalk, seen_luminances  # noqa: E402
from hoe_addon.files import writable_folder, write_text  # noqa: E402

PRESET: str = "two_hologram_ar"
SIZE: tuple[int, int] = (160, 120)
SAMPLES: int = 64
PUPILS_MM: tuple[tuple[float, float, float], ...] = ((-9, 0, 0), (0, 0, 0), (9, 0, 0))
WALK: ForwardWalk = ForwardWalk(PRESET, PUPILS_MM, rays=400_000)


def main(output: Path, samples: int) -> int:
    """Render, measure and compare.

    Args:
        output: Folder for view.exr, view.png, view.blend, metrics.json and luminance.json.
        samples: Samples per pixel of the view and per cell of the measurement, at least 4.

    Returns:
        0 if every luminance is as expected, else 1.
    """
    folder = writable_folder(output)
    device = opened(PRESET, [f"render.size={list(SIZE)}", f"render.samples={samples}"])
    save_view(device, render_view(device), folder, clean=True)

    expected = read_expected(HERE)
    report = [
        {
            "position_mm": row["position_mm"],
            "expected_cd_m2": claim.expected,
            "cycles_cd_m2": claim.found,
            "cycles_standard_error_cd_m2": field.standard_error_cd_m2,
            "allowed_cd_m2": claim.allowed,
            "as_expected": claim.holds,
        }
        for row, (claim, field) in zip(
            expected["pupils"], seen_luminances(device, expected, samples), strict=True
        )
    ]
    write_text(folder / "luminance.json", (json.dumps(report, indent=2), "\n"))
    show(report)
    print(f"{folder}: view.exr, view.png, view.blend, metrics.json, luminance.json")
    return 0 if all(row["as_expected"] for row in report) else 1


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


if __name__ == "__main__":
    arguments = read_arguments(HERE, __doc__, SAMPLES)
    if arguments.renew:
        sys.exit(write_expected(HERE, WALK.document(HERE)))
    sys.exit(main(arguments.out, arguments.samples))
