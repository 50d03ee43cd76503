# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram shader of a document: what is compiled in, and what its sockets get."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.efficiency.table import EfficiencyTable
from ..core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from ..model.hologram import HologramSpec
from .efficiency import efficiency_part, efficiency_sockets
from .haze import haze_definitions, haze_sockets
from .map import map_part
from .medium import medium_sockets
from .part import SocketValues
from .pattern import Followed, pattern_part
from .source import ShaderSource, specialised
from .surface import surface_part


@dataclass(frozen=True)
class Frame:
    """Where the recording's frame lies in the object that carries the hologram.

    Attributes:
        origin: Its origin in object space, in scene units.
        x: Its x axis, a unit vector in object space.
        y: Its y axis, a unit vector in object space; z is their cross product.
    """

    origin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    x: tuple[float, float, float] = (1.0, 0.0, 0.0)
    y: tuple[float, float, float] = (0.0, 1.0, 0.0)

    def matrix(self) -> FloatArray:
        """The frame as a matrix from its own coordinates to object space, shape ``(4, 4)``."""
        made = np.eye(4)
        made[:3, 0], made[:3, 1], made[:3, 3] = self.x, self.y, self.origin
        made[:3, 2] = np.cross(self.x, self.y)
        return made


def hologram_shader(
    spec: HologramSpec, followed: Followed | None = None, table: EfficiencyTable | None = None
) -> ShaderSource:
    """Specialise the hologram shader. Equal kinds and orders give equal texts.

    Args:
        spec: The hologram.
        followed: Waves of its recording that follow an object, in the object's frame.
        table: Its efficiencies, indexed by the ray that is walked backward, where its model uses
            a table; the numbers go into the text.

    Returns:
        The flat text.
    """
    branches = _branches(spec)
    folds = spec.efficiency.total_internal_reflection and TRANSMITTED_ZERO in branches
    unrecorded = _unrecorded(spec)
    return _shader(
        spec, branches, folds=folds, unrecorded=unrecorded, followed=followed, table=table
    )


def one_order_shader(
    spec: HologramSpec, branch: Branch, table: EfficiencyTable | None = None
) -> ShaderSource:
    """The same shader with one way out, to read its direction and efficiency as light back.

    There is no haze in it, and the shares of a table are interpolated.

    Args:
        spec: The hologram.
        branch: The order and side; it need not be one that the document lists.
        table: Its efficiencies, indexed by the light, where its model uses a table.

    Returns:
        The flat text.
    """
    folds = spec.efficiency.total_internal_reflection and branch == REFLECTED_ZERO
    unrecorded = _unrecorded(spec, branch)
    return _shader(spec, (branch,), folds=folds, unrecorded=unrecorded, forward=True, table=table)


def unit_efficiency_shader(spec: HologramSpec, branch: Branch) -> ShaderSource:
    """The same shader with all light in one order, to read directions where it carries none."""
    definitions = {
        "HOE_EFFICIENCY_PARAMETERS": "",
        "HOE_PREPARE_EFFICIENCY": "",
        "HOE_EACH_ORDER(X)": _each_order((branch,), {branch: "1.0"}),
    }
    if branch != TRANSMITTED_ZERO:
        definitions["HOE_TELL_UNRECORDED"] = "1"
    return _assembled(spec, definitions, _unrecorded(spec, branch))


def hologram_sockets(
    spec: HologramSpec,
    frame: Frame,
    units_per_mm: float = 1.0,
    followed: Followed | None = None,
    table: EfficiencyTable | None = None,
) -> SocketValues:
    """The numbers of the document as socket values.

    Args:
        spec: The hologram.
        frame: Where its recording's frame lies in the object.
        units_per_mm: Scene units in one mm.
        followed: Waves of its recording that follow an object, in the object's frame.
        table: Its efficiencies, where its model uses a table.

    Returns:
        Value by socket identifier; the wavelength comes from another node, and where a followed
        object is from drivers.
    """
    values: SocketValues = {
        "frame_origin": frame.origin,
        "frame_x": frame.x,
        "frame_y": frame.y,
    }
    reach_mm = math.hypot(*spec.surface.size_mm) / 2.0
    values |= pattern_part(spec.pattern, units_per_mm, followed, reach_mm).sockets
    values |= surface_part(spec.surface, units_per_mm).sockets
    values |= medium_sockets("back", spec.media.back)
    values |= medium_sockets("front", spec.media.front)
    values |= efficiency_sockets(spec, _branches(spec), units_per_mm, table)
    values |= haze_sockets(spec.efficiency.haze)
    return values


def _shader(
    spec: HologramSpec,
    branches: Sequence[Branch],
    *,
    folds: bool,
    unrecorded: Mapping[str, str],
    followed: Followed | None = None,
    forward: bool = False,
    table: EfficiencyTable | None = None,
) -> ShaderSource:
    needed = (*branches, TRANSMITTED_ZERO) if folds else tuple(branches)
    part = efficiency_part(spec, needed, table, forward=forward)
    definitions = {
        "HOE_EFFICIENCY_PARAMETERS": part.parameters,
        "HOE_PREPARE_EFFICIENCY": part.prepare,
        "HOE_EACH_ORDER(X)": part.drawn or _each_order(branches, part.shares),
    }
    if forward:
        definitions["HOE_FORWARD"] = "1"
    else:
        definitions |= haze_definitions(spec.efficiency.haze)
    if folds:
        definitions["HOE_TOTAL_INTERNAL_REFLECTION"] = "1"
        definitions["HOE_ZERO_ORDER_TRANSMITTED"] = part.shares.get(TRANSMITTED_ZERO, "0.0")
    return _assembled(spec, definitions, unrecorded, followed, part.functions)


def _assembled(
    spec: HologramSpec,
    efficiency: Mapping[str, str],
    unrecorded: Mapping[str, str],
    followed: Followed | None = None,
    functions: str = "",
) -> ShaderSource:
    """The text from its parts; the numbers in them are sockets, so their scale does not matter."""
    pattern = pattern_part(spec.pattern, 1.0, followed)
    surface = surface_part(spec.surface, 1.0)
    with_map = map_part(pattern.map)
    definitions = {
        "HOE_PATTERN_PARAMETERS": f"{pattern.parameters} {with_map.parameters}".strip(),
        "HOE_FIND_GRADIENT": f"{pattern.code} {with_map.code}".strip(),
        "HOE_SURFACE_PARAMETERS": surface.parameters,
        "HOE_FIND_NORMAL": surface.code,
        **efficiency,
    }
    if "recorded = 0" in definitions["HOE_FIND_GRADIENT"]:
        definitions |= unrecorded
    return specialised(
        "hoe_hologram", definitions, pattern.functions + surface.functions + functions
    )


def _unrecorded(spec: HologramSpec, only: Branch | None = None) -> dict[str, str]:
    """What goes on where nothing is recorded: all in order 0, or of that what one branch gets."""
    found = {"HOE_EACH_UNRECORDED(X)": ""}
    if only in (None, TRANSMITTED_ZERO):
        found["HOE_EACH_UNRECORDED(X)"] = _each_order(
            (TRANSMITTED_ZERO,), {TRANSMITTED_ZERO: "1.0"}
        )
    if spec.efficiency.total_internal_reflection and only in (None, REFLECTED_ZERO):
        found["HOE_UNRECORDED_REFLECTED"] = "1"
    return found


def _branches(spec: HologramSpec) -> tuple[Branch, ...]:
    return spec.efficiency.branches(spec.orders, spec.pattern.wavelength_nm)


def _steps(branch: Branch) -> str:
    return str(branch.order) if branch.frequency == 1.0 else f"{branch.steps:.9g}"


def _each_order(branches: Sequence[Branch], shares: Mapping[Branch, str]) -> str:
    sides = {False: "HOE_TRANSMITTED", True: "HOE_REFLECTED"}
    return " ".join(
        f"X({_steps(branch)}, {sides[branch.reflected]}, {shares[branch]})"
        for branch in branches
        if branch in shares
    )
