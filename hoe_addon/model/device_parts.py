# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a device document: light source, display, lens, eye, eyebox, room, render settings."""

from typing import Literal

from msgspec import Struct, to_builtins

from ..core import colour, spectrum
from ..core.errors import SpecError
from ..core.units import nm_to_m
from . import field_kinds, fields
from .field_error import FieldError
from .quality import QualitySpec, requested

BUILT_IN_IMAGES = ("chart", "white", "dots", "bars", "reticle", "speed")
"""Pictures that need no file: a test chart, a plain white field, a grid of dots, black and white
bars with letters, a red aiming mark, a green speedometer."""

ROOMS = ("living_room", "none", "desk", "range", "road", "wall")
"""Scenes behind a device: a living room, darkness, a desk top, open land, a road, a wall."""

WHITES = ("D65", "E", "A")
"""White points by the name of their illuminant."""

_LEAST_CENTRE_WIDTHS = 3.0
"""Nearer to wavelength 0 than this many widths, a line of the core would reach it."""

_MIN_PIXELS = 4  # Blender renders nothing smaller
_MAX_PIXELS = 16384
_LARGEST_PART_MM = 1000.0
_MAX_LUMINANCE = 1e9
_MAX_SAMPLES = 1_000_000
_MAX_SEED = 2**31 - 1
_MAX_BOUNCES = 1024
_MAX_GRID = 101
_MAX_EXPOSURE_EV = 100.0


class SourceSpec(Struct, frozen=True, forbid_unknown_fields=True):
    """Where the display and its lens stand.

    Attributes:
        patch: Name of the hologram over whose centre they stand, on the eye side.
    """

    patch: str

    def __post_init__(self) -> None:
        """Check the name."""
        field_kinds.text(self, "patch")


class PrimarySpec(Struct, frozen=True, forbid_unknown_fields=True):
    """One primary of a display, a Gaussian line.

    Attributes:
        centre_nm: Vacuum wavelength of its peak.
        fwhm_nm: Full width at half maximum.
    """

    centre_nm: float
    fwhm_nm: float

    def __post_init__(self) -> None:
        """Check wavelength and width."""
        fields.wavelength(self, "centre_nm")
        if fields.number(self, "fwhm_nm", above=0.0) >= self.centre_nm / _LEAST_CENTRE_WIDTHS:
            rule = f"must be below {self.centre_nm / _LEAST_CENTRE_WIDTHS:g}, a third of the centre"
            raise FieldError("fwhm_nm", rule, self.fwhm_nm)


type Primaries = str | tuple[PrimarySpec, PrimarySpec, PrimarySpec]
"""A set of ``core.spectrum`` by its name, or red, green and blue by their lines."""


class DisplaySpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A flat picture that gives light.

    Attributes:
        image: ``chart``, ``white``, ``dots``, or an image file beside the document.
        size_mm: Width and height.
        luminance_cd_m2: Luminance of its white.
        primaries: Spectra of red, green and blue.
        white: White point that the primaries are balanced to.
    """

    image: str = "chart"
    size_mm: tuple[float, float]
    luminance_cd_m2: float
    primaries: Primaries
    white: str = "D65"

    def __post_init__(self) -> None:
        """Check the picture, its size and its colours."""
        field_kinds.text(self, "image")
        fields.vector(self, "size_mm", 2, above=0.0)
        fields.number(self, "luminance_cd_m2", at_least=0.0, at_most=_MAX_LUMINANCE)
        if isinstance(self.primaries, str):
            field_kinds.choice(self, "primaries", spectrum.DISPLAY_PRIMARIES)
        elif len(self.primaries) != len("rgb"):
            raise FieldError("primaries", "must be red, green and blue", len(self.primaries))
        field_kinds.choice(self, "white", WHITES)
        self._check_gamut()

    def _check_gamut(self) -> None:
        try:
            colour.white_balance(self.spectra(), self.white)
        except SpecError as error:
            names = to_builtins(self.primaries)
            rule = f"must be able to mix the white {self.white} ({error})"
            raise FieldError("primaries", rule, names) from error

    def spectra(self) -> tuple[spectrum.Spectrum, spectrum.Spectrum, spectrum.Spectrum]:
        """Make the spectra of the primaries.

        Returns:
            Red, green and blue, each 1 at its peak.
        """
        if isinstance(self.primaries, str):
            return spectrum.display_primaries(self.primaries)
        red, green, blue = (
            spectrum.line(nm_to_m(line.centre_nm), nm_to_m(line.fwhm_nm)) for line in self.primaries
        )
        return red, green, blue


class LensSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """An ideal thin lens that collimates the display.

    Attributes:
        focal_length_mm: Focal length; the display stands in the focal plane.
        diameter_mm: Diameter of its clear aperture.
        distance_mm: Distance from the lens to the guide's eye-side face.
    """

    focal_length_mm: float
    diameter_mm: float
    distance_mm: float

    def __post_init__(self) -> None:
        """Check the lengths."""
        fields.number(self, "focal_length_mm", above=0.0)
        fields.number(self, "diameter_mm", above=0.0)
        fields.number(self, "distance_mm", above=0.0)


class EyeSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The eye, or the camera in its place.

    Attributes:
        pupil_diameter_mm: Diameter of the pupil.
        focus_mm: Distance that it is focused on; None is infinity.
        field_deg: Horizontal field of the picture.
        position_mm: Centre of the pupil.
    """

    pupil_diameter_mm: float
    focus_mm: float | None = None
    field_deg: float
    position_mm: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        """Check pupil, focus, field and place."""
        fields.number(self, "pupil_diameter_mm", above=0.0, at_most=_LARGEST_PART_MM)
        if self.focus_mm is not None:
            fields.number(self, "focus_mm", above=0.0)
        if fields.number(self, "field_deg", above=0.0) >= 180.0:
            raise FieldError("field_deg", "must be below 180", self.field_deg)
        fields.vector(self, "position_mm", 3)


class EyeboxSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """A grid of pupil positions around the eye's own.

    Attributes:
        grid: Number of positions along x and y.
        pitch_mm: Distance between neighbours along x and y.
    """

    grid: tuple[int, int] = (3, 3)
    pitch_mm: tuple[float, float]

    def __post_init__(self) -> None:
        """Check the grid."""
        fields.integers(self, "grid", 1, _MAX_GRID, size=2)
        fields.vector(self, "pitch_mm", 2, above=0.0)


class RoomSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The scene behind and around a device.

    Attributes:
        kind: Which scene; ``none`` is darkness.
        luminance_cd_m2: Luminance of a white surface in it.
    """

    kind: Literal["living_room", "none", "desk", "range", "road", "wall"] = "living_room"
    luminance_cd_m2: float

    def __post_init__(self) -> None:
        """Check kind and luminance."""
        field_kinds.choice(self, "kind", ROOMS)
        fields.number(self, "luminance_cd_m2", at_least=0.0)


class RenderSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """How the picture is made.

    Attributes:
        size: Width and height in pixels.
        samples: Samples per pixel.
        quality: What ``render`` has to reach instead of a number of samples: an error, a time, or
            ``draft``, ``preview``, ``final`` or ``reference``.
        seed: Seed of all random numbers.
        mode: ``spectral``, or ``preview`` at one wavelength.
        preview_wavelength_nm: Vacuum wavelength of the preview.
        spectrum_floor: Share of the wavelength samples kept for light other than the display's.
        wavelengths: How they are drawn: by the ``spectrum`` of the light and the eye's response,
            ``uniform``, or only at a few fixed ``lines``, which is an approximation.
        order_selection: By ``significance``, that is by efficiency, or ``guided`` toward the paths
            that matter to the picture; both are unbiased.
        effects: Changes of the effect plan: ``+haze`` and ``-levels`` turn one on and off, ``all``
            turns everything on.
        luminance_per_unit_cd_m2: Luminance that the scene-linear value 1.0 stands for.
        exposure_ev: Exposure of the shown picture, in stops; the EXR is left alone.
        max_bounces: Most surfaces that a path may pass.
    """

    size: tuple[int, int] = (640, 480)
    samples: int = 128
    quality: str | QualitySpec | None = None
    seed: int = 0
    mode: Literal["spectral", "preview"] = "spectral"
    preview_wavelength_nm: float = 532.0
    spectrum_floor: float = 0.5
    wavelengths: Literal["spectrum", "uniform", "lines"] = "spectrum"
    order_selection: Literal["guided", "significance"] = "guided"
    effects: tuple[str, ...] = ()
    luminance_per_unit_cd_m2: float = 100.0
    exposure_ev: float = 0.0
    max_bounces: int = 128

    def __post_init__(self) -> None:
        """Check every setting."""
        fields.integers(self, "size", _MIN_PIXELS, _MAX_PIXELS, size=2)
        fields.integer(self, "samples", 1, _MAX_SAMPLES)
        if not isinstance(self.quality, str | None):
            field_kinds.instance(self, "quality", QualitySpec)
        requested(self.quality)
        fields.integer(self, "seed", 0, _MAX_SEED)
        field_kinds.choice(self, "mode", ("spectral", "preview"))
        fields.wavelength(self, "preview_wavelength_nm")
        fields.number(self, "spectrum_floor", above=0.0, at_most=1.0)
        field_kinds.choice(self, "wavelengths", ("spectrum", "uniform", "lines"))
        field_kinds.choice(self, "order_selection", ("guided", "significance"))
        fields.number(self, "luminance_per_unit_cd_m2", above=0.0)
        fields.number(self, "exposure_ev", at_least=-_MAX_EXPOSURE_EV, at_most=_MAX_EXPOSURE_EV)
        fields.integer(self, "max_bounces", 1, _MAX_BOUNCES)
