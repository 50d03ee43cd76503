# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of ``accuracy`` in words: lines for the terminal, which the page shares."""

from .accuracy_report import COLUMNS, Report


def table(report: Report) -> list[str]:
    """Lines for the terminal: the best picture of every run, and what was not measured."""
    width, height = report["size"]
    lines = [
        f"{report['device']}, {width} x {height} pixels, field: {report['field']['what']}, "
        f"{report['field']['pixels']} pixels",
        f"reference: {report['reference']['samples']} samples in "
        f"{report['reference']['seconds']:.1f} s; {own_errors(report['reference'])}",
        "",
        f"{'':3} {'setting':46} {'samples':>7} {'time s':>13} {'error':>16} {'region':>8} "
        f"{'u_v_':>7} {'MTF 5':>6} {'s to 1 %':>9}",
    ]
    lines += [_line(run) for run in report["runs"]]
    lines += [
        "",
        budget_words(report),
        "< limited by the reference; * on the Pareto front; ? too short to time",
    ]
    if report["reference"]["why_no_sharpness"]:
        lines.append(f"no MTF: {report['reference']['why_no_sharpness']}")
    lines += [f"not measured: {name_of(each)}: {each['why']}" for each in report["not_measured"]]
    return lines


def name_of(run: Report) -> str:
    """Knob and value for people."""
    return f"{run['knob']}: {run['value']}" if run["value"] else run["knob"]


def shown(value: float | None, form: str) -> str:
    """A number as text, ``-`` where there is none, such as the colour of a black region."""
    return "-" if value is None else format(value, form)


def budget_words(report: Report) -> str:
    """Time that was asked for, time that was taken, and by what."""
    spent = report["spent_seconds"]
    return (
        f"{report['budget_seconds']:g} s asked, {spent['total']:.0f} s taken, set-up counted: "
        f"reference {spent['reference']:.0f} s, the device as it is {spent['as_it_is']:.0f} s, "
        f"other settings {spent['other_settings']:.0f} s"
    )


def own_errors(reference: Report) -> str:
    """Errors of the reference itself, for people."""
    own = reference["own_errors"]
    return (
        f"its own error: {shown(own['error'], '.2%')}, worst region "
        f"{shown(own['worst_region'], '.2%')}, u'v' {shown(own['colour'], '.4f')}"
    )


def time_of(run: Report, point: Report) -> str:
    """Time of a picture with its standard error, ``?`` where it is too short to time."""
    spread = f"{point['seconds']:.3g} +-{point['seconds_standard_error']:.1g}"
    return f"?{spread}" if run["too_short_to_time"] else spread


def _line(run: Report) -> str:
    point = run["points"][-1]
    limits = {name: "<" if name in point["limited"] else "" for name in COLUMNS}
    spread = point["error"]["standard_error"]
    error = f"{limits['error']}{100.0 * point['shown_error']:.3g} +-{100.0 * spread:.2g} %"
    region = f"{limits['worst_region']}{shown(point['worst_region']['value'], '.1%')}"
    colour = f"{limits['colour']}{shown(point['colour']['value'], '.4f')}"
    contrast = shown(run["sharpness"]["value"] if run["sharpness"] else None, ".3f")
    lasting = run["all_samples"]
    noise = shown(lasting["seconds_to_percent"] if lasting else None, ".3g")
    star = "*" if point["on_pareto_front"] else " "
    return (
        f"{run['number']:2}{star} {name_of(run)[:46]:46} {point['samples']:7} "
        f"{time_of(run, point):>13} {error:>16} {region:>8} {colour:>7} {contrast:>6} {noise:>9}"
    )
