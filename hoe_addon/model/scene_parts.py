# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Elements of a scene document, told apart by ``kind``.

Each has a frame of its own, placed in the frame of the scene: x right, y up, z toward the viewer,
in mm. It is turned about its x, then y, then z axis (of the scene), and then moved.
"""

from typing import Literal

from . import field_kinds, fields
from .device_parts import BUILT_IN_IMAGES, DisplaySpec
from .hologram import HologramSpec
from .scene_element import Place, SceneElement
from .scene_lens import LensElement
from .scene_spectra import SPECTRA, SpectrumSpec

_MAX_LUMINANCE = 1e9


class HologramElement(SceneElement, frozen=True, kw_only=True, tag="hologram"):
    """A hologram; its recording is given in its own frame.

    Attributes:
        hologram: The hologram, as in a document of its own.
    """

    hologram: HologramSpec

    def __post_init__(self) -> None:
        """Check the place and the kind of the hologram."""
        super().__post_init__()
        field_kinds.instance(self, "hologram", HologramSpec)


class DisplayElement(SceneElement, frozen=True, kw_only=True, tag="display"):
    """A picture that gives light to the side z > 0.

    Attributes:
        display: Picture, size, colours.
        mirrored: Whether left and right are swapped, for one that is seen by an odd number of
            reflections.
    """

    display: DisplaySpec
    mirrored: bool = False

    def __post_init__(self) -> None:
        """Check the place and the kind of the display."""
        super().__post_init__()
        field_kinds.instance(self, "display", DisplaySpec)
        field_kinds.flag(self, "mirrored")


class LampElement(SceneElement, frozen=True, kw_only=True, tag="lamp"):
    """A lamp that is equally bright all over.

    Attributes:
        shape: ``disc`` and ``rectangle`` shine to the side z > 0; ``sphere`` and ``line``, a
            round rod along y, all around.
        size_mm: Width and height; of a sphere and a line, the thickness and the height.
        luminance_cd_m2: Luminance.
        spectrum: Its light.
    """

    shape: Literal["disc", "rectangle", "sphere", "line"]
    size_mm: tuple[float, float]
    luminance_cd_m2: float
    spectrum: SpectrumSpec

    def __post_init__(self) -> None:
        """Check shape, size and light."""
        super().__post_init__()
        field_kinds.choice(self, "shape", ("disc", "rectangle", "sphere", "line"))
        fields.vector(self, "size_mm", 2, above=0.0)
        fields.number(self, "luminance_cd_m2", at_least=0.0, at_most=_MAX_LUMINANCE)
        field_kinds.instance(self, "spectrum", *SPECTRA)


class CardElement(SceneElement, frozen=True, kw_only=True, tag="card"):
    """A matte panel with a printed picture; its front is the side z > 0.

    Attributes:
        image: ``chart``, ``white``, ``dots``, ... or an image file beside the document.
        size_mm: Width and height.
        reflectance: Of the picture's white.
    """

    image: str
    size_mm: tuple[float, float]
    reflectance: float = 0.85

    def __post_init__(self) -> None:
        """Check picture, size and reflectance."""
        super().__post_init__()
        field_kinds.text(self, "image")
        fields.vector(self, "size_mm", 2, above=0.0)
        fields.number(self, "reflectance", at_least=0.0, at_most=1.0)

    @property
    def is_file(self) -> bool:
        """Whether the picture is a file."""
        return self.image not in BUILT_IN_IMAGES


class BlockElement(SceneElement, frozen=True, kw_only=True, tag="block"):
    """A matte body around the origin of its frame: a housing, a foot, a hub.

    Attributes:
        shape: ``box``, or ``cylinder`` with its axis along z.
        size_mm: Width, height and depth (along x, y, z).
        color: Scene-linear Rec. 709 reflectance.
    """

    shape: Literal["box", "cylinder"] = "box"
    size_mm: Place
    color: Place = (0.02, 0.02, 0.02)

    def __post_init__(self) -> None:
        """Check shape, size and colour."""
        super().__post_init__()
        field_kinds.choice(self, "shape", ("box", "cylinder"))
        fields.vector(self, "size_mm", 3, above=0.0)
        for place, share in enumerate(fields.vector(self, "color", 3)):
            fields.share(f"color[{place}]", share)


class HolderElement(SceneElement, frozen=True, kw_only=True, tag="holder"):
    """A frame around an opening in the plane z = 0, on a rod or without one.

    Attributes:
        outline: Shape of the opening.
        opening_mm: Width and height of the opening.
        rim_mm: Width of the frame.
        depth_mm: Thickness of the frame along z.
        rod_mm: Length of the rod below the frame, with a round foot; 0 is none.
        color: Scene-linear Rec. 709 reflectance.
    """

    outline: Literal["rectangle", "ellipse"] = "rectangle"
    opening_mm: tuple[float, float]
    rim_mm: float = 6.0
    depth_mm: float = 8.0
    rod_mm: float = 0.0
    color: Place = (0.03, 0.03, 0.03)

    def __post_init__(self) -> None:
        """Check outline, lengths and colour."""
        super().__post_init__()
        field_kinds.choice(self, "outline", ("rectangle", "ellipse"))
        fields.vector(self, "opening_mm", 2, above=0.0)
        fields.number(self, "rim_mm", above=0.0)
        fields.number(self, "depth_mm", above=0.0)
        fields.number(self, "rod_mm", at_least=0.0)
        for place, share in enumerate(fields.vector(self, "color", 3)):
            fields.share(f"color[{place}]", share)


type ElementSpec = (
    HologramElement
    | LensElement
    | DisplayElement
    | LampElement
    | CardElement
    | BlockElement
    | HolderElement
)
"""Any element of a scene."""
