# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the gallery of all presets: picture, command, time, and a number that an example checks.

Without options the page is written anew from gallery.json, the presets and what examples expect.
``--times`` takes a quick look at each preset first and keeps the times; ``--pictures`` renders each
by the command of the page and keeps the pictures, which takes much longer. Each render is a process
of its own, one after the other.
"""

import argparse
import json
import os
import platform
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from hoe_addon.files import write_text  # noqa: E402
from hoe_addon.model.document import preset_titles  # noqa: E402

PAGE: Path = HERE / "README.md"
TIMES: Path = HERE / "gallery.json"
PICTURE: str = "preview.png"
WIDTH: int = 260
"""Pixels of a picture on the page."""

QUICK: tuple[str, ...] = ("--size", "320x240", "--samples", "16")
"""Options of a quick look."""


@dataclass(frozen=True)
class Entry:
    """One preset of the gallery.

    Attributes:
        folder: Folder of its example.
        preset: Its name.
        number: Name of a number in expected.json, or the place of a pupil.
        words: What the number is.
    """

    folder: str
    preset: str
    number: str | int
    words: str

    @property
    def command(self) -> str:
        """What makes its picture."""
        return f"python -m hoe_addon render {self.preset} --out out/{self.preset}"


ENTRIES: tuple[Entry, ...] = (
    Entry("01_two_hologram_ar", "two_hologram_ar", 1, "luminance in the middle of the eyebox"),
    Entry("03_three_hologram_ar", "three_hologram_ar", 0, "luminance in the middle of the eyebox"),
    Entry("08_hud_combiner", "hud_combiner", "distance, pictures", "distance of the picture"),
    Entry(
        "07_holographic_sight", "holographic_sight", "distance, pictures", "distance of the reticle"
    ),
    Entry("04_point_lens", "point_lens", "f(630 nm), Cycles", "focal length for red, 630 nm"),
    Entry(
        "09_diffractive_achromat",
        "diffractive_achromat",
        "kinoform's Abbe number, Cycles",
        "Abbe number of the kinoform",
    ),
    Entry("05_grating_rainbow", "grating_rainbow", "order 1", "angle of order 1 at 546.1 nm"),
    Entry("06_compact_disc", "compact_disc", "radius at 550 nm", "radius that 550 nm is seen at"),
    Entry("12_laser_grating", "laser_grating", "order 2", "angle of order 2 at 632.8 nm"),
)

OTHERS: tuple[str, ...] = (
    "02_read_out_a_hologram",
    "10_how_much_light",
    "11_accuracy",
    "13_window",
    "14_script",
    "15_artist_tutorial",
    "16_engineer_tutorial",
)
"""Examples that are about no single preset."""


def render(entry: Entry, folder: Path, options: Sequence[str] = ()) -> dict[str, float]:
    """Render a preset by its command.

    Args:
        entry: The preset.
        folder: Folder for the results.
        options: Further options of the command.

    Returns:
        ``seconds`` by the clock and ``processor_seconds`` of the whole command.
    """
    command = ["-m", "hoe_addon", "render", entry.preset, "--out", str(folder), *options]
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run([sys.executable, *command], cwd=HERE.parent, check=True)
    seconds = time.perf_counter() - began
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return {"seconds": round(seconds, 1), "processor_seconds": round(used, 1)}


def keep_pictures(out: Path) -> None:
    """Render all presets, and keep their pictures beside the examples.

    Args:
        out: Folder for all results.
    """
    for entry in ENTRIES:
        render(entry, out / entry.preset)
        shutil.copy(out / entry.preset / "view.png", HERE / entry.folder / PICTURE)


def keep_times(out: Path) -> None:
    """Take a quick look at all presets, and keep the times.

    Args:
        out: Folder for all results.
    """
    times = {entry.preset: render(entry, out / entry.preset, QUICK) for entry in ENTRIES}
    write_text(TIMES, (json.dumps({"machine": machine(), "times": times}, indent=2), "\n"))


def machine() -> str:
    """Say what the times were measured on."""
    cores = len(os.sched_getaffinity(0))
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    except OSError:
        names = []
    return f"{cores} cores of {names[0] if names else platform.machine()}, {platform.system()}"


def page() -> str:
    """Write the page.

    Returns:
        Its text.
    """
    measured = json.loads(TIMES.read_text(encoding="utf-8"))
    titles = preset_titles()
    rows = [_row(entry, titles[entry.preset], measured["times"]) for entry in ENTRIES]
    others = [f"- [{_heading(folder)}]({folder}/README.md)" for folder in OTHERS]
    return "\n".join((*_head(measured["machine"]), *rows, "", *_BETWEEN, *others, ""))


_BETWEEN: tuple[str, ...] = (
    "Each picture links to its example, which says more and has the limits. In Blender's window",
    "these presets are in Add > Hologram > Scene and Add > Hologram > Device at Cursor.",
    "",
    "## More examples",
    "",
)


def _head(where: str) -> tuple[str, ...]:
    return (
        "# Examples",
        "",
        "Begin with the tutorial [for artists](15_artist_tutorial/README.md), five minutes in",
        "Blender's window, or [for engineers](16_engineer_tutorial/README.md), from a recording to",
        "numbers.",
        "",
        "## Gallery of the presets",
        "",
        "This page is written by `python examples/gallery.py`; `--pictures` and `--times` renew",
        "what is on it. Times are those of a quick look, the command with",
        f"`{' '.join(QUICK)}`: processor time with start and set-up, on {where}.",
        "By the clock it is between half of that and all of it, where two cores have nothing else",
        "to do. The pictures are of the whole command, 640x480 with the preset's own samples.",
        "",
        "| Picture | Preset and command | Quick look, s | A number that the example checks |",
        "|---|---|---|---|",
    )


def _row(entry: Entry, title: str, times: dict[str, dict[str, float]]) -> str:
    alternative = title.replace('"', "'")
    picture = (
        f'<a href="{entry.folder}/README.md"><img src="{entry.folder}/{PICTURE}" '
        f'width="{WIDTH}" alt="{alternative}"></a>'
    )
    seconds = times[entry.preset]["processor_seconds"]
    return (
        f"| {picture} | {title}<br>`{entry.command}` | {seconds:.0f} | "
        f"{entry.words}: {_number(entry)} |"
    )


def _number(entry: Entry) -> str:
    """The number that the example expects, and how far off it may be."""
    path = HERE / entry.folder / "expected.json"
    expected: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(entry.number, int):
        value = expected["pupils"][entry.number]["mean_cd_m2"]
        return f"{value} cd/m2, within {expected['tolerance']['relative']:.0%} and the noise"
    (row,) = (row for row in expected["numbers"] if row["name"] == entry.number)
    return f"{row['value']} {row['unit']}".rstrip() + f", within {row['allowed']:g}"


def _heading(folder: str) -> str:
    """First line of an example's page."""
    text = (HERE / folder / "README.md").read_text(encoding="utf-8")
    return text.splitlines()[0].removeprefix("# ")


def main() -> int:
    """Do what the arguments ask for.

    Returns:
        Exit code: 0.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pictures", action="store_true", help="render all presets first")
    parser.add_argument("--times", action="store_true", help="take the times of quick looks first")
    parser.add_argument("--out", type=Path, default=Path("out/gallery"))
    arguments = parser.parse_args()
    if arguments.pictures:
        keep_pictures(arguments.out.resolve())
    if arguments.times:
        keep_times(arguments.out.resolve())
    write_text(PAGE, (page(),))
    print(f"{PAGE}: written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
