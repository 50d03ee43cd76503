# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the manifest declares, the wheels of the lock for every system and Python; the builder."""

import zipfile
from pathlib import Path
from types import ModuleType

import pytest

SYSTEMS = {
    "linux-x64": "manylinux_2_28_x86_64",
    "macos-arm64": "macosx_11_0_arm64",
    "macos-x64": "macosx_10_13_x86_64",
    "windows-arm64": "win_arm64",
    "windows-x64": "win_amd64",
}
"""What a wheel calls Blender's platforms."""

NO_SUCH_WHEEL = {("cp314", "macos-x64")}
"""There is no msgspec for it, nor a Blender: the last one for Intel Macs had Python 3.11."""


def wheels(builder: ModuleType) -> list[list[str]]:
    return [Path(name).stem.split("-") for name in builder.manifest()["wheels"]]


def test_wheels_have_the_versions_of_the_lock(builder: ModuleType) -> None:
    for name, version, *_ in wheels(builder):
        assert version == builder.locked(name)[0], name


@pytest.mark.parametrize("python", ["cp313", "cp314"])
@pytest.mark.parametrize("system", sorted(SYSTEMS))
def test_each_system_and_python_has_its_msgspec(
    builder: ModuleType, python: str, system: str
) -> None:
    found = [
        tags
        for name, _, *tags in wheels(builder)
        if name == "msgspec" and tags[0] == python and SYSTEMS[system] in tags[2].split(".")
    ]
    assert len(found) == ((python, system) not in NO_SUCH_WHEEL)


def test_platforms_are_those_of_the_wheels(builder: ModuleType) -> None:
    assert set(builder.manifest()["platforms"]) == set(SYSTEMS)


def test_numpy_comes_with_blender(builder: ModuleType) -> None:
    """A second numpy in one process would break others' add-ons."""
    names = {name for name, *_ in wheels(builder)}
    assert names == {"msgspec", "openimageio", "threadpoolctl"}


def test_another_version_than_the_locks_is_refused(builder: ModuleType, tmp_path: Path) -> None:
    with pytest.raises(builder.BuildError, match=r"the lock has \d"):
        builder.fetch(tmp_path / "msgspec-0.0.1-cp313-cp313-win_amd64.whl")


def test_a_damaged_wheel_is_no_wheel_of_the_lock(builder: ModuleType, tmp_path: Path) -> None:
    damaged = tmp_path / "threadpoolctl.whl"
    damaged.write_bytes(b"no wheel")
    assert not builder.is_locked(damaged, builder.locked("threadpoolctl")[1])


def test_a_package_that_is_not_locked_is_told(builder: ModuleType) -> None:
    with pytest.raises(builder.BuildError, match="has no nonsense"):
        builder.locked("nonsense")


def test_pip_is_told_of_the_other_system(builder: ModuleType) -> None:
    options = builder.wanted("a-1-cp314-cp314-manylinux2014_x86_64.manylinux_2_28_x86_64.whl")
    assert options == [
        *("--implementation", "cp", "--python-version", "314", "--abi", "cp314"),
        *("--platform", "manylinux2014_x86_64", "--platform", "manylinux_2_28_x86_64"),
    ]
    assert builder.wanted("a-1-py3-none-any.whl") == []


def test_order_and_times_of_files_do_not_show(builder: ModuleType, tmp_path: Path) -> None:
    files = [("b.py", (2020, 1, 1, 0, 0, 0), 0o600), ("a.py", (2021, 1, 1, 0, 0, 0), 0o755)]
    for number, order in enumerate((files, files[::-1])):
        with zipfile.ZipFile(tmp_path / f"{number}.zip", "w") as archive:
            for name, time, mode in order:
                entry = zipfile.ZipInfo(name, (time[0] + number, *time[1:]))
                entry.external_attr = (mode - number) << 16
                archive.writestr(entry, name)
        builder.make_equal(tmp_path / f"{number}.zip", tmp_path / f"equal {number}.zip")
    first, second = ((tmp_path / f"equal {number}.zip").read_bytes() for number in (0, 1))
    assert first == second
    assert (tmp_path / "0.zip").read_bytes() != (tmp_path / "1.zip").read_bytes()
    with zipfile.ZipFile(tmp_path / "equal 0.zip") as archive:
        assert [archive.read(name) for name in archive.namelist()] == [b"a.py", b"b.py"]
