# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what is in the zip: HOE_TEST_INSTALLED=FILE.zip runs them on the installed extension.

The zip is installed and enabled for a Blender that was never used, and each import of
``hoe_addon`` gives the module of the extension, of which there is one only. The extension stays
importable while disabled; tests register it themselves.
"""

import atexit
import os
import shutil
import sys
import tempfile
from importlib import import_module
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

VARIABLE = "HOE_TEST_INSTALLED"
EXTENSION = "bl_ext.user_default.hoe_addon"
PACKAGE = "hoe_addon"
ROOT = Path(__file__).resolve().parents[1]


class InstalledPackage:
    """Finds the modules of the installed package under the names that tests have for them."""

    def __init__(self) -> None:
        self._own: dict[str, ModuleSpec | None] = {}

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> ModuleSpec | None:
        if name.partition(".")[0] != PACKAGE:
            return None
        return spec_from_loader(name, self)  # type: ignore[arg-type]

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        module = import_module(f"{EXTENSION}.{spec.name}")
        self._own[spec.name] = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        """It ran when it was made; only its spec must be its own again."""
        name = module.__name__.removeprefix(f"{EXTENSION}.")
        module.__spec__ = self._own[name]


def use(zip_path: Path) -> None:
    """Install a zip and let it stand for the package.

    Args:
        zip_path: The extension.
    """
    folder = tempfile.mkdtemp(prefix="hoe_")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    os.environ["BLENDER_USER_RESOURCES"] = folder
    sys.path[:] = [place for place in sys.path if Path(place).resolve() != ROOT]
    import bpy

    bpy.ops.extensions.package_install_files(
        filepath=str(zip_path), repo="user_default", enable_on_install=True
    )
    bpy.ops.preferences.addon_disable(module=EXTENSION)
    sys.meta_path.insert(0, InstalledPackage())  # type: ignore[arg-type]
    place = import_module(PACKAGE).__file__ or ""
    assert Path(place).is_relative_to(folder), place


def pytest_sessionfinish() -> None:
    """The package of the repository must not have been there at all."""
    if VARIABLE in os.environ:
        files = (getattr(module, "__file__", None) for module in sys.modules.values())
        assert not [file for file in files if file and Path(file).is_relative_to(ROOT / PACKAGE)]


if named := os.environ.get(VARIABLE):
    use(Path(named))
