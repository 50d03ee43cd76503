# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip: what is in it, and that Blender installs it, uses it and forgets it."""

import zipfile
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

Blender = Callable[[str], dict[str, Any]]

LARGEST_MB = 15.0
"""8 MB of it are OpenImageIO for Linux distributions; an extension of 30 MB takes a minute."""

MEMORY_MB = 5.0
"""Growth over 48 times. Measured: 2 MB at most within the first 25, then none within 75."""

ON = {"enabled": True, "material": True}
OFF = {"enabled": False, "material": False}


@pytest.mark.slow
def test_the_zip_holds_what_blender_runs_and_no_more(extension: Path) -> None:
    with zipfile.ZipFile(extension) as archive:
        names = archive.namelist()
    assert {name.partition("/")[0] for name in names} == {
        "LICENSE",
        "__init__.py",
        "blender_manifest.toml",
        "hoe_addon",
        "osl",
        "presets",
        "wheels",
    }
    kinds = {Path(name).suffix for name in names}
    assert kinds == {"", ".csv", ".h", ".json", ".osl", ".py", ".toml", ".whl"}
    assert not any("__pycache__" in name or "/." in name for name in names)
    assert {"hoe_addon/__init__.py", "presets/two_hologram_ar.json"} <= set(names)
    assert extension.stat().st_size / 1e6 < LARGEST_MB


@pytest.mark.slow
def test_every_source_and_data_file_is_in_the_zip(extension: Path, builder: ModuleType) -> None:
    shipped = {
        path.relative_to(builder.ROOT).as_posix()
        for folder in ("hoe_addon", "osl", "presets")
        for path in (builder.ROOT / folder).rglob("*")
        if path.is_file() and path.suffix not in {".pyc", ".oso"}
    }
    with zipfile.ZipFile(extension) as archive:
        assert shipped <= set(archive.namelist())


@pytest.mark.slow
def test_two_builds_are_equal(extension: Path, builder: ModuleType, tmp_path: Path) -> None:
    assert builder.build(tmp_path).read_bytes() == extension.read_bytes()


@pytest.mark.slow
def test_wheels_are_those_of_the_lock(extension: Path, builder: ModuleType, tmp_path: Path) -> None:
    with zipfile.ZipFile(extension) as archive:
        for wheel in builder.manifest()["wheels"]:
            copied = Path(archive.extract(wheel.removeprefix("./"), tmp_path))
            assert builder.is_locked(copied, builder.locked(copied.name.split("-")[0])[1])


@pytest.mark.slow
def test_the_life_of_the_extension(blender: Blender) -> None:
    told = blender("life")
    assert told["installed"] == told["enabled"] == ON
    assert told["disabled"] == OFF
    assert told["after disabling"] == told["before"]
    assert told["same when enabled again"]
    assert told["files"] == {"home": ON, "opened": ON, "wavelength_nm": 600.0}
    assert told["undo"] == {"undone": 600.0, "redone": 500.0, **ON}
    assert told["same after files and undo"]
    assert told["uninstalled"] == OFF
    assert told["after"] == told["before"]
    assert told["modules"] == []
    assert not told["folder"]


@pytest.mark.slow
def test_fifty_times_leak_nothing(blender: Blender) -> None:
    told = blender("cycles")
    second, half, last = told["2"], told["26"], told["50"]
    assert last["state"] == second["state"]
    assert last["classes"] == second["classes"]
    assert len(last["classes"]) > 20
    assert last["modules"] == second["modules"]
    # Python's caches of weak references fill up once; a leak is one object or more each time.
    assert last["objects"] - half["objects"] < 24
    assert last["resident_mb"] - second["resident_mb"] < MEMORY_MB


@pytest.mark.slow
def test_nothing_is_written_into_the_extension(blender: Blender) -> None:
    told = blender("writes")
    assert told["built"] == "DeviceScene"
    assert told["objects"] > 5
    assert told["same as in the zip"]
    assert told["map"].startswith("extensions/.user/user_default/hoe_addon/cache/")
    assert told["map"] in told["own files"]
    assert not told["elsewhere"]


@pytest.mark.slow
def test_blender_and_the_wheels_are_enough(blender: Blender) -> None:
    told = blender("libraries")
    assert told["modules"] > 300
    assert set(told["wheels"]) == {"msgspec", "threadpoolctl"}
    assert all(place.startswith("extensions/.local/") for place in told["wheels"].values())
    assert told["from the repository"] == []
