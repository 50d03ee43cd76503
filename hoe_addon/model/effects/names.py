# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of the effects, and what a plan says of each."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from ..hologram import HologramSpec

WHOLE_SCENE = ""
"""Instead of the name of a hologram: the decision holds for the whole scene."""


class Effect(StrEnum):
    """A named part of the model, which a scene may need or not."""

    DISPERSION = "dispersion"
    """Light of different wavelengths takes different ways."""
    BOUNCES = "bounces"
    """Paths that pass many surfaces."""
    PUPIL = "pupil"
    """Blur by the size of the eye's pupil."""
    ORDERS = "orders"
    """More than one diffraction order."""
    REFLECTED_ORDERS = "reflected_orders"
    """Orders that go back."""
    POSITION = "position"
    """A grating vector, or an efficiency, that changes over the hologram."""
    ANGLE = "angle"
    """Efficiency that depends on the direction of the light."""
    WAVELENGTH = "wavelength"
    """Efficiency that depends on the wavelength."""
    LEVELS = "levels"
    """A relief in levels in place of a continuous one."""
    MAKING_ERRORS = "making_errors"
    """Errors of the making of a relief."""
    VOLUME = "volume"
    """Selectivity of a volume hologram."""
    TABLE = "table"
    """Look-up in a table."""
    TABLE_WAVELENGTH = "table_wavelength"
    """The dimension of a table along the wavelength."""
    TABLE_ANGLE_X = "table_angle_x"
    """The dimension of a table across the lines of the grating."""
    TABLE_ANGLE_Y = "table_angle_y"
    """The dimension of a table along the lines of the grating."""
    TABLE_PLACE = "table_place"
    """The dimension of a table along the place on the hologram."""
    FRESNEL = "fresnel"
    """Reflection at bare faces of a dielectric."""
    TOTAL_REFLECTION = "total_reflection"
    """Total reflection at a hologram."""
    ABSORPTION = "absorption"
    """Light that is lost in a hologram."""
    HAZE = "haze"
    """Scattering around each order."""
    EXTENDED_SOURCE = "extended_source"
    """A recording source that is no point."""


@dataclass(frozen=True)
class Decision:
    """What a plan says of one effect.

    Attributes:
        effect: The effect.
        hologram: Name of the hologram, or `WHOLE_SCENE`.
        on: Whether it is simulated.
        why: One sentence, with numbers and units.
        error_without: Predicted relative RMS error of the picture's luminance if it is left out;
            None where it can not be left out.
        cost: Predicted time with it over the time without it, for pictures of equal error.
        overridden: Whether the user has decided, and not the plan.
        part: Which order it is about, such as ``T+1``; empty where it is about the whole effect.
        present: Whether the document has such an effect at all; else it is off without a loss.
    """

    effect: Effect
    hologram: str
    on: bool
    why: str
    error_without: float | None = None
    cost: float = 1.0
    overridden: bool = False
    part: str = ""
    present: bool = True


@dataclass(frozen=True)
class EffectPlan:
    """The effects that a scene calls for.

    Attributes:
        decisions: One for each effect that applies to a hologram, or to the whole scene.
        promise: Relative RMS error of the picture's luminance that all that is left out together
            stays below, as predicted; what the user has left out is counted too.
        changes: Fields of the render settings and of the eye that the plan sets, by their path.
        holograms: The simpler holograms, by their name in the document.
    """

    decisions: tuple[Decision, ...]
    promise: float
    changes: Mapping[str, str | float] = field(default_factory=dict[str, str | float], repr=False)
    holograms: Mapping[str, HologramSpec] = field(
        default_factory=dict[str, HologramSpec], repr=False
    )

    def is_on(self, effect: Effect, hologram: str = WHOLE_SCENE) -> bool:
        """Tell whether an effect is simulated; one without a decision is."""
        return all(
            each.on
            for each in self.decisions
            if each.effect == effect and each.hologram == hologram
        )

    @property
    def left_out(self) -> tuple[Decision, ...]:
        """The decisions that leave an effect out; some are of effects that are not present."""
        return tuple(each for each in self.decisions if not each.on)
