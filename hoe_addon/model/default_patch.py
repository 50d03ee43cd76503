# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A further hologram on a light guide, that goes together with those that are there."""

import math
from collections.abc import Iterator
from itertools import product
from typing import Literal

import numpy as np
from msgspec.structs import replace

from . import medium
from .device import LightGuideSpec, PatchSpec
from .efficiency import ConstantSpec, ShareTable
from .evaluate import trace
from .field_error import FieldError
from .rays import RayTable
from .recording import RecordingSpec
from .waves import PlaneWaveSpec

type Purpose = Literal["in", "out"]

_NAMES = {"in": "in_coupler", "out": "out_coupler"}
_SHARES = {"in": ShareTable(T={"0": 0.1, "1": 0.9}), "out": ShareTable(T={"0": 0.5, "1": 0.5})}
_WIDTHS = {"in": 0.15, "out": 0.3}
"""Width of a new hologram as a share of the plate's."""
_HEIGHT = 0.8
_SHRINKS = (1.0, 0.5, 0.25, 0.125)
_PLACES = 41
"""Places that are tried along a side."""


def default_patch(spec: LightGuideSpec, purpose: Purpose) -> PatchSpec:
    """Make a hologram that takes light into the guide, or gives it to the eye.

    It is the grating of the device's in-coupler, so that colours come together again.

    Args:
        spec: The device.
        purpose: ``"in"`` or ``"out"``.

    Returns:
        The hologram, on a free place of the eye-side face.

    Raises:
        FieldError: There is no free place, or the in-coupler sends no light into the guide.
    """
    made = PatchSpec(
        name=_free_name(spec, _NAMES[purpose]),
        face="eye",
        center_mm=spec.guide.center_mm,
        size_mm=spec.guide.size_mm,
        recording=_recording(spec, purpose),
        efficiency=ConstantSpec(table=_SHARES[purpose], total_internal_reflection=True),
        orders=(0, 1),
    )
    for shrink in _SHRINKS:
        width, height = spec.guide.size_mm
        size = (round(width * _WIDTHS[purpose] * shrink, 3), round(height * _HEIGHT * shrink, 3))
        for centre in _centres(spec, size):
            placed = replace(made, center_mm=centre, size_mm=size)
            if not any(placed.overlaps(other) for other in spec.holograms):
                return placed
    rule = "must leave a free place on the eye side of the plate; make one smaller first"
    raise FieldError("holograms", rule, len(spec.holograms))


def _free_name(spec: LightGuideSpec, name: str) -> str:
    taken = {patch.name for patch in spec.holograms}
    number = 1
    while name in taken:
        number += 1
        name = f"{name.rstrip('0123456789_')}_{number}"
    return name


def _centres(spec: LightGuideSpec, size: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Places where a patch stays on the plate, those nearest to the middle of the eye first."""
    sides: list[list[float]] = []
    for axis in (0, 1):
        middle, room = spec.guide.center_mm[axis], (spec.guide.size_mm[axis] - size[axis]) / 2.0
        places = np.linspace(middle - room, middle + room, _PLACES).round(3).tolist()
        sides.append(places)
    x, y, _ = spec.eye.position_mm
    yield from sorted(product(sides[0], sides[1]), key=lambda each: math.dist(each, (x, y)))


def _recording(spec: LightGuideSpec, purpose: Purpose) -> RecordingSpec:
    source = spec.patch(spec.source.patch)
    wavelength = source.hologram(spec.guide).pattern.wavelength_nm
    inside = medium.index_at(spec.guide, "medium", wavelength)
    outside = medium.index_at(spec.guide, "outside", wavelength)
    x, y, z = _guided(spec, wavelength)
    if purpose == "in":
        light = PlaneWaveSpec(direction=(x, y, -z), index=inside)
        return RecordingSpec(
            wavelength_nm=wavelength,
            object=light,
            reference=PlaneWaveSpec(direction=(0.0, 0.0, -1.0), index=outside),
        )
    return RecordingSpec(
        wavelength_nm=wavelength,
        object=PlaneWaveSpec(direction=(0.0, 0.0, 1.0), index=outside),
        reference=PlaneWaveSpec(direction=(x, y, z), index=inside),
    )


def _guided(spec: LightGuideSpec, wavelength_nm: float) -> tuple[float, float, float]:
    """Direction in the device of light in the guide, on its way to the eye-side face."""
    source = spec.patch(spec.source.patch)
    # Light of the engine comes along -z of the device, whose z is -z of a patch on the far face.
    heading = -1.0 if source.face == "eye" else 1.0
    ray = RayTable(
        np.array([[0.0, 0.0, 0.0]]),
        np.array([[0.0, 0.0, heading]]),
        np.array([wavelength_nm]),
        np.array([1]),
        np.array([source.face == "world"]),
    )
    x, y, z = trace(source.hologram(spec.guide), ray).direction[0].tolist()
    if not math.isfinite(x + y + z):
        raise FieldError("source.patch", "must send order +1 into the guide", source.name)
    return (x if source.face == "eye" else -x), y, abs(z)
