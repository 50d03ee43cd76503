# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a program does first with a document: reads it, writes it again, makes its shaders."""

from collections.abc import Mapping
from typing import Any

from hoe_addon.model.document import device_from, dump, hologram_from, to_document
from hoe_addon.model.effects.holograms import holograms_of
from hoe_addon.model.effects.overrides import read_overrides
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.reading import naming, parse_json
from hoe_addon.shading.hologram import Frame, hologram_shader, hologram_sockets
from tests.strangers.texts import MARK


def read_document(text: str) -> object:
    """Read a hologram or a device.

    Args:
        text: JSON, or anything else.

    Returns:
        The valid spec.
    """
    with naming("a.json"):
        return use_document(parse_json(text))


def use_document(document: object) -> object:
    """Make a spec of plain data, and what follows from it.

    Args:
        document: Plain data.

    Returns:
        The valid spec.
    """
    if isinstance(document, dict) and "surface" in document:
        hologram = hologram_from(document)
        assert hologram_from(to_document(hologram)) == hologram
        dump(hologram).encode()
        _use({hologram.name: hologram})
        return hologram
    device = device_from(document)
    assert device_from(to_document(device)) == device
    dump(device).encode()
    holograms = holograms_of(device)
    read_overrides(device.render.effects, holograms)
    _use(holograms)
    return device


def _use(holograms: Mapping[str, HologramSpec]) -> None:
    for hologram in holograms.values():
        if not hologram.efficiency.uses_table:
            text: str = hologram_shader(hologram).text
            assert MARK not in text
            assert text.isascii()
            sockets: dict[str, Any] = hologram_sockets(hologram, Frame())
            assert MARK not in repr(sockets)
