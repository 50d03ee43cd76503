# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""From documents (nm, mm) to the core's own types (SI)."""

from ..core.pattern import Pattern
from ..core.recording import Recording
from ..core.shapes import Shape
from ..core.units import nm_to_m
from .characteristic.convert import characteristic_from
from .convert_waves import wave_from
from .pattern import PatternSpec
from .recording import RecordingSpec
from .surface import SurfaceSpec


def recording_from(spec: RecordingSpec) -> Recording:
    """Make a recording of the core.

    Args:
        spec: The recording of a document.

    Returns:
        The same recording in SI units.
    """
    return Recording(
        object=wave_from(spec.object, spec.wavelength_nm),
        reference=wave_from(spec.reference, spec.wavelength_nm),
        wavelength=float(nm_to_m(spec.wavelength_nm)),
    )


def pattern_from(spec: PatternSpec) -> Pattern:
    """Make what is recorded in an element, for the core.

    Args:
        spec: The recording or the characteristic function of a document.

    Returns:
        The pattern in SI units.
    """
    if isinstance(spec, RecordingSpec):
        return recording_from(spec)
    return characteristic_from(spec)


def shape_from(spec: SurfaceSpec) -> Shape:
    """Make the surface of an element, for the core.

    Args:
        spec: The surface of a document.

    Returns:
        The shape in metres; a mesh as it is given, see ``element.element_shape``.
    """
    return spec.core_shape()
