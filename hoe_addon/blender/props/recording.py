# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The recording as properties: two waves and a wavelength.

Plane waves and points have properties of their own; other kinds are kept as text. A wave may follow
an object: its numbers are then those in the frame of the object.
"""

from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    PointerProperty,
    StringProperty,
)

from ...model.fields import WAVELENGTH_RANGE_NM
from ..ids import Beam, WaveKind
from ..registration import class_registrars
from . import details
from .changes import mark
from .detail_fitting import wave_changed
from .values import number, numbers, reset, store
from .wave_fields import WaveFields, swatch

WAVELENGTH_LIMITS = {
    "min": WAVELENGTH_RANGE_NM[0],
    "max": WAVELENGTH_RANGE_NM[1],
    "soft_min": 380.0,
    "soft_max": 780.0,
    "step": 100,
    "precision": 2,
}
"""Limits, slider range and digits of every wavelength in nm."""


class HOE_PG_wave(WaveFields, bpy.types.PropertyGroup):
    """One recording wave; only the fields of its kind count."""

    kind: EnumProperty(
        name="Wave",
        description="Kind of recording wave",
        items=WaveKind.items(),
        default=WaveKind.PLANE,
        update=wave_changed,
    )
    direction: FloatVectorProperty(
        name="Direction",
        description="Direction in which the light travels, of any length but zero; z is the normal",
        subtype="XYZ",
        size=3,
        default=(0.0, 0.0, 1.0),
        soft_min=-1.0,
        soft_max=1.0,
        step=1,
        precision=4,
        update=mark,
    )
    position_mm: FloatVectorProperty(
        name="Position",
        description="Place of the point source in the frame of the hologram, in mm",
        subtype="XYZ",
        size=3,
        default=(0.0, 0.0, -100.0),
        soft_min=-1000.0,
        soft_max=1000.0,
        step=100,
        precision=3,
        update=mark,
    )
    beam: EnumProperty(
        name="Beam",
        description="Which way the wave runs",
        items=Beam.items(),
        default=Beam.DIVERGING,
        update=mark,
    )
    index: FloatProperty(
        name="Index",
        description="Refractive index of the medium in which the wave arrives",
        default=1.0,
        min=1.0,
        soft_max=2.5,
        step=1,
        precision=4,
        update=mark,
    )

    details: StringProperty(
        name="Details",
        description="JSON of a wave that is neither a plane wave nor a point; lengths in mm",
        update=mark,
    )
    follows: BoolProperty(
        name="Follow Object",
        description="Take the place of the source from an object of the scene",
        default=False,
        update=mark,
    )
    target: PointerProperty(
        name="Source Object",
        description="Object that is the source: its origin is the point, its -Z is the direction",
        type=bpy.types.Object,
        update=mark,
    )

    def to_document(self, path: str) -> dict[str, Any]:
        """The wave as documents write it; in the frame of the object that it follows.

        Args:
            path: Its path, for messages.
        """
        if self.kind not in (WaveKind.PLANE, WaveKind.POINT):
            return details.read(self.details, "kind", self.kind, path)
        wave: dict[str, Any] = {"kind": self.kind, "index": number(self, "index")}
        if self.kind == WaveKind.PLANE:
            return wave | {"direction": numbers(self, "direction")}
        return wave | {"position_mm": numbers(self, "position_mm"), "beam": self.beam}

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the wave of a document.

        Args:
            document: The wave.
            path: Its path, for messages.
        """
        reset(self)
        self.kind = document["kind"]
        if document["kind"] not in (WaveKind.PLANE, WaveKind.POINT):
            self.details = details.written(document, "kind")
            return
        store(self, "index", document["index"], path)
        if document["kind"] == WaveKind.PLANE:
            store(self, "direction", document["direction"], path)
        else:
            store(self, "position_mm", document["position_mm"], path)
            self.beam = document["beam"]


class HOE_PG_recording(bpy.types.PropertyGroup):
    """The two waves whose interference is recorded."""

    wavelength_nm: FloatProperty(
        name="Recording Wavelength",
        description="Vacuum wavelength of the recording, in nm",
        default=532.0,
        update=mark,
        **WAVELENGTH_LIMITS,
    )
    colour: swatch("wavelength_nm")
    object: PointerProperty(
        name="Object Wave", description="The wave that order +1 gives back", type=HOE_PG_wave
    )
    reference: PointerProperty(
        name="Reference Wave",
        description="The wave that reads the hologram out",
        type=HOE_PG_wave,
    )

    def to_document(self) -> dict[str, Any]:
        """The recording as documents write it."""
        return {
            "wavelength_nm": number(self, "wavelength_nm"),
            "object": self.object.to_document("recording.object"),
            "reference": self.reference.to_document("recording.reference"),
        }

    def from_document(self, document: dict[str, Any], path: str) -> None:
        """Take the recording of a document.

        Args:
            document: The recording.
            path: Its path, for messages.
        """
        store(self, "wavelength_nm", document["wavelength_nm"], path)
        self.object.from_document(document["object"], f"{path}.object")
        self.reference.from_document(document["reference"], f"{path}.reference")


register, unregister = class_registrars((HOE_PG_wave, HOE_PG_recording))
