# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Look through a three-hologram light guide, and check its luminance at five pupils.

Claim: Cycles, which walks light backward from the eye, and a forward walk in numpy from the
display agree about a white picture in the middle of the eyebox and at its four sides: expander and
out-coupler have replicated the pupil in both dimensions.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import report  # noqa: E402
from hoe_addon.cli.example import read_arguments, read_expected, write_expected  # noqa: E402
from hoe_addon.cli.example_scene import opened  # noqa: E402
from hoe_addon.cli.luminance_example import ForwardWalk, seen_luminances  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402

PRESET: str = "three_hologram_ar"
PUPILS_MM: tuple[tuple[float, float, float], ...] = (
    (0.0, 0.0, 0.0),
    (-5.0, 0.0, 0.0),
    (5.0, 0.0, 0.0),
    (0.0, 3.5, 0.0),
    (0.0, -3.5, 0.0),
)
SAMPLES: int = 96
WALK: ForwardWalk = ForwardWalk(PRESET, PUPILS_MM, rays=100_000, weight_cut=1e-5)


def main(output: Path, samples: int) -> int:
    """Measure and compare.

    Args:
        output: Folder for numbers.json.
        samples: Samples per cell of the measurement, at least 4.

    Returns:
        0 if every luminance is as expected, else 1.
    """
    folder = writable_folder(output)
    found = seen_luminances(opened(PRESET), read_expected(HERE), samples)
    return report([claim for claim, _ in found], folder / "numbers.json")


if __name__ == "__main__":
    arguments = read_arguments(HERE, __doc__, SAMPLES)
    if arguments.renew:
        sys.exit(write_expected(HERE, WALK.document(HERE)))
    sys.exit(main(arguments.out, arguments.samples))
