# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions of documents: units, round trips, messages, and the schema."""

import json
import math
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from hoe_addon.core.errors import SpecError
from hoe_addon.model.characteristic import EvenRadialSpec, PolynomialSpec, PolynomialTerm
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from, to_document
from hoe_addon.model.evaluate import trace
from hoe_addon.model.field_error import FieldError
from hoe_addon.model.rays import RayTable
from hoe_addon.model.schema import SCHEMA_DIR

LENS = Path(__file__).parents[1] / "documents" / "lens.json"

GRID = [[float(i * i - j) for i in range(5)] for j in range(6)]

EXAMPLES: dict[str, dict[str, Any]] = {
    "linear": {"lines_per_mm": 500, "azimuth_deg": 30},
    "radial": {"lines_per_mm": 600},
    "even_radial": {"coefficients": [-300.0, 2.0], "normalization_mm": 10},
    "polynomial": {"terms": [{"x": 1, "y": 2, "coefficient": 30}], "normalization_mm": 10},
    "zernike": {
        "index": "noll",
        "coefficients": {"4": 100, "11": -3.5},
        "normalization_mm": 14,
        "unit": "waves",
    },
    "spline": {
        "origin_mm": [-30, -30],
        "pitch_mm": [15, 12],
        "coefficients": GRID,
        "unit": "waves",
    },
    "formula": {"formula": "sqrt(f^2+r^2)-f", "unit": "mm", "constants": {"f": 100}},
}


def document(kind: str, size: float = 20, **fields: Any) -> dict[str, Any]:
    return {
        "schema": 1,
        "name": "pattern",
        "surface": {"shape": "plane", "size_mm": [size, size]},
        "media": {},
        "characteristic": {"kind": kind, "wavelength_nm": 500, **fields},
        "efficiency": {"model": "constant", "table": {"T": {"0": 0.5, "1": 0.3, "-1": 0.2}}},
    }


def changed(kind: str, **fields: Any) -> dict[str, Any]:
    return document(kind, **{**EXAMPLES[kind], **fields})


def schema() -> jsonschema.Draft202012Validator:
    text = (SCHEMA_DIR / "hologram-1.schema.json").read_text(encoding="utf-8")
    return jsonschema.Draft202012Validator(json.loads(text))


@pytest.mark.parametrize("kind", EXAMPLES)
def test_documents_come_back_and_obey_the_schema(kind: str) -> None:
    spec = hologram_from(document(kind, **EXAMPLES[kind]))
    assert hologram_from(json.loads(json.dumps(to_document(spec)))) == spec
    schema().validate(document(kind, **EXAMPLES[kind]))
    schema().validate(to_document(spec))
    assert pattern_from(spec.pattern).wavelength == 500e-9


@pytest.mark.parametrize("kind", EXAMPLES)
def test_gradient_is_that_of_the_function(kind: str, rng: np.random.Generator) -> None:
    pattern = pattern_from(hologram_from(document(kind, **EXAMPLES[kind])).pattern)
    places = np.concatenate((rng.uniform(-9e-3, 9e-3, (50, 2)), np.zeros((50, 1))), axis=1)
    step = 1e-6
    for axis in range(2):
        shift = step * np.eye(3)[axis]
        slope = (pattern.function(places + shift) - pattern.function(places - shift)) / (2 * step)
        # Rounding of V, 1e-18 m, over the step; and the step squared times the third derivative.
        assert np.abs(slope - pattern.gradient(places)[:, axis]).max() < 1e-7


def test_units() -> None:
    slopes = {}
    for unit in ("mm", "waves", "radians"):
        spec = hologram_from(document("formula", formula="x/100", unit=unit))
        slopes[unit] = pattern_from(spec.pattern).gradient((0.0, 0.0, 0.0))[0]
    assert slopes["mm"] == pytest.approx(1e-2, rel=1e-14)
    assert slopes["waves"] == pytest.approx(1e-2 * 500e-6, rel=1e-14)
    assert slopes["radians"] == pytest.approx(1e-2 * 500e-6 / (2 * math.pi), rel=1e-14)


def test_a_quadratic_of_radians_is_a_lens() -> None:
    # V = -r^2 / (2 f): phase -pi r^2 / (lambda f), in the field's Binary 2.
    focal_mm, wavelength_mm = 80.0, 500e-6
    phase = -math.pi / (wavelength_mm * focal_mm)
    spec = hologram_from(document("even_radial", coefficients=[phase]))
    one, none = np.ones(1, dtype=np.int64), np.zeros(1, dtype=np.bool_)
    ray = RayTable(
        np.array([[0.1, 0, -1.0]]), np.array([[0, 0, 1.0]]), np.array([500.0]), one, none
    )
    out = trace(spec, ray).direction[0]
    assert -0.1 * out[2] / out[0] == pytest.approx(focal_mm, rel=1e-5)


def test_kinds_that_say_the_same_agree(rng: np.random.Generator) -> None:
    places = np.concatenate((rng.uniform(-9e-3, 9e-3, (50, 2)), np.zeros((50, 1))), axis=1)
    # Fringe 9: 6 rho^4 - 6 rho^2 + 1.
    same = (
        document("zernike", index="fringe", coefficients={"9": 50}, normalization_mm=12, unit="mm"),
        document("even_radial", coefficients=[-300, 300], normalization_mm=12, unit="mm"),
        document(
            "polynomial",
            terms=[
                {"x": x, "y": y, "coefficient": c}
                for x, y, c in ((2, 0, -300), (0, 2, -300), (4, 0, 300), (2, 2, 600), (0, 4, 300))
            ],
            normalization_mm=12,
            unit="mm",
        ),
        document("formula", formula="300*(r/a)^4-300*(r/a)^2", constants={"a": 12}, unit="mm"),
    )
    gradients = [pattern_from(hologram_from(each).pattern).gradient(places) for each in same]
    size = np.abs(gradients[0]).max()
    for other in gradients[1:]:
        assert np.abs(other - gradients[0]).max() < 1e-14 * size


REFUSED: list[tuple[dict[str, Any], str]] = [
    (
        {"kind": "cubic"},
        "characteristic.kind: must be one of linear, radial, even_radial, polynomial, zernike, "
        'spline, formula, sampled, got "cubic"',
    ),
    (changed("radial", lines_per_mm=-1), "characteristic.lines_per_mm: must be at least 0, got -1"),
    (
        changed("even_radial", coefficients=[]),
        "characteristic.coefficients: must be a list of length at least 1, got []",
    ),
    (
        changed("even_radial", normalization_mm=0),
        "characteristic.normalization_mm: must be above 0, got 0",
    ),
    (
        changed("even_radial", unit="cm"),
        'characteristic.unit: must be one of mm, radians, waves, got "cm"',
    ),
    (
        changed("polynomial", terms=[{"x": 21, "y": 0, "coefficient": 1}]),
        "characteristic.terms[0].x: must be from 0 to 20, got 21",
    ),
    (
        changed("polynomial", terms=[{"x": 1, "y": 0, "coefficient": 1}] * 2),
        "characteristic.terms[1]: must not repeat the powers x, y, got [1, 0]",
    ),
    (
        changed("zernike", index="ansi"),
        'characteristic.index: must be one of fringe, noll, got "ansi"',
    ),
    (
        changed("zernike", coefficients={"0": 1}),
        "characteristic.coefficients: index must be a whole number from 1 to 496 in the noll "
        'order, got "0"',
    ),
    (
        changed("zernike", index="fringe", coefficients={"38": 1}),
        "characteristic.coefficients: index must be a whole number from 1 to 37 in the fringe "
        'order, got "38"',
    ),
    (
        changed("zernike", coefficients={"4": "x"}),
        'characteristic.coefficients.4: must be a number, got "x"',
    ),
    (
        changed("spline", coefficients=[[1, 2, 3, 4]] * 3 + [[1, 2, 3, 4, 5]]),
        "characteristic.coefficients[3]: must have 4 numbers, like the first row, got 5",
    ),
    (changed("spline", pitch_mm=[1, 0]), "characteristic.pitch_mm[1]: must be above 0, got 0"),
    (
        changed("formula", formula="1+foo"),
        'characteristic.formula: column 3: unknown name "foo" (known: x, y, r, phi, pi, f, sqrt,',
    ),
    (changed("formula", formula=" "), 'characteristic.formula: must not be empty, got " "'),
    (
        changed("formula", formula="1/(x-3)"),
        "characteristic.formula: must have a value and a bounded gradient all over the surface: "
        'at x = 3 mm, y = -10 mm it divides by zero, got "1/(x-3)"',
    ),
    (
        changed("formula", formula="sqrt(9-x)"),
        "characteristic.formula: must have a value and a bounded gradient all over the surface: "
        'at x = 9.0625 mm, y = -10 mm it has no finite value, got "sqrt(9-x)"',
    ),
    (
        changed("formula", constants={"x": 1}),
        'characteristic.constants: names must not be those of the formulas, got "x"',
    ),
    (
        changed("formula", constants={"a b": 1}),
        "characteristic.constants: names must be up to 32 letters, digits and _, not beginning "
        'with a digit, got "a b"',
    ),
    (
        changed("formula", constants={"f": None}),
        "characteristic.constants.f: must be a number, got null",
    ),
]


@pytest.mark.parametrize(("bad", "message"), REFUSED)
def test_mistakes_are_named(bad: dict[str, Any], message: str) -> None:
    whole = bad if "characteristic" in bad else document(**bad)
    with pytest.raises(SpecError) as caught:
        hologram_from(whole)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    "broken",
    [
        document("cubic"),
        changed("linear", wavelength_nm=100),
        changed("radial", azimuth_deg=1),
        changed("even_radial", coefficients=[]),
        changed("even_radial", coefficients=[1.0] * 17),
        changed("even_radial", normalization_mm=0),
        changed("even_radial", unit="cm"),
        changed("polynomial", terms=[]),
        changed("zernike", index="ansi"),
        changed("zernike", coefficients={}),
        changed("zernike", coefficients={"4": "x"}),
        changed("spline", coefficients=[[1, 2, 3, 4]] * 3),
        changed("spline", pitch_mm=[1, 0]),
        changed("formula", formula="x" * 2001),
    ],
)
def test_the_schema_refuses_what_it_can_express_and_the_reader_too(broken: dict[str, Any]) -> None:
    assert not schema().is_valid(broken)
    with pytest.raises(SpecError):
        hologram_from(broken)


def test_specs_made_in_python_are_checked_too() -> None:
    with pytest.raises(FieldError, match="coefficients: must be 1 to 16 numbers, got 17"):
        EvenRadialSpec(500.0, (1.0,) * 17)
    with pytest.raises(FieldError, match="terms: must be 1 to 100 terms, got 0"):
        PolynomialSpec(500.0, ())
    term = PolynomialTerm(1, 2, np.float64(3.0))
    assert type(term.coefficient) is float


def test_a_kink_is_no_mistake() -> None:
    for formula in ("r/2", "abs(x)", "max(x,y)", "3*phi"):
        spec = hologram_from(document("formula", formula=formula, unit="mm"))
        assert to_document(spec)["characteristic"]["formula"] == formula


def test_only_the_outline_counts() -> None:
    whole = document("formula", formula="1/(r-11)", unit="mm")
    with pytest.raises(SpecError, match="divides by zero"):
        hologram_from(whole)
    whole["surface"]["outline"] = "ellipse"
    hologram_from(whole)


@pytest.mark.parametrize(
    "formula",
    [
        "0.02*sqrt(abs(x-0.337))",
        "pow(abs(x-.337),.9)",
        "abs(x-.1)^0.5",
        "sqrt((x-0.3)^2+(y-.2)^2-1e-6)",
    ],
)
def test_steep_places_between_those_looked_at_are_found(formula: str) -> None:
    """A gradient without bound on a line, or a small hole without a value."""
    document = json.loads(LENS.read_text(encoding="utf-8"))
    del document["recording"]
    document["surface"]["size_mm"] = [20, 20]
    kind = {"kind": "formula", "wavelength_nm": 532, "unit": "mm", "formula": formula}
    with pytest.raises(SpecError, match=r"characteristic\.formula: must have a value and a bound"):
        hologram_from(document | {"characteristic": kind})


@pytest.mark.parametrize(
    "kind",
    [
        {"kind": "even_radial", "normalization_mm": 1e-6, "coefficients": [1, 1, 1, 1, 1]},
        {
            "kind": "polynomial",
            "normalization_mm": 1e-17,
            "terms": [{"x": 3, "y": 0, "coefficient": 1}],
        },
    ],
    ids=lambda kind: kind["kind"],
)
def test_gradients_beyond_all_use_are_refused(kind: dict[str, Any]) -> None:
    document = json.loads(LENS.read_text(encoding="utf-8"))
    del document["recording"]
    with pytest.raises(SpecError, match="characteristic: must have a gradient of at most 1e"):
        hologram_from(document | {"characteristic": {"wavelength_nm": 532, **kind}})
