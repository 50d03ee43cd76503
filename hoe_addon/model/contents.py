# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hashes of documents that name files: what counts is what is in them."""

import hashlib
from pathlib import Path
from typing import cast


def with_contents(data: object) -> object:
    """Put the hash of what is in a file in the place of its name.

    Args:
        data: Plain data; fields called ``file`` name files.

    Returns:
        The same data with hashes.
    """
    if isinstance(data, dict):
        return {
            name: _file_digest(item) if name == "file" else with_contents(item)
            for name, item in cast("dict[str, object]", data).items()
        }
    if isinstance(data, list | tuple):
        return [with_contents(item) for item in cast("list[object]", data)]
    return data


def digest(data: bytes) -> str:
    """Return the SHA-256 of bytes, hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def _file_digest(name: object) -> object:
    return digest(Path(name).read_bytes()) if isinstance(name, str) and name else name
