# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of the part of threadpoolctl that is used; the package has none of its own."""

from contextlib import AbstractContextManager
from typing import Any

class ThreadpoolController:
    def limit(self, *, limits: int, user_api: str) -> AbstractContextManager[object]: ...

def threadpool_info() -> list[dict[str, Any]]: ...
