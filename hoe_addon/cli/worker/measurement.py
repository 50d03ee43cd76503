# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Job: what accuracy costs in time, for the document of a scene."""

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .session import Work

if TYPE_CHECKING:
    from ...model.device import DeviceSpec


def run(work: Work) -> dict[str, Any]:
    """Measure and keep the results.

    Args:
        work: The job; its setting ``budget`` is the time in seconds.

    Returns:
        What the window shows of it.
    """
    import bpy

    from ...blender.accuracy.runs import measure_accuracy
    from ...blender.document.held import document_of
    from ..accuracy import FILES, least_size, small, write_accuracy

    spec, budget = small(document_of(work.scene)), work.settings["budget"]
    least_size(spec)
    pictures = Path(bpy.data.filepath).parent
    found = measure_accuracy(
        spec, lambda variant: _opened(variant, pictures), budget, work.leash.stopped, work.told
    )
    plot = find_spec("matplotlib") is not None
    report = write_accuracy(spec, found, budget, work.out, plot=plot)
    without = "" if plot else "; without the diagram, for Blender has no matplotlib"
    files = [name for name in FILES if plot or name != "accuracy.png"]
    return {
        "words": f"{len(report['runs'])} settings measured in {found.spent.total:.0f} s, "
        f"{budget:g} s asked{without}",
        "stopped": found.stopped,
        "folder": str(work.out),
        "page": str(work.out / "accuracy.html"),
        "files": files,
    }


def _opened(spec: "DeviceSpec", pictures: Path) -> Any:
    """Build a variant of the device in a new, empty file."""
    import bpy

    from ...blender.build.device import build_device

    bpy.ops.wm.read_factory_settings(use_empty=True)
    assert bpy.context.scene is not None, "an empty file has a scene"
    return build_device(bpy.context.scene, spec, pictures)
