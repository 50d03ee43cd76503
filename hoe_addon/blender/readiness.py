# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What would make the picture of a scene black, pink or wrong, and how it is mended.

Panels ask whenever they are drawn: nothing here is worked out, all is read.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum, unique

import bpy

from ..core.errors import HoeError
from .document.held import has_device
from .document.versions import is_newer, newer_words
from .ids import Mode, Role
from .pictures.render_settings import flatten_shutter_curve
from .props import changes
from .props.sync import refresh
from .shaders import stand_in
from .shaders.osl import device_without_osl, has_osl

_FLAT = 1e-6
_OSL = "without Open Shading Language"


@unique
class Mend(StrEnum):
    """What one click does."""

    ENGINE = "engine"
    OSL = "osl"
    DEVICE = "device"
    WAVELENGTHS = "wavelengths"
    COLOURS = "colours"
    BOUNCES = "bounces"
    CAMERA = "camera"
    REFRESH = "refresh"


@dataclass(frozen=True)
class Trouble:
    """One thing that is not as holograms need it.

    Attributes:
        words: What is wrong and what comes of it, one sentence.
        mend: What a click does about it; None where no click can.
        button: Label of the button.
    """

    words: str
    mend: Mend | None = None
    button: str = ""


_NO_CYCLES = Trouble(
    "Holograms are traced by Cycles; other engines show plain stand-ins.",
    Mend.ENGINE,
    "Use Cycles",
)
_NO_OSL = Trouble(
    "This build of Blender has no Open Shading Language: plain stand-ins are shown. Use the "
    "build from blender.org."
)
_OSL_OFF = Trouble(
    "Open Shading Language is off in Cycles: plain stand-ins are shown.",
    Mend.OSL,
    "Switch On OSL",
)
_NO_WAVELENGTHS = Trouble(
    "Motion blur or its shutter is not as set: it carries the wavelengths, so colours are wrong.",
    Mend.WAVELENGTHS,
    "Restore Shutter",
)
_BROKEN_COLOURS = Trouble(
    "Denoising, adaptive sampling or clamping is on: each changes colours of wavelengths.",
    Mend.COLOURS,
    "Switch Off",
)
_FEW_SURFACES = Trouble(
    "Paths end after too few transparent surfaces: the picture loses light.",
    Mend.BOUNCES,
    "Restore Bounces",
)
_OTHER_CAMERA = Trouble(
    "The camera is not the eye, which has the spectral filter: colours are wrong.",
    Mend.CAMERA,
    "Look through the Eye",
)
_NO_FILTER = Trouble(
    "The camera has no spectral filter: colours are wrong. Add an eye with Add > Hologram > Eye."
)


def troubles(scene: bpy.types.Scene) -> tuple[Trouble, ...]:
    """Read what is not as holograms need it, what is worst first.

    Args:
        scene: The scene.

    Returns:
        All that is found; nothing for a scene without holograms.
    """
    if is_newer(scene):
        return (Trouble(f"This scene is {newer_words(scene.hologram.version)}."),)
    holograms = [each for each in bpy.data.materials if each.hologram.enabled and each.users]
    if not has_device(scene) and not _used_in(scene, holograms):
        return ()
    return (*_engine(scene), *_settings(scene), *_unmade(scene, holograms))


def mend(scene: bpy.types.Scene, trouble: Trouble) -> None:
    """Mend what one click can mend.

    Args:
        scene: The scene.
        trouble: One of its troubles, with a ``mend``.

    Raises:
        HoeError: It cannot be done.
    """
    assert trouble.mend is not None
    _MENDS[trouble.mend](scene)


def _used_in(
    scene: bpy.types.Scene, holograms: list[bpy.types.Material]
) -> list[bpy.types.Material]:
    """Those that objects of a scene or patches of its light guide have."""
    if not holograms:
        return []
    here = {slot.material for item in scene.objects for slot in item.material_slots}
    here.update(patch.material for patch in scene.hologram.patches)
    return [each for each in holograms if each in here]


def _engine(scene: bpy.types.Scene) -> Iterator[Trouble]:
    if scene.render.engine != "CYCLES":
        yield _NO_CYCLES
    if not has_osl():
        yield _NO_OSL
    elif not hasattr(scene, "cycles"):
        return
    else:
        kind = device_without_osl(scene)
        if kind is not None:
            words = f"The render device {kind} cannot run Open Shading Language: stand-ins show."
            yield Trouble(words, Mend.DEVICE, "Render on CPU")
        if not scene.cycles.shading_system:
            yield _OSL_OFF


def _settings(scene: bpy.types.Scene) -> Iterator[Trouble]:
    settings = getattr(scene, "cycles", None)
    if settings is None:
        return
    if is_spectral(scene):
        if not _carries_wavelengths(scene):
            yield _NO_WAVELENGTHS
        if _changes_colours(settings):
            yield _BROKEN_COLOURS
        if scene.camera is None or not _has_filter(scene.camera):
            eye = scene.hologram.eye.camera
            yield _OTHER_CAMERA if eye is not None and _has_filter(eye) else _NO_FILTER
    if settings.transparent_max_bounces < _wanted_bounces(scene):
        yield _FEW_SURFACES


def _unmade(scene: bpy.types.Scene, holograms: list[bpy.types.Material]) -> Iterator[Trouble]:
    # Objects are looked through only where there is something to tell.
    told = [each for each in holograms if each.hologram.problem or _can_refresh(each)]
    for material in _used_in(scene, told):
        problem: str = material.hologram.problem
        if _OSL in problem and not has_osl():
            continue  # the scene's own trouble, which is told once
        if problem:
            yield Trouble(f"{material.name}: {problem}")
        elif not changes.is_waiting():
            words = f"{material.name}: the shader is older than the properties."
            yield Trouble(words, Mend.REFRESH, "Refresh")


def is_spectral(scene: bpy.types.Scene) -> bool:
    """Tell whether paths of a scene draw wavelengths.

    Args:
        scene: The scene.

    Returns:
        What its document says; without one, whether its camera has the spectral filter.
    """
    if has_device(scene):
        return scene.hologram.render.mode == Mode.SPECTRAL
    return scene.camera is not None and _has_filter(scene.camera)


def _has_filter(camera: bpy.types.Object) -> bool:
    return any(child.hologram.role == Role.FILTER for child in camera.children)


def _carries_wavelengths(scene: bpy.types.Scene) -> bool:
    if not scene.render.use_motion_blur or scene.cycles.rolling_shutter_type != "NONE":
        return False
    points = scene.render.motion_blur_shutter_curve.curves[0].points
    return all(abs(point.location[1] - 1.0) < _FLAT for point in points)


def _changes_colours(settings: bpy.types.PropertyGroup) -> bool:
    return (
        settings.use_denoising
        or settings.use_adaptive_sampling
        or max(settings.sample_clamp_direct, settings.sample_clamp_indirect) > 0.0
        or settings.blur_glossy > 0.0
    )


def _wanted_bounces(scene: bpy.types.Scene) -> int:
    if not has_device(scene):
        return 0
    return min(scene.hologram.render.max_bounces, 1024)


def _use_cycles(scene: bpy.types.Scene) -> None:
    scene.render.engine = "CYCLES"
    stand_in.settle_if_changed(scene)


def _switch_on(scene: bpy.types.Scene) -> None:
    scene.cycles.shading_system = True
    stand_in.settle_if_changed(scene)


def _use_cpu(scene: bpy.types.Scene) -> None:
    scene.cycles.device = "CPU"
    stand_in.settle_if_changed(scene)


def _restore_shutter(scene: bpy.types.Scene) -> None:
    scene.render.use_motion_blur = True
    scene.cycles.rolling_shutter_type = "NONE"
    flatten_shutter_curve(scene)


def _keep_colours(scene: bpy.types.Scene) -> None:
    settings = scene.cycles
    settings.use_denoising = settings.use_adaptive_sampling = False
    settings.sample_clamp_direct = settings.sample_clamp_indirect = 0.0
    settings.blur_glossy = 0.0


def _restore_bounces(scene: bpy.types.Scene) -> None:
    wanted = _wanted_bounces(scene)
    scene.cycles.transparent_max_bounces = scene.cycles.min_transparent_bounces = wanted


def _look_through_eye(scene: bpy.types.Scene) -> None:
    scene.camera = scene.hologram.eye.camera


def _refresh_all(scene: bpy.types.Scene) -> None:
    """Refresh all holograms that can be; what fails stays noted, and the first error is told."""
    errors: list[HoeError] = []
    stale = [each for each in bpy.data.materials if _can_refresh(each)]
    for material in _used_in(scene, stale):
        try:
            refresh(material, make=bpy.app.background)
        except HoeError as error:
            changes.mark_block(material)
            errors.append(error)
    if errors:
        raise errors[0]


def _can_refresh(material: bpy.types.Material) -> bool:
    return changes.is_changed(material) and material.hologram.enabled and material.library is None


_MENDS: Mapping[Mend, Callable[[bpy.types.Scene], None]] = {
    Mend.ENGINE: _use_cycles,
    Mend.OSL: _switch_on,
    Mend.DEVICE: _use_cpu,
    Mend.WAVELENGTHS: _restore_shutter,
    Mend.COLOURS: _keep_colours,
    Mend.BOUNCES: _restore_bounces,
    Mend.CAMERA: _look_through_eye,
    Mend.REFRESH: _refresh_all,
}
