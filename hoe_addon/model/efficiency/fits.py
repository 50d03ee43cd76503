# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether an efficiency model goes with the pattern and the surface of its element."""

from ..field_error import FieldError
from ..pattern import PatternSpec
from ..surface import SurfaceSpec
from .kogelnik import KogelnikSpec
from .specs import EfficiencySpec


def check_fits(efficiency: EfficiencySpec, pattern: PatternSpec, surface: SurfaceSpec) -> None:
    """Check a model against the element that has it.

    Args:
        efficiency: The model.
        pattern: What is recorded in the element.
        surface: The element's surface.

    Raises:
        FieldError: They do not go together; the path begins with ``efficiency``.
    """
    if not isinstance(efficiency, KogelnikSpec):
        return
    try:
        efficiency.check_on(pattern, surface)
    except FieldError as error:
        raise error.inside("efficiency") from error
