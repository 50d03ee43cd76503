# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture as the sum of passes, each of which spends its samples on one kind of path.

Orders by significance toss a coin at the hologram that the eye looks at: straight on into the room,
or diffracted toward the display. The two kinds of path want different wavelengths, differ in cost
and in noise, and are seen in different parts of the picture. So they are rendered apart: every
pass follows its own orders at the first surface of a path and all orders at the later ones. No
weight is divided by a probability, nothing is left out, Cycles keeps its stratification, and the
sum is the whole picture.

A path that meets no hologram first is the same in every pass. Each pass counts a share of it, by
scaling its picture, and the hologram gives the share back to the paths that meet it. (A filter in
front of the eye could scale as well, but Cycles drops closures below 1e-5, and the weight of a
laser in it is small already.)
"""

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import IntEnum

import bpy
import numpy as np
from numpy.typing import NDArray

from ..build.device import DeviceScene
from .render import COMBINED, Progress, Region, render_samples
from .render_settings import picture_size

DISPLAY_LAYER = "Combined_display"
LAYERS = (COMBINED, DISPLAY_LAYER)


class FirstOrders(IntEnum):
    """Orders that a pass follows at the first surface, as the shader numbers them."""

    ALL = 0
    STRAIGHT = 1
    DIFFRACTED = 2


@dataclass(frozen=True, eq=False)
class Pass:
    """One term of the sum that is the picture.

    Attributes:
        device: The device in its scene.
        name: What it shows, in a word.
        orders: Orders that it follows at the first surface.
        sampling: Which of the scene's distributions of wavelengths it draws from.
        share: What it counts of light that meets no hologram first; those of different orders
            sum to 1.
        region: The part of the picture that it renders; None is all.
        weight: What it counts inside ``inside``: two passes of the same orders may share a region.
        inside: Region where ``weight`` holds; it counts fully outside.
        stream: Number of its random numbers, its own among the passes.
    """

    device: DeviceScene
    name: str
    orders: FirstOrders = FirstOrders.ALL
    sampling: int = 0
    share: float = 1.0
    region: Region | None = None
    weight: float = 1.0
    inside: Region | None = None
    stream: int = 0

    @property
    def pixels(self) -> int:
        """Number of pixels that it renders."""
        if self.region is not None:
            return self.region.pixels
        width, height = picture_size(self.device.scene)
        return width * height

    def render(
        self, seed: int, first: int, count: int, progress: Progress | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """Render some samples of the pass.

        Args:
            seed: Seed of the picture; each pass has random numbers of its own under it.
            first: Number of the first sample in the stratified sequence.
            count: Number of samples, at least 1.
            progress: Told after every part.

        Returns:
            The term of the sum by layer, scene-linear, shape ``(height, width, 3)``; 0 outside
            its region.

        Raises:
            RenderError: Blender gave no usable picture.
            CancelledError: The progress function asked to stop.
        """
        with _set_up(self):
            found = render_samples(
                self.device.scene,
                LAYERS,
                _seed(seed, self.stream),
                first,
                count,
                region=self.region,
                progress=progress,
            )
        for pixels in found.values():
            pixels *= self.share
            if self.inside is not None:
                pixels[self.inside.slices] *= self.weight
        return found


def whole(device: DeviceScene) -> Pass:
    """The picture in one pass, as any render of the scene makes it."""
    return Pass(device, "whole")


def is_divisible(device: DeviceScene) -> bool:
    """Whether passes by order are wanted, and there is something to divide."""
    spectral = device.spectral
    return (
        device.spec.render.order_selection == "guided"
        and spectral.drawn
        and len(spectral.samplings) > 1
        and any(True for _ in _sockets(device, "first_orders"))
    )


def _seed(seed: int, stream: int) -> int:
    """Seeds far apart, within Blender's range."""
    return (seed + stream * 0x3504F333) % (2**31)


@contextlib.contextmanager
def _set_up(this: Pass) -> Iterator[None]:
    """Let the scene render one pass, and afterwards the whole picture again."""
    values: Mapping[str, int | float] = {
        "first_orders": int(this.orders),
        "first_gain": 1.0 / this.share,
        "sampling": this.sampling,
    }
    found = [
        (socket, socket.default_value) for name in values for socket in _sockets(this.device, name)
    ]
    render = this.device.scene.render
    persistent = render.use_persistent_data
    try:
        if this.orders != FirstOrders.ALL:
            # Cycles would go on with the sample numbers of the pass before.
            render.use_persistent_data = False
        for socket, _ in found:
            if socket.default_value != values[socket.identifier]:
                socket.default_value = values[socket.identifier]
        yield
    finally:
        render.use_persistent_data = persistent
        for socket, kept in found:
            if socket.default_value != kept:
                socket.default_value = kept


def _sockets(device: DeviceScene, identifier: str) -> Iterator[bpy.types.NodeSocket]:
    """Sockets of that identifier in all Script nodes of the scene."""
    slots = (slot for item in device.scene.objects for slot in item.material_slots)
    materials = {slot.material for slot in slots if slot.material is not None}
    trees = [device.spectral.group, *(each.node_tree for each in materials)]
    for tree in trees:
        for node in tree.nodes if tree is not None else ():
            if node.bl_idname == "ShaderNodeScript":
                yield from (each for each in node.inputs if each.identifier == identifier)
