# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress bar of all long commands."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def progress_bar(label: str) -> Iterator[Callable[[float], None]]:
    """Show a bar on stderr, on a terminal only.

    Args:
        label: What is being done.

    Yields:
        The function to tell the finished share to, 0 to 1.
    """
    from tqdm import tqdm

    form = "{l_bar}{bar}| {elapsed} < {remaining}"
    with tqdm(total=1.0, desc=label, disable=None, bar_format=form, leave=False) as bar:

        def tell(done: float) -> None:
            bar.update(done - bar.n)

        yield tell
