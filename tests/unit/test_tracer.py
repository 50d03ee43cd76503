# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tracer: frames, apertures, sequences forward and back, and the splitting walk."""

from collections.abc import Sequence

import numpy as np
import pytest

from hoe_addon.core import media
from hoe_addon.core.arrays import FloatArray, unit
from hoe_addon.core.characteristic import LinearGrating
from hoe_addon.core.efficiency import Incidence, Polarization
from hoe_addon.core.efficiency.constant import ConstantShares
from hoe_addon.core.errors import SpecError
from hoe_addon.core.fresnel import reflectance_unpolarised
from hoe_addon.core.orders import REFLECTED_ZERO, TRANSMITTED_ZERO, Branch
from hoe_addon.core.ray_law import Status
from hoe_addon.core.recording import Recording
from hoe_addon.core.tracer import (
    Absorber,
    Aperture,
    Circle,
    Dielectric,
    EnergyBalance,
    Frame,
    Grating,
    IdealLens,
    Mirror,
    PlanarSurface,
    Rays,
    Receiver,
    Rectangle,
    Step,
    walk_sequence,
    walk_sequence_backward,
    walk_tree,
)
from hoe_addon.core.waves import PlaneWave, PointSource

AIR = media.by_name("air")
GLASS = media.constant(1.5)
GREEN = 532e-9
WIDE = Aperture(Rectangle(1.0, 1.0))
ENERGY = 1e-9
"""Sums of up to 1e5 weights; their rounding is a thousand times smaller."""
RETURN = 1e-12
"""Metres and components: paths of 0.1 m, with rounding amplified by 1 / cos < 100."""
EXACT = 1e-14
"""Some ten roundings of lengths below 0.1 m and of direction components."""


class EqualShares:
    """The same share for every branch."""

    def __init__(self, share: float) -> None:
        self.share = share

    def shares(
        self,
        branches: Sequence[Branch],
        light: Incidence,
        polarization: Polarization = Polarization.UNPOLARISED,
    ) -> FloatArray:
        return np.full((*light.shape, len(branches)), self.share)


def grating(frame: Frame, frequency: float, aperture: Aperture = WIDE, **changes) -> Grating:
    settings = {
        "pattern": LinearGrating((frequency, 0.0)),
        "index_back": AIR,
        "index_front": AIR,
        "branches": (Branch(1),),
        "efficiency": EqualShares(1.0),
    }
    return Grating(frame=frame, aperture=aperture, **(settings | changes))


def slab(thickness: float = 1e-3, aperture: Aperture = WIDE) -> list[PlanarSurface]:
    """A plate from z = 0 to z = thickness; both fronts look out of the glass."""
    bottom = Frame.at((0, 0, 0), normal=(0, 0, -1))
    top = Frame.at((0, 0, thickness))
    return [
        Dielectric(frame=frame, aperture=aperture, index_back=GLASS, index_front=AIR)
        for frame in (bottom, top)
    ]


def receiver(height: float, aperture: Aperture = WIDE) -> Receiver:
    return Receiver(frame=Frame.at((0, 0, height)), aperture=aperture)


def parts(energy: EnergyBalance) -> float:
    return energy.landed + energy.absorbed + energy.escaped + energy.pruned


class TestGeometry:
    @pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (1, -2, 3), (-9, 1, 0)])
    def test_frame_round_trip(self, normal: tuple[int, ...], rng: np.random.Generator) -> None:
        frame = Frame.at((0.1, -0.2, 0.3), normal)
        points = rng.normal(size=(2, 5, 3))
        np.testing.assert_allclose(frame.vector_to_world(np.array([0, 0, 1.0])), unit(normal))
        back = frame.point_to_local(frame.point_to_world(points))
        np.testing.assert_allclose(back, points, atol=EXACT)
        turned = frame.vector_to_local(frame.vector_to_world(points))
        np.testing.assert_allclose(turned, points, atol=EXACT)

    def test_frame_axes(self) -> None:
        np.testing.assert_array_equal(Frame.at((0, 0, 0)).rotation, np.eye(3))
        frame = Frame.at((0, 0, 0), (0, 0, 1), x_axis=(0, 2, 5))
        np.testing.assert_allclose(frame.rotation[:, 0], [0, 1, 0], atol=EXACT)

    def test_frame_must_be_a_rotation(self) -> None:
        for matrix in (np.diag([1.0, 1.0, -1.0]), 2 * np.eye(3), np.full((3, 3), np.nan)):
            with pytest.raises(SpecError, match=r"^rotation: must be a rotation matrix"):
                Frame(np.zeros(3), matrix)

    def test_holes_are_filled_without_gap_or_overlap(self) -> None:
        patch = Rectangle(0.2, 0.4, centre=(0.1, 0.0))
        disc = Circle(0.1, centre=(-0.3, 0.0))
        face = Aperture(Rectangle(1.0, 1.0), holes=(patch, disc))
        edges = np.linspace(-0.5, 0.5, 41)
        points = np.stack([*np.meshgrid(edges, edges), np.zeros((41, 41))], axis=-1)
        covers = [face, Aperture(patch), Aperture(disc)]
        count = sum(cover.contains(points).astype(int) for cover in covers)
        assert (count == 1).all()
        outside = np.array([[0.51, 0.0, 0.0], [0.0, -0.6, 0.0], [np.nan, 0.0, 0.0]])
        assert not face.contains(outside).any()

    def test_rays_broadcast_and_normalise(self) -> None:
        rays = Rays.of((0, 0, 0), [[0, 0, 2], [0, 3, 4]], [GREEN, 2 * GREEN])
        assert rays.position.shape == rays.direction.shape == (2, 3)
        np.testing.assert_allclose(rays.direction[1], [0.0, 0.6, 0.8])
        assert rays.weight.tolist() == [1.0, 1.0]
        assert Rays.of((0, 0, 0), (0, 0, 1), GREEN).wavelength.shape == (1,)


class TestLens:
    @pytest.mark.parametrize("side", [1.0, -1.0])
    def test_focal_plane_is_collimated_exactly(self, side: float, rng: np.random.Generator) -> None:
        focal = 0.02
        lens = IdealLens(frame=Frame.at((0, 0, 0)), aperture=WIDE, focal_length=focal)
        source = np.array([0.004, -0.003, -side * focal])
        rays = Rays.of(source, rng.normal(size=(40, 3)) * [0.1, 0.1, 0] + [0, 0, side], GREEN)
        walk = walk_sequence(rays, [Step(lens)])
        through_centre = np.broadcast_to(unit(-source), (40, 3))
        np.testing.assert_allclose(walk.rays.direction, through_centre, atol=EXACT)
        assert (walk.status == Status.OK).all()

    def test_images_by_the_lens_equation(self, rng: np.random.Generator) -> None:
        lens = IdealLens(frame=Frame.at((0, 0, 0)), aperture=WIDE, focal_length=0.02)
        screen = receiver(0.06)
        rays = Rays.of((0.001, 0, -0.03), rng.normal(size=(40, 3)) * 0.05 + [0, 0, 1], GREEN)
        walk = walk_sequence(rays, [Step(lens), Step(screen)])
        expected = np.broadcast_to([-0.002, 0, 0.06], (40, 3))
        np.testing.assert_allclose(walk.hits[1], expected, atol=EXACT)


class TestSequence:
    def device(self) -> list[Step]:
        """A lens, a plate with an in-coupler, two bounces, an out-coupler, and a mirror."""
        recording = Recording(
            PlaneWave((np.sin(np.radians(55.0)), 0.0, np.cos(np.radians(55.0))), 1.5),
            PointSource((0.0, 0.001, -0.3)),
            GREEN,
        )
        lens = IdealLens(frame=Frame.at((0, 0, -0.03)), aperture=WIDE, focal_length=0.05)
        coupler = grating(
            Frame.at((0, 0, 0)), 0.0, pattern=recording, index_front=GLASS, branches=(Branch(1),)
        )
        bottom, top = slab(1e-3)
        out = grating(
            Frame.at((0.005, 0, 0), normal=(0, 0, -1), x_axis=(1, 0, 0)),
            -1.5 * np.sin(np.radians(55.0)) / GREEN,
            index_back=GLASS,
            branches=(Branch(1, reflected=True),),
        )
        mirror = Mirror(frame=Frame.at((0.005, 0, 0.1), normal=(1, 0, -4)), aperture=WIDE)
        return [
            Step(lens),
            Step(coupler, order=1),
            Step(top, reflected=True),
            Step(bottom, reflected=True),
            Step(top, reflected=True),
            Step(out, order=1, reflected=True),
            Step(top),
            Step(mirror, reflected=True),
        ]

    def launched(self, rng: np.random.Generator) -> Rays:
        start = np.column_stack([rng.uniform(-1e-3, 1e-3, (200, 2)), np.full(200, -0.05)])
        heading = np.column_stack([rng.uniform(-0.02, 0.02, (200, 2)), np.ones(200)])
        return Rays.of(start, heading, rng.uniform(500e-9, 560e-9, 200))

    def test_backward_walk_returns_to_the_start(self, rng: np.random.Generator) -> None:
        rays, steps = self.launched(rng), self.device()
        forward = walk_sequence(rays, steps)
        assert (forward.status == Status.OK).all()
        # Start the way back beyond the last surface, as an eye does.
        ahead = forward.rays.position + 0.03 * forward.rays.direction
        last = Rays.of(ahead, forward.rays.direction, rays.wavelength)
        back = walk_sequence_backward(last, steps)
        assert (back.status == Status.OK).all()
        np.testing.assert_allclose(back.hits, forward.hits[::-1], atol=RETURN)
        np.testing.assert_allclose(back.rays.direction, -rays.direction, atol=RETURN)
        reach = np.linalg.norm(rays.position - back.rays.position, axis=1)[:, None]
        arrived = back.rays.position + reach * back.rays.direction
        np.testing.assert_allclose(arrived, rays.position, atol=RETURN)

    def test_backward_walk_may_start_on_the_last_surface(self, rng: np.random.Generator) -> None:
        rays, steps = self.launched(rng), self.device()
        back = walk_sequence_backward(walk_sequence(rays, steps).rays, steps)
        np.testing.assert_allclose(back.rays.direction, -rays.direction, atol=RETURN)

    def test_each_ray_has_its_status(self) -> None:
        small = Aperture(Circle(0.01))
        first = grating(Frame.at((0, 0, 0)), 1.2 / GREEN, small, index_front=GLASS)
        screen = receiver(0.01, Aperture(Rectangle(0.02, 0.02)))
        rays = Rays.of(
            [
                [0, 0, -1e-3],
                [0, 0, -1e-3],
                [0.1, 0, -1e-3],
                [0, 0, 1e-3],
                [0, 0, -1e-3],
                [0, 0, -1],
            ],
            [[-0.5, 0, 1], [1, 0, 1], [0, 0, 1], [0, 0, 1], [1, 0, 0], [0, 0, np.nan]],
            GREEN,
        )
        walk = walk_sequence(rays, [Step(first, order=1), Step(screen)])
        assert walk.status.tolist() == [
            Status.OK,
            Status.EVANESCENT,
            Status.MISS,
            Status.MISS,
            Status.MISS,
            Status.UNDEFINED,
        ]
        assert np.isnan(walk.rays.direction[1:]).all()
        assert np.isnan(walk.rays.position[1:]).all()
        assert np.isfinite(walk.hits[0, :2]).all()
        assert np.isnan(walk.hits[1, 1:]).all()

    def test_a_miss_behind_a_good_hit(self) -> None:
        screen = receiver(1.0, Aperture(Circle(0.1)))
        first = grating(Frame.at((0, 0, 0)), 0.5 / GREEN)
        rays = Rays.of((0, 0, -1e-3), (0, 0, 1), GREEN)
        walk = walk_sequence(rays, [Step(first, order=1), Step(screen)])
        assert walk.status.tolist() == [Status.MISS]

    def test_total_reflection_stops_a_transmitted_step(self) -> None:
        top = slab()[1]
        rays = Rays.of((0, 0, 0.5e-3), (1, 0, 1), GREEN)
        assert walk_sequence(rays, [Step(top)]).status.tolist() == [Status.EVANESCENT]
        assert walk_sequence(rays, [Step(top, reflected=True)]).status.tolist() == [Status.OK]

    def test_point_on_its_source_is_undefined(self) -> None:
        recording = Recording(PointSource((0, 0, 0)), PlaneWave((0, 0, 1)), GREEN)
        plate = grating(Frame.at((0, 0, 1)), 0.0, pattern=recording)
        rays = Rays.of([[0, 0, 0], [0.1, 0, 0]], (0, 0, 1), GREEN)
        walk = walk_sequence(rays, [Step(plate, order=1)])
        assert walk.status.tolist() == [Status.UNDEFINED, Status.OK]


class TestTree:
    @pytest.mark.parametrize("angle", [0.0, 30.0, 56.3, 80.0])
    def test_lossless_slab_sums_to_the_fresnel_series(self, angle: float) -> None:
        heading = (np.sin(np.radians(angle)), 0.0, np.cos(np.radians(angle)))
        rays = Rays.of((0, 0, -1e-3), heading, GREEN, 2.0)
        walk = walk_tree(rays, slab(), receiver(0.01), weight_cut=1e-13)
        single = float(reflectance_unpolarised(heading[2], 1.0, 1.5))
        # Each face reflects by s and p apart in truth; the tracer's light is unpolarised anew.
        assert walk.energy.landed == pytest.approx(2.0 * (1 - single) / (1 + single), abs=ENERGY)
        assert walk.energy.escaped == pytest.approx(4.0 * single / (1 + single), abs=ENERGY)
        assert walk.energy.absorbed == pytest.approx(0.0, abs=ENERGY)
        np.testing.assert_allclose(
            walk.landed.direction, np.broadcast_to(heading, walk.landed.direction.shape), atol=EXACT
        )
        assert walk.landed.interactions[0] == 2
        assert walk.landed.weight.sum() == pytest.approx(walk.energy.landed, abs=ENERGY)

    def test_energy_is_booked_whatever_happens(self, rng: np.random.Generator) -> None:
        hole = Circle(0.004, centre=(0.003, 0.0))
        bottom, top = slab(aperture=Aperture(Rectangle(0.03, 0.03), holes=(hole,)))
        patch = grating(
            top.frame,
            1.1 / GREEN,
            Aperture(hole),
            index_back=GLASS,
            branches=(Branch(1), Branch(-1), TRANSMITTED_ZERO, Branch(1, True), Branch(-1, True)),
            efficiency=EqualShares(0.18),
            total_internal_reflection=True,
        )
        black = Absorber(
            frame=Frame.at((0.015, 0, 0), normal=(1, 0, 0)), aperture=Aperture(Rectangle(1, 0.01))
        )
        silver = Mirror(
            frame=Frame.at((-0.02, 0, 0), normal=(1, 0, 0)), aperture=WIDE, reflectance=0.9
        )
        count = 100
        start = np.column_stack([rng.uniform(-0.01, 0.01, (count, 2)), np.full(count, -0.002)])
        rays = Rays.of(
            start, rng.normal(size=(count, 3)) * 0.4 + [0, 0, 1], GREEN, rng.uniform(1, 5, count)
        )
        scene = [bottom, top, patch, black, silver]
        walk = walk_tree(rays, scene, receiver(0.02), weight_cut=1e-3, max_interactions=12)
        energy = walk.energy
        assert energy.launched == pytest.approx(rays.weight.sum())
        assert parts(energy) == pytest.approx(energy.launched, rel=ENERGY)
        assert min(energy.landed, energy.absorbed, energy.escaped, energy.pruned) > 0.0
        assert np.isfinite(walk.landed.position).all()
        assert (walk.landed.weight > 0.0).all()

    def test_lossless_scene_loses_nothing(self, rng: np.random.Generator) -> None:
        rays = Rays.of((0, 0, -1e-3), rng.normal(size=(50, 3)) * 0.4 + [0, 0, 1], GREEN)
        energy = walk_tree(rays, slab(), receiver(0.01), weight_cut=1e-12).energy
        assert energy.absorbed == pytest.approx(0.0, abs=ENERGY)
        assert energy.landed + energy.escaped == pytest.approx(energy.launched, rel=ENERGY)

    def test_nearest_surface_wins_and_rays_keep_their_names(self) -> None:
        near = Absorber(frame=Frame.at((0, 0, 1)), aperture=Aperture(Rectangle(1, 1, (0.5, 0))))
        rays = Rays.of(
            [[-0.2, 0.1, 0], [0.2, 0, 0], [-0.1, 0, 0]], (0, 0, 1), [1e-6, 2e-6, 3e-6], [1, 2, 3]
        )
        walk = walk_tree(rays, [near], receiver(2.0))
        assert walk.landed.ray_id.tolist() == [0, 2]
        assert walk.landed.wavelength.tolist() == [1e-6, 3e-6]
        assert walk.landed.weight.tolist() == [1.0, 3.0]
        np.testing.assert_allclose(walk.landed.position, [[-0.2, 0.1], [-0.1, 0.0]])
        assert walk.energy.absorbed == 2.0

    def test_without_surfaces_rays_land_or_escape(self) -> None:
        rays = Rays.of((0, 0, 0), [[0, 0, 1], [0, 0, -1]], GREEN)
        energy = walk_tree(rays, [], receiver(1.0)).energy
        assert (energy.landed, energy.escaped) == (1.0, 1.0)

    def test_endless_bounces_end_at_the_limit(self) -> None:
        mirrors = [Mirror(frame=Frame.at((0, 0, z)), aperture=WIDE) for z in (0.0, 1.0)]
        rays = Rays.of((0, 0, 0.5), (0, 0, 1), GREEN)
        energy = walk_tree(rays, mirrors, receiver(2.0), max_interactions=7).energy
        assert energy.pruned == 1.0

    def test_reflected_grating_order_and_sequence_agree(self, rng: np.random.Generator) -> None:
        plate = grating(
            Frame.at((0, 0, 0.01), normal=(0.1, 0.2, 1)),
            0.3 / GREEN,
            branches=(Branch(2), REFLECTED_ZERO, Branch(-1, True)),
            efficiency=EqualShares(0.25),
        )
        rays = Rays.of((0, 0, 0), rng.normal(size=(30, 3)) * 0.1 + [0, 0, 1], GREEN)
        screen = receiver(0.02)
        tree = walk_tree(rays, [plate], screen).landed
        single = walk_sequence(rays, [Step(plate, order=2), Step(screen)])
        np.testing.assert_allclose(
            tree.position[np.argsort(tree.ray_id)], single.hits[1][:, :2], atol=EXACT
        )
        assert (tree.weight == 0.25).all()


class TestGuide:
    """A plate of glass with gratings on its top face."""

    THICKNESS = 0.5e-3
    ANGLE = np.radians(60.0)

    def run(self, shares: list[float], patch_width: float) -> tuple[np.ndarray, np.ndarray]:
        """Return position and weight of the pupils that leave a row of patches."""
        pitch = 2 * self.THICKNESS * np.tan(self.ANGLE)
        bottom = slab(self.THICKNESS)[0]
        patches = [
            grating(
                Frame.at((number * pitch, 0, self.THICKNESS)),
                -1.5 * np.sin(self.ANGLE) / GREEN,
                Aperture(Rectangle(patch_width, 1e-2)),
                index_back=GLASS,
                branches=(Branch(1), TRANSMITTED_ZERO),
                efficiency=ConstantShares({Branch(1): share, TRANSMITTED_ZERO: 1.0 - share}),
                total_internal_reflection=True,
            )
            for number, share in enumerate(shares)
        ]
        heading = (np.sin(self.ANGLE), 0, np.cos(self.ANGLE))
        start = (-0.25 * pitch, 0, 0.5 * self.THICKNESS)
        rays = Rays.of(start, heading, GREEN)
        end = Absorber(
            frame=Frame.at(((len(shares) - 0.75) * pitch, 0, 0), normal=(1, 0, 0)),
            aperture=Aperture(Rectangle(4 * self.THICKNESS, 1e-2)),
        )
        scene = [bottom, *patches, end]
        landed = walk_tree(rays, scene, receiver(0.01), weight_cut=1e-9).landed
        np.testing.assert_allclose(np.abs(landed.direction[:, :2]), 0.0, atol=EXACT)
        order = np.argsort(landed.position[:, 0])
        return landed.position[order, 0], landed.weight[order]

    def test_constant_share_falls_off_geometrically(self) -> None:
        share = 0.2
        places, weights = self.run([share] * 9, 0.9e-3)
        pitch = 2 * self.THICKNESS * np.tan(self.ANGLE)
        np.testing.assert_allclose(weights, share * (1 - share) ** np.arange(9), atol=EXACT)
        np.testing.assert_allclose(places, pitch * np.arange(9), atol=EXACT)

    def test_equal_pupils_need_growing_shares(self) -> None:
        count = 7
        _places, weights = self.run([1 / (count - k) for k in range(count)], 0.9e-3)
        np.testing.assert_allclose(weights, 1 / count, atol=EXACT)
