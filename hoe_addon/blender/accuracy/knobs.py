# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be turned to trade accuracy for time: each knob by itself, and combinations."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, cast

from msgspec import structs

from ...core.errors import SpecError
from ...model.device import DeviceSpec
from ...model.document import device_from, dump, to_document
from ...model.effects import Decision, plan_effects
from ...model.methods import METHODS
from .orders import named_documents, names_of, weakest_orders, without_orders

type Document = dict[str, Any]
type Change = Callable[[Document], None]
"""Changes a document of a device, every field written out, in place."""

_TABLED = ("kinoform", "kogelnik", "rcwa")
"""Models whose shares can be put into a table that is as fine as one likes."""
_LOOKED_UP = (*_TABLED, "table")
_TOLERANCES = (0.1, 0.01, 0.001)
_HARMONICS = (5, 11, 21)
_EVERYTHING = ("all",)


@dataclass(frozen=True)
class Setting:
    """One value of a knob.

    Attributes:
        value: What is set, for people.
        change: What it does to the document; None where it cannot be had.
        denoised: Whether the picture is denoised.
        why_not: Why it cannot be had.
    """

    value: str
    change: Change | None = None
    denoised: bool = False
    why_not: str = ""


@dataclass(frozen=True)
class Knob:
    """One thing that can be turned.

    Attributes:
        name: Its name.
        settings: Its values for a device; none where it does not apply.
        applies_to: What a device needs for it, for people.
    """

    name: str
    settings: Callable[[DeviceSpec], Sequence[Setting]]
    applies_to: str


@dataclass(frozen=True)
class Variant:
    """A device with one knob turned.

    Attributes:
        knob: Name of the knob.
        value: What it is set to.
        spec: The device.
        denoised: Whether its pictures are denoised.
    """

    knob: str
    value: str
    spec: DeviceSpec
    denoised: bool = False


@dataclass(frozen=True)
class NotMeasured:
    """A setting without a result.

    Attributes:
        knob: Name of the knob.
        value: What it would have been set to; empty for all values.
        why: Why there is no result.
    """

    knob: str
    value: str
    why: str


def reference_spec(spec: DeviceSpec) -> DeviceSpec:
    """The device with all effects on, all wavelengths, and the best sampling.

    Args:
        spec: The device.

    Returns:
        What everything is judged by.
    """
    render = structs.replace(
        spec.render,
        mode="spectral",
        wavelengths="spectrum",
        order_selection="guided",
        effects=_EVERYTHING,
    )
    return structs.replace(spec, render=render)


def variants(spec: DeviceSpec) -> tuple[list[Variant], list[NotMeasured]]:
    """All that is to be measured of a device.

    Args:
        spec: The device as it is asked for, from which one knob at a time is turned.

    Returns:
        The variants, first the device as it is, and the settings that do not apply.
    """
    found = [Variant("samples", "as it is", spec)]
    missing: list[NotMeasured] = []
    known = {(dump(spec), False): found[0]}
    for knob in KNOBS:
        settings = knob.settings(spec)
        if not settings:
            missing.append(NotMeasured(knob.name, "", f"needs {knob.applies_to}"))
        for setting in settings:
            try:
                changed = _changed(spec, setting)
            except SpecError as error:
                missing.append(NotMeasured(knob.name, setting.value, str(error)))
                continue
            variant = Variant(knob.name, setting.value, changed, setting.denoised)
            first = known.setdefault((dump(changed), setting.denoised), variant)
            if first is variant:
                found.append(variant)
            else:
                why = f"is the same as {first.knob}: {first.value}"
                missing.append(NotMeasured(knob.name, setting.value, why))
    return found, missing


def _changed(spec: DeviceSpec, setting: Setting) -> DeviceSpec:
    """The device with a knob turned.

    Raises:
        SpecError: It cannot be had, or is not valid.
    """
    if setting.change is None:
        raise SpecError(setting.why_not)
    document = to_document(spec)
    setting.change(document)
    return device_from(document)


def _rendered(**fields: object) -> Change:
    """Set fields of the render settings."""
    return lambda document: cast("Document", document["render"]).update(fields)


def _efficiency(models: Sequence[str], change: Change) -> Change:
    """Change the efficiency of every hologram that has one of some models."""

    def apply(document: Document) -> None:
        for _, hologram in named_documents(document):
            if hologram["efficiency"]["model"] in models:
                change(hologram["efficiency"])

    return apply


def _looked_up(**fields: object) -> Change:
    def change(efficiency: Document) -> None:
        efficiency["lookup"] = {**efficiency.get("lookup", {}), "form": "table", **fields}

    return change


def _has_model(spec: DeviceSpec, models: Sequence[str]) -> bool:
    found = named_documents(to_document(spec))
    return any(hologram["efficiency"]["model"] in models for _, hologram in found)


def _fixed(*settings: Setting) -> Callable[[DeviceSpec], Sequence[Setting]]:
    return lambda _spec: settings


def _resolutions(spec: DeviceSpec) -> Sequence[Setting]:
    if not _has_model(spec, _TABLED):
        return ()
    return [
        Setting(f"error up to {each:g}", _efficiency(_TABLED, _looked_up(tolerance=each)))
        for each in _TOLERANCES
    ]


def _interpolations(spec: DeviceSpec) -> Sequence[Setting]:
    if not _has_model(spec, _LOOKED_UP):
        return ()
    cubic = "the shader has linear interpolation and drawn nodes; finer tables do what orders would"
    return [
        Setting("drawn nodes (order 0)", _efficiency(_LOOKED_UP, _looked_up(choice="stochastic"))),
        Setting("linear (order 1)", _efficiency(_LOOKED_UP, _looked_up(choice="bilinear"))),
        Setting("cubic (order 3)", why_not=cubic),
    ]


def _harmonics(spec: DeviceSpec) -> Sequence[Setting]:
    if not _has_model(spec, ("rcwa",)):
        return ()
    return [
        Setting(f"{count} harmonics", _efficiency(("rcwa",), _harmonics_set(count)))
        for count in _HARMONICS
    ]


def _harmonics_set(count: int) -> Change:
    return lambda efficiency: efficiency.update(harmonics=count)


def _orders(spec: DeviceSpec) -> Sequence[Setting]:
    weak = weakest_orders(spec)
    return [
        Setting(f"without {names_of(weak[:count])}", without_orders(weak[:count]))
        for count in range(1, len(weak) + 1)
    ]


def _effects(spec: DeviceSpec) -> Sequence[Setting]:
    plan = plan_effects(spec)
    everything = "is the same as samples: as it is, whose plan leaves nothing out"
    settings = [
        Setting("all on", _rendered(effects=list(_EVERYTHING)))
        if plan.left_out
        else Setting("all on", why_not=everything)
    ]
    for effect in dict.fromkeys(each.effect for each in plan.decisions):
        own = [each for each in plan.decisions if each.effect == effect]
        running = [each for each in own if each.on]
        name = f"{'-' if running else '+'}{effect}"
        why_not = _why_not_turned(running, own)
        kept = [text for text in spec.render.effects if text[1:] != effect]
        change = None if why_not else _rendered(effects=[*kept, name])
        settings.append(Setting(name, change, why_not=why_not))
    return settings


def _why_not_turned(running: Sequence[Decision], own: Sequence[Decision]) -> str:
    """Why an effect cannot be turned on or off; empty where it can."""
    if running and all(each.error_without is None for each in running):
        return f"cannot be left out: {running[0].why}"
    if not running and not any(each.error_without for each in own):
        return f"changes nothing: {own[0].why}"
    return ""


_PUBLISHED = _rendered(**METHODS["published"])
_BEST = _rendered(**METHODS["guided"])
_QUICK = _rendered(**{**METHODS["guided"], "wavelengths": "lines"})

KNOBS = (
    Knob("denoiser", _fixed(Setting("on", _rendered(), denoised=True)), "nothing"),
    Knob(
        "combination",
        _fixed(
            Setting("published", _PUBLISHED),
            Setting("published, denoised", _PUBLISHED, denoised=True),
            Setting("guided: by spectrum, planned", _BEST),
            Setting("guided: by spectrum, planned, denoised", _BEST, denoised=True),
            Setting("guided: fixed lines, planned, denoised", _QUICK, denoised=True),
        ),
        "nothing",
    ),
    Knob(
        "order selection",
        _fixed(
            Setting("by significance", _rendered(order_selection="significance")),
            Setting("guided", _rendered(order_selection="guided")),
        ),
        "nothing",
    ),
    Knob(
        "wavelengths",
        _fixed(
            Setting("uniform", _rendered(wavelengths="uniform")),
            Setting("by spectrum", _rendered(wavelengths="spectrum")),
            Setting("fixed lines", _rendered(wavelengths="lines")),
        ),
        "nothing",
    ),
    Knob("orders kept", _orders, "a hologram with two orders or more"),
    Knob("effects", _effects, "a hologram"),
    Knob("table resolution", _resolutions, "a hologram whose shares depend on the light"),
    Knob("interpolation", _interpolations, "a hologram whose shares can stand in a table"),
    Knob("RCWA harmonics", _harmonics, "a hologram that is solved rigorously"),
)
"""All knobs, in the order in which they are measured while there is time."""
