# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader text: shipped file, headers pasted in, definitions on top.

Cycles compiles an in-memory text from a temporary folder, where `#include "hoe_ray.h"` finds
nothing: so every text is one flat file.
"""

import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache

from .. import resources

_SHADER = re.compile(r"^shader ", re.MULTILINE)
_INCLUDE = re.compile(r'^#include "(hoe_[a-z_]+\.h)"\n', re.MULTILINE)


@dataclass(frozen=True)
class ShaderSource:
    """A complete OSL text.

    Attributes:
        name: Name of the shipped shader, such as `hoe_hologram`.
        text: The flat text, ready to compile.
    """

    name: str
    text: str

    @property
    def digest(self) -> str:
        """First 16 hexadecimal digits of the text's SHA-256: equal texts need one compilation."""
        return hashlib.sha256(self.text.encode()).hexdigest()[:16]


def specialised(name: str, definitions: Mapping[str, str], functions: str = "") -> ShaderSource:
    """A shipped shader with definitions on top. Same arguments, same bytes.

    Args:
        name: File name in `osl/` without its ending.
        definitions: Macro name (with its parameter list, if any) to replacement.
        functions: OSL functions; they are put before the shader, after all headers.

    Returns:
        The flat text.
    """
    head = "".join(f"#define {macro} {value}\n" for macro, value in definitions.items())
    body = _SHADER.sub(lambda start: functions + start.group(), _flat(name), count=1)
    return ShaderSource(name, f"// Made from {name}.osl by hoe_addon.\n{head}{body}")


def defining(source: ShaderSource, macro: str) -> ShaderSource:
    """The same text with one more macro defined on top.

    Args:
        source: A flat text.
        macro: Name of the macro; its value is 1.

    Returns:
        The flat text.
    """
    return ShaderSource(source.name, f"#define {macro} 1\n{source.text}")


def array(values: Iterable[float]) -> str:
    """An OSL array initialiser; nine significant digits carry a float32 unchanged."""
    return "{ " + ", ".join(f"{float(value):.9g}" for value in values) + " }"


@cache
def _flat(name: str) -> str:
    pasted: set[str] = set()

    def paste(match: re.Match[str]) -> str:
        header = match.group(1)
        if header in pasted:
            return ""
        pasted.add(header)
        return _INCLUDE.sub(paste, _read(header))

    return _INCLUDE.sub(paste, _read(f"{name}.osl"))


def _read(file_name: str) -> str:
    return resources.osl_path(file_name).read_text(encoding="utf-8")
