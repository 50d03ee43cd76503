# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an efficiency model adds to the hologram shader.

The expression of a branch is evaluated where its direction is known. It may read, of the LIGHT that
takes this branch (in a backward walk that is the reverse of the leaving ray): ``light_x`` and
``light_y``, its n s along ``grating_x`` and ``grating_y``, and ``light_normal``, the size of its
part along the normal; ``light_from_back``; and of the hit
``wavelength_nm``, ``index_back``, ``index_front``, ``position``, ``grating_frequency`` (|tangential
grad V| / lambda_0 in 1/nm), and ``object_wave`` and ``reference_wave``, n s in the world.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from ...core.orders import Branch
from ..part import SocketValues


@dataclass(frozen=True)
class EfficiencyPart:
    """Text and numbers of an efficiency model.

    Attributes:
        shares: OSL expression of the share by branch; a branch that is missing gets no light.
        functions: OSL functions, put before the shader.
        parameters: Declarations of shader parameters, each with its trailing comma.
        prepare: Statements that run once per hit, before the first expression.
        sockets: Value by socket identifier.
        drawn: Takes the place of one ``X(steps, side, share)`` for each branch, where ``prepare``
            has drawn the one way out that is taken; empty where all branches are.
    """

    shares: Mapping[Branch, str]
    functions: str = ""
    parameters: str = ""
    prepare: str = ""
    sockets: SocketValues = field(
        default_factory=dict[str, "float | int | tuple[float, float, float]"]
    )
    drawn: str = ""
