# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of OSL expressions as Cycles finds them: each row of a table is one pixel of a camera."""

from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hoe_addon import resources
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.shading.source import ShaderSource, array

EFFICIENCY_HEADERS = ("hoe_medium.h", "hoe_kinoform.h", "hoe_math.h", "hoe_relief.h")

_WIDTH = 64
_LEAST_HEIGHT = 4
"""Blender makes no picture of fewer lines."""

_MOST_NUMBERS = 60_000
"""OSL's constant arrays hold 65,536 numbers."""

_RANGE = 200.0
"""Exponents of float32, subnormal ones too, become positive by this."""


def values_of(
    scene: bpy.types.Scene,
    call: str,
    rows: ArrayLike | Sequence[tuple[float, ...]],
    functions: str = "",
    headers: Sequence[str] = EFFICIENCY_HEADERS,
) -> NDArray[np.float64]:
    """Evaluate an OSL expression of the numbers a[0], a[1], ... of each row, in Cycles' cameras.

    A value comes back as mantissa, exponent and sign, since Cycles drops what is very dark and what
    is negative. Numbers are given to the shader in float32; NaN and infinity come back as such.

    Args:
        scene: An empty scene.
        call: The expression, a float.
        rows: Numbers, shape ``(R, k)``.
        functions: OSL text before the shader.
        headers: Shipped headers, in the order of their use.

    Returns:
        Values, shape ``(R,)``.
    """
    table = np.asarray(rows, dtype=np.float64)
    text = "".join(_without_includes(name) for name in headers) + functions
    most = _MOST_NUMBERS // table.shape[1] // _WIDTH * _WIDTH
    parts = [
        _part(scene, call, table[start : start + most], text)
        for start in range(0, len(table), most)
    ]
    return np.concatenate(parts)


def _without_includes(name: str) -> str:
    lines = resources.osl_path(name).read_text("utf-8").splitlines()
    return "".join(line + "\n" for line in lines if not line.startswith("#include"))


def _part(
    scene: bpy.types.Scene, call: str, rows: NDArray[np.float64], functions: str
) -> NDArray[np.float64]:
    count, size = rows.shape
    height = max(-(-count // _WIDTH), _LEAST_HEIGHT)
    table = np.zeros((height * _WIDTH, size))
    table[:count] = rows
    text = f"""{functions}
shader hoe_test_values(output point position = 0.0, output vector direction = vector(0, 0, 1),
                       output color throughput = 1.0)
{{
    float numbers[{table.size}] = {array(table.ravel())};
    point raster = camera_shader_raster_position();
    int row = (int)floor(raster[1] * {height});
    int first = {size} * ({_WIDTH} * row + (int)floor(raster[0] * {_WIDTH}));
    float a[{size}];
    for (int k = 0; k < {size}; ++k)
        a[k] = numbers[first + k];
    float value = {call};
    float size = abs(value);
    if (isnan(value))
        throughput = color(1.0, {_RANGE}, 4.0);
    else if (isinf(value))
        throughput = color(1.0, {_RANGE}, value > 0.0 ? 3.0 : 5.0);
    else {{
        float power = size > 0.0 ? logb(size) : 0.0;
        throughput = color(size * exp2(-power), power + {_RANGE}, value < 0.0 ? 2.0 : 1.0);
    }}
}}
"""
    pixels = _picture(scene, ShaderSource("hoe_test_values", text), height)
    # Pixel rows are counted from the top, raster from the bottom.
    mantissa, power, kind = np.moveaxis(pixels[::-1, :, :3], -1, 0)
    assert np.all(np.isin(kind, (1.0, 2.0, 3.0, 4.0, 5.0)))
    sign = np.select(
        [kind == 2.0, kind == 3.0, kind == 4.0, kind == 5.0], [-1.0, np.inf, np.nan, -np.inf], 1.0
    )
    return (sign * (mantissa * 2.0 ** (power - _RANGE))).ravel()[:count]


def _picture(
    scene: bpy.types.Scene, camera_shader: ShaderSource, height: int
) -> NDArray[np.float64]:
    """Render the throughput of a camera before a white world."""
    camera = bpy.data.cameras.new("Values")
    camera.type, camera.custom_mode = "CUSTOM", "INTERNAL"
    camera.custom_bytecode = compiled(camera_shader)
    camera.custom_bytecode_hash = camera_shader.digest
    scene.camera = bpy.data.objects.new("Values", camera)
    scene.collection.objects.link(scene.camera)
    scene.world = bpy.data.worlds.new("White")
    tree = nodes.new_tree(scene.world)
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    set_up(scene, samples=1, seed=0, spectral=False, max_bounces=4)
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x, scene.render.resolution_y = _WIDTH, height
    return render_layers(scene, (COMBINED,))[COMBINED].astype(np.float64)


def float32(values: Any) -> NDArray[np.float64]:
    """Return numbers as the shader gets them."""
    return np.asarray(values, dtype=np.float32).astype(np.float64)
