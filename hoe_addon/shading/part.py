# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What one part of a hologram (its pattern, its surface, its efficiency) adds to the shader."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from ..model.map_source import MapSource

type SocketValues = dict[str, float | int | tuple[float, float, float]]


@dataclass(frozen=True)
class ShaderPart:
    """Text and numbers of one part.

    Attributes:
        functions: OSL functions, put before the shader.
        parameters: Declarations of shader parameters, each with its trailing comma.
        code: Statements that run once per hit.
        sockets: Value by socket identifier of this part's parameters.
        map: What has to be baked, as terms of grad V that no code gives, if any.
    """

    functions: str = ""
    parameters: str = ""
    code: str = ""
    sockets: SocketValues = field(
        default_factory=dict[str, "float | int | tuple[float, float, float]"]
    )
    map: MapSource = field(default_factory=MapSource)


def parameter(kind: str, name: str, default: str, label: str, words: str) -> str:
    """One declaration of a shader parameter.

    Args:
        kind: OSL type.
        name: Identifier.
        default: OSL expression.
        label: Name for people.
        words: What it is, with its unit.

    Returns:
        The declaration, with its trailing comma.
    """
    return f'{kind} {name} = {default} [[ string label = "{label}", string help = "{words}" ]],'


def joined(parts: Iterable[ShaderPart]) -> ShaderPart:
    """Several parts as one, in order.

    Args:
        parts: The parts.

    Returns:
        Their texts one after the other, and all their sockets and terms of maps.
    """
    listed = list(parts)
    sockets: SocketValues = {}
    for part in listed:
        sockets |= part.sockets
    return ShaderPart(
        functions="".join(part.functions for part in listed),
        parameters=" ".join(part.parameters for part in listed if part.parameters),
        code=" ".join(part.code for part in listed if part.code),
        sockets=sockets,
        map=MapSource(tuple(term for part in listed for term in part.map.terms)),
    )
