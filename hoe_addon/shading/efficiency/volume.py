# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume holograms in the shader: two-wave theory itself, with the numbers as sockets."""

from collections.abc import Iterable

from ... import resources
from ...core.orders import Branch
from ...model.efficiency import KogelnikSpec, PlaceFormula, Varying
from ...model.hologram import HologramSpec
from ...model.recording import RecordingSpec
from ..formula import value_function
from ..medium import medium_sockets
from ..part import SocketValues, parameter
from .part import EfficiencyPart

_PARAMETERS = (
    ("float", "volume_a", "2.25", "Emulsion A", "Constant of n^2 of the emulsion"),
    ("vector", "volume_b", "vector(0.0)", "Emulsion B", "Sellmeier B1 B2 B3"),
    ("vector", "volume_c_um2", "vector(0.0)", "Emulsion C", "Sellmeier C1 C2 C3, in um^2"),
    ("float", "volume_shrinkage", "0.0", "Shrinkage", "Share of the thickness that goes"),
    ("float", "volume_index_shift", "0.0", "Index Shift", "Added to the index by development"),
    ("float", "volume_absorption", "0.0", "Absorption", "Of the amplitude, per mm"),
)
_NORMAL = ("float", "volume_normal_lines", "0.0", "Normal Lines", "Along the normal, per um")
_PLACE = ("float", "volume_mm", "1.0", "Emulsion mm", "Of 1 scene unit, length in mm")


def volume_part(
    spec: HologramSpec, model: KogelnikSpec, branches: Iterable[Branch], units_per_mm: float
) -> EfficiencyPart:
    """The shader's part for a volume hologram.

    Args:
        spec: The hologram.
        model: Its efficiency model.
        branches: The ways out that are asked for.
        units_per_mm: Scene units in one mm.

    Returns:
        Its part.
    """
    ways = {way: place for place, way in enumerate(_exposed(spec, model))}
    return EfficiencyPart(
        shares={way: _share(way, ways, model) for way in branches if way in ways},
        functions=_functions(model),
        parameters=" ".join(parameter(*each) for each in _declared(model)),
        prepare=_prepare(spec, model),
        sockets=_sockets(model, units_per_mm),
    )


def _exposed(spec: HologramSpec, model: KogelnikSpec) -> list[Branch]:
    """Order 0, then of each exposure order and side, four of them, in order."""
    found = model.branches((0,), spec.pattern.wavelength_nm)
    of_exposures = model.branches((1, -1), spec.pattern.wavelength_nm)
    frequencies = list(dict.fromkeys(way.frequency for way in of_exposures))
    return [*found, *sorted(of_exposures, key=lambda way: frequencies.index(way.frequency))]


def _share(way: Branch, ways: dict[Branch, int], model: KogelnikSpec) -> str:
    exposure = -1 if way.order == 0 else (ways[way] - 1) // 4
    side = "HOE_REFLECTED" if way.reflected else "HOE_TRANSMITTED"
    count = 1 + len(model.exposures)
    folds = int(model.total_internal_reflection)
    return (
        "hoe_volume_share(light_x, light_y, light_normal, light_from_back, emulsion_gratings, "
        f"emulsion_real, emulsion_imag, {count}, emulsion_index, emulsion_phase, emulsion_loss, "
        f"index_back, index_front, {folds}, {exposure}, {way.order}, {side})"
    )


def _varying(model: KogelnikSpec) -> dict[str, Varying]:
    """The fields that may be formulas, by the identifier of their socket or function."""
    further = {
        f"volume_modulation_{place}": each.modulation
        for place, each in enumerate(model.exposures, start=1)
    }
    return {
        "volume_thickness_um": model.thickness_um,
        "volume_modulation_0": model.modulation,
        **further,
    }


def _functions(model: KogelnikSpec) -> str:
    headers = (resources.osl_path(name).read_text("utf-8") for name in ("hoe_math.h", _HEADER))
    formulas = (
        value_function(f"hoe_{name}", value.parsed())
        for name, value in _varying(model).items()
        if isinstance(value, PlaceFormula)
    )
    return "".join((*headers, *formulas))


_HEADER = "hoe_volume.h"


def _declared(model: KogelnikSpec) -> list[tuple[str, str, str, str, str]]:
    found = [*_PARAMETERS]
    for name, value in _varying(model).items():
        if not isinstance(value, PlaceFormula):
            words = "Of the exposed emulsion, in um" if name.endswith("um") else "Of the index"
            found.append(("float", name, "0.0", _label(name), words))
    for place in range(1 + len(model.exposures)):
        name = f"volume_absorbing_{place}"
        found.append(("float", name, "0.0", _label(name), "Amplitude of the absorption, per mm"))
        if place > 0:
            name = f"volume_wavelength_nm_{place}"
            found.append(("float", name, "532.0", _label(name), "Of this exposure, in nm"))
    if model.normal_period_um is not None:
        found.append(_NORMAL)
    if any(isinstance(value, PlaceFormula) for value in _varying(model).values()):
        found.append(_PLACE)
    return found


def _label(name: str) -> str:
    return name.removeprefix("volume_").replace("_", " ").title()


def _sockets(model: KogelnikSpec, units_per_mm: float) -> SocketValues:
    values: SocketValues = {
        **medium_sockets("volume", model.index),
        "volume_shrinkage": model.shrinkage,
        "volume_index_shift": model.index_shift,
        "volume_absorption": model.absorption_per_mm,
        "volume_absorbing_0": model.absorption_modulation_per_mm,
    }
    for name, value in _varying(model).items():
        if not isinstance(value, PlaceFormula):
            values[name] = value
        else:
            values["volume_mm"] = 1.0 / units_per_mm
    for place, each in enumerate(model.exposures, start=1):
        values[f"volume_absorbing_{place}"] = each.absorption_modulation_per_mm
        values[f"volume_wavelength_nm_{place}"] = each.wavelength_nm
    if model.normal_period_um is not None:
        values["volume_normal_lines"] = 1.0 / model.normal_period_um
    return values


def _prepare(spec: HologramSpec, model: KogelnikSpec) -> str:
    count = 1 + len(model.exposures)
    lines = [
        f"float emulsion_um = {_value(model, 'volume_thickness_um')} * (1.0 - volume_shrinkage);",
        "float emulsion_index = hoe_index(volume_a, volume_b, volume_c_um2, wavelength_nm)"
        " + volume_index_shift;",
        "float emulsion_waves = M_PI * 1000.0 * emulsion_um / wavelength_nm;",
        "float emulsion_phase = emulsion_waves / emulsion_index;",
        "float emulsion_loss = volume_absorption * 0.001 * emulsion_um;",
        f"vector emulsion_gratings[{count}]; float emulsion_real[{count}];"
        f" float emulsion_imag[{count}];",
        "int emulsion_recorded = 1;",
    ]
    for place in range(count):
        lines += _grating(spec, model, place)
    return " ".join(lines)


def _grating(spec: HologramSpec, model: KogelnikSpec, place: int) -> list[str]:
    """Give lambda Q and kappa d of one exposure."""
    wavelength = f"volume_wavelength_nm_{place}" if place else "recording_wavelength_nm"
    ratio = f"(wavelength_nm / {wavelength})"
    normal = "0.0"
    if isinstance(spec.pattern, RecordingSpec):
        normal = (
            f"{ratio} * hoe_volume_normal_step(object_wave, reference_wave, unit_normal, "
            f"hoe_index(volume_a, volume_b, volume_c_um2, {wavelength}), emulsion_recorded)"
        )
    elif model.normal_period_um is not None:
        normal = "0.001 * wavelength_nm * volume_normal_lines"
    modulation = _value(model, f"volume_modulation_{place}")
    return [
        f"emulsion_gratings[{place}] = "
        f"vector({ratio} * slope, 0.0, {normal} / (1.0 - volume_shrinkage));",
        f"emulsion_real[{place}] = emulsion_recorded * emulsion_waves * {modulation};",
        f"emulsion_imag[{place}] = "
        f"emulsion_recorded * 0.0005 * emulsion_um * volume_absorbing_{place};",
    ]


def _value(model: KogelnikSpec, name: str) -> str:
    """The expression of a number or of a formula of the place."""
    if not isinstance(_varying(model)[name], PlaceFormula):
        return name
    return f"hoe_{name}(position[0] * volume_mm, position[1] * volume_mm)"
