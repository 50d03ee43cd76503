# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The extension's zip, built once for all tests, and a Blender that installs it."""

import importlib.util
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
SESSION = Path(__file__).with_name("blender_session.py")


@pytest.fixture(scope="session")
def builder() -> ModuleType:
    """The script that `make extension` runs."""
    spec = importlib.util.spec_from_file_location("extension", ROOT / ".ci" / "extension.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def extension(builder: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The zip; the first build fetches the wheels."""
    return builder.build(tmp_path_factory.mktemp("dist"))


@pytest.fixture
def blender(extension: Path, tmp_path: Path) -> Callable[[str], dict[str, Any]]:
    """Run a story of `blender_session` in a process with a Blender that was never used."""

    def tell(story: str) -> dict[str, Any]:
        done = subprocess.run(
            [sys.executable, str(SESSION), story, str(extension)],
            cwd=tmp_path,
            env={**os.environ, "BLENDER_USER_RESOURCES": str(tmp_path)},
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        # Blender prints the traceback of an add-on that fails, and goes on.
        assert "bl_ext.user_default.hoe_addon" not in done.stderr, done.stderr
        return json.loads(done.stdout.splitlines()[-1])

    return tell
