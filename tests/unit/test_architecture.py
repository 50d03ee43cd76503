# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules of the layout, proved on the source text."""

import ast
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "hoe_addon"

LAYERS = ("core", "model", "shading", "blender", "ui", "cli")
"""Each layer may import itself and those before it; the command line needs no window."""

BLENDER_MODULES = {"bpy", "bmesh", "mathutils", "gpu", "bpy_extras"}
BELOW_BLENDER = ("core", "model", "shading", "resources")

SOURCES = sorted(
    path
    for pattern in ("*.py", "hoe_addon/**/*.py", "tests/**/*.py", "examples/**/*.py", ".ci/*.py")
    for path in ROOT.glob(pattern)
)
SHADERS = sorted(path for suffix in ("osl", "h") for path in ROOT.glob(f"osl/**/*.{suffix}"))
SCRIPTS = [
    *(ROOT / name for name in ("Makefile", ".ci/run", ".ci/setup.sh", "pyproject.toml")),
    *sorted(ROOT.glob(".ci/typings/*.pyi")),
]
PACKAGE_SOURCES = sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def parse(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), filename=str(path))


def resolve(path: Path, node: ast.ImportFrom) -> str:
    """Absolute name of the module that a "from" import names, relative ones from the repo root."""
    if node.level == 0:
        return node.module or ""
    package = path.relative_to(ROOT).parent.parts
    base = package[: len(package) - (node.level - 1)]
    return ".".join((*base, *filter(None, [node.module])))


def imported(path: Path) -> Iterator[str]:
    """Absolute names of all that a file imports, also inside functions and under a condition."""
    for node in ast.walk(parse(path)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = resolve(path, node)
            yield module
            yield from (f"{module}.{alias.name}" for alias in node.names)


def layer_of(module: str) -> str | None:
    """First part of a module's name below hoe_addon, None for a foreign one."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 and parts[0] == "hoe_addon" else None


def part_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def sources_of(*parts: str) -> list[Path]:
    return [path for path in PACKAGE_SOURCES if part_of(path) in parts]


@pytest.mark.parametrize("path", sources_of(*LAYERS), ids=name_of)
def test_layer_imports_only_those_before_it(path: Path) -> None:
    allowed = LAYERS[: LAYERS.index(part_of(path)) + 1]
    if part_of(path) == "cli":
        allowed = tuple(layer for layer in allowed if layer != "ui")
    upward = {
        name
        for name in imported(path)
        if (layer := layer_of(name)) in LAYERS and layer not in allowed
    }
    assert not upward


@pytest.mark.parametrize("path", sources_of(*BELOW_BLENDER), ids=name_of)
def test_no_blender_below_the_blender_layer(path: Path) -> None:
    assert not {name.split(".")[0] for name in imported(path)} & BLENDER_MODULES


@pytest.mark.parametrize("path", sources_of("core"), ids=name_of)
def test_core_needs_numpy_and_its_threads_only(path: Path) -> None:
    roots = {name.split(".")[0] for name in imported(path)}
    assert roots <= {"numpy", "threadpoolctl", "hoe_addon", *sys.stdlib_module_names}
    assert not {name for name in imported(path) if layer_of(name) == "resources"}


@pytest.mark.parametrize("path", PACKAGE_SOURCES, ids=name_of)
def test_package_imports_itself_relatively(path: Path) -> None:
    """Inside an extension the package has a longer name, so an absolute import fails there."""
    absolute = [
        node
        for node in ast.walk(parse(path))
        if (
            isinstance(node, ast.ImportFrom)
            and node.level == 0
            and (node.module or "").startswith("hoe_addon")
        )
        or (
            isinstance(node, ast.Import) and any(a.name.startswith("hoe_addon") for a in node.names)
        )
    ]
    assert not absolute


@pytest.mark.parametrize("path", PACKAGE_SOURCES, ids=name_of)
def test_no_name_of_an_extension_repository(path: Path) -> None:
    assert "bl_ext" not in path.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", SOURCES, ids=name_of)
def test_no_code_from_strings(path: Path) -> None:
    calls = {
        node.func.id
        for node in ast.walk(parse(path))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert not calls & {"eval", "exec"}


@pytest.mark.parametrize("path", [*SOURCES, *SHADERS, *SCRIPTS], ids=name_of)
def test_licence_header(path: Path) -> None:
    head = path.read_text(encoding="utf-8").splitlines()[:3]
    assert any(line.endswith("SPDX-FileCopyrightText: hoe_addon contributors") for line in head)
    assert any(line.endswith("SPDX-License-Identifier: GPL-3.0-or-later") for line in head)


def test_version_stands_in_the_manifest_only() -> None:
    version = tomllib.loads((ROOT / "blender_manifest.toml").read_text())["version"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert project["dynamic"] == ["version"]
    for path in PACKAGE_SOURCES:
        constants = {node.value for node in ast.walk(parse(path)) if isinstance(node, ast.Constant)}
        assert version not in constants, name_of(path)


def test_imports_are_light() -> None:
    """The root and the package import nothing, so Blender's start and pure tests stay quick."""
    code = (
        "import sys, hoe_addon, hoe_addon.resources; "
        "print('bpy' in sys.modules, 'numpy' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "False"]


def test_top_level_init_is_inert() -> None:
    body = parse(ROOT / "__init__.py").body
    assert all(isinstance(node, ast.Expr | ast.FunctionDef) for node in body)
