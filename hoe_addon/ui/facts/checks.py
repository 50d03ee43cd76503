# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the last check of a hologram's model found, for as long as the hologram stays as it was."""

from dataclasses import dataclass

import bpy

from ...blender.props.sync import read_spec
from ...model.check import light_on, usual_light
from ...model.check.assumptions import findings
from ...model.check.candidates import Candidate, name_of
from ...model.check.shares import shares_of
from ...model.hologram import HologramSpec


@dataclass(frozen=True)
class Checked:
    """What a check found.

    Attributes:
        light: The light of the check, in words.
        warnings: Rules that are broken, one line each.
        held: How many hold.
    """

    light: str
    warnings: tuple[str, ...]
    held: int


_found: dict[int, tuple[HologramSpec, Checked]] = {}
"""Last result, with the hologram that it is about, by the material's session id."""


def check_now(material: bpy.types.Material) -> Checked:
    """Check the assumptions of the model of a hologram.

    No other model is held against it: that may take minutes, and has a command of its own.

    Args:
        material: A hologram.

    Returns:
        What was found.

    Raises:
        SpecError: The hologram is not valid, or its own model cannot be evaluated.
    """
    spec = read_spec(material)
    angles = usual_light(spec)
    lit = light_on(
        spec,
        [spec.pattern.wavelength_nm],
        [angles.theta_deg],
        [angles.phi_deg],
        from_front=angles.from_front,
    )
    own = Candidate(name_of(spec.efficiency), spec.efficiency, own=True, words="")
    told = findings(spec, lit, [shares_of(spec, own, lit)])
    warnings = tuple(each.warning for each in told if each.warning)
    checked = Checked(lit.words(0), warnings, len(told) - len(warnings))
    _found[material.session_uid] = (spec, checked)
    return checked


def last_check(owner: int, spec: HologramSpec) -> Checked | None:
    """Give the last result again, unless the hologram has changed.

    Args:
        owner: The material's session id.
        spec: The hologram as it is now.

    Returns:
        The result, or None.
    """
    kept = _found.get(owner)
    return kept[1] if kept is not None and kept[0] == spec else None


def forget() -> None:
    """Forget all results."""
    _found.clear()
