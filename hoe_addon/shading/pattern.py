# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The recorded pattern in the shader: code for ``gradient`` = grad V at ``position``.

The code may read ``position`` (the hit in the frame of the recording, in scene units) and sets
``gradient`` (which begins as zero) and, where nothing is recorded, ``recorded`` to 0.
"""

from collections.abc import Mapping

from ..model.pattern import PatternSpec
from ..model.recording import RecordingSpec
from ..model.waves import PlaneWaveSpec, PointSourceSpec, WaveSpec
from .characteristic import characteristic_part
from .following import following
from .part import ShaderPart, joined
from .wave_pair import pair_part
from .waves import wave_part

type Followed = Mapping[str, WaveSpec]
"""Waves that follow an object, by role (``object``, ``reference``), in the object's frame."""

_PLAIN = (PlaneWaveSpec, PointSourceSpec)
"""Two of these make a pair that keeps its digits when their sources are far."""


def pattern_part(
    pattern: PatternSpec,
    units_per_mm: float,
    followed: Followed | None = None,
    reach_mm: float | None = None,
) -> ShaderPart:
    """The shader's part for what is recorded.

    Args:
        pattern: The recording or the characteristic function.
        units_per_mm: Scene units in one mm.
        followed: Waves of the recording that follow an object.
        reach_mm: How far the element reaches from its centre, for the numbers of polynomials and
            of pairs of waves.

    Returns:
        Its part; its sockets hold the wavelength that V is stated for, too.
    """
    stated = ShaderPart(sockets={"recording_wavelength_nm": pattern.wavelength_nm})
    if isinstance(pattern, RecordingSpec):
        first, second = pattern.object, pattern.reference
        if not followed and isinstance(first, _PLAIN) and isinstance(second, _PLAIN):
            return joined((stated, pair_part(first, second, units_per_mm, reach_mm)))
        both = (
            _wave("object", "+", pattern.object, units_per_mm, followed or {}),
            _wave("reference", "-", pattern.reference, units_per_mm, followed or {}),
        )
        if both[0].map.terms:
            # The map comes last, and adds the object wave: see `map_part`.
            return joined((stated, *both, ShaderPart(code="object_wave = -gradient;")))
        return joined((stated, both[0], ShaderPart(code="object_wave = gradient;"), both[1]))
    return joined((stated, characteristic_part(pattern, units_per_mm, reach_mm)))


def _wave(
    role: str, sign: str, wave: WaveSpec, units_per_mm: float, followed: Followed
) -> ShaderPart:
    if role not in followed:
        return wave_part(role, sign, wave, units_per_mm)
    return following(role, wave_part(role, sign, followed[role], units_per_mm))
