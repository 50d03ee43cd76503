# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension's zip with Blender's own tool, the same bytes each time, and validate it.

The wheels that the manifest names come from the package index that pip is set up for, and must
have the hashes of the lock. Standard library only; run by the Python that has bpy.
"""

import argparse
import hashlib
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LOCK = ROOT / ".ci" / "requirements.lock"
MANIFEST = ROOT / "blender_manifest.toml"

EARLIEST = (1980, 1, 1, 0, 0, 0)
"""The earliest time that a zip can tell; each file gets it, so that two builds are equal."""


class BuildError(Exception):
    """The zip cannot be built; the message says why."""


def manifest() -> dict:
    """What the manifest says."""
    return tomllib.loads(MANIFEST.read_text(encoding="utf-8"))


def locked(package: str) -> tuple[str, set[str]]:
    """Find a package in the lock.

    Args:
        package: Its name, with underscores or with hyphens.

    Returns:
        The version, and the SHA-256 sums of its files.

    Raises:
        BuildError: The lock has no such package.
    """
    name = package.replace("_", "-").lower()
    found = re.search(
        rf"^{re.escape(name)}==(\S+)((?: \\\n +--hash=sha256:\w+)+)",
        LOCK.read_text(encoding="utf-8"),
        flags=re.MULTILINE,
    )
    if found is None:
        raise BuildError(f"{LOCK.name}: has no {name}; add it to pyproject.toml and run make lock")
    return found[1], set(re.findall(r"sha256:(\w+)", found[2]))


def wanted(wheel: str) -> list[str]:
    """Tell pip which wheel of a package it is: that for another system and Python too.

    Args:
        wheel: Name of the file, ``NAME-VERSION-PYTHON-ABI-SYSTEMS.whl``.

    Returns:
        Options of ``pip download``.
    """
    _, _, python, abi, systems = wheel.removesuffix(".whl").split("-")
    if systems == "any":
        return []
    options = ["--implementation", "cp", "--python-version", python.removeprefix("cp")]
    options += ["--abi", abi]
    for system in systems.split("."):
        options += ["--platform", system]
    return options


def is_locked(path: Path, hashes: set[str]) -> bool:
    """True for a file that is there and is one that the lock names."""
    return path.is_file() and hashlib.sha256(path.read_bytes()).hexdigest() in hashes


def fetch(path: Path) -> None:
    """Get a wheel, unless it is there already.

    Args:
        path: The file to be; its name says what it is.

    Raises:
        BuildError: The lock has another version, or the package index does not give the file.
    """
    name, version = path.name.split("-")[:2]
    in_lock, hashes = locked(name)
    if version != in_lock:
        raise BuildError(f"{path.name}: the lock has {in_lock}; name that one in {MANIFEST.name}")
    if is_locked(path, hashes):
        return
    with tempfile.TemporaryDirectory(prefix="hoe_") as folder:
        requirement = Path(folder) / "requirement.txt"
        sums = " ".join(f"--hash=sha256:{digest}" for digest in sorted(hashes))
        requirement.write_text(f"{name}=={version} {sums}\n", encoding="utf-8")
        pip = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
        pip += ["--no-deps", "--require-hashes", "--only-binary", ":all:", *wanted(path.name)]
        done = subprocess.run(
            [*pip, "--dest", folder, "--requirement", str(requirement)], check=False
        )
        got = Path(folder) / path.name
        if done.returncode or not got.is_file():
            raise BuildError(f"{path.name}: pip did not get it from the package index")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(got.read_bytes())


def blender_tool() -> Path:
    """Find Blender's tool for extensions, which is part of bpy and runs without it."""
    spec = find_spec("bpy")
    if spec is None or spec.origin is None:
        raise BuildError("bpy is missing; run make setup")
    tools = Path(spec.origin).parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
    return next(tools)


def run_tool(*arguments: str) -> None:
    """Run Blender's tool; it says itself what is wrong."""
    done = subprocess.run([sys.executable, str(blender_tool()), *arguments], check=False)
    if done.returncode:
        raise BuildError(f"Blender's tool refuses to {arguments[0]} the extension")


def make_equal(source: Path, target: Path) -> None:
    """Copy a zip with its files in order of name and without their times and owners.

    Args:
        source: The zip of Blender's tool, in the order and with the times of the disk.
        target: The zip to be.
    """
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w") as new:
        for entry in sorted(old.infolist(), key=lambda entry: entry.filename):
            plain = zipfile.ZipInfo(entry.filename, EARLIEST)
            plain.compress_type = entry.compress_type
            plain.external_attr = 0o100644 << 16
            plain.create_system = 3
            new.writestr(plain, old.read(entry), compresslevel=9)


def build(folder: Path) -> Path:
    """Build the zip and validate it.

    Args:
        folder: Where it goes.

    Returns:
        The zip.

    Raises:
        BuildError: A wheel cannot be had, or Blender's tool finds something wrong.
    """
    about = manifest()
    for wheel in about["wheels"]:
        fetch(ROOT / wheel)
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"{about['id']}-{about['version']}.zip"
    with tempfile.TemporaryDirectory(prefix="hoe_", dir=folder) as scratch:
        made, equal = Path(scratch) / "made.zip", Path(scratch) / target.name
        run_tool("build", f"--source-dir={ROOT}", f"--output-filepath={made}")
        make_equal(made, equal)
        run_tool("validate", str(equal))
        equal.replace(target)
    return target


def main() -> int:
    """Run from the command line.

    Returns:
        Exit code.
    """
    parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder for the zip")
    try:
        made = build(parser.parse_args().out)
    except BuildError as error:
        print(f"extension: {error}", file=sys.stderr)
        return 1
    print(f"extension: {made}, {made.stat().st_size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
