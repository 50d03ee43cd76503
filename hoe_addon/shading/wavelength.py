# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelength on ray time: the tables of the sampled spectrum, written into the shaders."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .source import ShaderSource, array, specialised

PLAIN_TIME = {"time_scale": 1.0, "time_offset": 0.0}
"""Socket values for a time that is set by the pixel row and not drawn through the shutter table."""


def wavelength_shader(nodes_nm: ArrayLike) -> ShaderSource:
    """The node that tells every material the wavelength of the path.

    Args:
        nodes_nm: Wavelengths in nm at equal steps of time from 0 to 1, at least two.

    Returns:
        The flat text.
    """
    nodes = np.asarray(nodes_nm, dtype=np.float64)
    return specialised(
        "hoe_wavelength",
        {"HOE_NODES": str(nodes.size), "HOE_WAVELENGTH_NODES": array(nodes)},
    )


def filter_shader(response: NDArray[np.float64]) -> ShaderSource:
    """The eye's response in front of the camera.

    Args:
        response: Linear RGB at the nodes, shape ``(K + 1, 3)``.

    Returns:
        The flat text.
    """
    return _tables_shader("hoe_spectral_filter", "RESPONSE", response.T)


def display_shader(emission: NDArray[np.float64]) -> ShaderSource:
    """The display.

    Args:
        emission: Emission of the red, green and blue primary at the nodes, shape ``(3, K + 1)``.

    Returns:
        The flat text.
    """
    return _tables_shader("hoe_display", "EMISSION", emission)


def _tables_shader(name: str, what: str, rgb: NDArray[np.float64]) -> ShaderSource:
    definitions = {"HOE_NODES": str(rgb.shape[1])}
    for channel, values in zip(("RED", "GREEN", "BLUE"), rgb, strict=True):
        definitions[f"HOE_{what}_{channel}"] = array(values)
    return specialised(name, definitions)
