# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiency models in the shader: which one a hologram gets."""

from collections.abc import Iterable

from ...core.orders import Branch
from ...model.efficiency import KinoformSpec
from ...model.hologram import HologramSpec
from .constant import constant_part
from .kinoform import kinoform_part
from .part import EfficiencyPart as EfficiencyPart


def efficiency_part(spec: HologramSpec, branches: Iterable[Branch]) -> EfficiencyPart:
    """The shader's part for the efficiency model of a hologram.

    Args:
        spec: The hologram.
        branches: The ways out that are asked for.

    Returns:
        Its part.
    """
    model = spec.efficiency
    if isinstance(model, KinoformSpec):
        return kinoform_part(model, branches)
    return constant_part(model, branches)
