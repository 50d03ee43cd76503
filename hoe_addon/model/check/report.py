# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that a check finds, as data."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...core.errors import SpecError
from ..hologram import HologramSpec
from .assumptions import Finding, findings
from .candidates import Candidate, candidates
from .light import Lit
from .shares import ModelShares, Progress, Way, absorbed, shares_of


@dataclass(frozen=True)
class Difference:
    """Where two models differ most in the share of an unpolarised order.

    Attributes:
        model: The model that is held against the document's own.
        size: Largest difference.
        order: Its order.
        side: ``T`` or ``R``.
        own: Share in the document's model.
        other: Share in the other one.
        light: The ray, in words.
    """

    model: str
    size: float
    order: int
    side: str
    own: float
    other: float
    light: str


@dataclass(frozen=True, eq=False)
class Report:
    """What a check found.

    Attributes:
        spec: The hologram.
        lit: The light.
        models: The models that were evaluated, the document's own first.
        left_out: Models that do not apply, with the reason.
        findings: Their assumptions.
    """

    spec: HologramSpec
    lit: Lit
    models: list[ModelShares]
    left_out: list[Candidate]
    findings: list[Finding]

    def ways(self, orders: Sequence[int]) -> list[Way]:
        """Ways out of the orders, on either side, that get light in some model."""
        listed = ((order, side) for side in (False, True) for order in orders)
        return [
            way
            for way in listed
            if not way[1] or any(np.any(model.of(way) > 0.0) for model in self.models)
        ]

    def differences(self) -> list[Difference]:
        """Largest difference of each other model from the document's own."""
        return [_difference(self.models[0], other, self.lit) for other in self.models[1:]]

    def warnings(self) -> list[str]:
        """All rules that are broken, a line each."""
        return [found.warning for found in self.findings if found.warning]

    def to_dict(self, orders: Sequence[int]) -> dict[str, Any]:
        """Give all of it as plain data.

        Args:
            orders: Orders to write; the sums are over all that propagate.

        Returns:
            Objects, lists, numbers and texts, for JSON.
        """
        count = len(self.lit.wavelength_nm)
        return {
            "hologram": self.spec.name,
            "light": [self._light(place, orders) for place in range(count)],
            "differences": [asdict(each) for each in self.differences()],
            "assumptions": [_plain(asdict(each)) for each in self.findings],
            "warnings": self.warnings(),
            "left_out": {each.name: each.words for each in self.left_out},
        }

    def _light(self, place: int, orders: Sequence[int]) -> dict[str, Any]:
        ways = self.ways(orders)
        return {
            "wavelength_nm": float(self.lit.wavelength_nm[place]),
            "theta_deg": float(self.lit.theta_deg[place]),
            "phi_deg": float(self.lit.phi_deg[place]),
            "from": "front" if bool(self.lit.incidence.from_front[place]) else "back",
            "models": {
                model.candidate.name: {
                    "orders": [
                        {"order": way[0], "side": side_of(way), **polarised(model.of(way)[place])}
                        for way in ways
                    ],
                    "T": polarised(model.total(reflected=False)[place]),
                    "R": polarised(model.total(reflected=True)[place]),
                    "A": polarised(absorbed(model)[place]),
                }
                for model in self.models
            },
        }


def check_hologram(spec: HologramSpec, lit: Lit, progress: Progress | None = None) -> Report:
    """Evaluate an element by every model that applies.

    Args:
        spec: The hologram.
        lit: The light.
        progress: Told how far the rigorous model is.

    Returns:
        The findings.

    Raises:
        SpecError: The document's own model cannot be evaluated.
    """
    models: list[ModelShares] = []
    left_out: list[Candidate] = []
    for candidate in candidates(spec, lit):
        try:
            models.append(shares_of(spec, candidate, lit, progress))
        except SpecError as error:
            if candidate.own:
                raise
            left_out.append(Candidate(candidate.name, None, own=False, words=str(error)))
    return Report(spec, lit, models, left_out, findings(spec, lit, models))


def side_of(way: Way) -> str:
    """The letter of a side."""
    return "R" if way[1] else "T"


def polarised(pair: FloatArray) -> dict[str, float]:
    """Values of s and p light with their mean."""
    return {"u": float(np.mean(pair)), "s": float(pair[0]), "p": float(pair[1])}


def _difference(own: ModelShares, other: ModelShares, lit: Lit) -> Difference:
    ways = sorted({*own.ways, *other.ways})
    first, second = (
        np.stack([model.of(way).mean(axis=-1) for way in ways], axis=-1) for model in (own, other)
    )
    place = np.unravel_index(int(np.argmax(np.abs(first - second))), first.shape)
    ray, way = int(place[0]), ways[int(place[1])]
    return Difference(
        model=other.candidate.name,
        size=float(abs(first[place] - second[place])),
        order=way[0],
        side=side_of(way),
        own=float(first[place]),
        other=float(second[place]),
        light=lit.words(ray),
    )


def _plain(entry: dict[str, Any]) -> dict[str, Any]:
    """JSON has no infinity and no NaN."""
    value = entry["value"]
    return entry | {"value": value if np.isfinite(value) else None}
