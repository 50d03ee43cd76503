# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts use, without any window; every name can be had from ``hoe_addon.blender`` too.

- Documents: ``load_device``, ``load_hologram``, ``device_from``, ``hologram_from``,
  ``to_document``, ``HologramSpec``, ``LightGuideSpec``, ``SceneSpec``.
- Scenes: ``build_device`` and its ``DeviceScene``; ``set_up`` for Cycles; ``has_osl``,
  ``require_osl``; ``spectral_scene`` and its ``SpectralScene``, with ``by_significance``.
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
from ..model.document import (
    device_from,
    hologram_from,
    load_device,
    load_hologram,
    to_document,
)
from ..model.effects import plan_effects, planned
from ..model.hologram import HologramSpec
from ..model.quality import QualitySpec
from ..model.scene import SceneSpec
from ..shading.hologram import Frame
from .convergence import converge
from .denoiser import denoise
from .device import DeviceScene, build_device
from .division import divided
from .element import hologram_element, surface_of
from .eye import add_eye, set_pupil
from .eyebox import survey
from .following import Followed
from .guide import add_guide, patch_frame
from .light_engine import add_light_engine
from .maps import prepare_map, update_map
from .materials import (
    absorber_material,
    dielectric_material,
    display_material,
    filter_material,
    hologram_material,
    picture,
    thin_lens_material,
)
from .osl import has_osl, require_osl
from .props.sync import read_frame, read_spec, refresh, refresh_changed, write_spec
from .reached import Reached
from .render import render_layers
from .render_settings import set_up
from .spectral import SpectralScene, spectral_scene
from .trace import trace_cycles
from .view import render_view, save_view

__all__ = [
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
    "add_eye",
    "add_guide",
    "add_light_engine",
    "build_device",
    "by_significance",
    "converge",
    "denoise",
    "device_from",
    "dielectric_material",
    "display_material",
    "divided",
    "filter_material",
    "has_osl",
    "hologram_element",
    "hologram_from",
    "hologram_material",
    "load_device",
    "load_hologram",
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
