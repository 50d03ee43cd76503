# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``presets``: the shipped presets, one line each."""

import argparse
from typing import Any


def register(subparsers: "argparse._SubParsersAction[Any]") -> None:
    """Add the command to the parser.

    Args:
        subparsers: Where the commands are.
    """
    text = "names of the shipped presets, one line each"
    parser = subparsers.add_parser("presets", help=text, description=text)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Print name and title of every preset.

    Args:
        args: No arguments of its own.

    Returns:
        Exit code.
    """
    del args
    from ..model.document import preset_titles

    titles = preset_titles()
    width = max(map(len, titles), default=0)
    for name, title in titles.items():
        print(f"{name:{width}}  {title}")
    return 0
