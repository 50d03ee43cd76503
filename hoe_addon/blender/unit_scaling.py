# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Multiply numbers of a scene, keyframes included, so that its picture stays the same."""

from collections.abc import Iterator

import bpy

_LENGTH, _AREA, _PER_LENGTH = 1, 2, -1

_LIGHTS = {
    "POINT": {"energy": _AREA, "shadow_soft_size": _LENGTH, "cutoff_distance": _LENGTH},
    "SPOT": {"energy": _AREA, "shadow_soft_size": _LENGTH, "cutoff_distance": _LENGTH},
    "AREA": {"energy": _AREA, "cutoff_distance": _LENGTH},
    "SUN": {},
}
"""Powers of the factor by type of lamp. The size of an area lamp follows its object's scale, the
radius of the others does not."""

_CAMERA = {
    "clip_start": _LENGTH,
    "clip_end": _LENGTH,
    "ortho_scale": _LENGTH,
    "dof.focus_distance": _LENGTH,
    # Blender takes the focal length as metres of the scene, whatever its unit.
    "dof.aperture_fstop": _PER_LENGTH,
}

_OBJECT = {"location": _LENGTH, "delta_location": _LENGTH, "scale": _LENGTH}

_SOCKETS = {
    "ShaderNodeVolumeAbsorption": {"Density": _PER_LENGTH},
    "ShaderNodeVolumeScatter": {"Density": _PER_LENGTH},
    "ShaderNodeVolumePrincipled": {"Density": _PER_LENGTH, "Emission Strength": _PER_LENGTH},
    "ShaderNodeSubsurfaceScattering": {"Scale": _LENGTH},
    "ShaderNodeBsdfPrincipled": {"Subsurface Scale": _LENGTH},
    "ShaderNodeBump": {"Distance": _LENGTH},
}
"""Lengths in shaders, and what is given by length."""


class Scaler:
    """Multiplies numbers by powers of one factor, each number and each curve once.

    Attributes:
        notes: What could not be multiplied, in words.
    """

    def __init__(self, factor: float) -> None:
        """Begin.

        Args:
            factor: What lengths are multiplied with.
        """
        self.notes: list[str] = []
        self._factor = factor
        self._done: set[tuple[int, str]] = set()

    def object(self, item: bpy.types.Object) -> None:
        """Scale an object about the origin of its parent, or of the world.

        Args:
            item: The object.
        """
        self._values(item, _OBJECT)

    def data(self, block: bpy.types.ID | None) -> None:
        """Scale a lamp or a camera; other data goes with its object.

        Args:
            block: Data of an object.
        """
        if isinstance(block, bpy.types.Light):
            powers = dict(_LIGHTS[block.type])
            if not getattr(block, "normalize", True):
                del powers["energy"]  # it is given by area already
            self._values(block, powers)
        elif isinstance(block, bpy.types.Camera):
            self._values(block, _CAMERA)

    def shader(self, owner: bpy.types.Material | bpy.types.World) -> None:
        """Scale the lengths in a shader.

        Args:
            owner: A material or a world.
        """
        for node in owner.node_tree.nodes if owner.node_tree is not None else ():
            powers = _SOCKETS.get(node.bl_idname, {})
            if node.bl_idname == "ShaderNodeDisplacement" and node.space == "WORLD":
                powers = {"Scale": _LENGTH}
            for socket in node.inputs:
                if socket.name in powers:
                    self._socket(owner, node, socket, powers[socket.name])

    def _socket(
        self,
        owner: bpy.types.ID,
        node: bpy.types.Node,
        socket: bpy.types.NodeSocket,
        power: int,
    ) -> None:
        if socket.is_linked:
            self.notes.append(f"{owner.name}: {socket.name} of {node.name} comes from another node")
        elif self._first(owner, f"{node.name}.{socket.identifier}"):
            socket.default_value *= self._factor**power

    def _values(self, block: bpy.types.ID, powers: dict[str, int]) -> None:
        for path, power in powers.items():
            group, _, field = path.rpartition(".")
            owner = getattr(block, group) if group else block
            if hasattr(owner, field) and self._first(block, path):
                factor, value = self._factor**power, getattr(owner, field)
                single = isinstance(value, float)
                setattr(owner, field, value * factor if single else [v * factor for v in value])
                self._curves(block, path, factor)

    def _curves(self, block: bpy.types.ID, path: str, factor: float) -> None:
        moved = block.animation_data
        if moved is None:
            return
        if any(driver.data_path == path for driver in moved.drivers):
            self.notes.append(f"{block.name}: {path} has a driver")
        for curve in _curves(moved):
            if curve.data_path == path and self._first(curve.id_data, repr(curve)):
                for key in curve.keyframe_points:
                    for point in (key.co, key.handle_left, key.handle_right):
                        point[1] *= factor
                curve.update()

    def _first(self, block: bpy.types.ID, what: str) -> bool:
        key = (block.session_uid, what)
        new = key not in self._done
        self._done.add(key)
        return new


def _curves(moved: bpy.types.AnimData) -> Iterator[bpy.types.FCurve]:
    """Curves of the action in use."""
    action, slot = moved.action, moved.action_slot
    for layer in action.layers if action is not None and slot is not None else ():
        for strip in layer.strips:
            bag = strip.channelbag(slot)
            if bag is not None:
                yield from bag.fcurves
