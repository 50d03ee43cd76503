# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The recorded pattern in the shader: code for ``gradient`` = grad V at ``position``.

The code may read ``position`` (the hit in the frame of the recording, in scene units) and sets
``gradient`` (which begins as zero) and, where nothing is recorded, ``recorded`` to 0.
"""

import math

from ..model.characteristic import LinearSpec
from ..model.pattern import PatternSpec
from ..model.recording import RecordingSpec
from .part import ShaderPart, joined, parameter
from .waves import wave_part


def pattern_part(pattern: PatternSpec, units_per_mm: float) -> ShaderPart:
    """The shader's part for what is recorded.

    Args:
        pattern: The recording or the characteristic function.
        units_per_mm: Scene units in one mm.

    Returns:
        Its part; its sockets hold the wavelength that V is stated for, too.
    """
    stated = ShaderPart(sockets={"recording_wavelength_nm": pattern.wavelength_nm})
    if isinstance(pattern, RecordingSpec):
        return joined(
            (
                stated,
                wave_part("object", "+", pattern.object, units_per_mm),
                wave_part("reference", "-", pattern.reference, units_per_mm),
            )
        )
    return joined((stated, _linear(pattern)))


def _linear(pattern: LinearSpec) -> ShaderPart:
    # lambda_0 Q has no dimension: lines per mm times nm, times 1e-6 mm per nm.
    size = pattern.lines_per_mm * pattern.wavelength_nm * 1e-6
    angle = math.radians(pattern.azimuth_deg)
    return ShaderPart(
        parameters=parameter(
            "vector", "grating", "vector(0.0)", "Grating", "Recording wavelength times Q"
        ),
        code="gradient = grating;",
        sockets={"grating": (size * math.cos(angle), size * math.sin(angle), 0.0)},
    )
