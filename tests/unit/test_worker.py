# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the process of a job needs no Blender for: its kinds of work, and their files."""

from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from hoe_addon.blender.job_files import JobKind
from hoe_addon.cli import accuracy, accuracy_page, accuracy_plot, accuracy_report, worker


@pytest.mark.parametrize("kind", JobKind)
def test_each_kind_of_work_has_its_function(kind: JobKind) -> None:
    module = import_module(f"hoe_addon.cli.worker.{worker._MODULES[kind]}")
    assert callable(module.run)


@pytest.mark.parametrize("plot", [True, False])
def test_files_of_a_measurement_with_and_without_its_diagram(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, plot: bool
) -> None:
    """Blender's own Python has no matplotlib."""
    drawn: list[Path] = []
    report = {"device": "a device"}
    monkeypatch.setattr(accuracy_report, "report_of", lambda *_: report)
    monkeypatch.setattr(accuracy_report, "written_json", lambda _: ["json"])
    monkeypatch.setattr(accuracy_report, "written_csv", lambda _: ["csv"])
    monkeypatch.setattr(accuracy_page, "page", lambda *arguments: [str(arguments[2])])
    monkeypatch.setattr(accuracy_plot, "write_plot", lambda path, _: drawn.append(path))
    nothing: Any = None
    assert accuracy.write_accuracy(nothing, nothing, 5.0, tmp_path, plot=plot) == report
    diagram = tmp_path / "accuracy.png" if plot else None
    assert drawn == ([diagram] if plot else [])
    assert (tmp_path / "accuracy.html").read_text() == str(diagram)
    assert (tmp_path / "accuracy.json").read_text() == "json"
    assert accuracy_page._diagram(None) == []
