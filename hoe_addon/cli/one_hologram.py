# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The hologram that a command looks at: a document of its own, or taken out of a device."""

import argparse
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, cast

from ..core.errors import SpecError

if TYPE_CHECKING:
    from ..model.hologram import HologramSpec

DOCUMENT_NAME = "PRESET|FILE.json"


def add_hologram_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the document, and the option that names a hologram in it.

    Args:
        parser: Parser of one command.
    """
    add = parser.add_argument
    add("document", metavar=DOCUMENT_NAME, help="a hologram, or a device or preset with holograms")
    add_hologram_option(parser, "default the only one")


def add_hologram_option(parser: argparse.ArgumentParser, default: str) -> None:
    """Add the option that names a hologram of a device.

    Args:
        parser: Parser of one command.
        default: What happens without it.
    """
    parser.add_argument(
        "--hologram",
        metavar="NAME",
        help="hologram of the device, with the surface and media that it has there: name of its "
        f'element or patch, "LENS front" or "LENS back" on a lens; {default}',
    )


def hologram_of(args: argparse.Namespace, assignments: Sequence[str] = ()) -> "HologramSpec":
    """Read the hologram that the arguments name.

    Args:
        args: Arguments as ``add_hologram_arguments`` adds them.
        assignments: Changes of the device, each ``path.to.field=value``.

    Returns:
        The valid hologram, in its own frame.

    Raises:
        SpecError: The document is not valid, or has no such hologram, or several without a name.
    """
    from ..model.document import load_device, load_hologram
    from ..model.effects.holograms import holograms_of
    from ..model.reading import naming

    if not names_device(args.document):
        with naming(args.document):
            _refuse_option("--hologram", args.hologram)
            _refuse_option("--set", next(iter(assignments), None))
        return load_hologram(args.document)
    device = load_device(args.document, assignments)
    with naming(args.document):
        return _chosen(holograms_of(device), args.hologram)


def names_device(document: str) -> bool:
    """Tell whether a document is a device, not a hologram.

    Args:
        document: Name of a preset, or path of a file.

    Raises:
        SpecError: It cannot be read.
    """
    from ..model.document import find_device
    from ..model.reading import naming, parse_json, read_text

    path = find_device(document)
    with naming(document):
        found = parse_json(read_text(path))
    fields = cast("dict[str, Any]", found) if isinstance(found, dict) else {}
    return "kind" in fields and "surface" not in fields


def _refuse_option(option: str, value: str | None) -> None:
    from ..model.field_error import FieldError

    if value is not None:
        raise FieldError(option, "must be left out for a hologram by itself", value)


def _chosen(found: Mapping[str, "HologramSpec"], name: str | None) -> "HologramSpec":
    from ..model.field_error import FieldError

    if not found:
        raise SpecError("--hologram: the device holds no hologram")
    if name is None and len(found) == 1:
        return next(iter(found.values()))
    rule = f"must be one of {', '.join(found)}"
    if name is None:
        raise SpecError(f"--hologram: is missing, {rule}")
    if name not in found:
        raise FieldError("--hologram", rule, name)
    return found[name]
