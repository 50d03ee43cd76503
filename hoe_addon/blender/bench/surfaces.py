# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How fast our surfaces render beside Cycles' own glass.

Every case is the same picture: an orthographic camera looks through two parallel square faces at
30 degrees, into a grey world that fills the rest. Only the material of the faces differs:

* ``stock_glass``: Cycles' Glass BSDF without roughness, evaluated under OSL like all the others;
* ``dielectric``: our dispersive dielectric with the same index and the same spectrum on ray time;
* ``hologram_N``: a kinoform of eight levels with N transmitted orders, recorded with a point and a
  plane wave, air on both sides.

A path meets a face twice on average in every case, so rates by samples compare like with like: a
hologram passes all its light on, and a plate of reflectance R is met once, and then, by the share
1 - R that enters, 1 / (1 - R) times more. The faces are so wide that no path misses one.

What is measured is the slope between renders with few and with many samples: synchronising the
scene, compiling shaders and writing the result cost both the same and are left out. The ratios
use processor time, all threads together, which other work on the machine disturbs little.
"""

import math
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import bpy

from ...core.errors import RenderError
from ...core.wavelength_sampling import by_significance
from ...model.efficiency import KinoformSpec
from ...model.hologram import HologramSpec, SideMedia
from ...model.recording import RecordingSpec
from ...model.surface import PlaneSurface
from ...model.waves import PlaneWaveSpec, PointSourceSpec
from ..build import meshes
from ..pictures.render import Progress
from ..pictures.render_settings import set_up
from ..quiet import captured_output
from ..shaders import nodes
from ..shaders.materials import dielectric_material, hologram_material
from ..shaders.spectral import SpectralScene, spectral_scene
from ..temporary import temporary_scene

INDEX = 1.5
ORDERS = (1, 3, 9)
STOCK = "stock_glass"
CASES = (STOCK, "dielectric", *(f"hologram_{count}" for count in ORDERS))

_SIDE_MM = 200.0
_THICKNESS_MM = 2.0
_VIEW_MM = 10.0
_ANGLE_DEG = 30.0
_BOUNCES = 64
_LONGER = (1, 4, 16)
"""Work of another process can make the longer of two short renders the quicker one."""

_FEW = 4
_MOST_ROUNDS = 9
"""Repetitions of all cases: the median of nine stands when four of them are disturbed."""

_LEAST_SECONDS = 1.0
"""A shorter render is not repeated to give more rounds: set-up varies by hundredths of a second."""


@dataclass(frozen=True)
class Speed:
    """What one case reached.

    Attributes:
        name: Name of the case.
        samples_per_second: Median over the rounds, by the clock on the wall.
        samples_per_cpu_second: Median over the rounds, by processor time of all threads.
        ratio: Median over the rounds of the processor's rate over that of the stock glass.
        spread: Third quartile of these ratios less the first.
    """

    name: str
    samples_per_second: float
    samples_per_cpu_second: float
    ratio: float
    spread: float


@dataclass(frozen=True)
class Benchmark:
    """One run of the benchmark.

    Attributes:
        size: Width and height of the picture in pixels.
        samples: Samples per pixel of the longer renders, by case.
        rounds: Repetitions.
        speeds: Results, the stock glass first.
    """

    size: tuple[int, int]
    samples: dict[str, int]
    rounds: int
    speeds: tuple[Speed, ...]


def run_benchmark(
    seconds: float, size: tuple[int, int], progress: Progress | None = None
) -> Benchmark:
    """Measure all cases, each in turn, several times over.

    Args:
        seconds: About how long the measured renders take together.
        size: Width and height of the picture in pixels.
        progress: Told after every measurement.

    Returns:
        Speeds and ratios.

    Raises:
        MissingOslError: This Blender has no OSL.
        RenderError: A render is too short for the clock.
    """
    with _bench_scene(size) as stand:
        count = max(1, min(_MOST_ROUNDS, int(seconds / (_LEAST_SECONDS * len(CASES)))))
        share = seconds / (count * len(CASES))
        samples = {name: stand.samples_for(name, share) for name in CASES}
        rounds: list[dict[str, tuple[float, float]]] = []
        for number in range(count):
            rounds.append({})
            for place, name in enumerate(CASES, start=1):
                rounds[-1][name] = stand.rates(name, samples[name])
                if progress is not None:
                    progress((number * len(CASES) + place) / (count * len(CASES)))
    speeds = tuple(_speed(name, rounds) for name in CASES)
    return Benchmark(size, samples, count, speeds)


def _speed(name: str, rounds: Sequence[dict[str, tuple[float, float]]]) -> Speed:
    # Each round compares with the glass of the same round, so that slow drifts cancel.
    ratios = [rates[name][1] / rates[STOCK][1] for rates in rounds]
    low, ratio, high = statistics.quantiles(ratios, n=4, method="inclusive")
    return Speed(
        name=name,
        samples_per_second=statistics.median(rates[name][0] for rates in rounds),
        samples_per_cpu_second=statistics.median(rates[name][1] for rates in rounds),
        ratio=ratio,
        spread=high - low,
    )


class _Stand:
    """The scene, whose two faces take one material after the other."""

    def __init__(self, scene: bpy.types.Scene, size: tuple[int, int]) -> None:
        self.scene = scene
        self._spectral = spectral_scene(by_significance(), (), 550.0, name="hoe bench")
        scene.render.resolution_x, scene.render.resolution_y = size
        self._faces = _add_faces(scene)
        _add_camera(scene)
        scene.world = _grey_world()
        makers: dict[str, Callable[[], bpy.types.Material]] = {
            STOCK: _stock_glass,
            "dielectric": lambda: dielectric_material("hoe bench", INDEX, 1.0, self._spectral),
        }
        makers |= {f"hologram_{n}": _hologram_maker(n, self._spectral) for n in ORDERS}
        self._materials = {name: makers[name]() for name in CASES}

    def samples_for(self, name: str, seconds: float) -> int:
        """Samples per pixel that take about this long; the render also warms everything up."""
        samples = _FEW
        while True:
            wall, _ = self._seconds(name, samples)
            again, _ = self._seconds(name, 4 * samples)
            if again - wall > 0.02 or samples >= 1 << 12:
                break
            samples *= 4
        each = max(again - wall, 1e-3) / (3 * samples)
        return max(2 * _FEW, _FEW + round(seconds / each))

    def rates(self, name: str, samples: int) -> tuple[float, float]:
        """Samples per second, by the clock on the wall and by the processor's."""
        render = self.scene.render
        for longer in _LONGER:
            few, many = self._seconds(name, _FEW), self._seconds(name, longer * samples)
            paths = render.resolution_x * render.resolution_y * (longer * samples - _FEW)
            wall, processor = (more - less for less, more in zip(few, many, strict=True))
            if wall > 0.0 and processor > 0.0:
                return paths / wall, paths / processor
        raise RenderError(f"{name}: the renders are too short to measure; give more seconds")

    def _seconds(self, name: str, samples: int) -> tuple[float, float]:
        self._dress(name)
        set_up(self.scene, samples=samples, seed=0, spectral=True, max_bounces=_BOUNCES)
        # Stock glass counts its bounces elsewhere; it gets as many.
        self.scene.cycles.max_bounces = _BOUNCES
        self.scene.cycles.transmission_bounces = self.scene.cycles.glossy_bounces = _BOUNCES
        self.scene.cycles.min_light_bounces = _BOUNCES
        wall, processor = time.perf_counter(), time.process_time()
        with captured_output():
            bpy.ops.render.render(scene=self.scene.name)
        return time.perf_counter() - wall, time.process_time() - processor

    def _dress(self, name: str) -> None:
        self._faces.materials.clear()
        self._faces.materials.append(self._materials[name])


@contextmanager
def _bench_scene(size: tuple[int, int]) -> Iterator[_Stand]:
    """A scene of its own, removed with all that was made for it."""
    with temporary_scene("hoe bench") as scene:
        with captured_output():
            set_up(scene, samples=1, seed=0, spectral=True, max_bounces=_BOUNCES)
            stand = _Stand(scene, size)
        yield stand


def _add_faces(scene: bpy.types.Scene) -> bpy.types.Mesh:
    """Two parallel squares, both normals outward, as one mesh; its rim is open."""
    half, height = _SIDE_MM / 2.0, _THICKNESS_MM / 2.0
    ring = ((-half, -half), (half, -half), (half, half), (-half, half))
    corners = [(x, y, z) for z in (height, -height) for x, y in ring]
    mesh = meshes.from_polygons("hoe bench", corners, [(0, 1, 2, 3), (7, 6, 5, 4)])
    meshes.add(scene.collection, mesh)
    return mesh


def _add_camera(scene: bpy.types.Scene) -> None:
    camera = bpy.data.cameras.new("hoe bench")
    camera.type = "ORTHO"
    camera.ortho_scale = _VIEW_MM
    eye = bpy.data.objects.new("hoe bench", camera)
    angle = math.radians(_ANGLE_DEG)
    eye.location = (50.0 * math.sin(angle), 0.0, 50.0 * math.cos(angle))
    eye.rotation_euler = (0.0, angle, 0.0)
    scene.collection.objects.link(eye)
    scene.camera = eye


def _grey_world() -> bpy.types.World:
    world = bpy.data.worlds.new("hoe bench")
    tree = nodes.new_tree(world)
    output = tree.nodes.new("ShaderNodeOutputWorld")
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    return world


def _stock_glass() -> bpy.types.Material:
    material = bpy.data.materials.new("hoe bench")
    tree = nodes.new_tree(material)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    glass = tree.nodes.new("ShaderNodeBsdfGlass")
    glass.distribution = "GGX"
    glass.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    glass.inputs["Roughness"].default_value = 0.0
    glass.inputs["IOR"].default_value = INDEX
    tree.links.new(glass.outputs[0], output.inputs["Surface"])
    return material


def _hologram_maker(count: int, spectral: SpectralScene) -> Callable[[], bpy.types.Material]:
    return lambda: hologram_material(_hologram(count), spectral)


def _hologram(count: int) -> HologramSpec:
    """A weak lens, so that all orders stay near the view."""
    recording = RecordingSpec(
        wavelength_nm=532.0,
        object=PointSourceSpec(position_mm=(10.0, 5.0, -300.0)),
        reference=PlaneWaveSpec(direction=(0.0, 0.0, 1.0)),
    )
    middle = 1
    return HologramSpec(
        name=f"hoe bench {count}",
        surface=PlaneSurface(size_mm=(_SIDE_MM, _SIDE_MM)),
        media=SideMedia(),
        recording=recording,
        efficiency=KinoformSpec(levels=8, design_wavelength_nm=532.0, relief=1.5),
        orders=tuple(range(middle - count // 2, middle + count // 2 + 1)),
    )
