# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same element by every efficiency model that applies to it."""

from collections.abc import Callable
from dataclasses import dataclass

from msgspec import Struct

from ...core.errors import SpecError
from ..efficiency import EfficiencySpec, KinoformSpec, KogelnikSpec, RcwaSpec
from ..efficiency.rcwa_profile import VolumeProfile
from ..hologram import HologramSpec
from .counterparts import kinoform_of_rcwa, kogelnik_of_rcwa, rcwa_of_kinoform, rcwa_of_kogelnik
from .light import Lit


@dataclass(frozen=True)
class Candidate:
    """One model of the element.

    Attributes:
        name: Its word in documents.
        efficiency: Its fields; None where it does not apply.
        own: Whether it is the model of the document.
        words: What it is made of, or why it does not apply.
    """

    name: str
    efficiency: EfficiencySpec | None
    own: bool
    words: str


def name_of(efficiency: Struct) -> str:
    """The word for a model in documents."""
    return str(type(efficiency).__struct_config__.tag)


def candidates(spec: HologramSpec, lit: Lit) -> list[Candidate]:
    """List the models of an element.

    Args:
        spec: The hologram.
        lit: The light of the check, at its centre.

    Returns:
        Its own model first, then one that can be made of it, or the reason why none can.
    """
    own = spec.efficiency
    found = [Candidate(name_of(own), own, own=True, words="the model of the document")]
    if isinstance(own, KinoformSpec):
        found.append(_attempt("rcwa", "the same relief", lambda: rcwa_of_kinoform(spec, own, lit)))
    elif isinstance(own, KogelnikSpec):
        words = "the same volume grating between the same media"
        found.append(_attempt("rcwa", words, lambda: rcwa_of_kogelnik(own, lit)))
    elif isinstance(own, RcwaSpec) and isinstance(own.profile, VolumeProfile):
        words = "the same volume grating without its surroundings"
        found.append(_attempt("kogelnik", words, lambda: kogelnik_of_rcwa(own, lit)))
    elif isinstance(own, RcwaSpec):
        found.append(_attempt("kinoform", "the same relief", lambda: kinoform_of_rcwa(spec, own)))
    return found


def _attempt(name: str, words: str, make: Callable[[], EfficiencySpec]) -> Candidate:
    try:
        return Candidate(name, make(), own=False, words=words)
    except SpecError as error:
        return Candidate(name, None, own=False, words=str(error))
