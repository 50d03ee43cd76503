# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavelength on ray time: the tables of the sampled spectrum, written into the shaders."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .source import ShaderSource, array, specialised

PLAIN_TIME = {"time_scale": 1.0, "time_offset": 0.0}
"""Socket values for a time that is set by the pixel row and not drawn through the shutter table."""


def wavelength_shader(nodes_nm: ArrayLike, samplings: int = 1) -> ShaderSource:
    """The node that tells every material the wavelength of the path.

    Args:
        nodes_nm: Wavelengths in nm at equal steps of time from 0 to 1, at least two; those of
            several samplings stand one behind the other.
        samplings: How many samplings there are.

    Returns:
        The flat text.
    """
    nodes = np.asarray(nodes_nm, dtype=np.float64)
    return specialised(
        "hoe_wavelength",
        {**_sizes(nodes.size, samplings), "HOE_WAVELENGTH_NODES": array(nodes)},
    )


def filter_shader(response: NDArray[np.float64], samplings: int = 1) -> ShaderSource:
    """The eye's response in front of the camera.

    Args:
        response: Linear RGB at the nodes, shape ``(S (K + 1), 3)``.
        samplings: Number S of samplings.

    Returns:
        The flat text.
    """
    return _tables_shader("hoe_spectral_filter", "RESPONSE", response.T, samplings)


def response_shader(response: NDArray[np.float64], samplings: int = 1) -> ShaderSource:
    """The eye's response as a factor of light sources.

    Args:
        response: Linear RGB at the nodes, shape ``(S (K + 1), 3)``.
        samplings: Number S of samplings.

    Returns:
        The flat text.
    """
    return _tables_shader("hoe_response", "RESPONSE", response.T, samplings)


def display_shader(emission: NDArray[np.float64], samplings: int = 1) -> ShaderSource:
    """The display.

    Args:
        emission: Emission of the red, green and blue primary at the nodes, shape
            ``(3, S (K + 1))``.
        samplings: Number S of samplings.

    Returns:
        The flat text.
    """
    return _tables_shader("hoe_display", "EMISSION", emission, samplings)


def one_wavelength_display_shader() -> ShaderSource:
    """The display of a scene where all paths have one wavelength: its colours are sockets.

    Returns:
        The flat text.
    """
    return specialised("hoe_display", {"HOE_ONE_WAVELENGTH": "1"})


def _tables_shader(name: str, what: str, rgb: NDArray[np.float64], samplings: int) -> ShaderSource:
    definitions = _sizes(rgb.shape[1], samplings)
    for channel, values in zip(("RED", "GREEN", "BLUE"), rgb, strict=True):
        definitions[f"HOE_{what}_{channel}"] = array(values)
    return specialised(name, definitions)


def _sizes(values: int, samplings: int) -> dict[str, str]:
    """Nodes in one sampling's table and values in all, as the literals that OSL wants."""
    return {"HOE_NODES": str(values // samplings), "HOE_VALUES": str(values)}
