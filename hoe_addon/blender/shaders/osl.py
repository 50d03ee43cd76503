# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compile OSL inside Blender, and say plainly where that cannot be done."""

import os
import re
from functools import cache

import bpy

from ...core.errors import MissingOslError, ShaderCompileError
from ...files import scratch_folder
from ...shading.source import ShaderSource
from ..quiet import captured_output

_DEVICES_WITH_OSL = ("NONE", "OPTIX")
"""Kinds of GPU in the preferences. Where none is chosen, Cycles takes the CPU."""


def has_osl() -> bool:
    """Whether this Blender's Cycles was built with Open Shading Language."""
    try:
        import _cycles
    except ImportError:
        return False
    return bool(_cycles.with_osl)


def require_osl(scene: bpy.types.Scene | None = None) -> None:
    """Refuse to go on where holograms cannot be rendered.

    Args:
        scene: When given, its render device is looked at too.

    Raises:
        MissingOslError: No OSL in this build, or the device cannot run it.
    """
    if not has_osl():
        raise MissingOslError(
            f"this Blender ({bpy.app.version_string}) was built without Open Shading Language, "
            "which holograms need; use the official build from blender.org or the bpy module"
        )
    if scene is not None:
        kind = device_without_osl(scene)
        if kind is not None:
            raise MissingOslError(
                f"the render device {kind} cannot run Open Shading Language; choose CPU, or OptiX "
                "in the preferences"
            )


def runs_osl(scene: bpy.types.Scene) -> bool:
    """Tell whether Cycles runs OSL for a scene as it is set up now.

    Args:
        scene: The scene; whether its engine is Cycles does not matter.

    Returns:
        False where the build or the device cannot, or OSL is switched off.
    """
    settings = getattr(scene, "cycles", None)
    if settings is None or not settings.shading_system:
        return False
    return has_osl() and device_without_osl(scene) is None


def device_without_osl(scene: bpy.types.Scene) -> str | None:
    """Find the kind of GPU that a scene renders on, where that cannot run OSL.

    Args:
        scene: The scene.

    Returns:
        Its kind in the preferences, such as ``CUDA``; None where OSL runs, or on the CPU.
    """
    if scene.cycles.device != "GPU":
        return None
    kind: str = bpy.context.preferences.addons["cycles"].preferences.compute_device_type
    return None if kind in _DEVICES_WITH_OSL else kind


@cache
def compiled(source: ShaderSource) -> str:
    """Compile a text; equal texts are compiled once per process.

    Args:
        source: The flat text.

    Returns:
        The bytecode (.oso text).

    Raises:
        MissingOslError: This build has no OSL.
        ShaderCompileError: With the first line that the compiler complains about.
    """
    require_osl()
    import _cycles

    with scratch_folder() as folder:
        text, bytecode = folder / f"{source.name}.osl", folder / f"{source.name}.oso"
        text.write_text(source.text, encoding="utf-8", newline="\n")
        with captured_output() as messages:
            done = _cycles.osl_compile(str(text), str(bytecode))
        if not done:
            raise ShaderCompileError(f"{source.name}.osl: {_first_error(messages, folder)}")
        return bytecode.read_text(encoding="utf-8")


def _first_error(messages: list[str], folder: str) -> str:
    for line in messages:
        if re.search(r"error", line, re.IGNORECASE):
            return line.replace(f"{folder}{os.sep}", "").strip()
    return "the compiler gave no reason"
