# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes: rays against every triangle one by one, normals, finer meshes, and their error."""

import time

import numpy as np
import pytest
from numpy.typing import NDArray

from hoe_addon.core.errors import SpecError
from hoe_addon.core.shapes import Conic, Cylinder, EvenAsphere, MeshShape, Plane, Shape
from hoe_addon.core.shapes.mesh import smooth_normals
from hoe_addon.core.shapes.refine import facet_departure, patch_departure, refined
from hoe_addon.core.shapes.tessellate import departure_from, ellipse_mesh, rectangle_mesh

SPHERE = Conic(50.0)
ROUNDING = 1e-13
"""A few hundred roundings of float64 over the size of these meshes."""

QUICK = 8.0
"""Seconds for 1e4 rays on 1e4 triangles; measured 0.5 on one core, every pair would take 100."""


def bowl(cells: int, shape: Shape = SPHERE) -> MeshShape:
    return rectangle_mesh(shape, 40.0, 40.0, cells, cells)


def random_rays(
    rng: np.random.Generator, count: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    origin = rng.uniform(-40.0, 40.0, (count, 3))
    aim = rng.uniform(-20.0, 20.0, (count, 3)) * (1.0, 1.0, 0.4)
    direction = aim - origin
    return origin, direction / np.linalg.norm(direction, axis=1, keepdims=True)


def one_by_one(
    mesh: MeshShape, origin: NDArray[np.float64], direction: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Nearest crossing by solving three equations for each ray and each triangle."""
    found = np.full(len(origin), np.inf)
    for corner in mesh.vertices[mesh.faces]:
        matrix = np.stack(
            (
                np.broadcast_to(corner[1] - corner[0], origin.shape),
                np.broadcast_to(corner[2] - corner[0], origin.shape),
                -direction,
            ),
            axis=-1,
        )
        u, v, t = np.linalg.solve(matrix, (origin - corner[0])[..., None])[..., 0].T
        met = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0) & (t >= 0.0)
        found = np.where(met, np.minimum(found, t), found)
    return np.where(np.isinf(found), np.nan, found)


def test_rays_meet_the_same_triangles_as_one_by_one(rng: np.random.Generator) -> None:
    mesh = bowl(9, Conic(-30.0))
    origin, direction = random_rays(rng, 3000)
    expected = one_by_one(mesh, origin, direction)
    np.testing.assert_allclose(mesh.intersect(origin, direction), expected, atol=1e-11)
    assert 0.2 < np.isfinite(expected).mean() < 0.95


def test_no_ray_slips_between_triangles(rng: np.random.Generator) -> None:
    """Aimed exactly at corners and at points of edges."""
    mesh = bowl(12)
    edges = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]]])
    share = rng.random((len(edges), 1))
    points = mesh.vertices[edges[:, 0]] * share + mesh.vertices[edges[:, 1]] * (1.0 - share)
    points = np.concatenate((points, mesh.vertices))
    inside = np.abs(points[:, :2]).max(axis=1) < 19.999
    origin = rng.normal(size=(len(points), 3)) * 3.0 + (0.0, 0.0, 40.0)
    direction = points - origin
    length = np.linalg.norm(direction, axis=1)
    distance = mesh.intersect(origin, direction / length[:, None])
    assert np.isfinite(distance[inside]).all()
    np.testing.assert_allclose(distance[inside], length[inside], rtol=1e-11)


def test_many_rays_on_many_triangles_are_quick(rng: np.random.Generator) -> None:
    mesh = bowl(72)
    assert len(mesh.faces) > 10_000
    origin, direction = random_rays(rng, 10_000)
    start = time.perf_counter()
    distance = mesh.intersect(origin, direction)
    assert time.perf_counter() - start < QUICK
    assert np.isfinite(distance).mean() > 0.2


def test_far_and_level_rays() -> None:
    mesh = bowl(10)
    far = mesh.intersect((3.0, 1.0, -1e9), (0.0, 0.0, 1.0))
    assert far == pytest.approx(1e9 + float(mesh.sag(3.0, 1.0)), abs=1e-6)
    flat = bowl(4, Plane())
    assert np.isnan(flat.intersect((-30.0, 0.1, 0.0), (1.0, 0.0, 0.0)))
    assert np.isnan(flat.intersect((0.0, 0.0, -1.0), (0.0, 0.0, -1.0)))
    assert flat.intersect((0.3, 0.2, 0.0), (0.0, 0.0, 1.0)) == 0.0


def test_normals_on_a_sphere_are_exact(rng: np.random.Generator) -> None:
    """Those of a sphere interpolate to the radius through the point of the facet."""
    mesh = bowl(10)
    origin, direction = random_rays(rng, 2000)
    hit = origin + mesh.intersect(origin, direction)[:, None] * direction
    hit = hit[np.isfinite(hit).all(axis=1)]
    expected = np.array((0.0, 0.0, 50.0)) - hit
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    np.testing.assert_allclose(mesh.normal(hit), expected, atol=ROUNDING)
    assert np.isnan(mesh.normal(hit + np.array((0.0, 0.0, 1e-3)))).all()


def test_height_is_that_of_the_corners() -> None:
    mesh = bowl(7)
    x, y, z = mesh.vertices.T
    np.testing.assert_allclose(mesh.sag(x, y), z, atol=ROUNDING)
    assert np.isnan(mesh.sag(20.1, 0.0))


def test_smooth_normals_of_a_cube_point_to_its_corners() -> None:
    """By angle: how a square is cut in two does not matter."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))])
    expected = corners / np.sqrt(3.0)
    np.testing.assert_allclose(smooth_normals(corners, faces), expected, atol=ROUNDING)


@pytest.mark.parametrize("parts", [1, 2, 3, 7])
def test_a_finer_mesh_keeps_corners_and_has_no_gap(parts: int) -> None:
    mesh = bowl(4)
    fine = refined(mesh, parts)
    count = len(mesh.vertices)
    np.testing.assert_array_equal(fine.vertices[:count], mesh.vertices)
    np.testing.assert_array_equal(fine.normals[:count], mesh.normals)
    assert len(fine.faces) == parts**2 * len(mesh.faces)
    assert len(fine.vertices) == (4 * parts + 1) ** 2
    ways = {
        tuple(pair) for face in fine.faces for pair in zip(face, np.roll(face, -1), strict=True)
    }
    assert len(ways) == 3 * len(fine.faces)
    open_edges = sum((end, start) not in ways for start, end in ways)
    assert open_edges == 4 * 4 * parts
    corner = fine.vertices[fine.faces]
    across = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    assert np.all(np.sum(across * fine.normals[fine.faces[:, 0]], axis=1) > 0.0)


CURVED = {
    "sphere": Conic(50.0),
    "paraboloid": Conic(-40.0, -1.0),
    "cylinder": Cylinder(45.0, "y"),
    "asphere": EvenAsphere(60.0, 0.0, (2e-6,), 29.0),
}


@pytest.mark.parametrize("name", CURVED)
@pytest.mark.parametrize("parts", [1, 2, 4])
def test_stated_departure_covers_the_true_one(name: str, parts: int) -> None:
    """Displacement and normals of the facets against the shape that the mesh was made from."""
    shape = CURVED[name]
    mesh = bowl(16, shape)
    fine = refined(mesh, parts)
    stated = facet_departure(mesh).of_finer(parts).on_top_of(patch_departure(mesh))
    corner = fine.vertices[fine.faces]
    shares = np.array([[1, 1, 1], [1.5, 1.5, 0], [0, 1.5, 1.5], [1.5, 0, 1.5], [2, 0.5, 0.5]]) / 3
    place = np.einsum("kc,fcx->fkx", shares, corner).reshape(-1, 3)
    smooth = np.einsum("kc,fcx->fkx", shares, fine.normals[fine.faces]).reshape(-1, 3)
    smooth /= np.linalg.norm(smooth, axis=1, keepdims=True)
    # The nearest point of the shape, up to the square of the distance.
    x, y = place[:, 0], place[:, 1]
    with np.errstate(invalid="ignore"):
        normal = shape.normal(np.stack((x, y, shape.sag(x, y)), axis=1))
        height = np.abs(place[:, 2] - shape.sag(x, y)) * normal[:, 2]
    assert np.nanmax(height) <= stated.displacement
    foot = place + (shape.sag(x, y) - place[:, 2])[:, None] * normal[:, 2:] * normal
    angle = np.linalg.norm(smooth - shape.normal(foot), axis=1)
    assert np.nanmax(angle) <= stated.angle + 0.1 * stated.displacement


def test_equilateral_triangles_depart_most_in_their_middle() -> None:
    """Of a sphere made from an octahedron: by a third more than the middle of an edge."""
    points = np.concatenate((np.eye(3), -np.eye(3)))
    faces = [(a, b, c) for a in (0, 3) for b in (1, 4) for c in (2, 5)]
    faces = [f if (sum(v > 2 for v in f) % 2 == 0) else (f[0], f[2], f[1]) for f in faces]
    fine = refined(MeshShape(points, np.array(faces), points), 6)
    round_points = fine.vertices / np.linalg.norm(fine.vertices, axis=1, keepdims=True)
    ball = MeshShape(round_points, fine.faces, round_points)
    middles = ball.vertices[ball.faces].mean(axis=1)
    departure = np.max(1.0 - np.linalg.norm(middles, axis=1))
    stated = facet_departure(ball).on_top_of(patch_departure(ball)).displacement
    assert departure <= stated < 1.3 * departure


def test_departure_falls_with_the_square_of_the_parts() -> None:
    coarse = departure_from(SPHERE, bowl(8))
    assert departure_from(SPHERE, bowl(16)) == pytest.approx(coarse / 4.0, rel=0.05)
    # Near the vertex the diagonal of a cell of 2 mm has a sagitta of d^2 / 8 R.
    near = departure_from(SPHERE, rectangle_mesh(SPHERE, 4.0, 4.0, 2, 2))
    assert near == pytest.approx(8.0 / (8.0 * 50.0), rel=0.01)
    assert departure_from(Plane(), bowl(3, Plane())) == 0.0
    assert facet_departure(bowl(3, Plane())).displacement < ROUNDING


def test_a_round_element_covers_its_ellipse() -> None:
    mesh = ellipse_mesh(Conic(60.0), 40.0, 20.0, 5)
    corner = mesh.vertices[mesh.faces][..., :2]
    edge, other = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    areas = 0.5 * (edge[:, 0] * other[:, 1] - edge[:, 1] * other[:, 0])
    assert np.all(areas > 0.0)
    # 256 chords miss 1e-4 of the ellipse.
    assert areas.sum() == pytest.approx(np.pi * 20.0 * 10.0, rel=1.1e-4)
    rim = np.hypot(mesh.vertices[:, 0] / 20.0, mesh.vertices[:, 1] / 10.0)
    assert rim.max() == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        ([(0, 0, 0)], np.zeros((0, 3), int), "faces: must not be empty"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 3)], r"faces\[0\]: must be from 0 to 2"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, -1)], r"faces\[0\]: must be from 0 to 2"),
        ([(0, 0, 0), (1, np.nan, 0), (0, 1, 0)], [(0, 1, 2)], r"vertices\[1\]: must be finite"),
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)], r"faces\[0\]: must have an area"),
        ([(0, 0), (1, 0), (2, 0)], [(0, 1, 2)], "must be rows of three numbers"),
    ],
)
def test_what_is_no_mesh_is_refused(vertices: object, faces: object, message: str) -> None:
    points = np.array(vertices, dtype=float)
    with pytest.raises(SpecError, match=message):
        MeshShape(
            points, np.array(faces), np.zeros_like(points) + (0.0, 0.0, 1.0)[: points.shape[1]]
        )
