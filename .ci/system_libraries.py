# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prove that the binary packages load, and get the system libraries that they miss.

Blender's module links to X11 and OpenGL even when it opens no window, and a bare server has
neither. As root on Debian and its kin the missing packages are installed; elsewhere the command
to do so is printed. Standard library only; run by the interpreter whose packages are checked.
"""

import os
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

MODULES = ("bpy", "numpy", "OpenImageIO")

DEBIAN_PACKAGES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libICE.so.6": "libice6",
    "libSM.so.6": "libsm6",
    "libX11.so.6": "libx11-6",
    "libXext.so.6": "libxext6",
    "libXfixes.so.3": "libxfixes3",
    "libXi.so.6": "libxi6",
    "libXrender.so.1": "libxrender1",
    "libXt.so.6": "libxt6",
    "libXxf86vm.so.1": "libxxf86vm1",
    "libgomp.so.1": "libgomp1",
    "libstdc++.so.6": "libstdc++6",
    "libxkbcommon.so.0": "libxkbcommon0",
}
"""Debian package by soname. Blender 5.2 misses nine of them on a bare Debian 12."""

_MAX_ROUNDS = 10
"""Each round mends at least one library; without ldd it is exactly one."""


def import_error() -> str:
    """Last line of what importing the modules says in a fresh process; empty when all is well."""
    code = "import " + ", ".join(MODULES)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return ""
    lines = done.stderr.strip().splitlines()
    return lines[-1] if lines else f"exit code {done.returncode}"


def missing_in_error(message: str) -> set[str]:
    """Soname that an ImportError names, as a set of none or one."""
    return set(re.findall(r"(\S+\.so[.\d]*): cannot open shared object file", message))


def missing_in_ldd(output: str) -> set[str]:
    """Sonames that ldd could not find."""
    return set(re.findall(r"^\s*(\S+) => not found", output, flags=re.MULTILINE))


def missing_libraries(message: str) -> set[str]:
    """Sonames that stand in the way of the import.

    Args:
        message: The ImportError, which names only the first.

    Returns:
        That one, and all others that Blender's main library links to.
    """
    missing = missing_in_error(message)
    spec = find_spec("bpy")
    if missing and spec and spec.origin and shutil.which("ldd"):
        main_library = Path(spec.origin).parent.glob("__init__*.so")
        for path in main_library:
            done = subprocess.run(["ldd", str(path)], capture_output=True, text=True, check=False)
            missing |= missing_in_ldd(done.stdout)
    return missing


def apt_command(packages: list[str]) -> list[str]:
    """The command that installs the packages, waiting for another apt-get to finish."""
    options = ["-o", "DPkg::Lock::Timeout=300", "--no-install-recommends"]
    return ["apt-get", "install", "-y", *options, *packages]


def install(packages: list[str]) -> None:
    """Install Debian packages, or tell how and stop.

    Raises:
        SystemExit: Not root, or not a Debian, or apt-get failed.
    """
    if os.geteuid() != 0 or not shutil.which("apt-get"):
        raise SystemExit(
            "setup: Blender's module needs system libraries. Install them and call again:\n"
            f"  sudo apt-get update && sudo apt-get install -y {' '.join(packages)}"
        )
    print(f"setup: installing system libraries: {' '.join(packages)}", file=sys.stderr)
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    for command in (["apt-get", "update"], apt_command(packages)):
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"setup: {' '.join(command)} failed:\n{done.stderr.strip()}")


def main() -> None:
    """Try the import, mend what is missing, and try again.

    Raises:
        SystemExit: The modules cannot be made to load; the message says what to do.
    """
    tried: set[str] = set()
    for _ in range(_MAX_ROUNDS):
        message = import_error()
        if not message:
            return
        missing = missing_libraries(message)
        unknown = missing - DEBIAN_PACKAGES.keys()
        if not missing or unknown or missing <= tried:
            names = ", ".join(sorted(unknown or missing)) or "none named"
            raise SystemExit(f"setup: the packages do not load: {message}\n  libraries: {names}")
        install(sorted({DEBIAN_PACKAGES[name] for name in missing}))
        tried |= missing
    raise SystemExit(f"setup: the packages still do not load: {import_error()}")


if __name__ == "__main__":
    main()
