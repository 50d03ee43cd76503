# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line, thin over the rest: ``python -m hoe_addon COMMAND ...``.

Every command is a module here with ``register(subparsers)`` and ``run(args) -> int``. What is
slow to import (numpy, bpy) is imported in ``run`` only. Mistakes of the user are `HoeError`: one
line on stderr and exit code 2; anything else is our own mistake and keeps its traceback.
"""

import re
import sys
from collections.abc import Sequence
from importlib import import_module

from ..core.errors import CancelledError, HoeError
from .interrupt import EXIT_INTERRUPTED
from .parser import Parser

COMMANDS = (
    "presets",
    "render",
    "eyebox",
    "trace",
    "efficiency",
    "check",
    "explain",
    "bake",
    "map",
    "bench",
    "accuracy",
    "demo",
)
"""Modules of the commands, in the order of ``--help``."""

EXIT_OK = 0
EXIT_ERROR = 2

_OPTION = re.compile(r"--[a-z][a-z-]*")
_NEGATIVE = re.compile(r"-[\d.].*")


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command.

    Args:
        argv: Arguments without the program's name; those of the process if None.

    Returns:
        Exit code: 0, 2 after an error of the user, 130 after Ctrl-C.
    """
    try:
        args = _parser().parse_args(_join_negative(sys.argv[1:] if argv is None else argv))
        return int(args.run(args))
    except SystemExit as exit_:  # argparse leaves this way after --help
        return int(exit_.code or EXIT_OK)
    except (KeyboardInterrupt, CancelledError):
        _complain("stopped by the user; no unfinished file is left")
        return EXIT_INTERRUPTED
    except HoeError as error:
        _complain(str(error))
        return EXIT_ERROR


def _parser() -> Parser:
    parser = Parser(
        prog="python -m hoe_addon", description="Holographic optical elements, ray by ray."
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    parser.set_defaults(run=_without_command)
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND")
    for name in COMMANDS:
        import_module(f".{name}", __name__).register(subparsers)
    return parser


def _without_command(args: object) -> int:
    if getattr(args, "version", False):
        from ..resources import version

        print(version())
        return EXIT_OK
    raise HoeError(f"COMMAND: is missing, must be one of {', '.join(COMMANDS)}")


def _join_negative(argv: Sequence[str]) -> list[str]:
    """Write ``--orders -3:3`` as ``--orders=-3:3``: argparse takes the value for an option.

    Changes of effects, such as ``--effects -haze``, begin with a minus too.
    """
    joined: list[str] = []
    for argument in argv:
        changes = bool(joined) and joined[-1] == "--effects"
        negative = _NEGATIVE.fullmatch(argument) and joined and _OPTION.fullmatch(joined[-1])
        if negative or changes:
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _complain(message: str) -> None:
    """Print one line, whatever the message holds."""
    print(f"hoe: error: {' '.join(message.split())}", file=sys.stderr)
