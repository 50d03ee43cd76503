# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures for tests with the add-on registered in Blender."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

LENS = Path(__file__).parents[1] / "documents" / "lens.json"


@pytest.fixture
def lens() -> dict[str, Any]:
    """The document of the README: a point and a plane wave, a kinoform of 8 levels."""
    return json.loads(LENS.read_text(encoding="utf-8"))


@pytest.fixture
def registered(clean_scene: Any) -> Iterator[Any]:
    """The clean scene, with the add-on registered while the test runs."""
    import hoe_addon

    hoe_addon.register()
    yield clean_scene
    hoe_addon.unregister()


@pytest.fixture
def make_material(registered: Any) -> Callable[..., Any]:
    """Make a hologram's material from its document, with a wavelength of its own scene."""
    from hoe_addon.blender.shaders.materials import hologram_material
    from hoe_addon.blender.shaders.spectral import spectral_scene
    from hoe_addon.core.spectrum import line
    from hoe_addon.core.wavelength_sampling import by_significance
    from hoe_addon.model.document import hologram_from

    laser = [line(532e-9, 1e-9)]
    spectral = spectral_scene(by_significance(laser, floor=0.5), laser, 532.0)

    def make(document: dict[str, Any], *placing: Any) -> Any:
        return hologram_material(hologram_from(document), spectral, *placing)

    return make
