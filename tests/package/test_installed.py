# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The installed zip passes the tests that the repository passes."""

import os
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

FEWEST = 400
"""Tests of Blender and its window that are quick; fewer means that some were not found."""


@pytest.mark.slow
@pytest.mark.timeout(1800)
def test_the_installed_zip_passes_the_tests_of_blender(extension: Path, tmp_path: Path) -> None:
    report = tmp_path / "report.xml"
    folders = [name for name in ("tests/blender", "tests/ui") if (ROOT / name).is_dir()]
    done = subprocess.run(
        [
            *(sys.executable, "-m", "pytest", "-q", "-m", "not slow", "-p", "no:cacheprovider"),
            *(f"--junitxml={report}", *folders),
        ],
        cwd=ROOT,
        env={**os.environ, "HOE_TEST_INSTALLED": str(extension)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-2000:]
    suite = ElementTree.parse(report).getroot().find("testsuite")
    assert suite is not None
    assert int(suite.attrib["tests"]) - int(suite.attrib["skipped"]) >= FEWEST
