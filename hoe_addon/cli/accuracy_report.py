# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of ``accuracy`` as plain data, as JSON and as CSV."""

import csv
import io
import json
import math
import os
import platform
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from ..core.picture_error import pareto_front

if TYPE_CHECKING:
    from ..blender.accuracy.results import Accuracy, Point, Run
    from ..core.picture_error import Estimate
    from ..model.device import DeviceSpec

type Report = dict[str, Any]

SCHEMA = 1
"""Version of the format of accuracy.json; it grows with every change that is no addition."""

PUBLISHED = ("combination", "published")
"""Knob and value of the run that others are compared with."""

_MEASURES = {
    "error": "relative RMS error of luminance over the field, noise and bias together",
    "display_error": "the same of the light of displays and lamps alone",
    "worst_region": "largest relative error of the mean luminance of one of 8 x 6 regions",
    "colour": "mean distance in u'v' of the mean colours of the regions",
    "sharpness": "modulation transfer of the display's picture at 5 cycles per degree",
    "seconds": "time to render without set-up, with the denoiser where it is used: processor time "
    "of a sample by the ratio of clock to processor in the renders of the reference",
    "time_error": "relative standard error of the time of a sample; above 0.2 it is too short to "
    "time: such pictures are not compared by their time",
    "seconds_to_percent": "time after which noise alone is 1 % of the mean luminance",
    "noise": "variance of the luminance of one sample, over the squared mean of the field",
    "speed_up": "processor time to equal noise by the published algorithm, over that of the run; "
    "its standard error is that of the times alone",
    "limited": "what is not three times larger than the reference's own error",
}
_PERCENT = 0.01
COLUMNS = ("error", "display_error", "worst_region", "colour")
"""Names of the errors of a picture."""


def report_of(spec: "DeviceSpec", found: "Accuracy", budget: float) -> Report:
    """Put all results together.

    Args:
        spec: The device that was measured, with the size of the pictures.
        found: What was found.
        budget: Seconds that were asked for.

    Returns:
        Plain data; nothing in it is infinite or not a number.
    """
    import bpy

    from ..model.device import LightGuideSpec
    from ..model.document import to_document
    from ..resources import version

    runs = [_run(number, run, found) for number, run in enumerate(found.runs, start=1)]
    _mark_front(runs)
    _compare(runs)
    return {
        "schema": SCHEMA,
        "device": spec.name,
        "title": spec.title,
        "size": list(spec.render.size),
        "seed": spec.render.seed,
        "budget_seconds": budget,
        "spent_seconds": {
            "total": _rounded(found.spent.total),
            "reference": _rounded(found.spent.reference),
            "as_it_is": _rounded(found.spent.first),
            "other_settings": _rounded(found.spent.others),
        },
        "stopped_by_user": found.stopped,
        "machine": _machine(),
        "clock_over_processor": _rounded(found.clock),
        "blender": bpy.app.version_string,
        "hoe_addon": version(),
        "settings": to_document(spec.render),
        "measures": _MEASURES,
        "field": {
            "what": "field of the display"
            if isinstance(spec, LightGuideSpec)
            else "where displays and lamps are seen",
            "pixels": int(found.judge.whole.field.sum()),
        },
        "reference": _reference(found),
        "runs": runs,
        "not_measured": [asdict(each) for each in found.not_measured],
    }


def _reference(found: "Accuracy") -> Report:
    own = found.judge.own_errors
    return {
        "samples": round(found.reference_samples),
        "seconds": _rounded(found.reference_seconds),
        "own_errors": {name: _rounded(each) for name, each in own.items()},
        "sharpness": _estimate(found.reference_sharpness),
        "why_no_sharpness": found.why_no_sharpness,
    }


def _run(number: int, run: "Run", found: "Accuracy") -> Report:
    own = found.judge.own_errors["error"]
    return {
        "number": number,
        "knob": run.variant.knob,
        "value": run.variant.value,
        "denoised": run.variant.denoised,
        "build_seconds": _rounded(run.build_seconds),
        "setup_seconds": _rounded(run.setup_seconds),
        "seconds_per_sample": _rounded(run.seconds_per_sample),
        "processor_seconds_per_sample": _rounded(run.processor_seconds_per_sample),
        "time_error": _rounded(run.time_error),
        "too_short_to_time": run.too_short_to_time,
        "denoiser_seconds": _rounded(run.finish_seconds),
        "all_samples": _lasting(run),
        "sharpness": _estimate(run.sharpness),
        "points": [_point(point, run, own) for point in run.points],
    }


def _lasting(run: "Run") -> Report | None:
    found = run.lasting
    if found is None:
        return None
    each = None if run.too_short_to_time else run.seconds_per_sample
    return {
        "error": _estimate(found.error),
        "worst_region": _estimate(found.worst_region),
        "colour": _estimate(found.colour),
        "noise": _rounded(found.noise),
        "display_noise": _rounded(found.display_noise),
        "seconds_to_percent": _to_percent(found.noise, each),
        "display_seconds_to_percent": _to_percent(found.display_noise, each),
    }


def _point(point: "Point", run: "Run", own: float) -> Report:
    """One picture; an error that the reference limits is shown as not below the reference's own."""
    limited = "error" in point.limited
    return {
        "samples": point.samples,
        "seconds": _rounded(point.seconds),
        "seconds_standard_error": _rounded(run.time_error * (point.seconds - run.finish_seconds)),
        "shown_error": _rounded(max(point.error.value, own) if limited else point.error.value),
        **{name: _estimate(getattr(point, name)) for name in COLUMNS},
        "limited": list(point.limited),
        "on_pareto_front": False,
    }


def _mark_front(runs: list[Report]) -> None:
    """Mark the pictures that no other beats in both time and error, where the time is known."""
    timed = [run for run in runs if not run["too_short_to_time"]] or runs
    points = [point for run in timed for point in run["points"]]
    front = pareto_front(
        [point["seconds"] for point in points], [point["shown_error"] for point in points]
    )
    for place in front:
        points[place]["on_pareto_front"] = True


def _compare(runs: list[Report]) -> None:
    """Say how much sooner than by the published algorithm noise is down, where that was run."""
    published = next((run for run in runs if (run["knob"], run["value"]) == PUBLISHED), None)
    if published is None or published["too_short_to_time"]:
        return
    for run in runs:
        if run["all_samples"] is None or run["too_short_to_time"]:
            continue
        for name in ("noise", "display_noise"):
            theirs, own = (
                (each["all_samples"][name] or 0.0) * each["processor_seconds_per_sample"]
                for each in (published, run)
            )
            ratio = theirs / own if own else None
            spread = math.hypot(published["time_error"], run["time_error"])
            both = None if ratio is None else (ratio, 0.0 if run is published else spread * ratio)
            for end, value in zip(("", "_standard_error"), both or (None, None), strict=True):
                run["all_samples"][f"{name.replace('noise', 'speed_up')}{end}"] = _rounded(value)


def written_json(report: Report) -> list[str]:
    """Text of accuracy.json, in pieces."""
    return [json.dumps(report, indent=2, allow_nan=False, ensure_ascii=False), "\n"]


def written_csv(report: Report) -> list[str]:
    """Text of accuracy.csv, one line a picture."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    estimates = [part for name in COLUMNS for part in (name, f"{name}_standard_error")]
    times = ("seconds", "seconds_standard_error")
    writer.writerow(
        ["run", "knob", "value", "samples", *times, *estimates, "limited", "on_pareto_front"]
    )
    for run in report["runs"]:
        for point in run["points"]:
            numbers: list[object] = []
            for name in COLUMNS:
                found = point[name] or {"value": "", "standard_error": ""}
                numbers += [found["value"], found["standard_error"]]
            start = [run["number"], run["knob"], run["value"], point["samples"]]
            start += [point[name] for name in times]
            limited = " ".join(point["limited"])
            writer.writerow([*start, *numbers, limited, int(point["on_pareto_front"])])
    return [text.getvalue()]


def _to_percent(noise: float | None, seconds_per_sample: float | None) -> float | None:
    if noise is None or seconds_per_sample is None:
        return None
    return _rounded(noise * seconds_per_sample / _PERCENT**2)


def _machine() -> Report:
    return {
        "system": platform.platform(),
        "processor": platform.processor() or platform.machine(),
        "threads": os.process_cpu_count(),
    }


def _estimate(found: "Estimate | None") -> Report | None:
    if found is None:
        return None
    return {"value": _rounded(found.value), "standard_error": _rounded(found.standard_error)}


def _rounded(value: float | None) -> float | None:
    """Six digits are more than is known; what is not finite is left out."""
    if value is None or not math.isfinite(value):
        return None
    return float(f"{value:.6g}")
