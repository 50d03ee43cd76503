# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Waves behind optics in documents: what is read, and what is said about mistakes."""

import copy
import json
from typing import Any

import jsonschema
import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.core.ray_fitting import FitStatus
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.convert_waves import wave_from
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.model.medium import medium_from
from hoe_addon.model.schema import hologram_schema

DOCUMENT: dict[str, Any] = {
    "schema": 1,
    "name": "behind a doublet",
    "surface": {"shape": "plane", "size_mm": [10, 8]},
    "media": {"back": 1.0, "front": 1.0},
    "recording": {
        "wavelength_nm": 532,
        "object": {
            "kind": "system",
            "source": {"kind": "point", "position_mm": [2, 1, -110], "medium": "air"},
            "surfaces": [
                {
                    "shape": "sphere",
                    "vertex_mm": [0, 0, -60],
                    "radius_mm": 50,
                    "semi_diameter_mm": 12,
                    "medium": "N-BK7",
                },
                {
                    "shape": "conic",
                    "vertex_mm": [0, 0, -55],
                    "normal": [0.02, 0, 1],
                    "radius_mm": -40,
                    "conic": -0.5,
                    "semi_diameter_mm": 12,
                    "medium": 1.0,
                },
                {
                    "shape": "plane",
                    "vertex_mm": [0, 0, -30],
                    "normal": [1, 0, -1],
                    "semi_diameter_mm": 20,
                    "interaction": "reflect",
                },
                {
                    "shape": "plane",
                    "vertex_mm": [-25, 0, -30],
                    "normal": [1, 0, -1],
                    "semi_diameter_mm": 20,
                    "interaction": "reflect",
                },
            ],
        },
        "reference": {"kind": "plane", "direction": [0, 0.2, 1]},
    },
    "efficiency": {
        "model": "kinoform",
        "levels": 0,
        "design_wavelength_nm": 532,
        "relief": 1.5,
    },
    "orders": [-1, 0, 1],
}
# The two mirrors shift the beam sideways by their distance.
DOCUMENT["recording"]["object"]["surfaces"][3]["vertex_mm"] = [25, 0, -30]


def changed(path: tuple[str | int, ...], value: object) -> dict[str, Any]:
    document = copy.deepcopy(DOCUMENT)
    place = document["recording"]["object"]
    for part in path[:-1]:
        place = place[part]
    place[path[-1]] = value
    return document


def shifted() -> dict[str, Any]:
    """The document with the element's frame where the beam arrives."""
    document = copy.deepcopy(DOCUMENT)
    wave = document["recording"]["object"]
    wave["source"]["position_mm"][0] -= 25
    for surface in wave["surfaces"]:
        surface["vertex_mm"][0] -= 25
    return document


def test_a_document_is_read_and_written_and_valid():
    spec = hologram_from(shifted())
    written = json.loads(json.dumps(to_document(spec)))
    assert hologram_from(written) == spec
    jsonschema.validate(written, hologram_schema())
    jsonschema.validate(shifted(), hologram_schema())


def test_numbers_reach_the_core_in_metres_at_the_recording_wavelength():
    spec = hologram_from(shifted())
    system = wave_from(spec.recording.object, 532.0).system
    first, second, mirror, _ = system.surfaces
    glass = float(medium_from("N-BK7").index(532e-9))
    assert system.indices == (1.0, glass, 1.0, 1.0, 1.0)
    assert (first.radius, second.conic, second.semi_diameter) == (0.05, -0.5, 0.012)
    assert mirror.index_after is None and mirror.radius == float("inf")
    np.testing.assert_allclose(first.frame.origin, (-0.025, 0.0, -0.06), rtol=1e-15)
    # Another wavelength of the recording means another index.
    document = shifted()
    document["recording"]["wavelength_nm"] = 633
    other = pattern_from(hologram_from(document).pattern)
    fits = [p.object.fit(np.zeros(3)) for p in (pattern_from(spec.pattern), other)]
    assert fits[0].status == fits[1].status == FitStatus.FITTED
    assert fits[0].path != fits[1].path


@pytest.mark.parametrize(
    ("path", "value", "message"),
    [
        (("surfaces",), [], "surfaces"),
        (("surfaces", 0, "radius_mm"), 0, r"surfaces\[0\].radius_mm: must not be 0"),
        (("surfaces", 0, "radius_mm"), 5, r"surfaces\[0\].semi_diameter_mm: must lie within"),
        (("surfaces", 1, "semi_diameter_mm"), 0, r"surfaces\[1\].semi_diameter_mm: must be above"),
        (("surfaces", 1, "normal"), [0, 0, 0], r"surfaces\[1\].normal: must not have zero length"),
        (("surfaces", 1, "conic"), "x", r"surfaces\[1\].conic: must be a number"),
        (("surfaces", 1, "medium"), "glue", r"surfaces\[1\].medium: must be one of air"),
        (("surfaces", 1, "medium"), None, r"surfaces\[1\].medium: must be given"),
        (("surfaces", 1, "medium"), 0.5, r"surfaces\[1\].medium: must be at least 1"),
        (("surfaces", 2, "medium"), 1.5, r"surfaces\[2\].medium: must not be given for a mirror"),
        (("surfaces", 2, "interaction"), "absorb", r"surfaces\[2\].interaction"),
        (("surfaces", 2, "shape"), "torus", r"surfaces\[2\].shape: must be one of"),
        (("surfaces", 2, "vertex_mm"), [0, 0], r"surfaces\[2\].vertex_mm"),
        (("source", "kind"), "lamp", r"source.kind: must be one of plane, point"),
        (("source", "medium"), "glue", r"source.medium: must be one of air"),
        (("source", "position_mm"), [0, 0, None], r"source.position_mm\[2\]"),
        (
            ("source",),
            {"kind": "plane", "direction": [0, 0, 0]},
            r"source.direction: must not have zero length",
        ),
        (
            ("surfaces", 1, "semi_diameter_mm"),
            1e-9,
            r"surfaces\[1\]: must let a ray.*0 rays",
        ),
    ],
)
def test_mistakes_are_named_where_they_are(path, value, message):
    with pytest.raises(SpecError, match=rf"^recording\.object\.{message}"):
        hologram_from(changed(path, value))


def test_light_that_goes_elsewhere_names_the_last_surface():
    with pytest.raises(SpecError, match=r"surfaces\[3\]: must send a ray to the element"):
        hologram_from(DOCUMENT)


def test_a_formula_without_an_index_names_its_medium():
    bad = {"sellmeier": {"b": [1, 0, 0], "c_um2": [0.3, 0, 0]}}
    rule = r"^recording\.object\.surfaces\[0\]\.medium: must have an index"
    with pytest.raises(SpecError, match=rule):
        hologram_from(changed(("surfaces", 0, "medium"), bad))
