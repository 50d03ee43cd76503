# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A survey of the eyebox: what the eye sees, and how bright it is, from a grid of pupils.

The views show the device as it is. The numbers come from renders of their own: a white display,
no other light, exactly the display's field, in cells of about half a degree.
"""

import contextlib
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.extremes import extremes, ratio
from ...core.photometry import luminance, measure
from ...core.picture_error import Estimate
from ...model.eyebox import PupilPosition, pupil_positions
from ...model.field import field_degrees, field_tangents
from ...shading.pictures import built_in
from ..build.device import DeviceScene
from ..kept import changed, kept
from ..shaders.materials import picture
from .division import divided
from .render import Progress, render_layers
from .render_settings import size_settings
from .view import DISPLAY_LAYER, View, render_view

_CELL_DEG = 0.5
_LEAST_CELLS = 4  # Blender renders nothing smaller
_FIELDS_SHARE = 0.2
"""Share of the work that the measurements count for progress, which come before the views."""

_INDEPENDENT_PARTS = 4
"""Renders with seeds of their own, whose spread gives the standard error."""


@dataclass(frozen=True, eq=False)
class FieldLuminance:
    """Light of a white display at one pupil.

    Attributes:
        mean_cd_m2: Mean luminance over the field.
        standard_error_cd_m2: Of that mean.
        least: Luminance of the darkest cell, in cd/m2.
        greatest: Luminance of the brightest cell, in cd/m2.
        u_prime: CIE 1976 u' of the mean colour, NaN for black.
        v_prime: CIE 1976 v' of the mean colour, NaN for black.
    """

    mean_cd_m2: float
    standard_error_cd_m2: float
    least: Estimate
    greatest: Estimate
    u_prime: float
    v_prime: float

    def to_dict(self) -> dict[str, Any]:
        """The numbers for JSON, which knows no NaN: black has no colour."""
        uniformity = ratio(self.least, self.greatest)
        black = math.isnan(self.u_prime)
        return {
            "mean_cd_m2": self.mean_cd_m2,
            "standard_error_cd_m2": self.standard_error_cd_m2,
            "min_cd_m2": self.least.value,
            "min_standard_error_cd_m2": self.least.standard_error,
            "max_cd_m2": self.greatest.value,
            "max_standard_error_cd_m2": self.greatest.standard_error,
            "uniformity": uniformity.value,
            "uniformity_standard_error": uniformity.standard_error,
            "u_prime": None if black else self.u_prime,
            "v_prime": None if black else self.v_prime,
        }


@dataclass(frozen=True, eq=False)
class PupilResult:
    """One pupil of a survey.

    Attributes:
        position: Where the pupil is.
        view: What the eye sees there.
        field: How bright a white display is there.
    """

    position: PupilPosition
    view: View
    field: FieldLuminance


def survey(
    device: DeviceScene, field_samples: int, progress: Progress | None = None
) -> Iterator[PupilResult]:
    """Look from every position of the eyebox.

    Args:
        device: The device in its scene; its camera is moved, and put back at the end.
        field_samples: Samples per cell of the luminance measurement, at least 4.
        progress: Told after every measurement and every part of a view.

    Yields:
        The positions, row by row from the top left.

    Raises:
        RenderError: Blender gave no usable picture.
        CancelledError: The progress function asked to stop.
    """
    positions = list(pupil_positions(device.guide_spec))
    render = device.scene.render
    before = tuple(device.eye.location), render.use_persistent_data
    try:
        # Only the camera moves between the views: the scene need not be prepared again.
        render.use_persistent_data = True
        division = divided(device, device.scene.cycles.samples)
        measured = _share_of(progress, 0.0, _FIELDS_SHARE)
        fields = fields_at(device, positions, field_samples, measured)
        each = (1.0 - _FIELDS_SHARE) / len(positions)
        for number, position in enumerate(positions):
            device.eye.location = position.centre_mm
            told = _share_of(progress, _FIELDS_SHARE + number * each, each)
            view = render_view(device, told, division)
            yield PupilResult(position, view, fields[number])
    finally:
        device.eye.location, render.use_persistent_data = before


@contextlib.contextmanager
def white_field(device: DeviceScene) -> Iterator[None]:
    """Show white on the display, switch the room off, and look at exactly the field."""
    assert device.panel is not None, "a light guide has a display"
    white = picture("white", built_in("white", 16, 16))
    scene, camera = device.scene, device.camera
    texture = next(
        node
        for node in device.panel.active_material.node_tree.nodes
        if node.bl_idname == "ShaderNodeTexImage"
    )
    columns, rows = (
        max(_LEAST_CELLS, round(angle / _CELL_DEG)) for angle in field_degrees(device.guide_spec)
    )
    half_x, half_y = field_tangents(device.guide_spec)
    tallness = (half_y / rows) / (half_x / columns)
    groups = (
        (texture, {"image": white, "extension": "EXTEND"}),
        (device.room, {"hide_render": True}),
        (camera, {"sensor_width": 2.0 * camera.lens * half_x}),
        (
            scene.render,
            {
                **size_settings(columns, rows),
                # Cells need not be square; Blender wants the smaller aspect to be 1.
                "pixel_aspect_x": max(1.0, 1.0 / tallness),
                "pixel_aspect_y": max(1.0, tallness),
            },
        ),
        (scene.cycles, {"pixel_filter_type": "BOX", "filter_width": 1.0}),
    )
    try:
        with changed(*groups):
            yield
    finally:
        bpy.data.images.remove(white)


def fields_at(
    device: DeviceScene,
    positions: Sequence[PupilPosition],
    samples: int,
    progress: Progress | None = None,
) -> list[FieldLuminance]:
    """Measure the light of a white display at some pupils; the camera stays at the last.

    Args:
        device: The device in its scene.
        positions: Where the pupil is put.
        samples: Samples per cell, at least 4.
        progress: Told after every position.

    Returns:
        Luminance and colour, in the order of the positions.
    """
    found: list[FieldLuminance] = []
    with white_field(device):
        for position in positions:
            device.eye.location = position.centre_mm
            found.append(measure_field(device, samples))
            if progress is not None:
                progress(len(found) / len(positions))
    return found


def measure_field(device: DeviceScene, samples: int) -> FieldLuminance:
    """Measure what the camera sees of the display, in a scene set up by ``white_field``.

    Args:
        device: The device in its scene.
        samples: Samples per cell, at least 4.

    Returns:
        Luminance and colour.
    """
    cycles, unit = device.scene.cycles, device.guide_spec.render.luminance_per_unit_cd_m2
    parts: list[NDArray[np.float32]] = []
    with kept((cycles, ("samples", "seed"))):
        cycles.samples = max(1, samples // _INDEPENDENT_PARTS)
        for _ in range(_INDEPENDENT_PARTS):
            cycles.seed += 1
            parts.append(render_layers(device.scene, (DISPLAY_LAYER,))[DISPLAY_LAYER])
    cells = [luminance(part, unit) for part in parts]
    means = [float(each.mean()) for each in cells]
    least, greatest = extremes(cells)
    whole = measure(np.mean(parts, axis=0), unit)
    return FieldLuminance(
        mean_cd_m2=float(np.mean(cells)),
        standard_error_cd_m2=float(np.std(means, ddof=1)) / math.sqrt(len(means)),
        least=least,
        greatest=greatest,
        u_prime=whole.u_prime,
        v_prime=whole.v_prime,
    )


def _share_of(progress: Progress | None, before: float, own: float) -> Progress | None:
    if progress is None:
        return None
    return lambda done: progress(before + own * done)
