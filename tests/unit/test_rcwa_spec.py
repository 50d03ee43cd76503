# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rigorous model in documents: what is read, what is refused, and what it becomes."""

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hoe_addon.core.efficiency import Polarization
from hoe_addon.core.errors import ConvergenceError, SpecError
from hoe_addon.core.orders import Branch
from hoe_addon.core.rcwa.stack import Lamellar, Layer, Uniform
from hoe_addon.model.check import light_on
from hoe_addon.model.document import dump, hologram_from, to_document
from hoe_addon.model.efficiency import RcwaSpec
from hoe_addon.model.efficiency.optical_index import OwnIndex, material_from
from hoe_addon.model.efficiency.rcwa import CoatingSpec
from hoe_addon.model.efficiency.rcwa_profile import BinaryProfile
from hoe_addon.model.efficiency.rcwa_stack import FIRST, materials_from, stack_from
from hoe_addon.model.evaluate import efficiencies, incident_direction
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.schema import hologram_schema

LOSSLESS = 1e-10
"""R + T of a lossless grating, the promise of the rigorous model."""
SAME = 1e-12
"""Equal layers from two descriptions differ by rounding alone."""

BINARY: dict[str, Any] = {"shape": "binary", "depth_um": 0.5, "duty": 0.4}
VOLUME: dict[str, Any] = {"shape": "volume", "thickness_um": 5, "index": 1.5, "modulation": 0.02}


def rcwa(profile: dict[str, Any], **fields: Any) -> dict[str, Any]:
    relief = {} if profile["shape"] in ("volume", "layers") else {"ridge": 1.5}
    return {"model": "rcwa", "profile": profile} | relief | fields


def hologram(efficiency: dict[str, Any], lines_per_mm: float = 800.0, **parts: Any) -> HologramSpec:
    grating = {"kind": "linear", "wavelength_nm": 532, "lines_per_mm": lines_per_mm}
    return hologram_from(
        {
            "schema": 1,
            "name": "grating",
            "surface": {"shape": "plane", "size_mm": [1, 1]},
            "media": {"back": 1.5, "front": 1},
            "characteristic": grating,
            "efficiency": efficiency,
            "orders": [-1, 0, 1],
        }
        | parts
    )


PROFILES: dict[str, dict[str, Any]] = {
    "binary": BINARY,
    "sawtooth": {"shape": "sawtooth", "depth_um": 1.0},
    "sinusoid": {"shape": "sinusoid", "depth_um": 0.4},
    "triangle": {"shape": "triangle", "depth_um": 0.4, "peak": 0.8},
    "staircase": {"shape": "staircase", "depth_um": 1.0, "levels": 4},
    "slanted": {"shape": "slanted", "depth_um": 0.4, "duty": 0.5, "slant_deg": 30},
    "polygon": {"shape": "polygon", "points": [[0.2, 0], [0.6, 0], [1.1, 0.3], [0.7, 0.3]]},
    "sampled": {"shape": "sampled", "heights_um": [0, 0.1, 0.4, 0.2]},
    "layers": {
        "shape": "layers",
        "layers": [
            {"thickness_um": 0.2, "segments": [{"width": 1, "index": 2}]},
            {
                "thickness_um": 0.3,
                "segments": [{"width": 0.3, "index": 2}, {"width": 0.7, "index": "air"}],
            },
        ],
    },
    "volume": VOLUME,
    "slanted volume": VOLUME | {"slant_deg": 20, "thickness_um": 1},
    "turned volume": VOLUME | {"normal_period_um": -1.5, "thickness_um": 1},
}


@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_read_and_written(profile: dict[str, Any]) -> None:
    spec = hologram(rcwa(profile))
    assert hologram_from(json.loads(dump(spec))) == spec
    assert not spec.efficiency.has_formula


@pytest.mark.parametrize("from_front", [False, True])
@pytest.mark.parametrize("profile", PROFILES.values(), ids=PROFILES)
def test_lossless_profiles_keep_the_energy(profile: dict[str, Any], from_front: bool) -> None:
    spec = hologram(rcwa(profile, harmonics=21, slices=10))
    direction = incident_direction(12.0, 25.0, from_front=from_front)
    shares = efficiencies(spec, direction, 532.0, range(-10, 11))
    assert float(shares.sum()) == pytest.approx(1.0, abs=LOSSLESS)
    assert shares.max() < 1.0


def test_the_sawtooth_turns_light_into_order_one() -> None:
    """It rises along Q, like the kinoform's phase; its mirror image does not."""
    depth_um = 0.532 / 0.5
    fixed = {"harmonics": 31, "slices": 12}
    sawtooth = hologram(rcwa({"shape": "sawtooth", "depth_um": depth_um}, **fixed), 200.0)
    points = [[0, 0], [1, 0], [0, depth_um]]
    falling = hologram(rcwa({"shape": "polygon", "points": points}, **fixed), 200.0)
    straight = incident_direction(0.0, 0.0, from_front=False)
    first = efficiencies(sawtooth, straight, 532.0, [-1, 1])[..., 0]
    mirrored = efficiencies(falling, straight, 532.0, [-1, 1])[..., 0]
    assert first[1] > 0.7
    assert first[0] < 0.05
    assert first[::-1] == pytest.approx(mirrored, abs=SAME)


def test_the_slant_leans_toward_q() -> None:
    """Fringes that lean toward +x send light along +z into order +1 (Bragg: K_z below 0)."""
    period_um, wavelength_um, index = 0.6, 0.532, 1.5
    # For light along z the order +1 is on Bragg if K_z = -(n - sqrt(n^2 - (lambda/Lambda)^2)) k.
    tilt = np.degrees(0.5 * np.arcsin(wavelength_um / period_um / index))
    media = {"media": {"back": index, "front": index}}
    profile = VOLUME | {"thickness_um": 10, "slant_deg": float(tilt)}
    spec = hologram(rcwa(profile), 1e3 / period_um, **media)
    straight = incident_direction(0.0, 0.0, from_front=False)
    found = efficiencies(spec, straight, 1e3 * wavelength_um, [-1, 1])[..., 0]
    assert found[1] > 0.7
    assert found[0] < 0.02
    normal_um = -period_um / float(np.tan(np.radians(tilt)))
    turned = VOLUME | {"thickness_um": 10, "normal_period_um": normal_um}
    same = hologram(rcwa(turned), 1e3 / period_um, **media)
    again = efficiencies(same, straight, 1e3 * wavelength_um, [-1, 1])[..., 0]
    assert again == pytest.approx(found, abs=1e-9)


def test_layers_say_the_same_as_a_relief() -> None:
    segments = [{"width": 0.4, "index": 1.5}, {"width": 0.6, "index": 1}]
    layered = rcwa(
        {"shape": "layers", "layers": [{"thickness_um": 0.5, "segments": segments}]}, harmonics=21
    )
    direction = incident_direction(12.0, 25.0, from_front=False)
    of_relief, of_layers = (
        efficiencies(hologram(document), direction, 532.0, range(-3, 4))
        for document in (rcwa(BINARY, harmonics=21), layered)
    )
    assert of_layers == pytest.approx(of_relief, abs=SAME)


def test_materials_and_layers_are_counted_alike() -> None:
    """Layers under, the profile, layers over: from the back to the front, with their materials."""
    spec = RcwaSpec(
        profile=BinaryProfile(depth_um=0.5),
        ridge=2.0,
        groove=1.25,
        under=(CoatingSpec(index=3.0, thickness_um=0.1),),
        over=(CoatingSpec(index=4.0, thickness_um=0.2),),
    )
    values = [complex(material.permittivity(5e-7)) for material in materials_from(spec)]
    assert values == [9.0, 4.0, 1.5625, 16.0]
    layers = [layer for layer in stack_from(spec, 1e6, 11).layers if isinstance(layer, Layer)]
    assert [layer.thickness for layer in layers] == pytest.approx([1e-7, 5e-7, 2e-7])
    assert isinstance(layers[0].pattern, Uniform)
    assert layers[0].pattern.material == FIRST
    assert isinstance(layers[1].pattern, Lamellar)
    assert layers[1].pattern.materials == (FIRST + 1, FIRST + 2)
    assert isinstance(layers[2].pattern, Uniform)
    assert layers[2].pattern.material == FIRST + 3


def test_a_metal_layer_under_the_relief_reflects() -> None:
    silver = {"index": {"n": 0.05, "k": 3.4}, "thickness_um": 0.5}
    spec = hologram(rcwa(BINARY, under=[silver], harmonics=21))
    front = incident_direction(5.0, 0.0, from_front=True)
    shares = efficiencies(spec, front, 532.0, range(-5, 6))
    assert 0.9 < float(shares[..., 1].sum()) < 1.0
    assert float(shares[..., 0].sum()) < 1e-6


def test_tabulated_index_is_linear_and_ends() -> None:
    metal = OwnIndex(table=((400.0, 0.1, 2.0), (600.0, 0.3, 4.0)))
    material = material_from(metal, "efficiency.ridge")
    assert complex(material.index(450e-9)) == pytest.approx(0.15 + 2.5j, abs=SAME)
    with pytest.raises(SpecError, match=r"efficiency\.ridge: .* no index at 650 nm; .* 400 to 600"):
        material.index(650e-9)


def test_polarisations_average_to_unpolarised() -> None:
    spec = hologram(rcwa(BINARY, harmonics=21))
    direction = incident_direction(20.0, 10.0, from_front=False)
    s, p, u = (efficiencies(spec, direction, 532.0, [0, 1], of) for of in Polarization)
    assert u == pytest.approx(0.5 * (s + p), abs=SAME)
    assert np.abs(s - p).max() > 1e-3


def test_no_convergence_tells_the_error() -> None:
    metal = {"n": 0.05, "k": 3.4}
    spec = hologram(rcwa(PROFILES["sawtooth"], ridge=metal, slices=2, tolerance=1e-9))
    assert isinstance(spec.efficiency, RcwaSpec)
    hasty = replace(spec.efficiency.model(), maximum=41)
    light = light_on(spec, [532.0], [20.0], [0.0], from_front=True).incidence
    with pytest.raises(
        ConvergenceError, match=r"^efficiency\.harmonics: .* off by [0-9.e-]+ at \d+ harm"
    ):
        hasty.shares([Branch(0)], light)


def test_too_many_orders_are_told_at_once() -> None:
    spec = hologram(rcwa(BINARY), 1.0)
    straight = incident_direction(0.0, 0.0, from_front=False)
    with pytest.raises(
        ConvergenceError, match=r"^efficiency\.harmonics: \d+ orders propagate, .*; give"
    ):
        efficiencies(spec, straight, 532.0, [0, 1])


@pytest.mark.parametrize(
    ("profile", "slices", "most"),
    [
        ("binary", "auto", 401),
        ("slanted", "auto", 401),
        ("sawtooth", "auto", 129),
        ("sawtooth", 2, 401),
        ("sawtooth", 1000, 65),
    ],
)
def test_searches_end_earlier_with_many_layers(profile: str, slices: object, most: int) -> None:
    """Layers times harmonics cubed is the work."""
    spec = hologram(rcwa(PROFILES[profile], slices=slices)).efficiency
    assert isinstance(spec, RcwaSpec)
    assert spec.model().maximum == most


def test_no_end_of_fringes_is_refused() -> None:
    profile = VOLUME | {"thickness_um": 10_000, "normal_period_um": 0.02}
    straight = incident_direction(0.0, 0.0, from_front=False)
    with pytest.raises(SpecError, match=r"efficiency\.profile: .* 5000 fringes .*, got 500000"):
        efficiencies(hologram(rcwa(profile)), straight, 532.0, [0])


CROSSED = [[0, 0], [0.5, 0.4], [0.5, 0], [0, 0.4]]

BAD: dict[str, tuple[dict[str, Any], str]] = {
    "unknown shape": (rcwa({"shape": "blob"}), r"profile\.shape: must be one of .*polygon.*volume"),
    "no shape": ({"model": "rcwa", "profile": {}}, r"profile.*shape: is missing"),
    "depth": (rcwa(BINARY | {"depth_um": 0}), r"profile\.depth_um: must be above 0, got 0"),
    "duty": (rcwa(BINARY | {"duty": 1}), r"profile\.duty: must be below 1, got 1"),
    "no ridge": (
        {"model": "rcwa", "profile": BINARY},
        r"efficiency\.ridge: must be given where profile\.shape is binary",
    ),
    "ridge of a volume": (rcwa(VOLUME, ridge=2), r"ridge: must be left out where .* volume"),
    "crossed": (
        rcwa({"shape": "polygon", "points": CROSSED}),
        r"profile\.points: edges must not cross; edge \d \(.*\)-\(.*\) across edge \d ",
    ),
    "flat polygon": (
        rcwa({"shape": "polygon", "points": [[0, 0], [1, 0], [0.5, 0]]}),
        r"profile\.points: must have a height above 0",
    ),
    "two corners": (
        rcwa({"shape": "polygon", "points": [[0, 0], [1, 1]]}),
        r"profile\.points: must be at least 3 corners, got 2",
    ),
    "deep corner": (
        rcwa({"shape": "polygon", "points": [[0, 0], [1, 0], [1, -1]]}),
        r"profile\.points\[2\]\[1\]: must be from 0 to 10000 um, got -1",
    ),
    "even heights": (
        rcwa({"shape": "sampled", "heights_um": [1, 1]}),
        r"profile\.heights_um: must not all be equal",
    ),
    "negative height": (
        rcwa({"shape": "sampled", "heights_um": [1, -1]}),
        r"profile\.heights_um\[1\]: must be at least 0, got -1",
    ),
    "levels": (rcwa(PROFILES["staircase"] | {"levels": 1}), r"profile\.levels: must be from 2"),
    "widths": (
        rcwa(
            {
                "shape": "layers",
                "layers": [{"thickness_um": 1, "segments": [{"width": 0.9, "index": 2}]}],
            }
        ),
        r"profile\.layers\[0\]\.segments: widths must sum to 1, got 0.9",
    ),
    "both slants": (
        rcwa(VOLUME | {"slant_deg": 1, "normal_period_um": 1}),
        r"profile\.normal_period_um: must not stand beside slant_deg",
    ),
    "narrow fringes": (
        rcwa(VOLUME | {"normal_period_um": 0.001}),
        r"profile\.normal_period_um: must be at least 0.01 in size, got 0.001",
    ),
    "even harmonics": (rcwa(BINARY, harmonics=20), r"harmonics: must be odd, 2 N \+ 1, or auto"),
    "word": (
        rcwa(BINARY, harmonics="many"),
        r"efficiency\.harmonics: must be auto or a whole number, got .many",
    ),
    "tolerance": (rcwa(BINARY, tolerance=0), r"tolerance: must be at least 1e-09, got 0"),
    "slices": (rcwa(BINARY, slices=0), r"slices: must be from 1 to 1000, got 0"),
    "index 0": (rcwa(BINARY, ridge=0), r"efficiency\.ridge: must be above 0, got 0"),
    "unknown glass": (rcwa(BINARY, ridge="glas"), r'ridge: must be one of air, .*, got "glas"'),
    "two ways": (
        rcwa(BINARY, ridge={"n": 1, "table": [[400, 1, 0], [500, 1, 0]]}),
        r"efficiency\.ridge: must have exactly one of n, table, sellmeier",
    ),
    "gain": (rcwa(BINARY, ridge={"n": 1, "k": -1}), r"efficiency\.ridge\.k: must be at least 0"),
    "table falls": (
        rcwa(BINARY, ridge={"table": [[500, 1, 0], [400, 1, 0]]}),
        r"efficiency\.ridge\.table\[1\]\[0\]: must be a wavelength above 500, .*, got 400",
    ),
    "table in um": (
        rcwa(BINARY, ridge={"table": [[0.5, 1, 0], [0.6, 1, 0]]}),
        r"efficiency\.ridge\.table\[0\]\[0\]: must be from 200 to 20000 nm, got 0.5",
    ),
    "coating": (
        rcwa(BINARY, over=[{"index": 1.4, "thickness_um": 0}]),
        r"efficiency\.over\[0\]\.thickness_um: must be above 0, got 0",
    ),
    "formula": (
        rcwa(BINARY, lookup={"form": "formula"}),
        r"lookup\.form: must be auto or table, since this model has no formula",
    ),
}


@pytest.mark.parametrize(("document", "message"), BAD.values(), ids=BAD)
def test_bad_input_is_named(document: dict[str, Any], message: str) -> None:
    with pytest.raises(SpecError, match=message) as raised:
        hologram(document)
    assert "\n" not in str(raised.value)


def test_schema_knows_the_model() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    check = jsonschema.Draft202012Validator(hologram_schema())
    for profile in PROFILES.values():
        assert check.is_valid(to_document(hologram(rcwa(profile))))
    document = to_document(hologram(rcwa(BINARY)))
    document["efficiency"]["profile"]["depth_um"] = 0
    assert not check.is_valid(document)
