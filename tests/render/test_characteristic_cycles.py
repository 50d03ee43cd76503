# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Characteristic functions in the shipped shader, in Cycles, against numpy, ray by ray."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from hoe_addon.blender.pictures.trace import trace_cycles
from hoe_addon.core.ray_law import Status
from hoe_addon.model.convert import pattern_from
from hoe_addon.model.document import hologram_from
from hoe_addon.model.evaluate import trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable

pytestmark = pytest.mark.render

DIRECTION = 2e-6
"""rad: some 30 roundings of float32 (6e-8) in normal, incidence, gradient and output."""

GRAZING = 3e-7
"""rad times cos: a tangential error of 3e-7 turns a ray toward grazing by 3e-7 / cos."""

HIT_MM = 2e-6
"""float32 places a hit of 10 mm to two units of its last digit; where grad V bends by K a mm,
that turns a ray by K times as much over the cosine."""

ELEMENTARY = 3e-7
"""Five roundings of float32 of a number below 1; OSL's own functions are off by 1e-6 to 1e-4."""

MAP = 1e-5
"""rad times cos: what the map of a pattern without a formula promises."""

LIMIT_BAND = 2e-6
"""Half width, in (n' cos')^2, of the band where float32 cannot tell the side of evanescence."""

EFFICIENCY = 1.1e-5
"""Cycles leaves out closures below a weight of 1e-5; above, float32 keeps 1e-6."""

HALF_MM = 9.5

rng = np.random.default_rng(7)
ZERNIKE = {str(j): float(value) for j, value in zip(range(1, 38), rng.normal(size=37), strict=True)}
GRID = (0.05 * rng.normal(size=(13, 13))).tolist()

FORMULAS = (
    "sqrt(100^2+r^2)-100",
    "20*cos(r/8)",
    "0.3*r*sin(phi)+r/9",
    "exp(-(r/7)^2)*2",
    "atan2(y+30,x+40)*8+atan(x/9)",
    "log(30+x)*4+tanh(y/5)",
    "abs(x)/4+max(y,0)/5-min(x,r/2)/9",
    "asin(x/20)*4+acos(y/25)",
    "pow(r,1.5)/40+r^2.3/200+(20+x)^-1.5",
    "sinh(x/9)*cosh(y/8)*2",
    "hypot(x,y-3)/3",
    "sin(4*x)*sin(3*y)/20",
    "(x^2+y^2)^4/1e7",
    "tan(x/15)*3/(2+cos(y/3))",
    "phi*0.4",
    "(20+x)^(y/30)",
)

ANALYTIC: dict[str, dict[str, Any]] = {
    "linear": {"lines_per_mm": 700, "azimuth_deg": 25},
    "radial": {"lines_per_mm": 600},
    "even_radial": {"coefficients": [-4e4, 3e3, -1e3, 500], "normalization_mm": 10},
    "polynomial": {
        "terms": [
            {"x": i, "y": j, "coefficient": 3e3 * (-1) ** (i * j) / (1 + i + j)}
            for i in range(5)
            for j in range(0, 5, 2)
        ],
        "normalization_mm": 10,
    },
    "zernike": {
        "index": "fringe",
        "coefficients": {j: 0.3 * value / int(j) for j, value in ZERNIKE.items()},
        "normalization_mm": 14,
        "unit": "mm",
    },
    "zernike of degree 30": {
        "kind": "zernike",
        "index": "noll",
        "coefficients": {"2": 2, "4": 0.5, "496": 1e-3, "400": 1e-3, "101": -4e-3},
        "normalization_mm": 14,
        "unit": "mm",
    },
    **{formula: {"kind": "formula", "formula": formula, "unit": "mm"} for formula in FORMULAS},
}


def hologram(kind: str, front: float = 1.5, **fields: Any) -> HologramSpec:
    characteristic = {"kind": kind, "wavelength_nm": 532, **fields}
    return hologram_from(
        {
            "schema": 1,
            "name": "pattern",
            "surface": {"shape": "plane", "size_mm": [20, 20]},
            "media": {"front": front},
            "characteristic": characteristic,
            "efficiency": {"model": "constant", "table": {"T": {"0": 0.5, "1": 0.3, "-1": 0.2}}},
        }
    )


def some_rays(seed: int, count: int = 1000, half: float = HALF_MM) -> RayTable:
    rng = np.random.default_rng(seed)
    hit = np.concatenate((rng.uniform(-half, half, (count, 2)), np.zeros((count, 1))), axis=1)
    cos = rng.uniform(0.5, 1.0, count)
    sin, phi = np.sqrt(1.0 - cos**2), rng.uniform(0.0, 2.0 * np.pi, count)
    side = rng.choice([-1.0, 1.0], count)
    direction = np.stack((sin * np.cos(phi), sin * np.sin(phi), side * cos), axis=1)
    origin = hit - direction * rng.uniform(0.5, 5.0, (count, 1))
    orders, sides = rng.choice([-1, 1], count), np.zeros(count, dtype=np.bool_)
    return RayTable(origin, direction, rng.uniform(450.0, 650.0, count), orders, sides)


def bend(spec: HologramSpec, hit_mm: np.ndarray) -> np.ndarray:
    """How fast grad V changes around hits, per mm: the size of its second derivatives."""
    pattern, step = pattern_from(spec.pattern), 1e-7
    sides = [
        pattern.gradient(hit_mm / 1e3 + step * axis) - pattern.gradient(hit_mm / 1e3 - step * axis)
        for axis in np.eye(3)[:2]
    ]
    slopes = np.stack(sides, axis=-1) / (2e3 * step)
    return np.sqrt(np.sum(slopes**2, axis=(-2, -1)))


def compare(spec: HologramSpec, rays: RayTable, promised: float = 0.0) -> None:
    cycles, exact = trace_cycles(spec, rays), trace(spec, rays)
    both = (cycles.status == Status.OK) & (exact.status == Status.OK)
    assert both.mean() > 0.1
    cos = np.abs(exact.direction[both, 2])
    angle = np.linalg.norm(cycles.direction[both] - exact.direction[both], axis=1)
    steep = np.nan_to_num(bend(spec, exact.hit_mm[both])) * HIT_MM / cos
    allowed = np.maximum(DIRECTION, GRAZING / cos) + steep + promised / cos
    assert np.all(angle <= allowed), np.max(angle / allowed)
    differ = cycles.status != exact.status
    limit = np.where(exact.status == Status.OK, exact.direction[:, 2] ** 2, 0.0)
    assert np.all(limit[differ] < LIMIT_BAND)
    assert differ.sum() <= 2e-3 * len(rays)
    assert np.max(np.abs(cycles.efficiency[both] - exact.efficiency[both])) < EFFICIENCY


@pytest.mark.parametrize("name", ANALYTIC)
def test_a_thousand_random_rays(name: str) -> None:
    fields = ANALYTIC[name]
    compare(hologram(**{"kind": name, **fields}), some_rays(1))


@pytest.mark.parametrize(
    "function",
    [
        "sin(x*20)/2",
        "cos(x*20)/2",
        "tan(x/8)/6",
        "exp(-x/3)/60",
        "log(10.1+x)/8",
        "asin(x/10.1)/4",
        "acos(x/10.1)/8",
        "atan(x)/4",
        "atan2(x,-1)/8",
        "sinh(x/3)/30",
        "cosh(x/3)/30",
        "tanh(x)/2",
        "pow(10.1+x,0.3)/5",
        "hypot(x,3)/20",
    ],
)
def test_the_shader_s_own_functions_are_exact_to_float32(function: str) -> None:
    # Along y = 0 the gradient of y f(x) is f(x) itself.
    x = np.linspace(-HALF_MM, HALF_MM, 501)
    start = np.stack((x, 0.0 * x, 0.0 * x - 1.0), axis=1)
    rays = RayTable(
        start,
        np.tile((0.0, 0.0, 1.0), (len(x), 1)),
        np.full(len(x), 532.0),
        np.ones(len(x), dtype=np.int64),
        np.zeros(len(x), dtype=np.bool_),
    )
    spec = hologram("formula", formula=f"y*({function})", unit="mm", front=1.0)
    cycles, exact = trace_cycles(spec, rays), trace(spec, rays)
    met = exact.status == Status.OK
    assert met.mean() > 0.9
    error = np.abs(cycles.direction - exact.direction)[met, 1]
    assert np.all(error <= ELEMENTARY + bend(spec, exact.hit_mm[met]) * HIT_MM)


@pytest.mark.parametrize("reverse", [False, True])
def test_a_ray_comes_back_by_order_minus_one_or_backward(reverse: bool) -> None:
    spec = hologram("even_radial", coefficients=[-4e4, 3e3], normalization_mm=10, front=1.0)
    rays = some_rays(2)
    once = trace_cycles(spec, rays)
    met = once.status == Status.OK
    out, order = once.direction[met], rays.order[met]
    # Onward in the opposite order, or the same way backward in the same order.
    toward, again = (-out, order) if reverse else (out, -order)
    return_rays = RayTable(
        once.hit_mm[met] - toward, toward, rays.wavelength_nm[met], again, rays.reflected[met]
    )
    home = trace_cycles(spec, return_rays)
    assert np.all(home.status == Status.OK)
    cos = np.minimum(np.abs(rays.direction[met, 2]), np.abs(out[:, 2]))
    wanted = -rays.direction[met] if reverse else rays.direction[met]
    angle = np.linalg.norm(home.direction - wanted, axis=1)
    # Twice through the shader, and the hit in between rounded to float32.
    assert np.all(angle <= 3.0 * np.maximum(DIRECTION, GRAZING / cos))


@pytest.mark.parametrize(
    "fields",
    [
        {"kind": "radial", "lines_per_mm": 600},
        {"kind": "formula", "formula": "r/3", "unit": "mm"},
        {"kind": "formula", "formula": "phi*2+r^2/50", "unit": "mm"},
        {"kind": "formula", "formula": "hypot(x,y)", "unit": "mm"},
    ],
)
def test_nothing_is_recorded_at_a_kink(fields: dict[str, Any]) -> None:
    spec = hologram(**fields)
    direction = np.array([[0.0, 0.0, 1.0]] * 2)
    rays = RayTable(
        direction * -2.0,
        direction,
        np.full(2, 532.0),
        np.array([0, 1]),
        np.zeros(2, dtype=np.bool_),
    )
    exact, cycles = trace(spec, rays), trace_cycles(spec, rays)
    # All light goes straight on, and none into order 1.
    assert exact.efficiency[0] == 1.0
    assert exact.status[1] != Status.OK
    assert cycles.efficiency[0] == pytest.approx(1.0, abs=1e-6)
    assert cycles.direction[0] == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)
    assert np.nan_to_num(cycles.efficiency[1]) == 0.0


def test_a_smooth_function_of_r_is_recorded_at_the_origin() -> None:
    spec = hologram("formula", formula="3*cos(r/4)+x/5", unit="mm")
    direction = np.array([[0.0, 0.0, 1.0]])
    rays = RayTable(
        -direction, direction, np.array([532.0]), np.array([1]), np.zeros(1, dtype=np.bool_)
    )
    cycles = trace_cycles(spec, rays)
    assert cycles.direction[0, 0] == pytest.approx(0.2 / 1.5, abs=DIRECTION)


def test_functions_that_are_not_defined_beside_the_element_of_a_document() -> None:
    # The spec is checked on its rectangle: a shader may still be asked where log has no value.
    spec = hologram("formula", formula="log(x+10.00001)+sqrt(y+10.001)", unit="mm")
    compare(spec, some_rays(3, count=300))


def test_long_formulas_compile_and_are_right() -> None:
    formula = "+".join(f"sin(x*{n / 40}+y/{n})/{n * 4}" for n in range(1, 40))
    compare(hologram("formula", formula=formula, unit="mm"), some_rays(4, count=300))


def test_a_spline_goes_through_a_map() -> None:
    grid = {"origin_mm": [-18, -18], "pitch_mm": [3, 3], "coefficients": GRID, "unit": "mm"}
    compare(hologram("spline", **grid), some_rays(5), MAP)


def test_samples_go_through_a_map(tmp_path: Path) -> None:
    x, y = np.meshgrid(np.linspace(-11, 11, 45), np.linspace(11, -11, 45))
    np.save(tmp_path / "v.npy", 0.3 * np.sin(x / 4) * np.cos(y / 5) + x / 9)
    fields = {"file": str(tmp_path / "v.npy"), "size_mm": [22, 22], "unit": "mm"}
    compare(hologram("sampled", **fields), some_rays(6), MAP)
