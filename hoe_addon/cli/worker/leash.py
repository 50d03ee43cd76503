# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How a process hears from the window that started it, also while Blender's C code runs."""

import os
import shutil
import sys
import threading
import time
from pathlib import Path

from ...blender.job_files import STOP
from ...core.errors import CancelledError
from ...files import discard_unfinished

_OFTEN_S = 0.05
"""The file that asks for an end is not looked for more often."""

EXIT_LET_GO = 130


class Leash:
    """The wish to end now and keep what is done; and the end of the window itself."""

    def __init__(self, folder: Path) -> None:
        """Watch from now on.

        Args:
            folder: Folder of the job; it goes when the window has gone.
        """
        self._folder = folder
        self._looked = 0.0
        self._stopped = False
        threading.Thread(target=self._wait, daemon=True).start()

    def stopped(self) -> bool:
        """Whether the work is to end now."""
        now = time.monotonic()
        if not self._stopped and now - self._looked > _OFTEN_S:
            self._looked = now
            self._stopped = (self._folder / STOP).exists()
        return self._stopped

    def check(self) -> None:
        """Leave the work where it is, if it is to end now.

        Raises:
            CancelledError: It is.
        """
        if self.stopped():
            raise CancelledError("stopped by the user")

    def _wait(self) -> None:
        # Nothing is ever written: the end of the file is the end of the window, or its last word.
        while os.read(sys.__stdin__.fileno() if sys.__stdin__ else 0, 1):
            pass
        discard_unfinished()
        shutil.rmtree(self._folder, ignore_errors=True)
        os._exit(EXIT_LET_GO)
