# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""``python -m hoe_addon``: hand over to the command line and exit with its code."""

import sys

from .cli import main
from .cli.interrupt import exit_on_interrupt

if __name__ == "__main__":
    exit_on_interrupt()
    sys.exit(main())
