# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a device until what its document asks for is reached, and keep the results."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ...files import VIEW_FILES, writable_folder
from ...model.quality import QualitySpec
from ..build.device import DeviceScene
from . import convergence, view
from .reached import END_WORDS, Reached
from .render import Progress
from .rounds import render_in_rounds


@dataclass(frozen=True)
class AskedView:
    """A picture that is kept.

    Attributes:
        folder: Where its files are.
        metrics: What metrics.json holds.
        reached: What was reached; None where only a number of samples was asked for.
        stopped: Whether the user ended it early.
    """

    folder: Path
    metrics: dict[str, Any]
    reached: Reached | None
    stopped: bool

    def words(self) -> str:
        """One line on what was reached."""
        if self.reached is None:
            samples, seconds = self.metrics["samples"], self.metrics["seconds"]
            line = f"{samples} samples per pixel in {seconds:.1f} s"
            return f"{line}, {END_WORDS['stopped']}" if self.stopped else line
        found, wanted = self.reached.picture, self.reached.request.error
        line = f"error {found.error:.2g} in {self.reached.seconds:.0f} s"
        if self.stopped or (wanted is not None and self.reached.end != "reached"):
            line += f", {END_WORDS[self.reached.end]}"
        return line


def keep_asked_view(
    device: DeviceScene,
    request: QualitySpec | None,
    folder: str | Path,
    *,
    clean: bool,
    started: float,
    progress: Progress,
    noted: Progress | None = None,
    stopped: convergence.Stopped | None,
) -> AskedView:
    """Render until a request is met, or the samples of the scene, and keep the picture.

    Args:
        device: The device in its scene.
        request: Error, time, or both; None for the samples.
        folder: Folder for the results, made where it is not there.
        clean: Whether view.png is denoised, where that helps.
        started: When the time began, by ``time.perf_counter``.
        progress: Told the share of the work that is done; may raise CancelledError.
        noted: Told the error so far, where an error or a time is asked for.
        stopped: Asked whether to end early, with the picture so far; None where nobody would ask.

    Returns:
        The picture that is kept.

    Raises:
        RenderError: Blender gave no usable picture.
        CancelledError: It was stopped before there was a picture.
        OutputError: A file cannot be written.
    """
    if request is None:
        if stopped is None:
            found, early = view.render_view(device, progress), False
        else:
            found, early = render_in_rounds(device, progress, stopped)
        place = writable_folder(folder, VIEW_FILES)
        metrics = view.save_view(device, found, place, clean=clean)
        return AskedView(place, metrics, None, early)
    found, reached = convergence.converge(
        device, request, progress, clean=clean, started=started, stopped=stopped, noted=noted
    )
    place = writable_folder(folder, VIEW_FILES)
    more = {"reached": reached.report()}
    metrics = view.save_view(device, found, place, clean=reached.denoising_helps, more=more)
    return AskedView(place, metrics, reached, reached.end == "stopped")
