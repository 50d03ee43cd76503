# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram shader of a document: what is compiled in, and what its sockets get."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.arrays import FloatArray
from ..core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from ..model.convert import branches_from
from ..model.efficiency import EfficiencySpec, KinoformSpec
from ..model.hologram import HologramSpec
from .map import map_part
from .medium import medium_sockets
from .part import SocketValues, parameter
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


def hologram_shader(spec: HologramSpec, followed: Followed | None = None) -> ShaderSource:
    """Specialise the hologram shader. Equal kinds and orders give equal texts.

    Args:
        spec: The hologram.
        followed: Waves of its recording that follow an object, in the object's frame.

    Returns:
        The flat text.
    """
    branches = branches_from(spec.efficiency, spec.orders)
    folds = spec.efficiency.total_internal_reflection and TRANSMITTED_ZERO in branches
    return _shader(spec, branches, folds=folds, unrecorded=_unrecorded(spec), followed=followed)


def one_order_shader(spec: HologramSpec, branch: Branch) -> ShaderSource:
    """The same shader with one way out, to read its direction and efficiency back.

    Args:
        spec: The hologram.
        branch: The order and side; it need not be one that the document lists.

    Returns:
        The flat text.
    """
    folds = spec.efficiency.total_internal_reflection and branch == REFLECTED_ZERO
    return _shader(spec, (branch,), folds=folds, unrecorded=_unrecorded(spec, branch))


def unit_efficiency_shader(spec: HologramSpec, branch: Branch) -> ShaderSource:
    """The same shader with all light in one order, to read directions where it carries none."""
    definitions = {
        "HOE_EFFICIENCY_PARAMETERS": "",
        "HOE_PREPARE_EFFICIENCY": "",
        "HOE_EACH_ORDER(X)": _each_order((branch,), {branch: "1.0"}),
    }
    return _assembled(spec, definitions, _unrecorded(spec, branch))


def hologram_sockets(
    spec: HologramSpec,
    frame: Frame,
    units_per_mm: float = 1.0,
    followed: Followed | None = None,
) -> SocketValues:
    """The numbers of the document as socket values.

    Args:
        spec: The hologram.
        frame: Where its recording's frame lies in the object.
        units_per_mm: Scene units in one mm.
        followed: Waves of its recording that follow an object, in the object's frame.

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
    values |= _efficiency_sockets(spec.efficiency)
    return values


def _shader(
    spec: HologramSpec,
    branches: Sequence[Branch],
    *,
    folds: bool,
    unrecorded: Mapping[str, str],
    followed: Followed | None = None,
) -> ShaderSource:
    efficiency = spec.efficiency
    needed = (*branches, TRANSMITTED_ZERO) if folds else tuple(branches)
    if isinstance(efficiency, KinoformSpec):
        shares = {
            branch: f"hoe_kinoform_efficiency({branch.order}, alpha, sine_alpha, levels)"
            for branch in needed
            if not branch.reflected
        }
        parameters, prepare = _KINOFORM_PARAMETERS, _KINOFORM_PREPARE
    else:
        shares = {branch: _share_socket(branch) for branch in dict.fromkeys(needed)}
        parameters = " ".join(_share_parameter(branch) for branch in shares)
        prepare = ""
    definitions = {
        "HOE_EFFICIENCY_PARAMETERS": parameters,
        "HOE_PREPARE_EFFICIENCY": prepare,
        "HOE_EACH_ORDER(X)": _each_order(branches, shares),
    }
    if folds:
        definitions["HOE_TOTAL_INTERNAL_REFLECTION"] = "1"
        definitions["HOE_ZERO_ORDER_TRANSMITTED"] = shares[TRANSMITTED_ZERO]
    return _assembled(spec, definitions, unrecorded, followed)


def _assembled(
    spec: HologramSpec,
    efficiency: Mapping[str, str],
    unrecorded: Mapping[str, str],
    followed: Followed | None = None,
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
    return specialised("hoe_hologram", definitions, pattern.functions + surface.functions)


_KINOFORM_PARAMETERS = " ".join(
    parameter(*declaration)
    for declaration in (
        ("float", "levels", "0.0", "Levels", "Steps of the relief; 0 is continuous"),
        (
            "float",
            "design_wavelength_nm",
            "532.0",
            "Design Wavelength",
            "One wave deep here, in nm",
        ),
        ("float", "relief_a", "2.25", "Relief A", "Constant of n^2 of the relief"),
        ("vector", "relief_b", "vector(0.0)", "Relief B", "Sellmeier B1 B2 B3"),
        ("vector", "relief_c_um2", "vector(0.0)", "Relief C", "Sellmeier C1 C2 C3, in um^2"),
    )
)
_KINOFORM_PREPARE = (
    "float alpha = hoe_phase_depth(relief_a, relief_b, relief_c_um2, "
    "design_wavelength_nm, wavelength_nm); "
    "float sine_alpha = hoe_sin_pi(alpha);"
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


def _each_order(branches: Sequence[Branch], shares: Mapping[Branch, str]) -> str:
    sides = {False: "HOE_TRANSMITTED", True: "HOE_REFLECTED"}
    return " ".join(
        f"X({branch.order}, {sides[branch.reflected]}, {shares[branch]})"
        for branch in branches
        if branch in shares
    )


def _share_socket(branch: Branch) -> str:
    sign = "m" if branch.order < 0 else "p"
    return f"efficiency_{'r' if branch.reflected else 't'}_{sign}{abs(branch.order)}"


def _share_parameter(branch: Branch) -> str:
    side = "Reflected" if branch.reflected else "Transmitted"
    label = f"{side} {branch.order:+d}"
    words = "Share of the light in this order, 0 to 1"
    return (
        f"float {_share_socket(branch)} = 0.0 "
        f'[[ string label = "{label}", string help = "{words}", float min = 0, float max = 1 ]],'
    )


def _efficiency_sockets(efficiency: EfficiencySpec) -> SocketValues:
    if isinstance(efficiency, KinoformSpec):
        return {
            "levels": float(efficiency.levels),
            "design_wavelength_nm": efficiency.design_wavelength_nm,
            **medium_sockets("relief", efficiency.relief),
        }
    return {
        _share_socket(Branch(order, reflected=reflected)): share
        for reflected, side in ((False, "T"), (True, "R"))
        for order, share in efficiency.table.shares(side).items()
    }
