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
    CHARACTERISTIC = "characteristic", 1, "Characteristic Function", "A function V(x, y)"


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
