# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""One thread for the linear algebra below numpy.

OpenBLAS shares even products of 42 x 42 matrices among threads, which wait for each other longer
than the product takes: stacks of such matrices are several times slower for it.
"""

from contextlib import AbstractContextManager
from functools import cache

from threadpoolctl import ThreadpoolController


def one_thread() -> AbstractContextManager[object]:
    """Keep the linear algebra to one thread inside the block."""
    return _libraries().limit(limits=1, user_api="blas")


@cache
def _libraries() -> ThreadpoolController:
    """Look for the loaded libraries once: that takes milliseconds."""
    return ThreadpoolController()
