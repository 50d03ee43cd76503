# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What a report of `accuracy` says of times and of values that the reference limits."""

from typing import Any
from unittest.mock import MagicMock

import pytest

from hoe_addon.cli import accuracy_page, accuracy_plot, accuracy_report, accuracy_table

SPENT = {"total": 74.0, "reference": 40.0, "as_it_is": 20.0, "other_settings": 14.0}


def point(seconds: float, error: float, *limited: str) -> dict[str, Any]:
    return {
        "samples": 8,
        "seconds": seconds,
        "seconds_standard_error": 0.1 * seconds,
        "shown_error": error,
        "error": {"value": error, "standard_error": 0.1 * error},
        "limited": list(limited),
        "on_pareto_front": False,
    }


def run(value: str, each: float, *points: dict[str, Any], short: bool = False) -> dict[str, Any]:
    return {
        "number": 1,
        "knob": "combination",
        "value": value,
        "points": list(points),
        "processor_seconds_per_sample": each,
        "time_error": 0.1,
        "too_short_to_time": short,
        "all_samples": {"noise": 4.0, "display_noise": None},
    }


def test_what_is_too_short_to_time_is_not_compared() -> None:
    runs = [
        run("published", 0.02, point(2.0, 0.2)),
        run("sound", 0.01, point(1.0, 0.2)),
        run("short", 0.001, point(0.1, 0.1), short=True),
    ]
    accuracy_report._mark_front(runs)
    assert [each["points"][0]["on_pareto_front"] for each in runs] == [False, True, False]
    accuracy_report._compare(runs)
    published, sound, short = (each["all_samples"] for each in runs)
    assert (published["speed_up"], published["speed_up_standard_error"]) == (1.0, 0.0)
    assert sound["speed_up"] == pytest.approx(2.0)
    assert sound["speed_up_standard_error"] == pytest.approx(2.0 * 0.02**0.5, rel=1e-5)
    assert sound["display_speed_up"] is None
    assert "speed_up" not in short
    assert accuracy_table.time_of(runs[1], runs[1]["points"][0]) == "1 +-0.1"
    assert accuracy_table.time_of(runs[2], runs[2]["points"][0]) == "?0.1 +-0.01"


def test_limited_values_are_hollow_in_the_main_diagram(monkeypatch: pytest.MonkeyPatch) -> None:
    """With axes that only record what is drawn, so that no plots are needed."""
    top, key = MagicMock(), MagicMock()
    top.get_xlim.return_value = top.get_ylim.return_value = (0.01, 10.0)
    monkeypatch.setattr(accuracy_plot, "_label", MagicMock())
    found = run("", 0.01, point(1.0, 0.2), point(2.0, 0.1, "error"))
    for each in found["points"]:
        each["on_pareto_front"] = True
    report = {"runs": [found], "reference": {"own_errors": {"error": 0.05}}}
    accuracy_plot._draw_all(top, key, report)
    faces: dict[float, list[str]] = {}
    for call in top.plot.call_args_list:
        if call.args[0]:
            faces.setdefault(call.args[0][0], []).append(call.kwargs["markerfacecolor"])
    # A small mark of its curve, and over it a large one of the front.
    assert faces == {1.0: ["0.75", "gold"], 2.0: ["white", "white"]}
    text = key.text.call_args.args[2]
    assert "2 s, < 10.00%" in text
    assert "1 s, 20.00%" in text


@pytest.mark.parametrize("what", ["field of the display", "where displays and lamps are seen"])
def test_page_says_over_which_pixels_errors_are(what: str) -> None:
    report = {
        "title": "A device",
        "size": [32, 24],
        "field": {"what": what, "pixels": 217},
        "machine": {"threads": 2, "processor": "x", "system": "y"},
        "blender": "5",
        "hoe_addon": "1",
        "budget_seconds": 30.0,
        "spent_seconds": SPENT,
    }
    said = accuracy_page._summary(report)
    assert f"32 x 24 pixels; errors over 217 of them ({what}). 2 threads" in said
    assert "Time: 30 s asked, 74 s taken, set-up counted: reference 40 s, the device" in said


NOTHING = {"value": None, "standard_error": None}


def without_colour() -> dict[str, Any]:
    """Report of a device whose lit picture has no region with a colour, and no mean of one."""
    dark = {**point(1.0, 0.2), "worst_region": NOTHING, "colour": NOTHING, "display_error": None}
    own = {"error": 0.05, "display_error": 0.0, "worst_region": None, "colour": None}
    return {
        "device": "holographic_sight",
        "size": [48, 36],
        "budget_seconds": 20.0,
        "spent_seconds": SPENT,
        "field": {"what": "where displays and lamps are seen", "pixels": 7},
        "reference": {
            "samples": 64,
            "seconds": 9.0,
            "own_errors": own,
            "why_no_sharpness": "",
        },
        "runs": [
            {
                **run("", 0.01, dark),
                "sharpness": NOTHING,
                "all_samples": {"seconds_to_percent": None},
            }
        ],
        "not_measured": [],
    }


def test_what_is_not_known_is_a_dash_in_table_and_page() -> None:
    report = without_colour()
    lines = accuracy_table.table(report)
    assert "its own error: 5.00%, worst region -, u'v' -" in lines[1]
    setting = next(line for line in lines if line.startswith(" 1"))
    assert setting.split()[-4:] == ["-", "-", "-", "-"]
    assert any(line.startswith("20 s asked, 74 s taken") for line in lines)
    assert "u'v' -" in accuracy_page._about_reference(report["reference"])
    row = "".join(accuracy_page._table(report))
    assert row.count("<td>-</td>") == 2
    assert "<td>- +- -</td>" in row
    assert accuracy_report.written_csv({**report, "runs": []})
