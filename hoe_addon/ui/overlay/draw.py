# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines on the graphics card: the only part that speaks to it.

Hidden parts are drawn too, faintly.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy

from . import colours, failure, state
from .document import Kind
from .lines import Lines


@dataclass(frozen=True)
class _Style:
    """How a kind is drawn.

    Attributes:
        width: Of lines, in pixels of a screen of ordinary density.
        hidden: Opacity of what stands behind other things, over that of the rest.
    """

    width: float
    hidden: float


_STYLES = {
    Kind.SOURCES: _Style(1.2, 0.22),
    Kind.EYEBOX: _Style(1.5, 0.3),
    Kind.PUPIL: _Style(1.8, 0.4),
    # Most of their way runs inside housings and plates.
    Kind.CHIEF_RAYS: _Style(2.0, 0.5),
}
"""In the order of drawing."""

_AROUND_THE_EYE = frozenset((Kind.PUPIL, Kind.EYEBOX))

_STALE = 0.35
"""Opacity of what was there before the scene became invalid, over that of the rest."""

_TEXT_SIZE = 12.0


@dataclass
class _Batches:
    """Batches of one scene; made when they are first drawn."""

    number: int
    is_stale: bool
    visible: dict[Kind, Any] = field(default_factory=dict)
    hidden: dict[Kind, Any] = field(default_factory=dict)


class _Drawing:
    """Handlers and batches; one for the process."""

    handlers: list[Any]
    batches: dict[int, _Batches]

    def __init__(self) -> None:
        self.handlers, self.batches = [], {}


_drawing = _Drawing()


def register() -> None:
    """Draw over all 3-D views."""
    failure.forget()
    add = bpy.types.SpaceView3D.draw_handler_add
    _drawing.handlers = [
        add(_guarded, (_draw_lines,), "WINDOW", "POST_VIEW"),
        add(_guarded, (_draw_labels,), "WINDOW", "POST_PIXEL"),
    ]


def unregister() -> None:
    """Draw no more, and give the memory back."""
    for handler in _drawing.handlers:
        bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    _drawing.handlers, _drawing.batches = [], {}


def _guarded(draw: Callable[[bpy.types.Context], None]) -> None:
    """Draw one layer."""
    context = bpy.context
    if _is_shown(context):
        failure.guarded(lambda: draw(context))


def _is_shown(context: bpy.types.Context) -> bool:
    space = context.space_data
    if space is None or space.type != "VIEW_3D" or not space.overlay.show_overlays:
        return False
    return bool(state.shown(context.scene).drawing.lines)


def _draw_lines(context: bpy.types.Context) -> None:
    import gpu

    kinds = _kinds_here(context)
    batches = _batches_of(context.scene)
    shader = gpu.shader.from_builtin("POLYLINE_SMOOTH_COLOR")
    _x, _y, width, height = gpu.state.viewport_get()
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_mask_set(False)
    shader.bind()
    shader.uniform_float("viewportSize", (width, height))
    try:
        gpu.state.depth_test_set("GREATER")
        _draw_layer(shader, batches.hidden, kinds, context)
        gpu.state.depth_test_set("LESS_EQUAL")
        _draw_layer(shader, batches.visible, kinds, context)
    finally:
        gpu.state.depth_test_set("NONE")
        gpu.state.depth_mask_set(True)
        gpu.state.blend_set("NONE")


def _kinds_here(context: bpy.types.Context) -> frozenset[Kind]:
    """Kinds that are on, without what stands around the eye where one looks out of it."""
    kinds = state.kinds_of(context.scene)
    return kinds - _AROUND_THE_EYE if _is_from_the_eye(context) else kinds


def _is_from_the_eye(context: bpy.types.Context) -> bool:
    space, scene = context.space_data, context.scene
    if context.region_data.view_perspective != "CAMERA":
        return False
    camera = space.camera if space.use_local_camera else scene.camera
    return camera is not None and camera == scene.hologram.eye.camera


def _draw_layer(
    shader: Any, layer: dict[Kind, Any], kinds: frozenset[Kind], context: bpy.types.Context
) -> None:
    for kind, style in _STYLES.items():
        if kind in kinds and kind in layer:
            width = style.width * context.preferences.system.ui_scale
            shader.uniform_float("lineWidth", width)
            layer[kind].draw(shader)


def _batches_of(scene: bpy.types.Scene) -> _Batches:
    now = state.shown(scene)
    made = _drawing.batches.get(scene.session_uid)
    if made is None or (made.number, made.is_stale) != (now.number, now.is_stale):
        made = _Batches(now.number, now.is_stale)
        for kind, lines in now.drawing.lines.items():
            drawn = lines.faint(_STALE) if now.is_stale else lines
            made.visible[kind] = _batch(drawn)
            made.hidden[kind] = _batch(drawn.faint(_STYLES[kind].hidden))
        _drawing.batches = {u: old for u, old in _drawing.batches.items() if state.is_kept(u)}
        _drawing.batches[scene.session_uid] = made
    return made


def _batch(lines: Lines) -> Any:
    import gpu
    from gpu_extras.batch import batch_for_shader

    shader = gpu.shader.from_builtin("POLYLINE_SMOOTH_COLOR")
    content: dict[str, Any] = {
        "pos": lines.ends.reshape(-1, 3),
        "color": lines.colours.reshape(-1, 4),
    }
    return batch_for_shader(shader, "LINES", content)


def _draw_labels(context: bpy.types.Context) -> None:
    import blf
    from bpy_extras.view3d_utils import location_3d_to_region_2d

    labels = state.shown(context.scene).drawing.labels
    if Kind.PUPIL not in _kinds_here(context):
        return
    blf.size(0, _TEXT_SIZE * context.preferences.system.ui_scale)
    blf.color(0, *colours.MEASURE, 1.0)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 3, 0.0, 0.0, 0.0, 0.7)
    for label in labels:
        place = location_3d_to_region_2d(context.region, context.region_data, label.place)
        if place is not None:
            width, height = blf.dimensions(0, label.text)
            blf.position(0, place.x - width / 2.0, place.y - 1.6 * height, 0.0)
            blf.draw(0, label.text)
    blf.disable(0, blf.SHADOW)
