# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact rays through the shipped hologram shader in a real Cycles render, and what comes back.

Each ray is one pixel row. A camera shader starts it, a rolling shutter gives it its wavelength on
ray time, the hologram diffracts it, and the world answers with the direction in which it arrived.
"""

import contextlib
from collections.abc import Iterator
from dataclasses import replace

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.orders import Branch
from ...core.ray_law import Status
from ...core.shapes.tessellate import departure_from
from ...core.units import m_to_mm, mm_to_m
from ...model.element import element_mesh, element_shape, first_hit
from ...model.evaluate import followed_frequency
from ...model.hologram import HologramSpec
from ...model.mesh_surface import MeshSurface
from ...model.rays import RayTable, TraceResult
from ...model.surface import PlaneSurface
from ...shading.hologram import Frame, hologram_sockets, one_order_shader, unit_efficiency_shader
from ...shading.probe import (
    MISSED,
    UNRECORDED,
    direction_world_shader,
    first_hit_only,
    position_shader,
    ray_camera_shader,
)
from ...shading.source import ShaderSource
from ...shading.surface import hit_part
from ...shading.wavelength import PLAIN_TIME, wavelength_shader
from ..build import meshes
from ..build.element import element_datablock
from ..shaders import nodes
from ..shaders.maps import update_map
from ..shaders.osl import compiled, require_osl
from ..shaders.tables import prepare_table
from ..temporary import temporary_scene
from .render import COMBINED, Progress, render_layers
from .render_settings import carry_time_on_rows, set_up

_ROWS = 1023
"""Rays in one render. Odd, so that no row has the time 0.5, which means preview."""
_NEAREST_MM, _FARTHEST_MM, _FARTHEST_HIT_MM = 1e-2, 100.0, 1e5
_LEAST_COSINE = 0.02
_LEAST_ROWS = 5
"""Odd too; Blender makes no picture lower than 4 rows."""


def trace_cycles(
    spec: HologramSpec, rays: RayTable, progress: Progress | None = None
) -> TraceResult:
    """Send rays through a hologram in Cycles, each into the one branch that it names.

    Args:
        spec: The hologram, in its own frame; 1 scene unit is 1 mm.
        rays: Rays in its frame.
        progress: Told after every render.

    Returns:
        What Cycles made of them, in float32 precision. The efficiency is that of the backward
        walk, which equals that of the ray as light by reciprocity. Points of extended sources
        are drawn by the shader's own numbers: even as in numpy, but not the same ray by ray.

    Raises:
        MissingOslError: This Blender has no OSL.
    """
    require_osl()
    count = len(rays)
    result = TraceResult(
        hit_mm=np.full((count, 3), np.nan),
        direction=np.full((count, 3), np.nan),
        status=np.full(count, int(Status.MISS)),
        efficiency=np.full(count, np.nan),
    )
    parts = list(_parts(rays, followed_frequency(spec, rays)))
    with _probe_scene(spec) as probe:
        for done, (branch, chosen) in enumerate(parts, start=1):
            probe.load(_started_near(spec, rays.part(chosen)))
            _read_back(probe, branch, chosen, result)
            if progress is not None:
                progress(done / len(parts))
    return result


def _started_near(spec: HologramSpec, rays: RayTable) -> RayTable:
    """The same rays, started where float32 serves them best; a hopeless one goes away instead.

    A ray that meets the element's shape starts 10 um to 100 mm before it, on its own line: one
    that starts on it hits there, and one from afar keeps its digits. Where facets stand for a
    curved surface, it starts before them, too. Cycles is asked about a ray that meets the shape
    beside the element; one that never meets it, or beyond any element, could be infinite in
    float32 and spoil its neighbours.
    """
    distance, _hit = first_hit(spec, rays.origin_mm, rays.direction)
    beside = element_shape(spec).intersect(mm_to_m(rays.origin_mm), rays.direction)
    distance = np.where(np.isnan(distance), m_to_mm(beside), distance)
    with np.errstate(invalid="ignore", over="ignore"):
        hit = rays.origin_mm + distance[:, None] * rays.direction
        meets = np.isfinite(distance) & (np.abs(hit).max(axis=1) < _FARTHEST_HIT_MM)
        nearest = _nearest_mm(spec, hit, rays.direction)
        start = hit - np.clip(distance, nearest, _FARTHEST_MM)[:, None] * rays.direction
    return replace(
        rays,
        origin_mm=np.where(meets[:, None], start, (0.0, 0.0, 1.0)),
        direction=np.where(meets[:, None], rays.direction, (0.0, 0.0, 1.0)),
    )


def _nearest_mm(
    spec: HologramSpec, hit: NDArray[np.float64], direction: NDArray[np.float64]
) -> NDArray[np.float64] | float:
    """How far before the surface a ray must start to be before its facets."""
    if isinstance(spec.surface, PlaneSurface | MeshSurface):
        return _NEAREST_MM
    shape = element_shape(spec)
    normal = shape.normal(mm_to_m(hit))
    sagitta = m_to_mm(departure_from(shape, element_mesh(spec).mesh))
    cosine = np.maximum(np.abs(np.sum(normal * direction, axis=1)), _LEAST_COSINE)
    return np.maximum(_NEAREST_MM, 2.0 * sagitta / cosine)


def _parts(
    rays: RayTable, frequency: NDArray[np.float64]
) -> Iterator[tuple[Branch, NDArray[np.int64]]]:
    """Rays of one branch, few enough for one render, by rising wavelength.

    Ray time finds its wavelength by interpolation between neighbours: sorted, a rounding of time
    moves the wavelength by next to nothing.
    """
    named = zip(rays.order.tolist(), rays.reflected.tolist(), frequency.tolist(), strict=True)
    for order, reflected, multiple in sorted(set(named)):
        this = (rays.order == order) & (rays.reflected == reflected) & (frequency == multiple)
        of_branch = np.flatnonzero(this)
        of_branch = of_branch[np.argsort(rays.wavelength_nm[of_branch], kind="stable")]
        for first in range(0, len(of_branch), _ROWS):
            branch = Branch(order, reflected=reflected, frequency=multiple)
            yield branch, of_branch[first : first + _ROWS]


def _read_back(
    probe: "_Probe", branch: Branch, chosen: NDArray[np.int64], result: TraceResult
) -> None:
    answer = probe.render(first_hit_only(unit_efficiency_shader(probe.spec, branch)))
    length = np.linalg.norm(answer, axis=1)
    missed, absent, gone = answer[:, 0] == MISSED, answer[:, 0] == UNRECORDED, length == 0.0
    met = ~missed & ~absent & ~gone
    result.status[chosen] = np.select(
        (missed, absent, gone),
        (int(Status.MISS), int(Status.UNDEFINED), int(Status.EVANESCENT)),
        int(Status.OK),
    )
    result.direction[chosen[met]] = answer[met] / length[met, None]

    weighted = probe.render(first_hit_only(one_order_shader(probe.spec, branch, probe.table)))
    weight = np.linalg.norm(weighted, axis=1)
    result.efficiency[chosen[~missed]] = weight[~missed]

    place = probe.render_positions()
    result.hit_mm[chosen[~missed]] = place[~missed]


class _Probe:
    """A scene with one hologram and a camera that is a list of rays."""

    def __init__(self, spec: HologramSpec, scene: bpy.types.Scene) -> None:
        self.spec = spec
        self.table = prepare_table(spec, backward=False)
        self.scene = scene
        self._rows = 0
        self._wavelengths = wavelength_shader((500.0, 500.0))
        facets, _error = element_datablock(spec)
        self.element = meshes.add(scene.collection, facets)
        mover = hit_part(spec.surface)
        self._positions = nodes.script_material("hoe probe", position_shader(mover), mover.sockets)
        self._camera = bpy.data.cameras.new("hoe probe")
        self._camera.type = "CUSTOM"
        self._camera.custom_mode = "INTERNAL"
        # The near clip would skip an element closer than 0.1 mm to a ray's start.
        self._camera.clip_start = 1e-6
        self._camera.clip_end = 1e6
        scene.camera = bpy.data.objects.new("hoe probe", self._camera)
        scene.collection.objects.link(scene.camera)
        _set_world(scene, direction_world_shader())

    def load(self, rays: RayTable) -> None:
        """Take other rays; an even number, or too few, are filled up by repeating the last."""
        last = len(rays) - 1
        self._rows = len(rays)
        rows = np.arange(max(_LEAST_ROWS, self._rows + (self._rows % 2 == 0))).clip(max=last)
        # Blender's cameras look along -z; the rays are counted from the bottom row.
        flip = np.array((1.0, 1.0, -1.0))
        source = ray_camera_shader(
            (rays.origin_mm * flip)[rows][::-1], (rays.direction * flip)[rows][::-1]
        )
        _set_camera_shader(self._camera, source)
        # Row r from the top has the time (r + 1) / rows: the node with that number.
        wavelength = rays.wavelength_nm[rows]
        self._wavelengths = wavelength_shader(np.concatenate((wavelength[:1], wavelength)))
        self.scene.render.resolution_x = 1
        self.scene.render.resolution_y = len(rows)

    def render(self, source: ShaderSource) -> NDArray[np.float64]:
        """Directions times weights, one row a ray; zero where no order goes on."""
        material = nodes.script_material("hoe probe", source, self._sockets(source))
        _link_wavelength(material, self._wavelengths)
        update_map(material, self.spec)
        try:
            return self._rendered(material)
        finally:
            bpy.data.materials.remove(material)

    def render_positions(self) -> NDArray[np.float64]:
        """Points where the rays hit the element, in mm."""
        return self._rendered(self._positions)

    def _rendered(self, material: bpy.types.Material) -> NDArray[np.float64]:
        self.element.data.materials.clear()
        self.element.data.materials.append(material)
        picture = render_layers(self.scene, (COMBINED,))[COMBINED]
        return picture[: self._rows, 0, :].astype(np.float64)

    def _sockets(self, source: ShaderSource) -> dict[str, nodes.SocketValue]:
        """The document's numbers for those sockets that this specialisation has."""
        present = nodes.socket_names(source)
        values = hologram_sockets(self.spec, Frame(), table=self.table)
        return {name: value for name, value in values.items() if name in present}


@contextlib.contextmanager
def _probe_scene(spec: HologramSpec) -> Iterator[_Probe]:
    """A scene of its own, removed with all that was made for it."""
    with temporary_scene("hoe probe") as scene:
        set_up(scene, samples=1, seed=0, spectral=True, max_bounces=8)
        carry_time_on_rows(scene)
        scene.cycles.pixel_filter_type = "BOX"
        yield _Probe(spec, scene)


def _set_camera_shader(camera: bpy.types.Camera, source: ShaderSource) -> None:
    camera.custom_bytecode = compiled(source)
    camera.custom_bytecode_hash = source.digest


def _set_world(scene: bpy.types.Scene, source: ShaderSource) -> None:
    world = bpy.data.worlds.new("hoe probe")
    scene.world = world
    tree = nodes.new_tree(world)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    node = nodes.add_script_node(tree, source, {})
    tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
    # Sampling the world by its brightness would evaluate directions as light.
    world.cycles.sampling_method = "NONE"


def _link_wavelength(material: bpy.types.Material, source: ShaderSource) -> None:
    tree = nodes.tree_of(material)
    wavelength = nodes.add_script_node(tree, source, PLAIN_TIME)
    hologram = next(n for n in tree.nodes if "wavelength_nm" in {s.identifier for s in n.inputs})
    tree.links.new(
        nodes.output_socket(wavelength, "wavelength_nm"),
        nodes.input_socket(hologram, "wavelength_nm"),
    )
