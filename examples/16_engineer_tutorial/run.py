# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The engineer's tutorial: from a recording to numbers, command by command.

Claim: directions are those of the grating equation, the shares keep the energy, the table holds
its tolerance, the luminance in the middle of the eyebox is that of a walk of rays without Cycles,
and an eye focused on infinity sees the full contrast.
"""

import csv
import json
import shlex
import shutil
import sys
from functools import partial
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli import main as command  # noqa: E402
from hoe_addon.cli.claims import Row, compare, report, row  # noqa: E402
from hoe_addon.cli.example import (  # noqa: E402
    Example,
    read_arguments,
    read_expected,
    write_expected,
)
from hoe_addon.core.errors import HoeError  # noqa: E402
from hoe_addon.files import writable_folder, write_text  # noqa: E402

GIVEN: tuple[str, ...] = ("coupler.json", "rays.csv", "guide.json")
COMMANDS: tuple[str, ...] = (
    "trace coupler.json rays.csv --out directions.csv",
    "efficiency coupler.json --wavelengths 450:640:10 --orders=-1:1 --from front --out shares.csv",
    "efficiency coupler.json --wavelengths 532 --orders=-1:1 --from front --out green.csv",
    "check coupler.json --from front --json check.json",
    "bake coupler.json --from front --wavelengths 460:630 --angles=-9.5:9.5 --across=-0.1:0.1 "
    "--tolerance 0.01 --out coupler.npz",
    "efficiency table.json --wavelengths 545 --theta 3 --orders 1 --from front --out table.csv",
    "efficiency coupler.json --wavelengths 545 --theta 3 --orders 1 --from front --out model.csv",
    "render guide.json --size 64x48 --error 0.4 --out view",
    "eyebox guide.json --size 64x48 --samples 4 --field-samples 2048 --grid 3x1 --pitch-mm 9,2.5 "
    "--out eyebox",
    "accuracy guide.json --size 48x36 --budget 20 --out accuracy",
)
"""What the tutorial's page names, in its order; paths are in the folder of the results."""

WAVELENGTHS_NM: tuple[float, ...] = (465.0, 532.0, 625.0)
RECORDED_NM, RECORDED_SINE = 532.0, -0.7423409777777779
CONVERGED: float = 0.5101
"""Share of order +1 at 532 nm with 145 harmonics, which are enough to 0.0035."""
WALKED_CD_M2: float = 19.0
"""Mean luminance in the middle of the eyebox by 100,000 rays from the display."""

SOURCE: str = (
    "directions: grating equation; shares: 1 in sum, and the same model with 145 harmonics; "
    "table: the model itself; luminance: hoe_addon.model.device_walk, 100,000 rays forward without "
    "Cycles; contrast: an eye without blur"
)
REASON: str = (
    "1e-6: digits of the file; 0.02: what 21 harmonics lack; 0.01: tolerance of the table; "
    "5 %: agreement that two engines are promised; 0.03: noise of the contrast"
)


def run_commands(folder: Path) -> None:
    """Run all commands, with their paths in one folder.

    Args:
        folder: Folder for the results.

    Raises:
        HoeError: A command has failed.
    """
    for name in GIVEN:
        shutil.copy(HERE / name, folder / name)
    coupler = json.loads((HERE / "coupler.json").read_text(encoding="utf-8"))
    coupler["efficiency"] = {"model": "table", "file": "coupler.npz"}
    write_text(folder / "table.json", (json.dumps(coupler, indent=2), "\n"))
    for line in COMMANDS:
        print(f"$ python -m hoe_addon {line}")
        name, *words = shlex.split(line)
        code = command([name, *(_placed(word, folder) for word in words)])
        if code:
            raise HoeError(f"{line}: ended with code {code}")


def _placed(word: str, folder: Path) -> str:
    """A word of a command, or the path that it stands for."""
    is_path = word.endswith((".json", ".csv", ".npz")) or word in ("view", "eyebox", "accuracy")
    return str(folder / word) if is_path else word


def measure(folder: Path) -> dict[str, float]:
    """Run the commands, and read their files.

    Args:
        folder: Folder for the results.

    Returns:
        Numbers by name.
    """
    run_commands(folder)
    rays = _rows(folder / "directions.csv")
    found = {_sine(nm): float(ray["out_l"]) for nm, ray in zip(WAVELENGTHS_NM, rays, strict=True)}
    shares = {
        (each["side"], each["order"]): float(each["efficiency"])
        for each in _rows(folder / "green.csv")
    }
    found["all orders, 532 nm"] = sum(shares.values())
    found["order +1, 532 nm"] = shares["T", "1"]
    table, model = (_transmitted(folder / f"{name}.csv") for name in ("table", "model"))
    found["table - model, 545 nm, 3 deg"] = table - model
    eyebox = json.loads((folder / "eyebox" / "eyebox.json").read_text(encoding="utf-8"))
    found["luminance in the middle"] = eyebox["positions"][1]["mean_cd_m2"]
    accuracy = json.loads((folder / "accuracy" / "accuracy.json").read_text(encoding="utf-8"))
    found["contrast at 5/deg"] = accuracy["reference"]["sharpness"]["value"]
    return found


def _rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def _transmitted(path: Path) -> float:
    return next(float(each["efficiency"]) for each in _rows(path) if each["side"] == "T")


def _sine(wavelength_nm: float) -> str:
    return f"direction along x, {wavelength_nm:g} nm"


def expected_numbers() -> list[Row]:
    """Closed forms, and what other engines give."""
    return [
        *(
            row(_sine(nm), "1", round(RECORDED_SINE * nm / RECORDED_NM, 8), 1e-6)
            for nm in WAVELENGTHS_NM
        ),
        row("all orders, 532 nm", "1", 1.0, 1e-8),
        row("order +1, 532 nm", "1", CONVERGED, 0.02),
        row("table - model, 545 nm, 3 deg", "1", 0.0, 0.01),
        row("luminance in the middle", "cd/m2", WALKED_CD_M2, round(0.05 * WALKED_CD_M2, 2)),
        row("contrast at 5/deg", "1", 1.0, 0.03),
    ]


def main(output: Path) -> int:
    """Run the commands and compare.

    Args:
        output: Folder for all results, and numbers.json.

    Returns:
        0 if the numbers are as expected, else 1.
    """
    from hoe_addon.blender.quiet import forget_removed_engines

    forget_removed_engines()
    folder = writable_folder(output).resolve()
    return report(compare(read_expected(HERE), measure(folder)), folder / "numbers.json")


EXAMPLE = Example(HERE, "guide.json", SOURCE, REASON, partial(measure, HERE), expected_numbers)

if __name__ == "__main__":
    arguments = read_arguments(HERE, __doc__)
    if arguments.renew:
        sys.exit(write_expected(HERE, EXAMPLE.document()))
    sys.exit(main(arguments.out))
