# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures for all tests."""

from typing import Any

import numpy as np
import pytest

SEED = 20260101


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
