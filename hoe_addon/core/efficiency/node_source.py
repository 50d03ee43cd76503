# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A model evaluated at nodes of a table; every value is kept, so that stopped work can go on.

A node is six numbers: 1.0 for light from the front (else 0.0), wavelength in metres, the direction
cosines along and across the grating, x and y in metres.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, as_float
from ..errors import SpecError
from ..orders import TRANSMITTED_ZERO, Branch
from .incidence import Incidence, Polarization
from .model import EfficiencyModel
from .rigorous import RigorousGrating
from .settling import Settled, Settling
from .table_check import SIDES, shown

type Progress = Callable[[float], None]
type LightAt = Callable[[FloatArray], Incidence]
"""Makes the light of nodes, shape ``(N, 6)``; the frequency is NaN where nothing is recorded."""

NODE = 6
"""Numbers of a node."""

_BATCH = 1024
_SUM_SLACK = 1e-3
"""Models are off by rounding and by their own convergence; more is a mistake."""

_ROUNDING = 1e-12
_FURTHEST = 0.25
"""Corners of cells that touch the rim are hardly further out, as a share of it."""

_MOST_COSINE = 0.9999
"""Light of an order that does not propagate is looked at in this direction instead."""


@dataclass(eq=False)
class NodeSource:
    """Shares of a model at nodes.

    Attributes:
        model: The model.
        branches: The K ways out.
        light_at: Makes the light of nodes.
        radius: Largest cosine of a direction in the plane; corners of a grid that lie beyond
            continue the shares at this rim.
        backward: Whether a node is a ray that is walked backward: each branch then has the share of
            the light that takes it, which is the reversed pair.
        polarization: Of the light.
        notice: Told the share of each evaluation that is done; what it raises stops the work.
        excess: By how much shares of one node summed to more than 1, before they were scaled down.
            Backward walks of models that are not reciprocal do so; the shader scales them, too.
        settled: What a model that searches at each ray has settled on; see `settle`.
    """

    model: EfficiencyModel
    branches: tuple[Branch, ...]
    light_at: LightAt
    radius: float
    backward: bool = False
    polarization: Polarization = Polarization.UNPOLARISED
    notice: Progress | None = None
    excess: float = 0.0
    settled: Settled | None = None
    _known: dict[tuple[float, ...], FloatArray] = field(
        default_factory=dict[tuple[float, ...], FloatArray]
    )

    @property
    def watched(self) -> tuple[Branch, ...]:
        """The branches, then those whose cut-offs may be felt: on either side, one order more."""
        frequencies = sorted({way.frequency for way in self.branches})
        orders = [way.order for way in self.branches]
        more = (
            Branch(order, reflected=side, frequency=frequency)
            for side in (False, True)
            for frequency in frequencies
            for order in range(min(orders) - 1, max(orders) + 2)
        )
        return tuple(dict.fromkeys((*self.branches, *more)))

    @property
    def evaluated(self) -> int:
        """At how many nodes the model has been evaluated."""
        return len(self._known)

    def settle(self, nodes: FloatArray) -> None:
        """Let a model that searches at each ray do so at some nodes, and keep to what it finds.

        Args:
            nodes: Nodes that stand for all others, shape ``(N, 6)``.

        Raises:
            SpecError: The model does.
        """
        light = self.light_at(nodes)
        recorded = np.isfinite(light.frequency)
        if isinstance(self.model, Settling) and recorded.any():
            self.settled = self.model.settled(self.branches, _chosen(light, recorded))
            self.model = self.settled.model

    def passing(self, nodes: FloatArray) -> BoolArray:
        """Tell which of the watched branches propagate at nodes, without the model; (N, V)."""
        return propagates(self.light_at(self._directions(nodes)[0]), self.watched)

    def at(self, nodes: FloatArray) -> tuple[FloatArray, BoolArray]:
        """Give shares at nodes.

        Args:
            nodes: Nodes, shape ``(N, 6)``.

        Returns:
            Shares, shape ``(N, K)``, NaN where nothing is recorded; and which of the watched
            branches propagate, shape ``(N, V)``.

        Raises:
            SpecError: The model gives no number, or too much light, to orders that propagate.
        """
        rim, inner, share = self._directions(nodes)
        rows = self._rows(np.concatenate((rim, inner)))
        count = len(self.branches)
        here, further = rows[: len(rim), :count], rows[len(rim) :, :count]
        # Straight on beyond the rim; as much as there is, and no less than none.
        shares = np.clip(here + share[:, None] * (here - further), 0.0, 1.0)
        shares = shares / np.maximum(np.sum(shares, axis=-1, keepdims=True), 1.0)
        return shares, rows[: len(rim), count:] > 0.0

    def _rows(self, nodes: FloatArray) -> FloatArray:
        """Evaluate what is not known yet; shares and 1.0 for what propagates, ``(N, K + V)``."""
        if isinstance(self.model, RigorousGrating):
            # It is the same in a mirror across the grooves.
            nodes = np.concatenate((nodes[:, :3], np.abs(nodes[:, 3:4]), nodes[:, 4:]), axis=1)
        keys = [tuple(node) for node in nodes.tolist()]
        missing = list(dict.fromkeys(key for key in keys if key not in self._known))
        for start in range(0, len(missing), _BATCH):
            chunk = missing[start : start + _BATCH]
            self._known.update(zip(chunk, self._evaluated(as_float(chunk)), strict=True))
            if self.notice is not None:
                self.notice((start + len(chunk)) / len(missing))
        width = len(self.branches) + len(self.watched)
        return np.asarray([self._known[key] for key in keys]).reshape(len(keys), width)

    def polarised(self, polarization: Polarization) -> "NodeSource":
        """The same source for other light, with nothing evaluated yet."""
        return replace(self, polarization=polarization, excess=0.0, _known={})

    def state(self) -> tuple[FloatArray, FloatArray]:
        """All that has been evaluated: nodes, shape ``(N, 6)``, and rows, shape ``(N, K + V)``."""
        width = len(self.branches) + len(self.watched)
        nodes = np.asarray(list(self._known), dtype=np.float64).reshape(-1, NODE)
        return nodes, np.asarray(list(self._known.values())).reshape(-1, width)

    def restore(self, nodes: FloatArray, rows: FloatArray) -> None:
        """Take up what an earlier run has evaluated; see `state`."""
        for node, row in zip(as_float(nodes).tolist(), rows, strict=True):
            self._known[tuple(node)] = row

    def _directions(self, nodes: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Find where to look for a node: corners of the grid are no directions.

        Returns:
            The node, or the one on the rim toward it; one inside the rim as far as the node is
            outside; and 1.0 for nodes outside, shape ``(N,)``.
        """
        length = np.hypot(nodes[:, 2], nodes[:, 3])
        outside = length > self.radius * (1.0 + _ROUNDING)
        safe = np.where(outside, length, 1.0)[:, None]
        step = np.minimum(length - self.radius, _FURTHEST * self.radius)[:, None]
        rim, inner = nodes.copy(), nodes.copy()
        rim[:, 2:4] = np.where(outside[:, None], nodes[:, 2:4] * self.radius / safe, rim[:, 2:4])
        moved = nodes[:, 2:4] * (self.radius - step) / safe
        inner[:, 2:4] = np.where(outside[:, None], moved, rim[:, 2:4])
        return rim, inner, outside.astype(np.float64)

    def _evaluated(self, nodes: FloatArray) -> FloatArray:
        light = self.light_at(nodes)
        recorded = np.isfinite(light.frequency)
        passing = propagates(light, self.watched)
        shares = np.full((len(nodes), len(self.branches)), np.nan)
        if recorded.all():
            shares[:] = self._shares(light)
        elif recorded.any():
            shares[recorded] = self._shares(_chosen(light, recorded))
        live = passing[:, : len(self.branches)]
        self._check(nodes, shares, live & recorded[:, None])
        shares = np.clip(np.where(live, shares, np.nan_to_num(shares)), 0.0, 1.0)
        shares = _within_one(shares, live)
        total = np.sum(shares, axis=-1, keepdims=True)
        self.excess = max(self.excess, float(np.max(total)) - 1.0)
        shares = shares / np.maximum(total, 1.0)
        shares[~recorded] = np.nan
        return np.concatenate((shares, passing.astype(np.float64)), axis=1)

    def _shares(self, light: Incidence) -> FloatArray:
        same = isinstance(self.model, RigorousGrating)
        if not self.backward or (same and self.polarization is Polarization.UNPOLARISED):
            # A rigorous solution of unpolarised light is that of the reversed pair.
            return self.model.shares(self.branches, light, self.polarization)
        columns = [
            self.model.shares((way,), self._sent(light, way), self.polarization)[..., 0]
            for way in self.branches
        ]
        return np.stack(columns, axis=-1)

    def _sent(self, light: Incidence, way: Branch) -> Incidence:
        """Light that takes a branch into the reverse of a walked ray."""
        sent = light.reversed(way.steps, reflected=way.reflected)
        length = np.hypot(sent.tangential[..., 0], sent.tangential[..., 1])
        if way == TRANSMITTED_ZERO:
            # Light that cannot leave in the order 0 may be reflected: it comes from this side.
            trapped = length > sent.index_in
            sent = replace(sent, from_front=np.where(trapped, light.from_front, sent.from_front))
        most = _MOST_COSINE * sent.index_in
        # An order that does not propagate must not stop the model.
        shrunk = np.where(length > sent.index_in, most / np.maximum(length, most), 1.0)
        return replace(sent, tangential=sent.tangential * shrunk[..., None])

    def _check(self, nodes: FloatArray, shares: FloatArray, live: BoolArray) -> None:
        """Refuse what no model should give; `nodes`, `shares` and `live` go row by row."""
        total = np.sum(np.where(live, shares, 0.0), axis=-1)
        # A comparison with NaN is false. Backward, the shares belong to different light.
        bad = ~(total <= (np.inf if self.backward else 1.0 + _SUM_SLACK))
        if bad.any():
            row = int(np.argmax(bad))
            side = SIDES[int(nodes[row, 0])]
            where = ", ".join(shown(axis, float(nodes[row, 1 + axis])) for axis in range(3))
            rule = f"must give shares that sum to at most 1, got {total[row]:.6g}"
            raise SpecError(f"efficiency.model: {rule} for light from the {side} at {where}")


def propagates(light: Incidence, branches: Sequence[Branch]) -> BoolArray:
    """Tell which branches propagate.

    Args:
        light: The light, shape ``(...)``.
        branches: K ways out.

    Returns:
        Shape ``(..., K)``; False where nothing is recorded.
    """
    columns = [
        np.sum(light.shifted(way.steps) ** 2, axis=-1)
        <= (light.index_in if way.reflected else light.index_out) ** 2
        for way in branches
    ]
    return np.stack(columns, axis=-1)


def _within_one(shares: FloatArray, live: BoolArray) -> FloatArray:
    """Leave to orders that do not propagate no more than the others leave.

    They may have any share. Nothing at all would make a cliff at the cut-off.
    """
    others = np.sum(np.where(live, shares, 0.0), axis=-1, keepdims=True)
    theirs = np.sum(np.where(live, 0.0, shares), axis=-1, keepdims=True)
    room = np.maximum(1.0 - others, 0.0)
    part = np.where(theirs > room, room / np.where(theirs > 0.0, theirs, 1.0), 1.0)
    return np.where(live, shares, part * shares)


def _chosen(light: Incidence, rows: BoolArray) -> Incidence:
    waves = light.waves
    if waves is not None:
        waves = replace(waves, object=waves.object[rows], reference=waves.reference[rows])
    names = ("wavelength", "tangential", "from_front", "index_back", "index_front", "frequency")
    parts = {name: getattr(light, name)[rows] for name in (*names, "place")}
    return replace(light, **parts, waves=waves)
