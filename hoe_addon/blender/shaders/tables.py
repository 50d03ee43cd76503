# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of efficiencies for the shader, made before anything in the scene is changed."""

from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ...core.gradient_map import Progress
from ...model.hologram import HologramSpec
from ...model.tables.cache import table_for
from ...shading.pattern import Followed
from ..paths import own_folder


def prepare_table(
    spec: HologramSpec,
    progress: Progress | None = None,
    *,
    followed: Followed | None = None,
    backward: bool = True,
    make: bool = True,
) -> EfficiencyTable | None:
    """Make sure of the table of a hologram.

    Args:
        spec: The hologram.
        progress: Told the share that is done while the table is made; what it raises, such as
            `CancelledError`, stops the work.
        followed: Waves of the recording that follow an object.
        backward: Whether the shader walks from the camera to the light; else along the light.
        make: Whether to make the table where it is not in the cache.

    Returns:
        The table from the cache, or made now, which may take minutes; None where the shader
        computes the shares by a formula.

    Raises:
        NotMadeError: It is not in the cache, and is not to be made.
        HoeError: The table can not be made, read or written, or would have to change with an
            object that moves.
    """
    if not spec.efficiency.uses_table:
        return None
    if followed:
        waves = " and ".join(sorted(followed))
        raise SpecError(
            f"efficiency: a table is made for fixed sources, but the {waves} wave follows an "
            "object; unbind it, or take a model that the shader computes by a formula"
        )
    return table_for(spec, progress, backward, own_folder(), make=make)
