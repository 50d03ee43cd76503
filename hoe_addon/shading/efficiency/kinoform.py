# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinoform in the shader: its formula, with the numbers as sockets where it is closed."""

from collections.abc import Iterable

from ...core.efficiency.profiles import Binary, Profile, Sawtooth
from ...core.efficiency.segments import Segments, Steps
from ...core.errors import SpecError
from ...core.orders import Branch
from ...model.efficiency import KinoformSpec
from ...model.efficiency.kinoform import MOST_PIECES
from ..medium import medium_sockets
from ..part import SocketValues, parameter
from .part import EfficiencyPart
from .relief import segments_function, steps_function

_PARAMETERS = (
    ("float", "design_wavelength_nm", "532.0", "Design Wavelength", "Depth is stated here, in nm"),
    ("float", "depth_waves", "1.0", "Depth", "Phase depth at the design wavelength, in waves"),
    ("float", "relief_a", "2.25", "Relief A", "Constant of n^2 of the relief"),
    ("vector", "relief_b", "vector(0.0)", "Relief B", "Sellmeier B1 B2 B3"),
    ("vector", "relief_c_um2", "vector(0.0)", "Relief C", "Sellmeier C1 C2 C3, in um^2"),
)
_LEVELS = ("float", "levels", "0.0", "Levels", "Steps of the relief; 0 is continuous")
_EDGE = ("float", "edge_width", "0.0", "Edge Width", "Share of the period that a wall takes")
_DUTY = ("float", "duty", "0.5", "Duty", "Share of the period that the ridge takes")
_PREPARE = (
    "float relief_index = hoe_index(relief_a, relief_b, relief_c_um2, wavelength_nm); "
    "float straight_depth = hoe_straight_depth(depth_waves, relief_index, "
    "hoe_index(relief_a, relief_b, relief_c_um2, design_wavelength_nm), "
    "design_wavelength_nm, wavelength_nm);"
)
_STRAIGHT = "straight_depth"
_OBLIQUE = "hoe_oblique_depth(straight_depth, relief_index, light_x, light_y)"

type _Declaration = tuple[str, str, str, str, str]


def kinoform_part(spec: KinoformSpec, branches: Iterable[Branch]) -> EfficiencyPart:
    """The shader's part for a kinoform.

    Args:
        spec: The model of a document.
        branches: The ways out that are asked for; reflected ones get nothing.

    Returns:
        Its part.

    Raises:
        SpecError: The profile has more pieces than the shader sums up (see `has_formula`).
    """
    profile = spec.made_profile()
    if isinstance(profile, Segments | Steps) and profile.pieces > MOST_PIECES:
        rule = f"must have at most {MOST_PIECES} pieces for a formula in the shader"
        raise SpecError(f"efficiency.profile: {rule}, got {profile.pieces}; use a table")
    call, own, values = _closed_form(profile)
    alpha = _OBLIQUE if spec.angle_dependent else _STRAIGHT
    return EfficiencyPart(
        shares={
            branch: call.format(order=branch.order, alpha=alpha)
            for branch in branches
            if not branch.reflected
        },
        functions=_functions(profile),
        parameters=" ".join(parameter(*declaration) for declaration in (*own, *_PARAMETERS)),
        prepare=_PREPARE,
        sockets={
            **values,
            "design_wavelength_nm": spec.design_wavelength_nm,
            "depth_waves": spec.made_depth_waves,
            **medium_sockets("relief", spec.relief),
        },
    )


def _closed_form(profile: Profile) -> tuple[str, tuple[_Declaration, ...], SocketValues]:
    """The call for one order, and the parameters and sockets that it reads."""
    match profile:
        case Sawtooth(levels=levels, edge_width=0.0):
            call = "hoe_kinoform_efficiency({order}, {alpha}, levels)"
            return call, (_LEVELS,), {"levels": float(levels)}
        case Sawtooth(levels=levels, edge_width=width):
            call = "hoe_walled_kinoform_efficiency({order}, {alpha}, levels, edge_width)"
            return call, (_LEVELS, _EDGE), {"levels": float(levels), "edge_width": width}
        case Binary(duty=duty):
            return "hoe_binary_efficiency({order}, {alpha}, duty)", (_DUTY,), {"duty": duty}
        case Segments() | Steps():
            return "hoe_profile_efficiency({order}, {alpha})", (), {}
        case _:
            return "hoe_sinusoid_efficiency({order}, {alpha})", (), {}


def _functions(profile: Profile) -> str:
    """OSL functions that hold a profile of pieces; no others are needed."""
    if isinstance(profile, Segments):
        return segments_function(profile)
    return steps_function(profile) if isinstance(profile, Steps) else ""
