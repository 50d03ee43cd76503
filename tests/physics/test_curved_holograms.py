# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holograms recorded and read out on curved surfaces, in numpy."""

from typing import Any

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.orders import Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.shapes import Conic
from hoe_addon.core.shapes.tessellate import rectangle_mesh
from hoe_addon.core.units import m_to_mm, mm_to_m
from hoe_addon.model.document import hologram_from
from hoe_addon.model.element import element_mesh, element_shape
from hoe_addon.model.evaluate import fan, trace
from hoe_addon.model.hologram import HologramSpec
from hoe_addon.model.rays import RayTable

COUNT = 1000
READ_OUT = 1e-12
"""rad; the promise of the recording, thousands of roundings of float64."""

OBJECT_MM = (6.0, -4.0, 70.0)

CURVED: dict[str, dict[str, Any]] = {
    "sphere": {"shape": "sphere", "size_mm": [40, 40], "radius_mm": 55},
    "sphere the other way": {"shape": "sphere", "size_mm": [40, 40], "radius_mm": -45},
    "conic": {"shape": "conic", "size_mm": [40, 40], "radius_mm": 40, "conic": -1.3},
    "cylinder": {"shape": "cylinder", "size_mm": [40, 40], "radius_mm": -30, "axis": "y"},
    "asphere": {
        "shape": "asphere",
        "size_mm": [40, 40],
        "radius_mm": 60,
        "conic": -0.4,
        "coefficients": [1e-6, -3e-10],
    },
    "round": {"shape": "sphere", "size_mm": [40, 30], "radius_mm": 60, "outline": "ellipse"},
}


def hologram(surface: dict[str, Any], **changes: Any) -> HologramSpec:
    document = {
        "schema": 1,
        "name": "curved",
        "surface": surface,
        "media": {"back": 1.0, "front": 1.0},
        "recording": {
            "wavelength_nm": 532,
            "object": {"kind": "point", "position_mm": list(OBJECT_MM), "beam": "converging"},
            "reference": {"kind": "plane", "direction": [0.2, 0.1, 1.0]},
        },
        "efficiency": {"model": "constant", "table": {"T": {"0": 0.2, "1": 0.5, "-1": 0.3}}},
        "orders": [-1, 0, 1],
    }
    return hologram_from(document | changes)


def windshield(cells: int) -> dict[str, Any]:
    """A leaning, doubly curved sheet as a mesh without normals, as a CAD file gives it."""
    along = np.linspace(-60.0, 60.0, cells + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(along, 0.6 * along))
    z = 0.5 * y + x**2 / 700.0 + y**2 / 900.0 + 1e-6 * x**2 * y
    number = np.arange((cells + 1) ** 2).reshape(cells + 1, cells + 1)
    a, b, c, d = (
        part.ravel()
        for part in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    )
    faces = np.concatenate((np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)))
    return {
        "shape": "mesh",
        "vertices_mm": np.stack((x, y, z), axis=1).tolist(),
        "faces": faces.tolist(),
    }


def points_on(
    spec: HologramSpec, rng: np.random.Generator, half: float = 14.0
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Random points of the surface in mm, and the normals there."""
    shape = element_shape(spec)
    x, y = mm_to_m(rng.uniform(-half, half, (2, COUNT)))
    points = np.stack((x, y, shape.sag(x, y)), axis=1)
    return m_to_mm(points), shape.normal(points)


def unit(vectors: Any) -> NDArray[np.float64]:
    vectors = np.asarray(vectors, dtype=np.float64)
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


@pytest.mark.parametrize("name", [*CURVED, "mesh"])
def test_reference_wave_gives_the_object_wave(name: str, rng: np.random.Generator) -> None:
    """And order -1 the reverse: a ray toward the object point comes back along the reference."""
    spec = hologram(CURVED.get(name) or windshield(24))
    points, normal = points_on(spec, rng)
    reference = np.broadcast_to(unit((0.2, 0.1, 1.0)), points.shape)
    toward = unit(np.array(OBJECT_MM) - points)
    out = fan(spec, points, reference, 532.0, [Branch(1)])
    assert np.all(out.status == Status.OK)
    assert np.abs(out.directions[:, 0] - toward).max() < READ_OUT
    back = fan(spec, points, -toward, 532.0, [Branch(1)])
    assert np.abs(back.directions[:, 0] + reference).max() < READ_OUT
    reverse = fan(spec, points, toward, 532.0, [Branch(-1)])
    assert np.abs(reverse.directions[:, 0] - reference).max() < READ_OUT
    # The surfaces are truly curved: a plane's normal would send the rays elsewhere.
    assert np.abs(normal[:, :2]).max() > 0.1


@pytest.mark.parametrize("name", CURVED)
def test_traced_rays_go_through_the_object_point(name: str, rng: np.random.Generator) -> None:
    """With the hit found along the ray, from either side of the element."""
    spec = hologram(CURVED[name])
    points, _ = points_on(spec, rng, 10.0)
    direction = np.broadcast_to(unit((0.2, 0.1, 1.0)), points.shape)
    origin = points - 40.0 * direction
    order = np.ones(COUNT, dtype=np.int64)
    rays = RayTable(origin, direction, np.full(COUNT, 532.0), order, np.zeros(COUNT, dtype=bool))
    result = trace(spec, rays)
    assert np.all(result.status == Status.OK)
    np.testing.assert_allclose(result.hit_mm, points, atol=1e-12)
    offset = np.array(OBJECT_MM) - result.hit_mm
    aside = np.cross(offset, result.direction)
    assert np.abs(aside).max() < READ_OUT * np.linalg.norm(offset, axis=1).max()
    np.testing.assert_allclose(result.efficiency, 0.5)


def test_outline_and_side_decide_what_is_hit() -> None:
    spec = hologram(CURVED["round"], media={"back": 1.0, "front": 1.5})
    x = np.array([0.0, 19.9, 15.0, 0.0, 0.0])
    y = np.array([0.0, 0.0, 12.0, 14.9, 15.1])
    origin = np.stack((x, y, np.full(5, 30.0)), axis=1)
    direction = np.tile((0.0, 0.0, -1.0), (5, 1))
    zeros = np.zeros(5, dtype=np.int64)
    rays = RayTable(origin, direction, np.full(5, 532.0), zeros, zeros == 1)
    result = trace(spec, rays)
    assert result.status.tolist() == [0, 0, Status.MISS, 0, Status.MISS]
    # From the front, where the index is 1.5, order 0 refracts at the true normal.
    normal = element_shape(spec).normal(mm_to_m(result.hit_mm[1]))
    sines = np.cross(normal, direction[1]) * 1.5, np.cross(normal, result.direction[1])
    np.testing.assert_allclose(*sines, atol=1e-14)


def test_a_crossing_beside_the_element_does_not_shade_it() -> None:
    """The ray passes through the sphere where the element is not, then meets the element."""
    spec = hologram(CURVED["sphere"])
    target = np.array((10.0, 0.0, m_to_mm(float(element_shape(spec).sag(0.01, 0.0)))))
    origin = np.array((-50.0, 0.0, 25.0))
    direction = unit(target - origin)[None]
    beside = m_to_mm(element_shape(spec).intersect(mm_to_m(origin), direction))
    assert beside < 20.0
    zero = np.zeros(1, dtype=np.int64)
    result = trace(spec, RayTable(origin[None], direction, np.full(1, 532.0), zero, zero == 1))
    assert result.status[0] == Status.OK
    np.testing.assert_allclose(result.hit_mm[0], target, atol=1e-12)
    np.testing.assert_allclose(result.direction, direction, atol=1e-14)


def test_order_of_a_grating_on_a_sphere_against_mpmath(rng: np.random.Generator) -> None:
    """Order 2 at another wavelength between two media; the law solved in 40 digits."""
    mpmath.mp.dps = 40
    spec = hologram(CURVED["sphere"], media={"back": 1.0, "front": 1.6})
    points, _ = points_on(spec, rng, 12.0)
    for place in points[:50]:
        incident = unit(rng.normal(size=3) * 0.2 + (0.0, 0.0, 1.0))
        out = fan(spec, place, incident, 450.0, [Branch(2)])
        p = [mpmath.mpf(v) for v in place.tolist()]
        upright = [-p[0] / 55, -p[1] / 55, 1 - p[2] / 55]
        size = mpmath.norm(upright)
        upright = [v / size for v in upright]
        away = [mpmath.mpf(v) - q for v, q in zip(OBJECT_MM, p, strict=True)]
        reach = mpmath.norm(away)
        plane = [mpmath.mpf(v) for v in ("0.2", "0.1", "1")]
        length = mpmath.norm(plane)
        ratio = 2 * mpmath.mpf(450) / 532
        total = [
            mpmath.mpf(i) + ratio * (a / reach - b / length)
            for i, a, b in zip(incident.tolist(), away, plane, strict=True)
        ]
        across = mpmath.fdot(total, upright)
        tangent = [t - across * n for t, n in zip(total, upright, strict=True)]
        rest = mpmath.mpf("1.6") ** 2 - mpmath.fdot(tangent, tangent)
        if rest < 0:
            assert out.status[0] == Status.EVANESCENT
            continue
        expected = [
            (t + mpmath.sqrt(rest) * n) / 1.6 for t, n in zip(tangent, upright, strict=True)
        ]
        np.testing.assert_allclose(out.directions[0], [float(v) for v in expected], atol=1e-13)


@pytest.mark.parametrize("cells", [12, 24, 48])
@pytest.mark.parametrize("refine", [False, True])
def test_mesh_of_a_sphere_is_as_good_as_it_says(
    cells: int, refine: bool, rng: np.random.Generator
) -> None:
    """Traced rays against the sphere itself, for incidence up to 45 degrees."""
    sphere = hologram(CURVED["sphere"])
    facets = rectangle_mesh(Conic(55.0), 40.0, 40.0, cells, cells)
    mesh = hologram(
        {
            "shape": "mesh",
            "vertices_mm": facets.vertices.tolist(),
            "faces": facets.faces.tolist(),
            "normals": facets.normals.tolist(),
            "refine": refine,
        }
    )
    points, normal = points_on(sphere, rng, 19.0)
    aside = unit(np.cross(normal, rng.normal(size=points.shape)))
    tilt = rng.uniform(0.0, np.pi / 4, (COUNT, 1))
    direction = np.cos(tilt) * normal + np.sin(tilt) * aside
    order = rng.choice([-1, 0, 1], COUNT)
    rays = RayTable(points - 9.0 * direction, direction, np.full(COUNT, 532.0), order, order == 5)
    exact, found = trace(sphere, rays), trace(mesh, rays)
    both = (exact.status == Status.OK) & (found.status == Status.OK)
    steep = np.abs(np.sum(exact.direction * normal, axis=1)) > np.sqrt(0.5)
    assert (both & steep).sum() > 300
    error = np.linalg.norm(exact.direction - found.direction, axis=1)[both & steep].max()
    stated = element_mesh(mesh).direction_error
    assert error < stated
    # It is an honest estimate, not one that is always large enough.
    assert error > 0.02 * stated
    if refine and cells > 12:
        assert stated < 1e-4


def test_windshield_from_a_cad_file_images_where_it_should(rng: np.random.Generator) -> None:
    """Normals are made from the faces, so the sheet is known to what its mesh resolves."""
    coarse, fine = (hologram(windshield(cells)) for cells in (24, 96))
    assert element_mesh(coarse).parts > 1
    points, _ = points_on(fine, rng, 30.0)
    direction = np.broadcast_to((0.0, 0.0, 1.0), points.shape)
    order = np.ones(COUNT, dtype=np.int64)
    rays = RayTable(
        points - 20.0 * direction, direction, np.full(COUNT, 532.0), order, np.zeros(COUNT, bool)
    )
    one, other = trace(coarse, rays), trace(fine, rays)
    assert np.all(one.status == other.status)
    apart = np.linalg.norm(one.direction - other.direction, axis=1)
    assert np.nanmax(apart) < element_mesh(coarse).direction_error
