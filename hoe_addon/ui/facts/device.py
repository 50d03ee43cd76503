# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The numbers that an engineer asks of a device first, as lines of text with their units."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import bpy
import msgspec

from ...blender.add.elements import has_eye
from ...blender.document import foreign
from ...blender.document.held import document_of, has_device
from ...blender.document.size import enlargement
from ...blender.props.sync import read_spec
from ...core.errors import HoeError
from ...model.contents import digest
from ...model.device import DeviceSpec, LightGuideSpec
from ...model.field import field_degrees
from ...model.scene import SceneSpec
from ...model.scene_parts import DisplayElement, HologramElement
from ...model.scene_view import chief_ray, image_distance_mm
from ..wording import part_of

_MOST_PAIRS = 4
"""Pairs of a hologram and a display whose image is looked for; each takes some milliseconds."""

_PUPIL_STEP_MM = 1.0
"""Distance of the two pupils from which an image is seen."""

_FAR_M = 1000.0
"""From here on an image is called infinitely far."""


@dataclass(frozen=True)
class Line:
    """One line of a table.

    Attributes:
        label: What it is.
        value: The number with its unit.
    """

    label: str
    value: str


@dataclass(frozen=True)
class DeviceFacts:
    """What panels say of the device in a scene.

    Attributes:
        lines: Its numbers, as its eye sees it; none without an eye.
        problem: Why its properties make no valid document; empty where they do.
        foreign: Names of things in the scene that the document does not know.
        enlargement: How many times its true size the device has in the scene.
        digest: Hash of all that its effect plan depends on.
    """

    lines: tuple[Line, ...] = ()
    problem: str = ""
    foreign: tuple[str, ...] = ()
    enlargement: float = 1.0
    digest: str = ""


def device_facts(scene: bpy.types.Scene) -> DeviceFacts:
    """Work out what panels say of the device in a scene.

    Args:
        scene: Any scene.

    Returns:
        The facts; none for a scene without a device.
    """
    if not has_device(scene):
        return DeviceFacts()
    try:
        spec = document_of(scene)
    except HoeError as error:
        return DeviceFacts(problem=_problem(scene, error), foreign=foreign.things(scene))
    return DeviceFacts(
        tuple(lines_of(spec)) if has_eye(scene) else (),
        scene.hologram.problem,
        foreign.things(scene),
        enlargement(scene),
        plan_digest(spec),
    )


def _problem(scene: bpy.types.Scene, error: HoeError) -> str:
    """Say what is wrong; of a hologram only where, for its own panels tell what."""
    for item in scene.objects:
        for slot in item.material_slots:
            if slot.material is None or not slot.material.hologram.enabled:
                continue
            try:
                read_spec(slot.material, item)
            except HoeError as found:
                return f"Problem in the {part_of(str(found)) or 'hologram'} of {item.name}"
    return str(error)


def lines_of(spec: DeviceSpec) -> Iterator[Line]:
    """The numbers of a device.

    Args:
        spec: Its document.

    Yields:
        Lines, the most asked for first.
    """
    if isinstance(spec, LightGuideSpec):
        yield from _guide_lines(spec)
    else:
        yield from _scene_lines(spec)
    width, height = spec.render.size
    per_degree = width / spec.eye.field_deg
    yield Line("Picture", f"{width} x {height} px")
    yield Line("Resolution", f"{per_degree:.3g} px/deg")


def plan_digest(spec: DeviceSpec) -> str:
    """Hash of all that the effect plan of a document depends on.

    Args:
        spec: The document.

    Returns:
        A hash; it stays the same when only samples, quality, seed, exposure or words change.
    """
    render = msgspec.structs.replace(
        spec.render, samples=1, quality=None, seed=0, exposure_ev=0.0, mode="spectral"
    )
    plain = msgspec.structs.replace(spec, title="-", description="", render=render)
    return digest(msgspec.json.encode((plain, spec.render.mode)))


def _guide_lines(spec: LightGuideSpec) -> Iterator[Line]:
    across, up = field_degrees(spec)
    yield Line("Field of View", f"{across:.3g}° x {up:.3g}°")
    yield Line("Virtual Image", "at infinity")
    relief = spec.guide.relief_mm + spec.eye.position_mm[2]
    yield Line("Eye Relief", f"{relief:.4g} mm")
    columns, rows = (
        (count - 1) * pitch
        for count, pitch in zip(spec.eyebox.grid, spec.eyebox.pitch_mm, strict=True)
    )
    yield Line("Eyebox Grid", f"{columns:.3g} x {rows:.3g} mm")
    yield Line("Display White", f"{spec.display.luminance_cd_m2:.4g} cd/m²")


def _scene_lines(spec: SceneSpec) -> Iterator[Line]:
    width, height = spec.render.size
    tangent = math.tan(math.radians(spec.eye.field_deg) / 2.0) * height / width
    up = 2.0 * math.degrees(math.atan(tangent))
    yield Line("Field of View", f"{spec.eye.field_deg:.3g}° x {up:.3g}°")
    holograms = [each for each in spec.elements if isinstance(each, HologramElement)]
    displays = [each for each in spec.elements if isinstance(each, DisplayElement)]
    pairs = [(hologram, display) for hologram in holograms for display in displays]
    for hologram, display in pairs[:_MOST_PAIRS]:
        distance = _image_distance_m(spec, hologram, display)
        if distance is not None:
            several = f" of {display.name}" if len(pairs) > 1 else ""
            yield Line(f"Virtual Image{several}", in_metres(distance))


def in_metres(distance: float) -> str:
    """Write the distance of an image.

    Args:
        distance: Distance from the pupil in m, negative behind the eye.

    Returns:
        Metres and dioptres.
    """
    if abs(distance) >= _FAR_M:
        return "at infinity"
    dioptres = f"{-1.0 / distance:+.2f} D"
    if abs(distance) < 1.0:
        return f"{distance * 1e3:.3g} mm, {dioptres}"
    return f"{distance:.3g} m, {dioptres}"


def _image_distance_m(
    spec: SceneSpec, hologram: HologramElement, display: DisplayElement
) -> float | None:
    """How far away order +1 of a hologram shows a display; None where it shows none."""
    own = hologram.hologram
    wavelength = own.pattern.wavelength_nm
    ways = own.efficiency.branches(own.orders, wavelength)
    x, y, z = spec.eye.position_mm
    pupils = [(x, y + side * _PUPIL_STEP_MM / 2.0, z) for side in (-1.0, 1.0)]
    for reflected in sorted({way.reflected for way in ways if way.order == 1}):
        try:
            seen = [
                chief_ray(spec, hologram.name, display.name, pupil, wavelength, reflected=reflected)
                for pupil in pupils
            ]
        except HoeError:
            continue
        return image_distance_mm(pupils, seen) * 1e-3
    return None
