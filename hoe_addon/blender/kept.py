# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of the user's that are other for a while, and then theirs again."""

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any


@contextlib.contextmanager
def kept(*groups: tuple[Any, Iterable[str]]) -> Iterator[None]:
    """Give settings back at the end, whatever became of them meanwhile.

    Args:
        groups: What has the settings, and their names, in the order in which they are given back.
    """
    values = [(owner, name, getattr(owner, name)) for owner, names in groups for name in names]
    try:
        yield
    finally:
        for owner, name, value in values:
            setattr(owner, name, value)


@contextlib.contextmanager
def changed(*groups: tuple[Any, Mapping[str, Any]]) -> Iterator[None]:
    """Change settings, and give them back at the end.

    Args:
        groups: What has the settings, and their values by name.
    """
    with kept(*groups):
        for owner, values in groups:
            for name, value in values.items():
                setattr(owner, name, value)
        yield
