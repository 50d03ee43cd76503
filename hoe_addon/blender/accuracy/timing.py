# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a sample takes, told apart from what every render takes whatever its samples are.

A render of few samples is mostly the latter, so that two short renders say next to nothing of a
sample. What a render takes by itself is much the same for all settings of one device, and the many
renders of the reference tell it. It enters here as something known within bounds, beside the
renders themselves: short renders then rely on it, and long ones hardly need it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

KNOWN = 0.2
"""A time with a larger relative standard error is called too short to tell."""

_GUESSED_SCATTER, _GUESS_COUNTS = 0.1, 4.0
"""Relative scatter of the time of a render, and how many renders that guess is worth."""

_SPREAD = 0.3
"""Relative spread of what a render takes by itself, over the settings of one device."""


@dataclass(frozen=True)
class FixedTime:
    """What is known of the time that each render takes whatever its samples are.

    Attributes:
        seconds: That time for one pass.
        error: Standard error of it.
        scatter: Relative scatter of the time of a render.
    """

    seconds: float = 0.5
    error: float = 0.5
    scatter: float = _GUESSED_SCATTER


@dataclass(frozen=True)
class SampleTime:
    """Time of a sample.

    Attributes:
        seconds: Seconds per sample per pixel, above zero.
        error: Standard error of it.
        fixed: What is known of the rest of the time by now.
    """

    seconds: float
    error: float
    fixed: FixedTime

    @property
    def relative_error(self) -> float:
        """Standard error over the time."""
        return self.error / self.seconds

    @property
    def is_known(self) -> bool:
        """Whether the renders were long enough to tell."""
        return self.relative_error <= KNOWN

    def for_other_settings(self) -> FixedTime:
        """What is known of the fixed time where another setting of the same device is rendered."""
        fixed = self.fixed
        error = math.hypot(fixed.error, _SPREAD * fixed.seconds)
        return FixedTime(fixed.seconds, error, fixed.scatter)


def sample_time(
    work: Sequence[float], seconds: Sequence[float], fixed: FixedTime, passes: int = 1
) -> SampleTime:
    """Tell the time of a sample from that of some renders.

    Args:
        work: Samples per pixel of each render, at least one render.
        seconds: Time of each, above zero.
        fixed: What is known of their fixed time before.
        passes: Passes of each render; each has its fixed time.

    Returns:
        The straight line whose relative deviations, together with that of the fixed time, are
        least by their squares. The scatter is that of the renders, pooled with the known one.
    """
    spent = np.array(seconds, dtype=np.float64)
    rows = np.stack([passes / spent, np.array(work, dtype=np.float64) / spent], axis=1)
    start, each, _ = _line(rows, fixed, fixed.scatter)
    deviations = float(np.sum((rows @ np.array([start, each]) - 1.0) ** 2))
    counts = _GUESS_COUNTS + max(0, len(spent) - 2)
    scatter = math.sqrt((_GUESS_COUNTS * fixed.scatter**2 + deviations) / counts)
    start, each, covariance = _line(rows, fixed, scatter)
    start_error, error = np.sqrt(np.diag(covariance)).tolist()
    if start < 0.0:
        start, each = 0.0, float(np.sum(rows[:, 1]) / np.sum(rows[:, 1] ** 2))
    # What is below its own error might as well be zero; nothing may be divided by that.
    return SampleTime(max(each, error), error, FixedTime(start, start_error, scatter))


def _line(
    rows: NDArray[np.float64], fixed: FixedTime, scatter: float
) -> tuple[float, float, NDArray[np.float64]]:
    """Fixed time of a pass, time of a sample, and their covariance."""
    left = np.vstack([rows / scatter, [[1.0 / fixed.error, 0.0]]])
    right = np.append(np.full(len(rows), 1.0 / scatter), fixed.seconds / fixed.error)
    covariance: NDArray[np.float64] = np.linalg.inv(left.T @ left)
    start, each = (covariance @ left.T @ right).tolist()
    return start, each, covariance
