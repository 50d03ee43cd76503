# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every shipped shader, compiled: it stands alone, and its sockets are documented."""

import re
from collections.abc import Iterator
from itertools import product
from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender.shaders import nodes
from hoe_addon.blender.shaders.osl import compiled
from hoe_addon.core.errors import ShaderCompileError
from hoe_addon.core.orders import Branch
from hoe_addon.model.document import hologram_from
from hoe_addon.resources import OSL_DIR
from hoe_addon.shading.hologram import (
    Frame,
    hologram_shader,
    hologram_sockets,
    one_order_shader,
    unit_efficiency_shader,
)
from hoe_addon.shading.interface import Parameter, ParameterKind, parameters
from hoe_addon.shading.source import ShaderSource, specialised
from hoe_addon.shading.wavelength import wavelength_shader

SHADERS = sorted(path.stem for path in OSL_DIR.glob("*.osl"))
ON_NODES = [name for name in SHADERS if name != "hoe_probe_camera"]
"""A camera's shader has no sockets: Cycles reads its outputs."""

UNIT_WORDS = {
    "_nm": "in nm",
    "_um2": "um^2",
    "_length": "scene units",
    "_luminance": "scene units",
}
"""What the help says of a number, by the end of its identifier."""

WAVES = {
    "plane": {"kind": "plane", "direction": [0.3, -0.4, 1.2], "index": 1.5},
    "point": {"kind": "point", "position_mm": [10, 5, -9], "beam": "converging", "index": 1.0},
}
MODELS = {
    "kinoform": {"model": "kinoform", "levels": 8, "design_wavelength_nm": 532, "relief": 1.5},
    "constant": {"model": "constant", "table": {"T": {"-1": 0.1, "0": 0.6}, "R": {"1": 0.05}}},
    "nothing": {"model": "constant", "table": {"T": {}, "R": {}}},
}
FLOAT32 = 2.0**-23
"""Relative: sockets are float32, and OSL prints its defaults with nine digits."""


def every_kind() -> Iterator[Any]:
    for first, second, model, folds in product(WAVES, WAVES, MODELS, (False, True)):
        document = {
            "schema": 1,
            "name": "lens",
            "surface": {"shape": "plane", "size_mm": [4, 4]},
            "media": {"back": "fused silica", "front": 1.0},
            "recording": {
                "wavelength_nm": 532,
                "object": WAVES[first],
                "reference": WAVES[second],
            },
            "efficiency": MODELS[model] | {"total_internal_reflection": folds},
            "orders": [-1, 0, 1],
        }
        yield pytest.param(document, id=f"{first}-{second}-{model}-{'folds' if folds else 'plain'}")


def inputs(source: ShaderSource) -> dict[str, Parameter]:
    return {p.name: p for p in parameters(compiled(source)) if not p.is_output}


@pytest.mark.parametrize("name", SHADERS)
def test_every_shader_compiles_by_itself(name: str) -> None:
    assert f"\nshader {name}" in compiled(specialised(name, {}))


@pytest.mark.parametrize("name", ON_NODES)
def test_every_socket_is_documented_with_its_unit(name: str) -> None:
    for parameter in inputs(specialised(name, {})).values():
        assert parameter.label, parameter.name
        assert re.match(r"[A-Z0-9]|x axis|y axis", parameter.help), parameter.name
        for ending, words in UNIT_WORDS.items():
            if parameter.name.endswith(ending):
                assert words in parameter.help, parameter.name


@pytest.mark.parametrize("name", ON_NODES)
def test_identifiers_and_labels_are_used_once(name: str) -> None:
    found = parameters(compiled(specialised(name, {})))
    for role in (False, True):
        for words in ("name", "label"):
            texts = [getattr(p, words) for p in found if p.is_output is role]
            assert len(set(texts)) == len(texts)


@pytest.mark.parametrize("name", ON_NODES)
def test_sockets_of_a_node_are_those_of_the_shader(clean_scene: bpy.types.Scene, name: str) -> None:
    """Identifiers, labels and defaults, read back from Blender."""
    source = specialised(name, {})
    tree = bpy.data.node_groups.new("tree", "ShaderNodeTree")
    node = nodes.add_script_node(tree, source, {})
    found = parameters(compiled(source))
    for is_output, sockets in ((False, node.inputs), (True, node.outputs)):
        wanted = [p for p in found if p.is_output is is_output]
        assert [s.identifier for s in sockets] == [p.name for p in wanted]
        assert [s.name for s in sockets] == [p.label for p in wanted]
    for parameter in inputs(source).values():
        value = nodes.input_socket(node, parameter.name).default_value
        read = np.atleast_1d(np.asarray(value, dtype=np.float64))[: len(parameter.default)]
        np.testing.assert_allclose(read, parameter.default, rtol=FLOAT32)


def test_known_defaults() -> None:
    """A few, as they stand in the .osl files."""
    hologram = inputs(specialised("hoe_hologram", {}))
    assert hologram["recording_wavelength_nm"].default == (532.0,)
    assert hologram["recording_wavelength_nm"].kind is ParameterKind.FLOAT
    assert hologram["frame_y"].default == (0.0, 1.0, 0.0)
    assert hologram["efficiency_t_p0"].default == (1.0,)
    assert inputs(specialised("hoe_dielectric", {}))["inside_a"].default == (2.25,)
    display = inputs(specialised("hoe_display", {}))
    assert (display["image"].kind, display["image"].default) == (ParameterKind.COLOR, (1, 1, 1))


@pytest.mark.parametrize("document", list(every_kind()))
def test_socket_values_fit_the_compiled_hologram(document: dict[str, Any]) -> None:
    """Every value has a socket of its type; only the wavelength comes from elsewhere."""
    spec = hologram_from(document)
    present = inputs(hologram_shader(spec))
    values = hologram_sockets(spec, Frame())
    assert values.keys() <= present.keys()
    assert present.keys() - values.keys() == {"wavelength_nm", "first_orders", "first_gain"}
    for name, value in values.items():
        parameter = present[name]
        assert np.size(value) == len(parameter.default), name
        assert isinstance(value, int) == (parameter.kind is ParameterKind.INT), name
    for role in ("object", "reference"):
        if document["recording"][role]["kind"] == "plane":
            assert np.linalg.norm(values[f"{role}_direction"]) == pytest.approx(1.0, abs=1e-15)
    for parameter in present.values():
        assert parameter.label
        assert parameter.help


@pytest.mark.parametrize("document", list(every_kind())[::6])
def test_probe_shaders_compile(document: dict[str, Any]) -> None:
    spec = hologram_from(document)
    for branch in (Branch(0), Branch(-1), Branch(1, reflected=True)):
        if document["efficiency"]["model"] == "kinoform" or branch.order == -1:
            assert compiled(one_order_shader(spec, branch))
        assert compiled(unit_efficiency_shader(spec, branch))


def test_same_text_is_compiled_once() -> None:
    first = compiled(wavelength_shader((400.0, 700.0)))
    hits = compiled.cache_info().hits
    assert compiled(wavelength_shader((400.0, 700.0))) is first
    assert compiled.cache_info().hits == hits + 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "shader hoe_wrong(output closure color result = 0)\n{\n"
            "    vector first = mistake;\n    int second = other;\n}\n",
            r"hoe_wrong\.osl:3: error: 'mistake' was not declared",
        ),
        ("// one\n// two\nshader hoe_wrong(\n{\n", r"hoe_wrong\.osl:4: error: Syntax error"),
        ('#include "nothing.h"\nshader hoe_wrong() {}\n', r"hoe_wrong\.osl.*nothing\.h"),
        ("", r"hoe_wrong\.osl: .*No shader function"),
    ],
    ids=["unknown name", "syntax", "include", "empty"],
)
def test_a_compile_error_names_file_and_line_of_the_first_mistake(text: str, message: str) -> None:
    with pytest.raises(ShaderCompileError, match=message) as caught:
        compiled(ShaderSource("hoe_wrong", text))
    said = str(caught.value)
    assert "\n" not in said
    assert "second" not in said
    assert "hoe_osl_" not in said  # the temporary folder, gone by now
    assert "other" not in said


def test_a_value_without_a_socket_is_our_own_mistake(clean_scene: bpy.types.Scene) -> None:
    tree = bpy.data.node_groups.new("tree", "ShaderNodeTree")
    with pytest.raises(KeyError, match="nothing"):
        nodes.add_script_node(tree, specialised("hoe_thin_lens", {}), {"nothing": 1.0})
