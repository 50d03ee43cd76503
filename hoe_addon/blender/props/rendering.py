# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a picture is made, as properties.

What Cycles or Blender have a setting for stands there: size, samples, seed and exposure.
"""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
)

from ...model.methods import METHODS
from ...model.quality import ERROR_RANGE, SECONDS_RANGE
from ..ids import Goal, Method, Mode, Quality
from ..registration import class_registrars
from .changes import mark
from .recording import WAVELENGTH_LIMITS
from .values import number, reset, store
from .wave_fields import swatch


class HOE_PG_effect(bpy.types.PropertyGroup):
    """One change of the effect plan; its name is the text, such as ``-levels`` or ``+haze``."""


class HOE_PG_render(bpy.types.PropertyGroup):
    """How the picture is made."""

    mode: EnumProperty(
        name="Colours",
        description="Which wavelengths the picture is made of",
        items=Mode.items(),
        default=Mode.SPECTRAL,
        update=mark,
    )
    preview_wavelength_nm: FloatProperty(
        name="Preview Wavelength",
        description="Vacuum wavelength that the viewport shows, in nm",
        default=532.0,
        update=mark,
        **WAVELENGTH_LIMITS,
    )
    preview_colour: swatch("preview_wavelength_nm")
    goal: EnumProperty(
        name="Render Until",
        description="When a render ends",
        items=Goal.items(),
        default=Goal.QUALITY,
    )
    error: FloatProperty(
        name="Error",
        description="Relative error of the luminance of a pixel that the render has to reach, "
        "before denoising; 0.1 is 10 %",
        default=0.1,
        min=ERROR_RANGE[0],
        max=ERROR_RANGE[1],
        soft_min=0.01,
        soft_max=1.0,
        step=1,
        precision=3,
    )
    seconds: FloatProperty(
        name="Time",
        description="Seconds that the render may take, set-up counted",
        default=60.0,
        min=SECONDS_RANGE[0],
        max=SECONDS_RANGE[1],
        soft_min=5.0,
        soft_max=3600.0,
        step=500,
        precision=0,
    )
    ends_in_time: BoolProperty(
        name="Or after",
        description="End when the time is over, even if the error is not reached",
        default=False,
    )
    quality: EnumProperty(
        name="Quality",
        description="Error by name",
        items=Quality.items(),
        default=Quality.PREVIEW,
    )
    method: EnumProperty(
        name="Method",
        description="How paths are drawn; both give the same mean",
        items=Method.items(),
        default=Method.GUIDED,
        update=mark,
    )
    denoise: BoolProperty(
        name="Denoise",
        description="Denoise the picture that is shown; the EXR and all numbers never are",
        default=True,
    )
    spectrum_floor: FloatProperty(
        name="Even Share",
        description="Share of the paths whose wavelengths are drawn evenly, for light that no "
        "display or lamp gives, such as that of the room",
        default=0.5,
        min=1e-3,
        max=1.0,
        step=1,
        precision=2,
        update=mark,
    )
    luminance_per_unit_cd_m2: FloatProperty(
        name="Luminance of 1.0",
        description="Luminance that the scene-linear value 1 stands for, in cd/m²",
        default=100.0,
        min=1e-6,
        soft_max=1e4,
        step=1000,
        precision=1,
        update=mark,
    )
    max_bounces: IntProperty(
        name="Bounces",
        description="Most surfaces that a path of light may pass or be reflected at",
        default=128,
        min=1,
        max=1024,
        update=mark,
    )
    effects: CollectionProperty(
        name="Effects",
        description="Changes of the effect plan, such as -levels and +haze",
        type=HOE_PG_effect,
    )
    lines_only: BoolProperty(
        name="Fixed Lines",
        description="Render at a few fixed wavelengths, an approximation",
        default=False,
        update=mark,
        options={"HIDDEN"},
    )

    def request(self) -> str | dict[str, float] | None:
        """What is asked of the picture, as documents write it."""
        match Goal(self.goal):
            case Goal.SAMPLES:
                return None
            case Goal.ERROR if self.ends_in_time:
                return {"error": number(self, "error"), "seconds": number(self, "seconds")}
            case Goal.ERROR:
                return {"error": number(self, "error")}
            case Goal.SECONDS:
                return {"seconds": number(self, "seconds")}
            case Goal.QUALITY:
                return self.quality

    def to_document(self) -> dict[str, Any]:
        """The settings as documents write them, without those that Cycles has."""
        method = METHODS[self.method]
        published = self.method == Method.PUBLISHED
        own = [effect.name for effect in self.effects if not (published and effect.name == "all")]
        return {
            "quality": self.request(),
            "mode": self.mode,
            "preview_wavelength_nm": number(self, "preview_wavelength_nm"),
            "spectrum_floor": number(self, "spectrum_floor"),
            "wavelengths": "lines" if self.lines_only else method["wavelengths"],
            "order_selection": method["order_selection"],
            "effects": ["all", *own] if published else own,
            "luminance_per_unit_cd_m2": number(self, "luminance_per_unit_cd_m2"),
            "max_bounces": self.max_bounces,
        }

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the render settings of a document.

        Args:
            document: The settings.
            path: Their path, for messages.
        """
        reset(self)
        self.mode = document["mode"]
        for field in ("preview_wavelength_nm", "spectrum_floor", "luminance_per_unit_cd_m2"):
            store(self, field, document[field], path)
        self.max_bounces = document["max_bounces"]
        self.lines_only = document["wavelengths"] == "lines"
        if document["wavelengths"] == "uniform":
            self.method = Method.PUBLISHED
        for text in document["effects"]:
            self.effects.add().name = text
        self._take_request(document["quality"], path)

    def _take_request(self, quality: str | dict[str, float] | None, path: str) -> None:
        self.goal = Goal.SAMPLES
        if isinstance(quality, str):
            self.goal, self.quality = Goal.QUALITY, quality
            return
        given = {name: item for name, item in (quality or {}).items() if item is not None}
        for field in given:
            store(self, field, given[field], f"{path}.quality")
        if "error" in given:
            self.goal, self.ends_in_time = Goal.ERROR, "seconds" in given
        elif given:
            self.goal = Goal.SECONDS


register, unregister = class_registrars((HOE_PG_effect, HOE_PG_render))
