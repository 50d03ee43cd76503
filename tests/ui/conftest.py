# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures for tests of the window's parts, in Blender without a window."""

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
def plate(registered: Any) -> Any:
    """A plate of 40 x 40 mm, the active object; it has no material."""
    import bpy

    mesh = bpy.data.meshes.new("Plate")
    half = 20.0
    corners = [(-half, -half, 0.0), (half, -half, 0.0), (half, half, 0.0), (-half, half, 0.0)]
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    made = bpy.data.objects.new("Plate", mesh)
    registered.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    made.select_set(True)
    return made


@pytest.fixture
def make_hologram(plate: Any) -> Callable[..., Any]:
    """Put a hologram of a document on the plate; its shader is made too."""
    import bpy

    from hoe_addon.blender.props.sync import refresh, write_spec
    from hoe_addon.model.document import hologram_from

    def make(document: dict[str, Any], *, compiled: bool = False) -> Any:
        spec = hologram_from(document)
        material = bpy.data.materials.new(spec.name)
        write_spec(material, spec)
        plate.data.materials.clear()
        plate.data.materials.append(material)
        plate.active_material = material
        if compiled:
            refresh(material)
        return material

    return make
