# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Effects in plain words, for panels and tooltips."""

from collections.abc import Mapping

from ...model.effects.names import Effect

_LEAST_SHOWN = 1e-4

LABELS: Mapping[Effect, tuple[str, str]] = {
    Effect.DISPERSION: ("Dispersion", "Light of different wavelengths takes different ways"),
    Effect.BOUNCES: ("Many Surfaces", "Paths that pass many surfaces"),
    Effect.PUPIL: ("Pupil", "Blur by the size of the eye's pupil"),
    Effect.ORDERS: ("Diffraction Orders", "More than one diffraction order"),
    Effect.REFLECTED_ORDERS: ("Reflected Orders", "Diffraction orders that go back"),
    Effect.POSITION: (
        "Change over the Hologram",
        "The grating changes from place to place",
    ),
    Effect.ANGLE: ("Efficiency by Angle", "Efficiency depends on the direction of the light"),
    Effect.WAVELENGTH: ("Efficiency by Wavelength", "Efficiency depends on the wavelength"),
    Effect.LEVELS: ("Relief Levels", "A relief in steps in place of a continuous one"),
    Effect.MAKING_ERRORS: ("Errors of Making", "Errors in the making of a relief"),
    Effect.VOLUME: ("Volume Selectivity", "A thick hologram answers to few angles and wavelengths"),
    Effect.TABLE: ("Table", "Look-up of the efficiency in a table"),
    Effect.TABLE_WAVELENGTH: ("Table: Wavelength", "The table's dimension along the wavelength"),
    Effect.TABLE_ANGLE_X: ("Table: Angle Across", "The table's dimension across the grating lines"),
    Effect.TABLE_ANGLE_Y: ("Table: Angle Along", "The table's dimension along the grating lines"),
    Effect.TABLE_PLACE: ("Table: Place", "The table's dimension along the place on the hologram"),
    Effect.FRESNEL: ("Fresnel Reflection", "Reflection at bare faces of glass or plastic"),
    Effect.TOTAL_REFLECTION: ("Total Reflection", "Total internal reflection at the hologram"),
    Effect.ABSORPTION: ("Absorption", "Light that is lost in the hologram"),
    Effect.HAZE: ("Haze", "Scattering around each order"),
    Effect.EXTENDED_SOURCE: ("Extended Source", "A recording source that is no point"),
}
"""Label and one sentence for each effect."""


def error_words(error: float) -> str:
    """Write a relative error for people.

    Args:
        error: Relative error of luminance, at least 0.

    Returns:
        Per cent.
    """
    if error <= 0.0:
        return "0 %"
    if error < _LEAST_SHOWN:
        return "below 0.01 %"
    if error > 1.0:
        return "over 100 %"
    return f"{error * 100.0:.2g} %" if error < 0.995 else "100 %"
