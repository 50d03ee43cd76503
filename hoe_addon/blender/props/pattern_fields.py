# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of characteristic functions and surfaces, as properties that are fields of texts."""

from typing import Any

from ..ids import Choice, Outline
from .detail_fields import choice, in_details, number, vector, word

_LENGTH: dict[str, Any] = {"soft_min": 0.1, "soft_max": 500.0, "step": 100, "precision": 3}
_LENGTHS = (1e-6, 1e6)
_WAVELENGTHS = (1.0, 1e6)


class Unit(Choice):
    """Units of a characteristic function."""

    MM = "mm", 0, "Millimetres", "Millimetres of optical path"
    WAVES = "waves", 1, "Waves", "Waves of the stated wavelength"
    RADIANS = "radians", 2, "Radians", "Radians of phase"


class ZernikeOrder(Choice):
    """Orders of Zernike polynomials."""

    NOLL = "noll", 0, "Noll", "Noll's order, each of rms 1"
    FRINGE = "fringe", 1, "Fringe", "The order of the University of Arizona, each 1 at its largest"


class Axis(Choice):
    """Axes of a cylinder."""

    X = "x", 0, "X", "Straight along x"
    Y = "y", 1, "Y", "Straight along y"


class FunctionFields:
    """Of a characteristic function."""

    wavelength_nm: number(
        in_details("wavelength_nm"),
        "Design Wavelength",
        "Vacuum wavelength that the function is stated for, in nm",
        532.0,
        _WAVELENGTHS,
        soft_min=380.0,
        soft_max=780.0,
        step=100,
        precision=2,
    )
    lines_per_mm: number(
        in_details("lines_per_mm"),
        "Lines",
        "Lines of the grating in one mm",
        600.0,
        (0.0, 1e6),
        soft_max=3000.0,
        step=100,
        precision=3,
    )
    azimuth_deg: number(
        in_details("azimuth_deg"),
        "Azimuth",
        "Direction of the grating, from x toward y, in degrees",
        0.0,
        soft_min=-180.0,
        soft_max=180.0,
        step=100,
        precision=3,
    )
    coefficients: vector(
        in_details("coefficients"),
        "Coefficients",
        "Factors of the 2nd, 4th, 6th and 8th power of the radius, in the unit; further ones stay",
        (0.0, 0.0, 0.0, 0.0),
        soft_min=-1000.0,
        soft_max=1000.0,
        step=10,
        precision=6,
    )
    normalization_mm: number(
        in_details("normalization_mm"),
        "Normalization",
        "Radius that the coefficients are stated for, in mm",
        1.0,
        _LENGTHS,
        **_LENGTH,
    )
    unit: choice(in_details("unit"), "Unit", "Unit of the function", Unit, Unit.RADIANS)
    zernike_order: choice(
        in_details("index"),
        "Order",
        "Order of the indices and normalisation of the polynomials",
        ZernikeOrder,
        ZernikeOrder.NOLL,
    )
    formula: word(
        in_details("formula"),
        "Formula",
        "V as a formula of x, y, r (in mm) and phi, with + - * / ^, sqrt, sin, cos, exp, ...",
    )
    file: word(
        in_details("file"),
        "File",
        "Values of V on a grid: an .exr with one channel, an .npy or a .csv",
        subtype="FILE_PATH",
    )
    grid_size_mm: vector(
        in_details("size_mm"),
        "Size",
        "Width and height of the grid on the element, in mm",
        (40.0, 40.0),
        _LENGTHS,
        **_LENGTH,
    )


class SurfaceFields:
    """Of a surface that is no plane."""

    curved_size_mm: vector(
        in_details("size_mm"),
        "Size",
        "Width and height of the element, in mm",
        (40.0, 40.0),
        _LENGTHS,
        **_LENGTH,
    )
    curved_outline: choice(
        in_details("outline"), "Outline", "Outline of the element", Outline, Outline.RECTANGLE
    )
    radius_mm: number(
        in_details("radius_mm"),
        "Radius",
        "Radius of curvature in mm; above 0 the centre lies on the side of the normal",
        100.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=100,
        precision=3,
    )
    conic: number(
        in_details("conic"),
        "Conic Constant",
        "0 is a sphere, -1 a paraboloid, below that a hyperboloid",
        0.0,
        soft_min=-3.0,
        soft_max=1.0,
        step=1,
        precision=4,
    )
    axis: choice(
        in_details("axis"), "Axis", "Axis along which the cylinder is straight", Axis, Axis.X
    )
    mesh_file: word(
        in_details("file"),
        "File",
        "Mesh of the surface: an .stl or .obj file in mm",
        subtype="FILE_PATH",
    )
