# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Read out a recorded hologram with six rays, in numpy and in Cycles.

Claim: both engines send the rays where published numbers say: numpy to their printed digits, the
shader in Cycles to what float32 can hold.
"""

import argparse
import csv
import json
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli import main as command  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402

HOLOGRAM: Path = HERE / "lens.json"
RAYS: Path = HERE / "rays.csv"
EXPECTED: Path = HERE / "expected.json"
ENGINES: tuple[str, ...] = ("numpy", "cycles")


def main(output: Path) -> int:
    """Trace the rays and compare.

    Args:
        output: Folder for numpy.csv and cycles.csv.

    Returns:
        0 if every number is as expected, 2 if a trace failed, else 1.
    """
    folder = writable_folder(output)
    expected = json.loads(EXPECTED.read_text(encoding="utf-8"))
    right = True
    for engine in ENGINES:
        out = folder / f"{engine}.csv"
        code = command(["trace", str(HOLOGRAM), str(RAYS), "--out", str(out), "--engine", engine])
        if code:
            return code
        with out.open(encoding="utf-8", newline="") as file:
            right &= show(engine, list(csv.DictReader(file)), expected)
    print(f"{folder}: {', '.join(f'{engine}.csv' for engine in ENGINES)}")
    return 0 if right else 1


def show(engine: str, found: list[dict[str, str]], expected: dict[str, Any]) -> bool:
    """Print one engine's rays beside the expected ones.

    Args:
        engine: Name of the engine.
        found: Rows that it wrote.
        expected: What expected.json holds.

    Returns:
        Whether all are within the tolerance.
    """
    allowed = expected["tolerance"][engine]
    print(f"{engine}, allowed difference {allowed['value']:g}")
    print("ray  side  wavelength   index x l    index x m    difference  efficiency")
    print("                   nm           1            1             1           1")
    right = True
    for number, (row, wanted) in enumerate(zip(found, expected["rays"], strict=True), start=1):
        index = wanted["index"]
        tangential = [index * float(row[name]) for name in ("out_l", "out_m")]
        published = wanted["index_times_direction"]
        difference = max(abs(a - b) for a, b in zip(tangential, published, strict=True))
        onward = (float(row["out_n"]) > 0.0) == (row["side"] == "T")
        share = abs(float(row["efficiency"]) - wanted["efficiency"])
        fits = difference <= allowed["value"] and onward
        fits &= share <= expected["tolerance"]["efficiency"]["value"]
        right &= fits
        print(
            f"{number:3}  {row['side']:>4}{float(row['wavelength_nm']):12.1f}"
            f"{tangential[0]:12.8f} {tangential[1]:12.8f}{difference:14.1e}"
            f"{float(row['efficiency']):12.5f}{'' if fits else '  NOT AS EXPECTED'}"
        )
    return right


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/02_read_out_a_hologram"))
    sys.exit(main(parser.parse_args().out))
