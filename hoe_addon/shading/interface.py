# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The sockets of a shader, read from its compiled text (.oso).

The compiler's own list of parameters is the one interface table: names, types, defaults, labels
and help stand in the .osl file only.
"""

import re
from dataclasses import dataclass
from enum import StrEnum


class ParameterKind(StrEnum):
    """OSL types that have a socket."""

    FLOAT = "float"
    INT = "int"
    VECTOR = "vector"
    COLOR = "color"
    CLOSURE = "closure color"


@dataclass(frozen=True)
class Parameter:
    """One parameter of a shader.

    Attributes:
        name: Identifier in the shader and of the socket.
        kind: OSL type.
        is_output: Whether the shader writes it.
        default: Default numbers; empty for a closure.
        label: Words for the socket.
        help: Words for the tooltip, with the unit.
    """

    name: str
    kind: ParameterKind
    is_output: bool
    default: tuple[float, ...]
    label: str
    help: str


_LINE = re.compile(
    r"^(?P<role>o?param)\t(?P<type>[a-z ]+?)(?P<array>\[\d*\])?\t(?P<name>\w+)\t?(?P<rest>.*)$"
)
_META = re.compile(r'%meta\{string,(label|help),"((?:[^"\\]|\\.)*)"\}')


def parameters(compiled: str) -> tuple[Parameter, ...]:
    """The parameters that become sockets, in the shader's order. Arrays keep their defaults.

    Args:
        compiled: Text of an .oso file.

    Returns:
        Every scalar, vector, colour and closure parameter.
    """
    found: list[Parameter] = []
    for line in compiled.splitlines():
        match = _LINE.match(line)
        if match is None or match["array"]:
            continue
        meta = dict(_META.findall(match["rest"]))
        numbers = match["rest"].split("\t")[0].split("%")[0].split()
        kind = ParameterKind(match["type"])
        found.append(
            Parameter(
                name=match["name"],
                kind=kind,
                is_output=match["role"] == "oparam",
                default=() if kind is ParameterKind.CLOSURE else tuple(map(float, numbers)),
                label=meta.get("label", match["name"].replace("_", " ").title()),
                help=meta.get("help", ""),
            )
        )
    return tuple(found)
