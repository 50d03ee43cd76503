# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Choices that Blender files hold, each with its words and the number that it is stored as.

A .blend keeps the number, not the name: a number is never given to another choice, and a choice
that is gone leaves its number unused.
"""

import zlib
from enum import StrEnum

from ..core.media import CATALOGUE

type EnumItem = tuple[str, str, str, int]
"""Identifier, label, tooltip and stored number, as Blender's enum properties take them."""


class Choice(StrEnum):
    """Base of all choices; the value is the word that documents use.

    Attributes:
        number: What a .blend stores.
        label: Words for the menu.
        words: Words for the tooltip.
    """

    number: int
    label: str
    words: str

    def __new__(cls, value: str, number: int, label: str, words: str) -> "Choice":
        """Make a member that is a plain string with three more attributes."""
        member = str.__new__(cls, value)
        member._value_ = value
        member.number = number
        member.label = label
        member.words = words
        return member

    @classmethod
    def items(cls) -> list[EnumItem]:
        """The list for an enum property."""
        return [(item.value, item.label, item.words, item.number) for item in cls]


class MediumKind(Choice):
    """How a medium is given."""

    CONSTANT = "constant", 0, "Constant Index", "The same index at every wavelength"
    CATALOGUE = "catalogue", 1, "Catalogue", "A glass or plastic with published dispersion"
    SELLMEIER = "sellmeier", 2, "Sellmeier", "Coefficients of one's own"


class WaveKind(Choice):
    """Kinds of recording wave."""

    PLANE = "plane", 0, "Plane Wave", "The same direction everywhere"
    POINT = "point", 1, "Point Source", "Away from a point, or toward it"
    WINDOW = "window", 2, "Point behind a Window", "A point source seen through a flat plate"
    ASTIGMATIC = "astigmatic", 3, "Line Foci", "A wave with two line foci at right angles"
    EXTENDED = "extended", 4, "Extended Source", "One point of the source is drawn for each ray"
    SYSTEM = "system", 5, "Behind Optics", "A source seen through lenses and mirrors"


class Beam(Choice):
    """Which way a spherical wave runs."""

    DIVERGING = "diverging", 0, "Diverging", "The wave runs away from its point"
    CONVERGING = "converging", 1, "Converging", "The wave runs toward its point"


class PatternKind(Choice):
    """How it is said what is recorded."""

    RECORDING = "recording", 0, "Recording", "Two waves and a wavelength"
    CHARACTERISTIC = (
        "characteristic",
        1,
        "Function",
        "A characteristic function V(x, y), without waves",
    )


class CharacteristicKind(Choice):
    """Kinds of characteristic function."""

    LINEAR = "linear", 0, "Grating", "Straight, evenly spaced lines"
    RADIAL = "radial", 1, "Rings", "Circular, evenly spaced lines"
    EVEN_RADIAL = "even_radial", 2, "Even Radial", "Even powers of the radius (Binary 2)"
    POLYNOMIAL = "polynomial", 3, "Polynomial", "Powers of x and y (Binary 1)"
    ZERNIKE = "zernike", 4, "Zernike", "Noll or fringe polynomials"
    SPLINE = "spline", 5, "Spline", "A grid of cubic B-splines"
    FORMULA = "formula", 6, "Formula", "An expression of x, y, r and phi"
    SAMPLED = "sampled", 7, "File", "An image or an array of values"


class Shape(Choice):
    """Shapes of a hologram's surface."""

    PLANE = "plane", 0, "Plane", "A flat element"
    SPHERE = "sphere", 1, "Sphere", "A part of a sphere"
    CYLINDER = "cylinder", 2, "Cylinder", "A part of a cylinder"
    CONIC = "conic", 3, "Conic", "A paraboloid, ellipsoid or hyperboloid"
    ASPHERE = "asphere", 4, "Asphere", "A conic with even powers of the radius"
    MESH = "mesh", 5, "Mesh", "The mesh of the object, or of a file"


class Outline(Choice):
    """Outlines of a hologram, seen along its normal."""

    RECTANGLE = "rectangle", 0, "Rectangle", "A rectangle of this width and height"
    ELLIPSE = "ellipse", 1, "Ellipse", "The ellipse in that rectangle, such as a round lens"


class EfficiencyModel(Choice):
    """How the light is shared among the orders."""

    KINOFORM = "kinoform", 0, "Kinoform", "A thin relief, continuous or in steps"
    CONSTANT = "constant", 1, "Constant Shares", "The same share at every wavelength and angle"
    KOGELNIK = "kogelnik", 2, "Volume Hologram", "Thick fringes in two-wave theory"
    RCWA = "rcwa", 3, "Rigorous Grating", "Any layers, by rigorous coupled-wave analysis"
    TABLE = "table", 4, "Table", "Shares from a file"


class Side(Choice):
    """Which way an order leaves."""

    TRANSMITTED = "T", 0, "Transmitted", "The order goes on through the surface"
    REFLECTED = "R", 1, "Reflected", "The order goes back"


class Role(Choice):
    """What an object is in a device or a scene."""

    NONE = "none", 0, "Other", "Not part of a device"
    ROOT = "root", 1, "Device", "The frame of a whole device; what hangs on it moves with it"
    HOLOGRAM = "hologram", 2, "Hologram", "A hologram on a surface"
    LENS = "lens", 3, "Lens", "A round lens of glass, with a hologram on a face or without one"
    DISPLAY = "display", 4, "Display", "A picture that gives light"
    LAMP = "lamp", 5, "Lamp", "A lamp that is equally bright all over"
    CARD = "card", 6, "Card", "A matte panel with a printed picture"
    BLOCK = "block", 7, "Block", "A matte body"
    HOLDER = "holder", 8, "Holder", "A frame around an opening"
    GUIDE = "guide", 9, "Light Guide", "A plate that carries light to the eye"
    ENGINE = "engine", 10, "Light Engine", "Display and lens that send light into a guide"
    PART = "part", 11, "Part", "A piece of another element, such as a face of a lens"
    EYE = "eye", 12, "Eye", "The camera with a pupil that looks"
    FILTER = "filter", 13, "Spectral Filter", "The eye's response, in front of the camera"
    IDEAL_LENS = "ideal_lens", 14, "Ideal Lens", "A thin lens without any error"
    SLAB = "slab", 15, "Light-Guide Slab", "A clear plate without a device around it"
    GLASS = "glass", 16, "Dispersive Glass", "A body whose index depends on the wavelength"
    ROOM = "room", 17, "Room Part", "A piece of the room, made anew wherever the room changes"


class DeviceKind(Choice):
    """What the document of a scene describes."""

    NONE = "none", 0, "None", "No device"
    LIGHT_GUIDE = "light_guide", 1, "Light Guide", "A light guide with a light engine and an eye"
    SCENE = "scene", 2, "Scene", "Holograms, displays and lamps, and an eye"


class PictureKind(Choice):
    """What a display or a card shows."""

    CHART = "chart", 0, "Test Chart", "Circles, a grid and patches of colour"
    WHITE = "white", 1, "White", "Plain white"
    DOTS = "dots", 2, "Dots", "A grid of dots"
    BARS = "bars", 3, "Bars", "Black and white bars with letters"
    RETICLE = "reticle", 4, "Aiming Mark", "A red circle with a dot"
    SPEED = "speed", 5, "Speed", "A green speedometer"
    IMAGE = "image", 6, "Image", "An image of this file"


class Primaries(Choice):
    """What makes the colours of a display; all but the last are names of sets."""

    LED = "led_rgb", 0, "LED", "Red, green and blue LEDs"
    LASER = "laser_rgb", 1, "Laser", "Three lasers"
    OLED = "oled_rgb", 2, "OLED", "An OLED panel"
    OWN = "own", 3, "Own", "Three lines of your own, as JSON"


class RoomKind(Choice):
    """What stands behind and around a device."""

    NONE = "none", 0, "None", "Nothing of the add-on; whatever else the scene holds stays"
    LIVING_ROOM = "living_room", 1, "Living Room", "A furnished room with a window"
    DESK = "desk", 2, "Desk", "The top of a desk"
    RANGE = "range", 3, "Open Land", "Open land with targets"
    ROAD = "road", 4, "Road", "A road in daylight"
    WALL = "wall", 5, "Wall", "A plain wall"


class White(Choice):
    """White points."""

    D65 = "D65", 0, "D65 (Daylight)", "Average daylight, 6500 K"
    E = "E", 1, "E (Equal Energy)", "The same power at every wavelength"
    A = "A", 2, "A (Tungsten)", "A tungsten lamp, 2856 K"


class Mode(Choice):
    """Which wavelengths a picture is made of."""

    SPECTRAL = "spectral", 0, "Spectral", "Every path draws a wavelength of its own; true colours"
    PREVIEW = "preview", 1, "One Wavelength", "All paths have the wavelength of the preview"


class Goal(Choice):
    """When a render ends."""

    SAMPLES = "samples", 0, "Samples", "After the samples that are set for Cycles"
    ERROR = "error", 1, "Error", "When the stated error is reached"
    SECONDS = "seconds", 2, "Time", "When the time is over; the error reached is told"
    QUALITY = "quality", 3, "Quality", "When the error of a quality by name is reached"


class Quality(Choice):
    """Qualities by name; ``model.methods`` has the error of each."""

    DRAFT = "draft", 0, "Draft", "A first look"
    PREVIEW = "preview", 1, "Preview", "Good enough to judge the composition"
    FINAL = "final", 2, "Final", "For a picture that is shown"
    REFERENCE = "reference", 3, "Reference", "To measure in"


class Method(Choice):
    """How paths are drawn; all but ``lines`` give the same mean."""

    GUIDED = "guided", 0, "Guided", "Toward the orders and wavelengths that the picture needs"
    PUBLISHED = "published", 1, "As Published", "Uniform wavelengths, orders by significance"


class Face(Choice):
    """Faces of a light guide."""

    EYE = "eye", 0, "Eye Side", "The face toward the eye"
    WORLD = "world", 1, "World Side", "The face away from the eye"


def catalogue_items() -> list[EnumItem]:
    """The media of the catalogue as a list for an enum property.

    Returns:
        One item a medium. The stored number comes from the name, so that it stays the same
        wherever the catalogue grows.
    """
    return [
        (name, name, f"Index after: {medium.source}", zlib.crc32(name.encode()) & 0x7FFFFFFF)
        for name, medium in CATALOGUE.items()
    ]
