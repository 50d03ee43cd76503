# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What effects cost: predicted time with one over the time without it, at equal samples."""

from .names import Effect

COSTS = {
    Effect.ORDERS: 1.03,
    Effect.REFLECTED_ORDERS: 1.03,
    Effect.POSITION: 1.05,
    Effect.EXTENDED_SOURCE: 1.10,
    Effect.LEVELS: 1.02,
    Effect.MAKING_ERRORS: 1.05,
    Effect.ANGLE: 1.05,
    Effect.WAVELENGTH: 1.05,
    Effect.VOLUME: 1.30,
    Effect.TABLE: 1.30,
    Effect.TABLE_WAVELENGTH: 1.15,
    Effect.TABLE_ANGLE_X: 1.15,
    Effect.TABLE_ANGLE_Y: 1.15,
    Effect.TABLE_PLACE: 1.15,
    Effect.TOTAL_REFLECTION: 1.03,
    Effect.ABSORPTION: 1.02,
    Effect.HAZE: 1.10,
    Effect.PUPIL: 1.0,
}
"""Of the shader's work at a hit, which is a part of the whole; rough, from short runs."""

SPECTRAL_TIME = 1.2
"""A sample with motion blur and the filter before the eye, over one without them."""
