# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""accuracy.html: one file with the diagram, the pictures side by side, and all numbers."""

import base64
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from .accuracy_report import Report
from .accuracy_table import budget_words, name_of, own_errors, shown, time_of

if TYPE_CHECKING:
    from ..blender.accuracy.results import Accuracy

_STYLE = """\
body { font: 15px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 84em; padding: 0 1em;
  color: #222; background: #fff; }
img { max-width: 100%; height: auto; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(19em, 1fr)); gap: 1em; }
.pictures img { width: 100%; image-rendering: pixelated; background: #000; }
figure { margin: 0; }
figcaption { font-size: 0.9em; }
table { border-collapse: collapse; font-size: 0.9em; }
th, td { border-bottom: 1px solid #ccc; padding: 0.2em 0.6em; text-align: right; }
th:nth-child(2), td:nth-child(2) { text-align: left; }
.front { background: #fff3c4; }
"""
_KEY = "Shaded: on the Pareto front. &lt;: limited by the reference. ?: too short to time."
_HEADS = (
    "run",
    "setting",
    "samples",
    "seconds",
    "error",
    "light of displays",
    "worst region",
    "u'v'",
    "MTF at 5 /deg",
    "seconds to 1 % noise",
)


def page(report: Report, found: "Accuracy", plot: Path | None) -> list[str]:
    """Make the page.

    Args:
        report: What `accuracy_report.report_of` gave.
        found: The results with their pictures.
        plot: The diagram, a PNG file; None where there is none.

    Returns:
        Its text in pieces; every text of the document is escaped.
    """
    from ..blender.accuracy.pictures import png_of

    title = escape(f"What accuracy costs: {report['device']}")
    reference = report["reference"]
    pictures = [
        _figure("reference", _about_reference(reference), png_of(found.judge.whole.picture))
    ]
    for run, result in zip(report["runs"], found.runs, strict=True):
        about = _about(run["points"][-1])
        pictures.append(_figure(f"{run['number']}. {name_of(run)}", about, png_of(result.picture)))
    return [
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n',
        f"<title>{title}</title>\n<style>\n{_STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n",
        f"<p>{escape(_summary(report))}</p>\n",
        f"<p>{escape(_about_reference(reference))}</p>\n",
        *_diagram(plot),
        '<h2>Pictures</h2>\n<div class="pictures">\n',
        *pictures,
        "</div>\n<h2>Numbers</h2>\n",
        *_table(report),
        "<h2>What the numbers are</h2>\n<ul>\n",
        *(
            f"<li><b>{escape(name)}</b>: {escape(text)}</li>\n"
            for name, text in report["measures"].items()
        ),
        "</ul>\n<h2>Not measured</h2>\n<ul>\n",
        *(
            f"<li>{escape(name_of(each))}: {escape(each['why'])}</li>\n"
            for each in report["not_measured"]
        ),
        "</ul>\n</body>\n</html>\n",
    ]


def _diagram(plot: Path | None) -> list[str]:
    if plot is None:
        return []
    return [f'<p><img alt="error against time" src="{_data(plot.read_bytes())}"></p>\n']


def _summary(report: Report) -> str:
    width, height = report["size"]
    machine = report["machine"]
    return (
        f"{report['title']}. {width} x {height} pixels; errors over "
        f"{report['field']['pixels']} of them ({report['field']['what']}). {machine['threads']} "
        f"threads of {machine['processor']}, {machine['system']}, Blender {report['blender']}, "
        f"hoe_addon {report['hoe_addon']}. Time: {budget_words(report)}."
    )


def _about_reference(reference: Report) -> str:
    return f"{reference['samples']} samples, {reference['seconds']:.3g} s; {own_errors(reference)}"


def _about(point: Report) -> str:
    limited = " (limited by the reference)" if "error" in point["limited"] else ""
    return (
        f"{point['samples']} samples, {point['seconds']:.3g} s, error {point['shown_error']:.2%}"
        f"{limited}"
    )


def _figure(name: str, about: str, png: bytes) -> str:
    caption = f"<b>{escape(name)}</b><br>{escape(about)}"
    image = f'<img alt="{escape(name)}" src="{_data(png)}">'
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>\n"


def _data(png: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(png).decode('ascii')}"


def _table(report: Report) -> list[str]:
    rows = ["<table>\n<tr>", *(f"<th>{escape(head)}</th>" for head in _HEADS), "</tr>\n"]
    for run in report["runs"]:
        for place, point in enumerate(run["points"]):
            last = place == len(run["points"]) - 1
            front = ' class="front"' if point["on_pareto_front"] else ""
            cells = "".join(f"<td>{escape(text)}</td>" for text in _cells(run, point, last))
            rows.append(f"<tr{front}>{cells}</tr>\n")
    return [*rows, f"</table>\n<p>{_KEY}</p>\n"]


def _cells(run: Report, point: Report, last: bool) -> list[str]:
    lasting, contrast = run["all_samples"], run["sharpness"]
    percent = lasting["seconds_to_percent"] if lasting else None
    return [
        str(run["number"]),
        name_of(run),
        str(point["samples"]),
        time_of(run, point),
        _number(point, "error", 100.0, " %"),
        _number(point, "display_error", 100.0, " %"),
        _number(point, "worst_region", 100.0, " %"),
        _number(point, "colour", 1.0, ""),
        _contrast(contrast) if contrast and last else "",
        f"{percent:.3g}" if percent is not None and last else "",
    ]


def _contrast(found: Report) -> str:
    return f"{shown(found['value'], '.3f')} +- {shown(found['standard_error'], '.3f')}"


def _number(point: Report, name: str, scale: float, unit: str) -> str:
    found = point[name]
    if found is None:
        return ""
    if found["value"] is None:
        return "-"
    sign = "< " if name in point["limited"] else ""
    value, spread = scale * found["value"], scale * found["standard_error"]
    return f"{sign}{value:.3g} +- {spread:.2g}{unit}"
