# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user decides about effects, as it stands in ``Scene.hologram.render.effects``."""

import bpy

from ...core.errors import SpecError
from ...model.effects.names import WHOLE_SCENE
from ...model.effects.overrides import read_overrides
from ..props import changes


def choose(scene: bpy.types.Scene, effect: str, hologram: str, *, on: bool) -> None:
    """Turn an effect on or off, whatever the plan says.

    Args:
        scene: The scene.
        effect: Name of the effect.
        hologram: Name of the hologram; empty for the whole scene.
        on: Whether it is simulated.

    Raises:
        SpecError: There is no such effect.
    """
    text = f"{hologram}:" if hologram else ""
    text += f"{'+' if on else '-'}{effect}"
    read_overrides((text,), (hologram,))
    _remove(scene, effect, (hologram,))
    scene.hologram.render.effects.add().name = text
    changes.mark_block(scene)


def leave_to_plan(scene: bpy.types.Scene, effect: str, hologram: str) -> None:
    """Let the plan decide about an effect again.

    Args:
        scene: The scene.
        effect: Name of the effect.
        hologram: Name of the hologram; what was decided for all holograms goes too.
    """
    _remove(scene, effect, (hologram, WHOLE_SCENE))
    changes.mark_block(scene)


def leave_all_to_plan(scene: bpy.types.Scene) -> None:
    """Let the plan decide about all effects.

    Args:
        scene: The scene.
    """
    scene.hologram.render.effects.clear()
    changes.mark_block(scene)


def is_chosen(scene: bpy.types.Scene, effect: str, hologram: str) -> bool:
    """Tell whether the user has decided about an effect.

    Args:
        scene: The scene.
        effect: Name of the effect.
        hologram: Name of the hologram; empty for the whole scene.

    Returns:
        Whether he has, for this hologram or for all.
    """
    return any(
        _is_about(entry.name, effect, (hologram, WHOLE_SCENE))
        for entry in scene.hologram.render.effects
    )


def _remove(scene: bpy.types.Scene, effect: str, holograms: tuple[str, ...]) -> None:
    entries = scene.hologram.render.effects
    for place in reversed(range(len(entries))):
        if _is_about(entries[place].name, effect, holograms):
            entries.remove(place)


def _is_about(text: str, effect: str, holograms: tuple[str, ...]) -> bool:
    name = text.rpartition(":")[0]
    try:
        chosen = read_overrides((text,), (name,)).chosen
    except SpecError:
        return False
    return any((effect, hologram) in chosen for hologram in holograms)
