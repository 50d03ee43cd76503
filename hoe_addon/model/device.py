# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The document of a light-guide device: guide, holograms on it, display, lens, eye, room.

Frame: x right, y up, z toward the viewer, in mm. The eye's pupil is at the origin and looks along
-z. The guide's eye-side face lies at z = -relief, its world-side face one thickness beyond.
"""

from typing import Literal

from msgspec import Struct

from . import field_kinds, fields, medium, pattern
from .characteristic import CharacteristicSpec
from .device_parts import (
    BUILT_IN_IMAGES,
    DisplaySpec,
    EyeboxSpec,
    EyeSpec,
    LensSpec,
    RenderSpec,
    RoomSpec,
    SourceSpec,
)
from .efficiency import EFFICIENCIES, EfficiencySpec, check_fits, settle_orders
from .field_error import FieldError
from .hologram import HologramSpec, Orders, SideMedia
from .medium import MediumRef
from .recording import RecordingSpec
from .scene import SceneSpec
from .surface import PlaneSurface

_THICKEST_MM = 1000.0
_EDGE_SLACK_MM = 1e-9
_MAX_HOLOGRAMS = 200
"""Patches may touch each other and the rim; this allows for the rounding of their corners."""


class GuideSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A plane-parallel plate in front of the eye.

    Attributes:
        medium: What it is made of.
        outside: What is around it.
        thickness_mm: Distance of its two faces.
        size_mm: Width and height.
        center_mm: Centre of the faces, x and y.
        relief_mm: Distance from the pupil plane to the eye-side face.
    """

    medium: MediumRef
    outside: MediumRef = "air"
    thickness_mm: float
    size_mm: tuple[float, float]
    center_mm: tuple[float, float] = (0.0, 0.0)
    relief_mm: float

    def __post_init__(self) -> None:
        """Check media and sizes."""
        medium.check(self, "medium")
        medium.check(self, "outside")
        fields.number(self, "thickness_mm", above=0.0, at_most=_THICKEST_MM)
        fields.vector(self, "size_mm", 2, above=0.0)
        fields.vector(self, "center_mm", 2)
        fields.number(self, "relief_mm", above=0.0)

    def face_z_mm(self, face: str) -> float:
        """Place of a face on the z axis.

        Args:
            face: ``"eye"`` or ``"world"``.

        Returns:
            z in mm, in the frame of the device.
        """
        return -self.relief_mm if face == "eye" else -self.relief_mm - self.thickness_mm


class PatchSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A hologram on one face of the guide.

    Its own frame has z along the outward normal of its face: on the eye side the axes are those
    of the device, on the world side they are turned by 180 degrees about y. The recording is
    given in that frame; the guide is behind it (z < 0), the outside before it.

    Attributes:
        name: Name of the patch, once in a device.
        face: Face of the guide that it lies on.
        center_mm: Its centre, x and y, in the frame of the device.
        size_mm: Width and height.
        recording: The two waves that it was made with, or
        characteristic: the function V(x, y) that is recorded in it; exactly one of the two.
        efficiency: How much light each order gets.
        orders: Orders that are traced; those of the table where it is left out.
    """

    name: str
    face: Literal["eye", "world"]
    center_mm: tuple[float, float]
    size_mm: tuple[float, float]
    recording: RecordingSpec | None = None
    characteristic: CharacteristicSpec | None = None
    efficiency: EfficiencySpec
    orders: Orders = ()

    def __post_init__(self) -> None:
        """Check the patch alone."""
        field_kinds.text(self, "name")
        field_kinds.choice(self, "face", ("eye", "world"))
        fields.vector(self, "center_mm", 2)
        fields.vector(self, "size_mm", 2, above=0.0)
        field_kinds.instance(self, "efficiency", *EFFICIENCIES)
        surface = PlaneSurface(size_mm=self.size_mm)
        pattern.check(self, surface)
        settle_orders(self, self.efficiency)
        check_fits(self.efficiency, pattern.pattern_of(self), surface)

    def hologram(self, guide: GuideSpec) -> HologramSpec:
        """Give the patch as a hologram of its own.

        Args:
            guide: The guide that it lies on.

        Returns:
            The hologram, in the patch's own frame.
        """
        return HologramSpec(
            name=self.name,
            surface=PlaneSurface(size_mm=self.size_mm),
            media=SideMedia(back=guide.medium, front=guide.outside),
            recording=self.recording,
            characteristic=self.characteristic,
            efficiency=self.efficiency,
            orders=self.orders,
        )

    def overlaps(self, other: "PatchSpec") -> bool:
        """Tell whether two patches cover the same ground.

        Args:
            other: Another patch.

        Returns:
            True if both lie on the same face and share more than an edge.
        """
        return self.face == other.face and all(
            abs(self.center_mm[axis] - other.center_mm[axis])
            < (self.size_mm[axis] + other.size_mm[axis]) / 2.0 - _EDGE_SLACK_MM
            for axis in (0, 1)
        )


class LightGuideSpec(
    Struct,
    frozen=True,
    forbid_unknown_fields=True,
    kw_only=True,
    tag_field="kind",
    tag="light_guide",
):
    """A holographic AR device around one light guide.

    Attributes:
        schema: Version of the document's format.
        name: Short name, as the preset's file.
        title: One line for lists.
        description: What it shows, and where its numbers come from.
        guide: The plate.
        holograms: The patches on it.
        source: Where the display sends its light in.
        display: The picture, in the focal plane of the lens.
        lens: The collimating lens.
        eye: The eye that looks.
        eyebox: Places of the pupil for a survey.
        room: What is seen through the guide.
        render: How the picture is made.
    """

    schema: Literal[1] = 1
    name: str
    title: str
    description: str = ""
    guide: GuideSpec
    holograms: tuple[PatchSpec, ...]
    source: SourceSpec
    display: DisplaySpec
    lens: LensSpec
    eye: EyeSpec
    eyebox: EyeboxSpec
    room: RoomSpec
    render: RenderSpec

    def __post_init__(self) -> None:
        """Check what the parts cannot check alone."""
        field_kinds.text(self, "name")
        field_kinds.text(self, "title")
        field_kinds.text(self, "description", empty=True)
        for name, kind in _PARTS.items():
            field_kinds.instance(self, name, kind)
        if not self.holograms:
            raise FieldError("holograms", "must hold at least one hologram", self.holograms)
        if len(self.holograms) > _MAX_HOLOGRAMS:
            rule = f"must hold at most {_MAX_HOLOGRAMS} holograms"
            raise FieldError("holograms", rule, len(self.holograms))
        if self.eye.position_mm[2] <= -self.guide.relief_mm:
            rule = f"must lie before the guide's face at z = {-self.guide.relief_mm:g}"
            raise FieldError("eye.position_mm[2]", rule, self.eye.position_mm[2])
        for place, patch in enumerate(self.holograms):
            self._check_patch(place, patch)
        names = [patch.name for patch in self.holograms]
        if self.source.patch not in names:
            rule = f"must name a hologram ({', '.join(names)})"
            raise FieldError("source.patch", rule, self.source.patch)

    def _check_patch(self, place: int, patch: PatchSpec) -> None:
        where = f"holograms[{place}]"
        for axis, label in enumerate("xy"):
            reach = (
                abs(patch.center_mm[axis] - self.guide.center_mm[axis]) + patch.size_mm[axis] / 2
            )
            if reach > self.guide.size_mm[axis] / 2 + _EDGE_SLACK_MM:
                rule = f"must keep the patch on the guide in {label}"
                raise FieldError(f"{where}.center_mm[{axis}]", rule, patch.center_mm[axis])
        for other in self.holograms[:place]:
            if other.name == patch.name:
                raise FieldError(f"{where}.name", "must be used once", patch.name)
            if other.overlaps(patch):
                rule = f"must keep the patch clear of {other.name}"
                raise FieldError(f"{where}.center_mm", rule, patch.center_mm)
        try:
            patch.hologram(self.guide)
        except FieldError as error:
            # Only the guide's media are new here; the patch has checked the rest itself.
            raise error.moved(_GUIDE_FIELDS[error.field]) from error

    @property
    def picture_files(self) -> tuple[tuple[str, str], ...]:
        """Pictures that are files: the field that names each, and the name."""
        if self.display.image in BUILT_IN_IMAGES:
            return ()
        return (("display.image", self.display.image),)

    def patch(self, name: str) -> PatchSpec:
        """Find a hologram by its name.

        Args:
            name: Name of the patch.

        Returns:
            The patch.

        Raises:
            FieldError: If there is none; the message lists the names.
        """
        for patch in self.holograms:
            if patch.name == name:
                return patch
        names = ", ".join(patch.name for patch in self.holograms)
        raise FieldError("holograms", f"must name a hologram ({names})", name)


_GUIDE_FIELDS = {"media.back": "guide.medium", "media.front": "guide.outside"}

_PARTS = {
    "guide": GuideSpec,
    "source": SourceSpec,
    "display": DisplaySpec,
    "lens": LensSpec,
    "eye": EyeSpec,
    "eyebox": EyeboxSpec,
    "room": RoomSpec,
    "render": RenderSpec,
}

type DeviceSpec = LightGuideSpec | SceneSpec
"""Any device, told apart by ``kind``."""
