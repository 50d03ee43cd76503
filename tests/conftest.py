# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures for all tests."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

pytest_plugins = ("tests.installed",)

SEED = 20260101


@pytest.fixture(scope="session", autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Maps that tests make are kept away from those of the user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("HOE_CACHE_DIR", str(tmp_path_factory.mktemp("maps")))
        yield


@pytest.fixture
def rng() -> np.random.Generator:
    """Random numbers that are the same in every run and in every test."""
    return np.random.default_rng(SEED)


@pytest.fixture
def clean_scene() -> Any:
    """Blender's scene after a start with factory settings and an empty file.

    The import stands here, so that tests without Blender stay quick; it is no importorskip,
    since a machine where Blender does not load has to fail.
    """
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    return bpy.context.scene
