# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of a hologram show beside its properties: a few numbers and a plot."""

from dataclasses import dataclass, replace

import bpy
import numpy as np

from ...blender.props.followed import carrier_of, read_followed_roles
from ...blender.props.sync import read_spec
from ...blender.shaders.tables import prepare_table
from ...core.arrays import FloatArray
from ...core.efficiency.table import EfficiencyTable
from ...core.errors import HoeError, NotMadeError
from ...core.orders import Branch
from ...core.ray_law import Status
from ...core.units import mm_to_m
from ...model.check import light_on, recorded_place_mm
from ...model.check.light import Lit
from ...model.convert import pattern_from
from ...model.efficiency import KinoformSpec, KogelnikSpec, RcwaSpec
from ...model.element import element_shape
from ...model.evaluate import centre_mm, fan
from ...model.hologram import HologramSpec
from ...model.medium import index_at
from . import previews
from .cache import Facts
from .checks import Checked, forget, last_check
from .curves import ANGLES_DEG, WAVELENGTHS_NM, Curves, curves_of
from .device import Line
from .plot import plot_pixels

_MOST_PEAKS = 2
_STEEPEST_DEG = 60.0
"""Peaks are looked for up to this angle; beyond it hardly any light goes."""
_TO_THE_EDGE = 0.4999
_NO_LIGHT = "No order gets light where this was worked out, so there is no plot"
_LEAST_LINES = 1e-6
"""Of those at the edge; fewer are none but for rounding."""


@dataclass(frozen=True)
class MaterialFacts:
    """All that is shown; texts are ready to be drawn.

    Attributes:
        problem: Why the hologram is not valid, or nothing.
        grating: Lines about what is recorded.
        place: Where that and the efficiencies hold, if not at the centre; else nothing.
        efficiency: Lines about how the light is shared.
        plot: Icon of the plot, 0 where there is none.
        without_plot: Why there is no plot, or nothing.
        check: What the last check of the model found, if the hologram is still as it was.
    """

    problem: str = ""
    grating: tuple[Line, ...] = ()
    place: str = ""
    efficiency: tuple[Line, ...] = ()
    plot: int = 0
    without_plot: str = ""
    check: Checked | None = None


def facts_of(material: bpy.types.Material) -> MaterialFacts:
    """Work out what is shown of a hologram.

    Args:
        material: The material.

    Returns:
        The facts; an invalid hologram has its problem.
    """
    if not material.hologram.enabled:
        return MaterialFacts()
    try:
        spec = read_spec(material)
        place_mm = recorded_place_mm(spec)
        grating = _grating(spec, place_mm)
    except HoeError as error:
        return MaterialFacts(problem=str(error))
    known = MaterialFacts(
        grating=grating,
        place=_place(spec, place_mm),
        efficiency=tuple(_relief(spec)),
        check=last_check(material.session_uid, spec),
    )
    try:
        curves = curves_of(spec, _table(spec))
    except NotMadeError:
        return replace(known, without_plot="The plot is there once the table is baked")
    except HoeError as error:
        return replace(known, without_plot=str(error))
    if not curves.ways:
        return replace(known, without_plot=_NO_LIGHT)
    return replace(
        known,
        efficiency=(*_peaks(curves), *known.efficiency, *_bragg(spec, curves)),
        plot=previews.show(material.session_uid, plot_pixels(curves)),
    )


def _table(spec: HologramSpec) -> EfficiencyTable | None:
    """The table of a model that takes too long to be evaluated here."""
    if isinstance(spec.efficiency, RcwaSpec):
        return prepare_table(spec, make=False)
    return None


def _place(spec: HologramSpec, place_mm: FloatArray) -> str:
    aside_mm = float(np.linalg.norm(place_mm - centre_mm(spec)))
    if not aside_mm:
        return ""
    return f"At {aside_mm:.3g} mm from the centre: nothing is recorded in the middle"


def _grating(spec: HologramSpec, place_mm: FloatArray) -> tuple[Line, ...]:
    recorded_nm = spec.pattern.wavelength_nm
    lit = light_on(spec, [recorded_nm], [0.0], [0.0], from_front=False, at_mm=place_mm)
    # Where nothing is recorded the frequency is NaN.
    here, finest = float(np.nan_to_num(lit.incidence.frequency[0])), _finest(spec)
    lines: list[Line] = []
    if here > _LEAST_LINES * max(1.0, finest):
        lines = [
            Line("Period", _period(here)),
            Line("Lines", f"{here / 1e3:.4g} per mm"),
            Line("Order +1", _first_order(spec, lit)),
        ]
    if finest > 1.01 * here:
        lines.append(Line("Finest Period", _period(finest)))
    return tuple(lines) or (Line("Grating", "none"),)


def _period(lines_per_metre: float) -> str:
    return f"{1e6 / lines_per_metre:.4g} \N{MICRO SIGN}m"


def _finest(spec: HologramSpec) -> float:
    """Most lines per metre in the middle of a side of the element; 0 where nothing is there."""
    width, height = (_TO_THE_EDGE * side for side in mm_to_m(np.asarray(spec.surface.size_mm)))
    shape, pattern = element_shape(spec), pattern_from(spec.pattern)
    x, y = np.array([-width, width, 0.0, 0.0]), np.array([0.0, 0.0, -height, height])
    points = np.stack((x, y, shape.sag(x, y)), axis=-1)
    points = points[np.isfinite(points).all(axis=-1)]
    if not len(points):
        return 0.0
    normal = shape.normal(points)
    gradient = np.broadcast_to(pattern.gradient(points), points.shape)
    along = gradient - np.sum(gradient * normal, axis=-1, keepdims=True) * normal
    lines = np.linalg.norm(along, axis=-1) / pattern.wavelength
    return float(np.max(np.nan_to_num(lines)))


def _first_order(spec: HologramSpec, lit: Lit) -> str:
    """Where order +1 goes, for light along the normal."""
    ways = (Branch(1), Branch(1, reflected=True))
    out = fan(spec, lit.point_mm, lit.direction[0], spec.pattern.wavelength_nm, ways)
    lit_ways = out.weights[:2] > 0.0
    chosen = 1 if lit_ways[1] and not lit_ways[0] else 0
    if out.status[chosen] != Status.OK:
        return "does not leave"
    cosine = abs(float(np.dot(out.directions[chosen], lit.normal)))
    angle = np.degrees(np.arccos(min(1.0, cosine)))
    return f"{angle:.4g}\N{DEGREE SIGN} off, {'reflected' if chosen else 'transmitted'}"


def _peaks(curves: Curves) -> list[Line]:
    """Where the strongest orders beside 0 get most, of both plots."""
    found: list[tuple[float, Line]] = []
    for place, (order, reflected) in enumerate(curves.ways):
        if order:
            name = f"Order {order:+d}{' back' if reflected else ''}"
            share, where = _peak(curves, place)
            found.append((share, Line(name, f"{100.0 * share:.3g} %{where}")))
    found.sort(key=lambda entry: -entry[0])
    return [line for _, line in found[:_MOST_PEAKS]]


def _peak(curves: Curves, place: int) -> tuple[float, str]:
    by_wavelength = curves.by_wavelength[:, place]
    by_angle = np.where(np.abs(ANGLES_DEG) <= _STEEPEST_DEG, curves.by_angle[:, place], 0.0)
    best, steepest = int(np.nanargmax(by_wavelength)), int(np.nanargmax(by_angle))
    share = float(by_wavelength[best])
    # The angle is told only where it gains something, the wavelength only where it matters.
    if by_angle[steepest] > 1.02 * share:
        return float(by_angle[steepest]), f" at {ANGLES_DEG[steepest]:.3g}\N{DEGREE SIGN}"
    if np.nanmin(by_wavelength) > 0.999 * share:
        return share, ""
    return share, f" at {WAVELENGTHS_NM[best]:.0f} nm"


def _relief(spec: HologramSpec) -> list[Line]:
    own = spec.efficiency
    if not isinstance(own, KinoformSpec):
        return []
    index = index_at(own, "relief", own.design_wavelength_nm)
    depth_um = own.made_depth_waves * own.design_wavelength_nm * 1e-3 / (index - 1.0)
    if own.levels:
        depth_um *= (own.levels - 1) / own.levels
    lines = [Line("Relief Depth", f"{depth_um:.4g} \N{MICRO SIGN}m")]
    if own.levels:
        step_nm = 1e3 * depth_um / (own.levels - 1)
        lines.append(Line("Step", f"{step_nm:.4g} nm"))
    return lines


def _bragg(spec: HologramSpec, curves: Curves) -> list[Line]:
    if not isinstance(spec.efficiency, KogelnikSpec | RcwaSpec):
        return []
    light = curves.light
    side = "front" if light.from_front else "back"
    return [Line("Meant for", f"{light.theta_deg:.4g}\N{DEGREE SIGN} from the {side}")]


def _places(material: bpy.types.Material) -> object:
    """Where the sources are that a hologram follows, and what carries it."""
    roles = read_followed_roles(material)
    if not roles:
        return None
    targets = [getattr(material.hologram.recording, role).target for role in roles]
    items = [item for item in (carrier_of(material), *targets) if item is not None]
    return [[value for row in item.matrix_world for value in row] for item in items]


FACTS = Facts("materials", facts_of, stamp=_places)
"""Facts of every hologram that was shown."""


def register() -> None:
    """Follow changes."""
    FACTS.register()


def unregister() -> None:
    """Undo ``register``, and forget all."""
    FACTS.unregister()
    forget()
