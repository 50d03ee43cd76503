# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps in materials: attached, packed, replaced and taken away without a trace."""

import copy
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.core.errors import CancelledError
from hoe_addon.model.document import hologram_from

BEHIND_A_LENS: dict[str, Any] = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [0, 0, -60]},
    "surfaces": [
        {
            "shape": "sphere",
            "vertex_mm": [0, 0, -20],
            "radius_mm": 60,
            "semi_diameter_mm": 40,
            "medium": "N-BK7",
        }
    ],
}


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path))
    return tmp_path


@pytest.fixture
def behind(lens: dict[str, Any]) -> dict[str, Any]:
    """The lens of the README, its point moved behind optics."""
    document = copy.deepcopy(lens)
    document["surface"]["size_mm"] = [8, 6]
    document["recording"]["object"] = copy.deepcopy(BEHIND_A_LENS)
    return document


@pytest.fixture
def material_of(clean_scene: Any) -> Any:
    from hoe_addon.blender.shaders.materials import hologram_material
    from hoe_addon.blender.shaders.spectral import spectral_scene
    from hoe_addon.core.spectrum import line
    from hoe_addon.core.wavelength_sampling import by_significance

    laser = [line(532e-9, 1e-9)]
    spectral = spectral_scene(by_significance(laser, floor=0.5), laser, 532.0)

    def make(document: dict[str, Any], *args: Any, **options: Any) -> Any:
        return hologram_material(hologram_from(document), spectral, *args, **options)

    return make


def images() -> list[Any]:
    import bpy

    return [image for image in bpy.data.images if "hoe_map" in image.keys()]  # noqa: SIM118


def test_a_map_is_attached_as_the_shader_needs_it(material_of, behind):
    material = material_of(behind)
    (image,) = images()
    texture = material.node_tree.nodes["Map"]
    assert texture.image == image
    assert (texture.interpolation, texture.extension) == ("Cubic", "EXTEND")
    assert image.alpha_mode == "CHANNEL_PACKED"
    assert image.colorspace_settings.name == "Non-Color"
    assert image.is_float and tuple(image.size) == (32, 32)
    feeds = {
        link.to_socket.identifier: (link.from_node.name, link.from_socket.name)
        for link in material.node_tree.links
    }
    assert feeds["map_gradient"] == ("Map", "Color")
    assert feeds["map_recorded"] == ("Map", "Alpha")
    assert feeds["Vector"][0] == "Map Coordinates"


def test_scene_units_reach_the_coordinates(material_of, behind):
    sockets = [
        {s.identifier: s for s in material.node_tree.nodes["Map Coordinates"].inputs}
        for material in (material_of(behind), material_of(behind, None, 0.1))
    ]
    wide, narrow = (list(each["map_extent"].default_value)[:2] for each in sockets)
    # 29 pitches across 8 mm, and 32 texels.
    assert wide == pytest.approx([8 * 32 / 29, 6 * 32 / 29])
    assert narrow == pytest.approx([value / 10 for value in wide])


def test_equal_patterns_share_an_image(material_of, behind):
    first, second = material_of(behind), material_of(behind)
    (image,) = images()
    assert image.users == 2
    assert first.node_tree.nodes["Map"].image == second.node_tree.nodes["Map"].image


@pytest.mark.parametrize("pack", [True, False])
def test_packed_or_in_its_file(material_of, behind, folder, pack):
    material_of(behind, pack=pack)
    (image,) = images()
    assert (image.packed_file is not None) == pack
    if not pack:
        assert Path(image.filepath).parent == folder


def test_a_packed_map_is_the_map_also_after_saving(material_of, behind, folder, tmp_path):
    import bpy
    import numpy as np

    from hoe_addon.model import map_cache

    material = material_of(behind)
    material.use_fake_user = True
    path = tmp_path / "scene.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    (file,) = folder.glob("map-*.exr")
    (image,) = images()
    kept = map_cache.read_map(file, image["hoe_map"])
    file.unlink()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    (image,) = images()
    pixels = np.empty(32 * 32 * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    np.testing.assert_array_equal(pixels.reshape(32, 32, 4), kept.texels.astype(np.float32))


def test_another_pattern_leaves_no_image_behind(material_of, behind):
    import bpy

    from hoe_addon.blender.shaders.maps import update_map

    material = material_of(behind)
    before = images()[0]["hoe_map"]
    texts = len(bpy.data.texts)
    moved = copy.deepcopy(behind)
    moved["recording"]["object"]["source"]["position_mm"][0] = 1
    update_map(material, hologram_from(moved))
    (image,) = images()
    assert image["hoe_map"] != before
    assert len(bpy.data.texts) == texts
    assert sum(node.bl_idname == "ShaderNodeTexImage" for node in material.node_tree.nodes) == 1


def test_another_surface_takes_another_text(material_of, behind):
    import bpy

    from hoe_addon.blender.shaders.maps import update_map

    material = material_of(behind)
    texts = {text.name for text in bpy.data.texts}
    curved = copy.deepcopy(behind)
    curved["surface"] = {"shape": "sphere", "size_mm": [8, 6], "radius_mm": 50}
    update_map(material, hologram_from(curved))
    names = {s.identifier for s in material.node_tree.nodes["Map Coordinates"].inputs}
    assert "surface_curvature" in names
    assert len({text.name for text in bpy.data.texts} - texts) == 1
    assert len(bpy.data.texts) == len(texts)


def test_a_formula_needs_no_map(material_of, behind, lens):
    import bpy

    from hoe_addon.blender.shaders.maps import update_map

    material = material_of(behind)
    update_map(material, hologram_from(lens))
    assert not images()
    assert not {"Map", "Map Coordinates"} & {node.name for node in material.node_tree.nodes}
    assert not [t for t in bpy.data.texts if t.name.startswith("hoe_map_coordinates")]
    material_of(lens)
    assert not images()


def test_stopped_work_leaves_the_material_as_it_was(material_of, behind):
    import bpy

    from hoe_addon.blender.shaders.maps import update_map

    material = material_of(behind)
    image = material.node_tree.nodes["Map"].image
    moved = copy.deepcopy(behind)
    moved["recording"]["object"]["source"]["position_mm"][0] = 2

    def stop(_share: float) -> None:
        raise CancelledError("stopped")

    with pytest.raises(CancelledError):
        update_map(material, hologram_from(moved), progress=stop)
    assert material.node_tree.nodes["Map"].image == image
    assert images() == [image]
    with pytest.raises(CancelledError):
        material_of(moved, progress=stop)
    assert [material] == [item for item in bpy.data.materials if item.name.startswith("lens")]


class TestLostFile:
    """An image that is not packed, and whose file is gone."""

    @pytest.fixture
    def seen(self, clean_scene: Any) -> Any:
        """Directions of rays that come down through an element with a material."""
        import bpy
        import numpy as np

        from hoe_addon.blender.build import meshes
        from hoe_addon.blender.pictures.render import COMBINED, render_layers
        from hoe_addon.blender.pictures.render_settings import set_up
        from hoe_addon.blender.shaders import nodes
        from hoe_addon.shading.probe import direction_world_shader

        set_up(clean_scene, samples=1, seed=0, spectral=False, max_bounces=8)
        clean_scene.render.resolution_x = clean_scene.render.resolution_y = 8
        camera = bpy.data.cameras.new("Camera")
        camera.type, camera.ortho_scale = "ORTHO", 2.0
        clean_scene.camera = bpy.data.objects.new("Camera", camera)
        clean_scene.camera.location = (0.0, 0.0, 30.0)
        clean_scene.collection.objects.link(clean_scene.camera)
        clean_scene.world = bpy.data.worlds.new("World")
        tree = nodes.new_tree(clean_scene.world)
        output = tree.nodes.new("ShaderNodeOutputWorld")
        node = nodes.add_script_node(tree, direction_world_shader(), {})
        tree.links.new(nodes.output_socket(node, "result"), output.inputs["Surface"])
        clean_scene.world.cycles.sampling_method = "NONE"
        plate = meshes.add(clean_scene.collection, meshes.rectangle("Plate", 6.0, 6.0))

        def directions(material: Any) -> Any:
            plate.data.materials.clear()
            plate.data.materials.append(material)
            picture = render_layers(clean_scene, (COMBINED,))[COMBINED].reshape(-1, 3)
            return picture / np.linalg.norm(picture, axis=1, keepdims=True)

        return directions

    @pytest.fixture
    def one_order(self, behind: dict[str, Any]) -> dict[str, Any]:
        efficiency = {"model": "constant", "table": {"T": {"1": 1.0}}}
        return behind | {"efficiency": efficiency, "orders": [1]}

    @pytest.mark.render
    def test_without_the_add_on_light_goes_straight_on(self, material_of, one_order, seen, folder):
        import bpy

        material = material_of(one_order, pack=False)
        before = seen(material)
        assert abs(before[:, :2]).max() > 1e-3  # diffracted
        for file in folder.iterdir():
            file.unlink()
        bpy.data.images[0].reload()
        after = seen(material)
        # Through glass and air order 0 is refracted, and does not turn at normal incidence.
        assert abs(after - (0.0, 0.0, -1.0)).max() < 1e-6

    @pytest.mark.render
    def test_with_the_add_on_the_map_is_made_anew(self, material_of, one_order, seen, folder):
        import bpy
        import numpy as np

        import hoe_addon

        hoe_addon.register()
        try:
            material = material_of(one_order, pack=False)
            before = seen(material)
            for file in folder.iterdir():
                file.unlink()
            bpy.data.images[0].reload()
            np.testing.assert_array_equal(seen(material), before)
            assert len(list(folder.iterdir())) == 1
        finally:
            hoe_addon.unregister()
