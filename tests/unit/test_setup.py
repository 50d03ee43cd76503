# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The set-up script, the lock and the manifest agree with each other."""

import importlib.util
import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

from hoe_addon import resources

ROOT = Path(__file__).resolve().parents[2]
LOCK = (ROOT / ".ci" / "requirements.lock").read_text()
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
MANIFEST = tomllib.loads((ROOT / "blender_manifest.toml").read_text())

SHELL_TOOLS = ("bash", "dirname", "cmp", "cat")


@pytest.fixture(scope="module")
def system_libraries() -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "system_libraries", ROOT / ".ci" / "system_libraries.py"
    )
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def bare_clone(tmp_path: Path) -> Path:
    """The files of the set-up, and a PATH folder without any Python."""
    (tmp_path / ".ci").mkdir()
    for name in ("setup.sh", "requirements.lock", "system_libraries.py"):
        shutil.copy(ROOT / ".ci" / name, tmp_path / ".ci" / name)
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in SHELL_TOOLS:
        found = shutil.which(name)
        assert found
        (tools / name).symlink_to(found)
    return tmp_path


def run_setup(clone: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", ".ci/setup.sh"],
        cwd=clone,
        env={"PATH": str(clone / "tools")},
        capture_output=True,
        text=True,
        check=False,
    )


def add_command(folder: Path, name: str, text: str) -> None:
    path = folder / name
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


def test_second_setup_does_nothing(bare_clone: Path) -> None:
    python = bare_clone / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    add_command(python.parent, "python", "exit 1")
    shutil.copy(bare_clone / ".ci" / "requirements.lock", bare_clone / ".venv")
    done = run_setup(bare_clone)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_setup_without_python_says_what_to_install(bare_clone: Path) -> None:
    done = run_setup(bare_clone)
    assert done.returncode == 1
    assert "Python 3.13 is needed" in done.stderr


def test_setup_passes_over_a_shim_that_does_not_run(bare_clone: Path) -> None:
    add_command(bare_clone / "tools", "python3.13", "exit 127")
    add_command(bare_clone / "tools", "python3", "echo 3.11")
    done = run_setup(bare_clone)
    assert done.returncode == 1
    assert "Python 3.13 is needed" in done.stderr


def test_changed_lock_means_a_new_setup(bare_clone: Path) -> None:
    python = bare_clone / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    add_command(python.parent, "python", "exit 1")
    (bare_clone / ".venv" / "requirements.lock").write_text("# older\n")
    assert run_setup(bare_clone).returncode == 1


def test_every_package_is_locked_by_hash() -> None:
    pins = re.findall(r"^([a-z0-9][\w.-]*)==\S+", LOCK, flags=re.MULTILINE)
    blocks = re.split(r"^(?=[a-z0-9][\w.-]*==)", LOCK, flags=re.MULTILINE)[1:]
    assert len(pins) == len(blocks)
    assert all("--hash=sha256:" in block for block in blocks)


def test_lock_names_no_host() -> None:
    assert "://" not in LOCK
    assert "--index-url" not in LOCK


def test_lock_holds_every_direct_dependency() -> None:
    direct = PROJECT["project"]["dependencies"] + PROJECT["dependency-groups"]["dev"]
    names = {re.split(r"[=>\[]", entry)[0].replace(".", "-") for entry in direct}
    pins = set(re.findall(r"^([a-z0-9][\w.-]*)==", LOCK, flags=re.MULTILINE))
    assert names <= pins


def test_python_version_is_the_same_everywhere() -> None:
    wanted = (ROOT / ".python-version").read_text().strip()
    assert PROJECT["project"]["requires-python"] == f">={wanted}"
    assert f"readonly wanted={wanted}\n" in (ROOT / ".ci" / "setup.sh").read_text()
    assert PROJECT["tool"]["pyright"]["pythonVersion"] == wanted
    assert PROJECT["tool"]["ruff"]["target-version"] == "py" + wanted.replace(".", "")


def test_blender_of_the_tests_is_one_that_the_manifest_allows() -> None:
    pin = re.search(r"^bpy==([\d.]+)", LOCK, flags=re.MULTILINE)
    assert pin
    pinned, least = (
        tuple(map(int, text.split("."))) for text in (pin[1], MANIFEST["blender_version_min"])
    )
    assert pinned >= least


def test_resources_answer_with_the_manifest() -> None:
    assert resources.version() == MANIFEST["version"]
    assert resources.MANIFEST == ROOT / "blender_manifest.toml"


def test_unknown_shader_is_refused() -> None:
    with pytest.raises(FileNotFoundError, match="no-such"):
        resources.osl_path("no-such.osl")


def test_import_error_names_the_library(system_libraries: ModuleType) -> None:
    message = "ImportError: libXi.so.6: cannot open shared object file: No such file or directory"
    assert system_libraries.missing_in_error(message) == {"libXi.so.6"}
    assert system_libraries.missing_in_error("ImportError: no module named bpy") == set()


def test_ldd_names_all_libraries(system_libraries: ModuleType) -> None:
    output = (
        "\tlibSM.so.6 => not found\n"
        "\tlibm.so.6 => /lib/libm.so.6 (0x0)\n"
        "\tlibGL.so.1 => not found\n"
    )
    assert system_libraries.missing_in_ldd(output) == {"libSM.so.6", "libGL.so.1"}


def test_ordinary_user_is_told_the_packages(
    system_libraries: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    with pytest.raises(SystemExit, match="apt-get install -y libgl1 libsm6"):
        system_libraries.install(["libgl1", "libsm6"])
