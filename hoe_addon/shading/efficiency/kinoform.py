# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinoform in the shader: its formula, with the numbers as sockets."""

from collections.abc import Iterable

from ...core.orders import Branch
from ...model.efficiency import KinoformSpec
from ..medium import medium_sockets
from ..part import parameter
from .part import EfficiencyPart

_PARAMETERS = " ".join(
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
_PREPARE = (
    "float alpha = hoe_phase_depth(relief_a, relief_b, relief_c_um2, "
    "design_wavelength_nm, wavelength_nm); "
    "float sine_alpha = hoe_sin_pi(alpha);"
)


def kinoform_part(spec: KinoformSpec, branches: Iterable[Branch]) -> EfficiencyPart:
    """The shader's part for a kinoform.

    Args:
        spec: The model of a document.
        branches: The ways out that are asked for; reflected ones get nothing.

    Returns:
        Its part.
    """
    return EfficiencyPart(
        shares={
            branch: f"hoe_kinoform_efficiency({branch.order}, alpha, sine_alpha, levels)"
            for branch in branches
            if not branch.reflected
        },
        parameters=_PARAMETERS,
        prepare=_PREPARE,
        sockets={
            "levels": float(spec.levels),
            "design_wavelength_nm": spec.design_wavelength_nm,
            **medium_sockets("relief", spec.relief),
        },
    )
