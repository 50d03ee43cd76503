# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of the examples that measure in rendered pictures."""

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from .picture_options import open_device

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..blender.build.device import DeviceScene

_SMALL_PUPIL_MM = 0.5
"""Sharp pictures, whose spots have their middle in the direction of one ray."""

_SPOT_MM = 0.2


def opened(preset: str, changes: Sequence[str] = ()) -> "DeviceScene":
    """Build a preset in a new, empty Blender file.

    Args:
        preset: Name of the device.
        changes: Changes in the form of ``--set``.

    Returns:
        The device in its scene.
    """
    from ..model.document import load_device

    return open_device(argparse.Namespace(device=preset), load_device(preset, changes))


def seen_angles_deg(preset: str, changes: Sequence[str]) -> tuple[float, float]:
    """Render a scene without its room, and find where its light is.

    Args:
        preset: Name of the scene.
        changes: Changes in the form of ``--set``, after which it shows one spot.

    Returns:
        Degrees to the right and up from the eye.
    """
    from ..model.scene_view import gaze_of

    return gaze_of(_seen(preset, changes))


def seen_spot(
    preset: str,
    display: str,
    pupil_mm: tuple[float, float, float],
    wavelength_nm: float,
    changes: Sequence[str],
) -> "NDArray[np.float64]":
    """Render a small white square in the middle of a display, and find where it is seen.

    Args:
        preset: Name of the scene.
        display: Name of the display.
        pupil_mm: Middle of the pupil.
        wavelength_nm: The one wavelength of the picture.
        changes: Further changes in the form of ``--set``.

    Returns:
        Direction from the pupil, shape ``(3,)``.
    """
    return _seen(
        preset,
        [
            f"elements.{display}.display.image=white",
            f"elements.{display}.display.size_mm=[{_SPOT_MM}, {_SPOT_MM}]",
            f"eye.position_mm={list(pupil_mm)}",
            "render.mode=preview",
            f"render.preview_wavelength_nm={wavelength_nm}",
            *changes,
        ],
    )


def _seen(preset: str, changes: Sequence[str]) -> "NDArray[np.float64]":
    from ..blender.build.measure import seen_direction

    quiet = ("room.kind=none", f"eye.pupil_diameter_mm={_SMALL_PUPIL_MM}")
    return seen_direction(opened(preset, (*quiet, *changes)))
