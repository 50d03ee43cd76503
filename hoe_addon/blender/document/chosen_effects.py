# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user decides about effects, as it stands in ``Scene.hologram.render.effects``."""

import bpy
from msgspec.structs import replace

from ...core.errors import SpecError
from ...model.device import DeviceSpec
from ...model.effects.holograms import holograms_of
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


def forget(scene: bpy.types.Scene, hologram: str) -> None:
    """Forget all that was decided for a hologram that is taken away.

    Args:
        scene: The scene.
        hologram: Its name.
    """
    entries = scene.hologram.render.effects
    for place in reversed(range(len(entries))):
        if _hologram_of(entries[place].name) == hologram:
            entries.remove(place)


def of_present[S: DeviceSpec](spec: S) -> S:
    """Leave out what was decided for holograms that have another name now, or are gone.

    Args:
        spec: The document of a scene.

    Returns:
        One whose ``render.effects`` name only holograms that it has.
    """
    effects = spec.render.effects
    if not any(map(_hologram_of, effects)):
        return spec
    names = ("", *holograms_of(spec))
    present = tuple(text for text in effects if _hologram_of(text) in names)
    return replace(spec, render=replace(spec.render, effects=present))


def _hologram_of(text: str) -> str:
    """Name of the hologram that a change of the plan is about; empty for the whole scene."""
    return text.rpartition(":")[0]


def _remove(scene: bpy.types.Scene, effect: str, holograms: tuple[str, ...]) -> None:
    entries = scene.hologram.render.effects
    for place in reversed(range(len(entries))):
        if _is_about(entries[place].name, effect, holograms):
            entries.remove(place)


def _is_about(text: str, effect: str, holograms: tuple[str, ...]) -> bool:
    name = _hologram_of(text)
    try:
        chosen = read_overrides((text,), (name,)).chosen
    except SpecError:
        return False
    return any((effect, hologram) in chosen for hologram in holograms)
