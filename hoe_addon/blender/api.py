# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts use, without any window; every name can be had from ``hoe_addon.blender`` too.

- Documents: ``load_device``, ``load_hologram``, ``device_from``, ``hologram_from``,
  ``to_document``, ``HologramSpec``, ``LightGuideSpec``, ``SceneSpec``.
- Scenes: ``build_device`` and its ``DeviceScene``; ``set_up`` for Cycles; ``has_osl``,
  ``require_osl``; ``spectral_scene`` and its ``SpectralScene``, with ``by_significance``.
- Adding, as Add > Hologram does, after ``hoe_addon.register()``: ``add_scene``, ``add_device``
  with its ``AddedDevice``, ``add_hologram``, ``hologram_on_faces``, ``add_slab``,
  ``add_ideal_lens``, ``add_glass``, ``make_glass``, ``add_display``, ``add_lamp``, ``give_eye``;
  ``set_size``. What a scene holds: ``device_of``, ``document_of``.
- Elements: ``hologram_element``, ``surface_of`` a mesh of one's own; ``add_guide``,
  ``add_light_engine``, ``add_eye``, ``set_pupil``, ``patch_frame``.
- Materials: ``hologram_material``, ``dielectric_material``, ``thin_lens_material``,
  ``display_material``, ``filter_material``, ``absorber_material``, ``picture``.
- A hologram's properties, after ``hoe_addon.register()``: ``write_spec``, ``read_spec``,
  ``read_frame``, ``Frame``; then ``refresh`` or ``refresh_changed`` for the shader. Sources that
  are objects: ``Followed``. Maps of what has no formula: ``prepare_map``, ``update_map``.
- Less work: ``plan_effects`` and ``planned``; ``divided``, a picture in passes; ``converge`` until
  an error or a time, a ``QualitySpec``, is ``Reached``.
- Results: ``render_view``, ``save_view``, ``survey``, ``render_layers``, ``denoise``,
  ``trace_cycles``.
"""

from ..core.wavelength_sampling import by_significance
from ..model.device import LightGuideSpec
from ..model.document import device_from, hologram_from, load_device, load_hologram, to_document
from ..model.effects import plan_effects, planned
from ..model.hologram import HologramSpec
from ..model.quality import QualitySpec
from ..model.scene import SceneSpec
from ..shading.hologram import Frame
from .add.bodies import add_glass, add_ideal_lens, add_slab, make_glass
from .add.emitters import add_display, add_lamp
from .add.eye import give_eye
from .add.hologram import add_hologram, hologram_on_faces
from .add.presets import AddedDevice, add_device, add_scene
from .build.device import DeviceScene, build_device
from .build.element import hologram_element, surface_of
from .build.eye import add_eye, set_pupil
from .build.guide import add_guide, patch_frame
from .build.light_engine import add_light_engine
from .document.held import device_of, document_of
from .document.size import set_size
from .pictures.convergence import converge
from .pictures.denoiser import denoise
from .pictures.division import divided
from .pictures.eyebox import survey
from .pictures.reached import Reached
from .pictures.render import render_layers
from .pictures.render_settings import set_up
from .pictures.trace import trace_cycles
from .pictures.view import render_view, save_view
from .props.sync import read_frame, read_spec, refresh, refresh_changed, write_spec
from .shaders.following import Followed
from .shaders.maps import prepare_map, update_map
from .shaders.materials import (
    absorber_material,
    dielectric_material,
    display_material,
    filter_material,
    hologram_material,
    picture,
    thin_lens_material,
)
from .shaders.osl import has_osl, require_osl
from .shaders.spectral import SpectralScene, spectral_scene

__all__ = [
    "AddedDevice",
    "DeviceScene",
    "Followed",
    "Frame",
    "HologramSpec",
    "LightGuideSpec",
    "QualitySpec",
    "Reached",
    "SceneSpec",
    "SpectralScene",
    "absorber_material",
    "add_device",
    "add_display",
    "add_eye",
    "add_glass",
    "add_guide",
    "add_hologram",
    "add_ideal_lens",
    "add_lamp",
    "add_light_engine",
    "add_scene",
    "add_slab",
    "build_device",
    "by_significance",
    "converge",
    "denoise",
    "device_from",
    "device_of",
    "dielectric_material",
    "display_material",
    "divided",
    "document_of",
    "filter_material",
    "give_eye",
    "has_osl",
    "hologram_element",
    "hologram_from",
    "hologram_material",
    "hologram_on_faces",
    "load_device",
    "load_hologram",
    "make_glass",
    "patch_frame",
    "picture",
    "plan_effects",
    "planned",
    "prepare_map",
    "read_frame",
    "read_spec",
    "refresh",
    "refresh_changed",
    "render_layers",
    "render_view",
    "require_osl",
    "save_view",
    "set_pupil",
    "set_size",
    "set_up",
    "spectral_scene",
    "surface_of",
    "survey",
    "thin_lens_material",
    "to_document",
    "trace_cycles",
    "update_map",
    "write_spec",
]
