# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Formula, interpolated table and drawn table beside each other: same picture, and how soon.

Every case is the same picture: a camera looks through one hologram, a kinoform, at a checkered
world that its orders bring together. Only the form differs in which the shader has the
efficiencies.

The error of one sample is the scatter of pictures of different seeds. The time to a given error
goes as the time of a sample times the variance of a sample; what is reported is its ratio to the
first case. Times are processor time, as in `bench`: the slope between few and many samples.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal

import bpy
import numpy as np
from numpy.typing import NDArray

from ...core.errors import RenderError
from ...core.wavelength_sampling import by_significance
from ...model.efficiency import KinoformSpec
from ...model.efficiency.common import LookupSpec
from ...model.hologram import HologramSpec, SideMedia
from ...model.recording import RecordingSpec
from ...model.surface import PlaneSurface
from ...model.waves import PlaneWaveSpec, PointSourceSpec
from ..build import meshes
from ..pictures.render import COMBINED, Progress, render_layers
from ..pictures.render_settings import set_up
from ..quiet import captured_output
from ..shaders import nodes
from ..shaders.materials import hologram_material
from ..shaders.spectral import spectral_scene
from ..temporary import temporary_scene

type Form = Literal["formula", "bilinear", "stochastic"]

_LOOKUPS: dict[Form, LookupSpec] = {
    "formula": LookupSpec(form="formula"),
    "bilinear": LookupSpec(form="table"),
    "stochastic": LookupSpec(form="table", choice="stochastic"),
}
_SIDE_MM, _VIEW_MM = 40.0, 10.0
_PIXELS = 64
_BLOCK = 8
"""Pixels of a side of the squares whose means are compared."""

_SAMPLES, _SEEDS = 16, 8
_FEW, _MANY, _TIMED = 8, 136, 3
_ORDERS = (-2, -1, 0, 1, 2, 3)


@dataclass(frozen=True)
class LookupSpeed:
    """What one form reached.

    Attributes:
        form: ``formula``, ``bilinear`` or ``stochastic``.
        microseconds: Processor time of a sample.
        deviation: Standard deviation of one sample of a pixel; the mean picture is about 0.5.
        time_to_error: Time to a given error over that of the first form.
        difference: Root mean square of the difference of the mean picture from that of the first
            form, by its own standard deviation: about 1 where both are alike.
    """

    form: Form
    microseconds: float
    deviation: float
    time_to_error: float
    difference: float


def compare_lookups(
    forms: tuple[Form, ...] = ("formula", "bilinear", "stochastic"),
    efficiency: KinoformSpec | None = None,
    progress: Progress | None = None,
) -> tuple[LookupSpeed, ...]:
    """Measure the forms, in turn.

    Args:
        forms: Which; the first one is what the others are compared with.
        efficiency: The kinoform; by default one whose shares depend on the wavelength alone.
        progress: Told after every form.

    Returns:
        Results in the order of the forms.

    Raises:
        MissingOslError: This Blender has no OSL.
        RenderError: A render is too short for the clock.
    """
    kinoform = efficiency or KinoformSpec(
        levels=8, design_wavelength_nm=450.0, relief="PMMA", angle_dependent=False
    )
    pictures: list[NDArray[np.float64]] = []
    seconds: list[float] = []
    with _bench_scene() as stand:
        for place, form in enumerate(forms, start=1):
            stand.dress(_hologram(kinoform, _LOOKUPS[form]))
            pictures.append(np.stack([stand.picture(seed) for seed in range(1, _SEEDS + 1)]))
            seconds.append(stand.seconds_per_sample(form))
            if progress is not None:
                progress(place / len(forms))
    variances = [float(np.mean(np.var(each, axis=0, ddof=1))) * _SAMPLES for each in pictures]
    first = seconds[0] * variances[0]
    return tuple(
        LookupSpeed(
            form=form,
            microseconds=1e6 * duration,
            deviation=variance**0.5,
            time_to_error=duration * variance / first,
            difference=_difference(pictures[0], each) if each is not pictures[0] else 0.0,
        )
        for form, duration, variance, each in zip(forms, seconds, variances, pictures, strict=True)
    )


def _hologram(efficiency: KinoformSpec, lookup: LookupSpec) -> HologramSpec:
    """The hologram of the comparison, a weak lens, with one form of look-up."""
    fields = {name: getattr(efficiency, name) for name in efficiency.__struct_fields__}
    recording = RecordingSpec(
        wavelength_nm=532.0,
        object=PointSourceSpec(position_mm=(60.0, 5.0, -300.0)),
        reference=PlaneWaveSpec(direction=(0.0, 0.0, 1.0)),
    )
    return HologramSpec(
        name="hoe bench",
        surface=PlaneSurface(size_mm=(_SIDE_MM, _SIDE_MM)),
        media=SideMedia(),
        recording=recording,
        efficiency=KinoformSpec(**(fields | {"lookup": lookup})),
        orders=_ORDERS,
    )


def _difference(first: NDArray[np.float64], second: NDArray[np.float64]) -> float:
    """Mean pictures beside each other, in squares, by the scatter of the seeds."""
    blocks = [_blocks(each) for each in (first, second)]
    apart = blocks[0].mean(axis=0) - blocks[1].mean(axis=0)
    # One scatter for all squares: that of single ones is known from a few seeds only.
    variance = sum(float(np.mean(np.var(each, axis=0, ddof=1))) for each in blocks) / _SEEDS
    return float(np.sqrt(np.mean(apart**2) / variance))


def _blocks(pictures: NDArray[np.float64]) -> NDArray[np.float64]:
    count = _PIXELS // _BLOCK
    return pictures.reshape(-1, count, _BLOCK, count, _BLOCK).mean(axis=(2, 4))


class _Stand:
    """The scene, whose element takes one material after the other."""

    def __init__(self, scene: bpy.types.Scene) -> None:
        self.scene = scene
        self._spectral = spectral_scene(by_significance(), (), 550.0, name="hoe bench")
        scene.render.resolution_x = scene.render.resolution_y = _PIXELS
        self._element = meshes.rectangle("hoe bench", _SIDE_MM, _SIDE_MM)
        meshes.add(scene.collection, self._element)
        _add_camera(scene)
        scene.world = _checkered_world()

    def dress(self, spec: HologramSpec) -> None:
        """Give the element another hologram."""
        with captured_output():
            material = hologram_material(spec, self._spectral)
        self._element.materials.clear()
        self._element.materials.append(material)

    def picture(self, seed: int) -> NDArray[np.float64]:
        """One noisy picture."""
        set_up(self.scene, samples=_SAMPLES, seed=seed, spectral=True, max_bounces=8)
        return render_layers(self.scene, (COMBINED,))[COMBINED][..., 0].astype(np.float64)

    def seconds_per_sample(self, form: str) -> float:
        """Processor time of one sample, the median of several slopes."""
        slopes = [self._seconds(_MANY) - self._seconds(_FEW) for _ in range(_TIMED)]
        middle = float(np.median(slopes))
        if middle <= 0.0:
            raise RenderError(f"{form}: the renders are too short to measure")
        return middle / (_PIXELS**2 * (_MANY - _FEW))

    def _seconds(self, samples: int) -> float:
        set_up(self.scene, samples=samples, seed=0, spectral=True, max_bounces=8)
        start = time.process_time()
        with captured_output():
            bpy.ops.render.render(scene=self.scene.name)
        return time.process_time() - start


@contextmanager
def _bench_scene() -> Iterator[_Stand]:
    """A scene of its own, removed with all that was made for it."""
    with temporary_scene("hoe bench") as scene:
        with captured_output():
            set_up(scene, samples=1, seed=0, spectral=True, max_bounces=8)
            stand = _Stand(scene)
        yield stand


def _add_camera(scene: bpy.types.Scene) -> None:
    camera = bpy.data.cameras.new("hoe bench")
    camera.type, camera.ortho_scale = "ORTHO", _VIEW_MM
    eye = bpy.data.objects.new("hoe bench", camera)
    eye.location = (0.0, 0.0, 50.0)
    scene.collection.objects.link(eye)
    scene.camera = eye


def _checkered_world() -> bpy.types.World:
    world = bpy.data.worlds.new("hoe bench")
    world.cycles.sampling_method = "NONE"
    tree = nodes.new_tree(world)
    place = tree.nodes.new("ShaderNodeTexCoord")
    checker = tree.nodes.new("ShaderNodeTexChecker")
    checker.inputs["Scale"].default_value = 24.0
    checker.inputs["Color1"].default_value = (1.0, 1.0, 1.0, 1.0)
    checker.inputs["Color2"].default_value = (0.0, 0.0, 0.0, 1.0)
    background = tree.nodes.new("ShaderNodeBackground")
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(place.outputs["Generated"], checker.inputs["Vector"])
    tree.links.new(checker.outputs["Color"], background.inputs["Color"])
    tree.links.new(background.outputs[0], output.inputs["Surface"])
    return world
