# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light goes where: three models beside published numbers, and where the simple ones end.

Claim: two-wave theory gives Kogelnik's numbers, coupled-wave analysis those of other solvers; the
two agree where a volume grating is thick and not where it is thin; and a relief with N levels
tends to the scalar formula as its period grows.
"""

import math
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

from hoe_addon.cli.claims import Row, row  # noqa: E402
from hoe_addon.cli.example import Example, read_arguments, write_expected  # noqa: E402
from hoe_addon.core.efficiency import Polarization  # noqa: E402
from hoe_addon.files import writable_folder  # noqa: E402
from hoe_addon.model.document import hologram_from, load_hologram, to_document  # noqa: E402
from hoe_addon.model.evaluate import efficiencies, incident_direction  # noqa: E402
from hoe_addon.model.hologram import HologramSpec  # noqa: E402
from hoe_addon.model.override import override  # noqa: E402

type Shares = NDArray[np.float64]

SOURCE: str = (
    "Kogelnik (1969): his closed forms. Binary relief: geometry of Moharam et al. (1995), values "
    "of two independent solvers. Levels: scalar theory, Swanson (1989)"
)
REASON: str = (
    "1e-5: the digits of the published numbers; 0.005 where they have two digits; 0.02: a "
    "relief with steps that are some wavelengths wide still differs by that from scalar theory"
)
WAVELENGTH_NM: float = 532.0
BRAGG_DEG: float = -10.21447
LEVELS: tuple[int, ...] = (2, 4, 8)
PERIODS: tuple[float, ...] = (2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 35.0)
"""In wavelengths."""
BINARY: Mapping[str, tuple[int, bool, float]] = {
    "R0": (0, True, 0.00471),
    "R-1": (-1, True, 0.03889),
    "T-1": (-1, False, 0.15190),
    "T0": (0, False, 0.65506),
    "T+1": (1, False, 0.11955),
}
DIGITS: float = 1e-5


def shares_of(
    spec: HologramSpec,
    theta_deg: float | Sequence[float],
    wavelength_nm: float,
    orders: Sequence[int],
    *,
    from_front: bool = False,
) -> Shares:
    """Shares for s light at the middle of an element, shape ``(..., orders, 2)``: T, R."""
    direction = incident_direction(theta_deg, 0.0, from_front=from_front)
    return efficiencies(spec, direction, wavelength_nm, orders, Polarization.S)


def volume(model: str, changes: Mapping[str, Any]) -> HologramSpec:
    """The volume grating of volume.json by one of two models."""
    document = to_document(load_hologram(HERE / "volume.json"))
    document["characteristic"] |= changes.get("characteristic", {})
    values = document["efficiency"] | changes.get("efficiency", {})
    if model == "kogelnik":
        document["efficiency"] = values
    else:
        kept = {name: values[name] for name in ("thickness_um", "index", "modulation")}
        profile = {"shape": "volume", "slant_deg": 0.0, **kept}
        document["efficiency"] = {"model": "rcwa", "profile": profile, "tolerance": 1e-5}
    return hologram_from(document)


THIN: Mapping[str, Any] = {
    "characteristic": {"lines_per_mm": 500},
    "efficiency": {"thickness_um": 5.0, "modulation": 0.05},
}
"""A grating that looks thick and is not: Q' = 3.5."""


def thin_bragg_deg() -> float:
    """Bragg angle of the thin grating, in the medium."""
    return -math.degrees(math.asin(WAVELENGTH_NM * 1e-6 * 500 / (2.0 * 1.5)))


@cache
def levelled(levels: int, period: float) -> float:
    """Share of the transmitted light that a relief of N levels sends into order 1."""
    document = override(
        to_document(load_hologram(HERE / "relief.json")),
        [
            "media.back=1.5",
            "characteristic.wavelength_nm=550",
            f"characteristic.lines_per_mm={1e6 / (550 * period)!r}",
            f'efficiency.profile={{"shape": "staircase", "depth_um": 1.1, "levels": {levels}}}',
            "efficiency.ridge=1.5",
            "efficiency.tolerance=1e-4",
        ],
    )
    spec = hologram_from(document)
    highest = math.ceil(period * 1.5)
    orders = range(-highest, highest + 1)
    transmitted = shares_of(spec, 0.0, 550.0, orders)[:, 0]
    return float(transmitted[highest + 1] / transmitted.sum())


def measure() -> dict[str, float]:
    """Ask the models.

    Returns:
        Shares by name.
    """
    found: dict[str, float] = {}
    thick = volume("kogelnik", {})
    found["thick, Kogelnik"] = float(shares_of(thick, BRAGG_DEG, WAVELENGTH_NM, [1])[0, 0])
    thick = volume("rcwa", {})
    found["thick, rigorous"] = float(shares_of(thick, BRAGG_DEG, WAVELENGTH_NM, [1])[0, 0])
    for model, name in (("kogelnik", "Kogelnik"), ("rcwa", "rigorous")):
        thin = shares_of(volume(model, THIN), thin_bragg_deg(), WAVELENGTH_NM, [1])
        found[f"thin, {name}"] = float(thin[0, 0])
    relief = load_hologram(HERE / "relief.json")
    binary = shares_of(relief, 10.0, 500.0, [-1, 0, 1], from_front=True)
    for name, (order, reflected, _) in BINARY.items():
        found[f"binary relief, {name}"] = float(binary[order + 1, int(reflected)])
    for levels in LEVELS:
        found[f"{levels} levels, {PERIODS[-1]:g} wavelengths"] = levelled(levels, PERIODS[-1])
    return found


def expected_numbers() -> list[Row]:
    """Closed forms and published numbers."""
    cosine = math.cos(math.radians(BRAGG_DEG))
    coupling = math.pi * 0.03 * 9.0 / (WAVELENGTH_NM * 1e-3 * cosine)
    return [
        row("thick, Kogelnik", "1", round(math.sin(coupling) ** 2, 5), DIGITS),
        row("thick, rigorous", "1", 0.98532, DIGITS),
        row("thin, Kogelnik", "1", 0.99, 0.005),
        row("thin, rigorous", "1", 0.36, 0.005),
        *(row(f"binary relief, {name}", "1", value[2], DIGITS) for name, value in BINARY.items()),
        *(
            row(f"{levels} levels, {PERIODS[-1]:g} wavelengths", "1", scalar(levels), 0.02)
            for levels in LEVELS
        ),
    ]


def scalar(levels: int) -> float:
    """Efficiency of N levels in scalar theory: sinc^2(1 / N)."""
    return round((math.sin(math.pi / levels) * levels / math.pi) ** 2, 6)


def draw(path: Path) -> None:
    """Draw where the simple models hold.

    Args:
        path: PNG file to write.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    angles = np.linspace(-20.0, 0.0, 161)
    curves = (({}, "tab:blue", "9 um, 1 um"), (THIN, "tab:red", "5 um, 2 um"))
    for changes, colour, name in curves:
        for model, style in (("kogelnik", "--"), ("rcwa", "-")):
            shares = shares_of(volume(model, changes), angles, WAVELENGTH_NM, [1])[:, 0, 0]
            label = f"{name}, {'two-wave' if model == 'kogelnik' else 'rigorous'}"
            left.plot(angles, shares, style, color=colour, label=label)
    left.set(xlabel="angle in the medium, degrees", ylabel="share in order +1", ylim=(0, 1.05))
    left.set_title("Volume grating: thickness, period")
    left.legend(fontsize=8)
    for levels, colour in zip(LEVELS, ("tab:blue", "tab:green", "tab:red"), strict=True):
        rigorous = [levelled(levels, period) for period in PERIODS]
        right.semilogx(PERIODS, rigorous, "o-", color=colour, label=f"{levels} levels, rigorous")
        right.axhline(scalar(levels), linestyle="--", color=colour, label="scalar formula")
    right.set(xlabel="period / wavelength", ylabel="order +1 / all transmitted", ylim=(0, 1.05))
    right.set_xticks(PERIODS, [f"{period:g}" for period in PERIODS])
    right.minorticks_off()
    right.set_title("Relief one wave deep")
    right.legend(fontsize=8)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=100)


EXAMPLE = Example(HERE, "volume.json, relief.json", SOURCE, REASON, measure, expected_numbers)


def main() -> int:
    """Draw, measure and compare, or write the expected numbers anew.

    Returns:
        0 if every number is as expected, else 1.
    """
    arguments = read_arguments(HERE, __doc__)
    if arguments.renew:
        return write_expected(HERE, EXAMPLE.document())
    folder = writable_folder(arguments.out)
    draw(folder / "models.png")
    return EXAMPLE.check(folder)


if __name__ == "__main__":
    sys.exit(main())
