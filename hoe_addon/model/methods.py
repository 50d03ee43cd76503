# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names for what a picture is traced with, and for how good it is to be.

``published`` is the algorithm of the literature: wavelengths are equally likely, every hit draws an
order in proportion to its efficiency, and every effect is simulated. ``guided`` is what a render
does by itself: wavelengths by the light and the eye, passes by order, the effects that are needed.
"""

from collections.abc import Mapping

METHODS: Mapping[str, Mapping[str, object]] = {
    "guided": {"wavelengths": "spectrum", "order_selection": "guided", "effects": []},
    "published": {
        "wavelengths": "uniform",
        "order_selection": "significance",
        "effects": ["all"],
    },
}
"""Fields of the render settings by the name of the way."""

QUALITY_ERRORS: Mapping[str, float] = {
    "draft": 0.5,
    "preview": 0.25,
    "final": 0.1,
    "reference": 0.03,
}
"""Relative error of a pixel's luminance by the name of the quality: each costs four to eleven times
the time of the one before."""
