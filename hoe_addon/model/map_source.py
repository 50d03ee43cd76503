# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The terms of grad V that a shader takes from a map."""

from dataclasses import dataclass

from .characteristic import CharacteristicSpec
from .waves import WaveSpec

type MapTerm = tuple[int, WaveSpec | CharacteristicSpec]
"""+1 or -1, and the wave or the characteristic function whose gradient counts so."""


@dataclass(frozen=True)
class MapSource:
    """A sum of terms.

    Attributes:
        terms: The terms; without any, there is no map.
    """

    terms: tuple[MapTerm, ...] = ()
