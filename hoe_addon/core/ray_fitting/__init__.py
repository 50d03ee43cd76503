# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays from a source through a chain of surfaces to given points: one file a step.

`system` says what the chain is, `chain` traces it with derivatives, `landing` measures by how
much rays miss a point, `newton` moves them onto it, `search` finds every ray that reaches a
point, `many` does so for a crowd of points, and `fit` says what became of each.
"""

from .fit import NoRayError, RayFit, check_reaches, fit_rays
from .many import FitStatus
from .system import OpticalSurface, OpticalSystem

__all__ = [
    "FitStatus",
    "NoRayError",
    "OpticalSurface",
    "OpticalSystem",
    "RayFit",
    "check_reaches",
    "fit_rays",
]
