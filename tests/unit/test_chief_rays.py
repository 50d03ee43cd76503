# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Chief rays for drawings: their places and directions are those of the reference tracers."""

import itertools
from typing import Any

import msgspec
import numpy as np
import pytest

from hoe_addon.core import tracer
from hoe_addon.core.units import m_to_mm, mm_to_m, nm_to_m
from hoe_addon.model.chief_rays import Orders, Pieces, chief_rays, chief_wavelengths_nm
from hoe_addon.model.chief_rays.pieces import NO_PARENT
from hoe_addon.model.device import LightGuideSpec
from hoe_addon.model.device_surfaces import DeviceSurfaces, surfaces_of
from hoe_addon.model.document import load_device
from hoe_addon.model.scene import SceneSpec
from hoe_addon.model.scene_lens import LensElement
from hoe_addon.model.scene_lens_walk import through_lens
from hoe_addon.model.scene_parts import HologramElement
from hoe_addon.model.scene_view import pass_hologram, rotation_of

AGREE = 1e-9
"""Of unit vectors, and of places in mm: far above rounding, far below what a line can show."""

GUIDES = ("two_hologram_ar", "three_hologram_ar")


def guide(name: str, *changes: str) -> LightGuideSpec:
    spec = load_device(name, list(changes))
    assert isinstance(spec, LightGuideSpec)
    return spec


def scene(name: str) -> SceneSpec:
    spec = load_device(name)
    assert isinstance(spec, SceneSpec)
    return spec


def ways_to_display(pieces: Pieces) -> list[list[int]]:
    """Numbers of the pieces of each ray that ends on the display, from the eye on."""
    inner = set(pieces.parent.tolist())
    found: list[list[int]] = []
    for leaf in range(len(pieces.nm)):
        if leaf not in inner and not pieces.is_open[leaf]:
            way = [leaf]
            while pieces.parent[way[-1]] != NO_PARENT:
                way.append(int(pieces.parent[way[-1]]))
            found.append(way[::-1])
    return found


def corners_of(pieces: Pieces, way: list[int]) -> Any:
    """All places of a ray, from the eye on; its pieces hang together."""
    for first, second in itertools.pairwise(way):
        assert np.array_equal(pieces.ends_mm[first, 1], pieces.ends_mm[second, 0])
    return np.array([pieces.ends_mm[way[0], 0], *(pieces.ends_mm[each, 1] for each in way)])


def steps_along(spec: LightGuideSpec, device: DeviceSurfaces, hits_mm: Any) -> list[tracer.Step]:
    """What the reference tracer has to follow: light runs along these places in the guide."""
    steps: list[tracer.Step] = []
    ways = np.diff(hits_mm, axis=0)
    for place, before, after in zip(hits_mm[1:-1], ways[:-1], ways[1:], strict=True):
        before, after = before / np.linalg.norm(before), after / np.linalg.norm(after)
        eye_side = abs(place[2] - spec.guide.face_z_mm("eye")) < 1e-6
        mirrored = bool(np.allclose(after, before * (1.0, 1.0, -1.0), atol=1e-9))
        surface: tracer.PlanarSurface = device.parts[0 if eye_side else 1]
        for number, patch in enumerate(spec.holograms):
            on_face = eye_side == (patch.face == "eye")
            offset = np.abs(place[:2] - patch.center_mm)
            if on_face and np.all(offset <= np.asarray(patch.size_mm) / 2.0):
                surface = device.parts[2 + number]
        order = 0 if mirrored else 1
        steps.append(tracer.Step(surface, order, reflected=bool(before[2] * after[2] < 0.0)))
    return steps


@pytest.mark.parametrize("name", GUIDES)
@pytest.mark.parametrize("eye_mm", [(0.0, 0.0, 0.0), (3.0, 1.5, 2.0)])
def test_reference_tracer_takes_light_of_the_display_to_the_pupil(name: str, eye_mm: Any) -> None:
    spec = guide(name, f"eye.position_mm={list(eye_mm)}")
    device = surfaces_of(spec)
    pieces = chief_rays(spec, Orders(1, 1), corners=True)
    ways = ways_to_display(pieces)
    assert len(ways) >= 10
    for way in ways:
        places_mm = corners_of(pieces, way)[::-1]
        display, lens = places_mm[:2]
        start = tracer.Rays.of(mm_to_m(display), lens - display, nm_to_m(pieces.nm[way[0]]))
        steps = [tracer.Step(device.lens), *steps_along(spec, device, places_mm[1:])]
        walk = tracer.walk_sequence(start, steps)
        assert np.all(walk.status == 0)
        hits_mm = m_to_mm(walk.hits[:, 0])
        assert np.max(np.abs(hits_mm - places_mm[1:-1])) < AGREE
        # Straight on from the last hit, the middle of the pupil is met.
        to_eye = np.asarray(eye_mm) - hits_mm[-1]
        assert np.max(np.abs(to_eye / np.linalg.norm(to_eye) - walk.rays.direction[0])) < AGREE


@pytest.mark.parametrize("name", GUIDES)
def test_middle_and_corners_of_the_display_are_where_they_are_seen(name: str) -> None:
    spec = guide(name)
    pieces = chief_rays(spec, Orders(0, 1), corners=True)
    x, y = spec.patch(spec.source.patch).center_mm
    half = np.asarray(spec.display.size_mm) / 2.0
    shares = [(0, 0), (-1, -1), (1, -1), (1, 1), (-1, 1)]
    colours = len(chief_wavelengths_nm(spec))
    for way in ways_to_display(pieces):
        wanted = np.asarray(shares[pieces.root[way[0]] // colours]) * half
        end = pieces.ends_mm[way[-1], 1]
        assert np.allclose(end[:2] - (x, y), wanted, atol=AGREE)
        first = pieces.ends_mm[way[0]]
        assert np.array_equal(first[0], spec.eye.position_mm)
        seen = (first[1] - first[0])[:2] / -(first[1] - first[0])[2]
        assert np.allclose(seen, wanted / spec.lens.focal_length_mm, atol=AGREE)


def test_two_hologram_middle_gets_through_in_green() -> None:
    pieces = chief_rays(guide("two_hologram_ar"), Orders(0, 1))
    ways = ways_to_display(pieces)
    assert 532.0 in [round(float(pieces.nm[way[0]])) for way in ways]
    assert all(len(way) > 6 for way in ways), "total reflections are drawn"


def test_picture_that_is_turned_by_the_holograms_is_aimed_at_anew() -> None:
    spec = guide("two_hologram_ar")
    out = spec.holograms[1]
    assert out.recording is not None
    turned = msgspec.structs.replace(
        out.recording, object=msgspec.structs.replace(out.recording.object, direction=(0.02, 0, 1))
    )
    holograms = (spec.holograms[0], msgspec.structs.replace(out, recording=turned))
    spec = msgspec.structs.replace(spec, holograms=holograms)
    pieces = chief_rays(spec, Orders(0, 1), corners=True)
    x, y = spec.patch(spec.source.patch).center_mm
    half = np.asarray(spec.display.size_mm) / 2.0
    ways = ways_to_display(pieces)
    assert ways
    for way in ways:
        share = (pieces.ends_mm[way[-1], 1, :2] - (x, y)) / half
        assert np.min(np.abs(np.abs(share) - np.round(np.abs(share)))) < 1e-6
        assert np.all(np.abs(np.abs(share) - np.round(np.abs(share))) < 1e-6)


@pytest.mark.parametrize("name", GUIDES)
def test_order_0_goes_straight_through_the_guide(name: str) -> None:
    pieces = chief_rays(guide(name), Orders(0, 0))
    assert not ways_to_display(pieces)
    ways = np.diff(pieces.ends_mm[pieces.is_open], axis=1)[:, 0]
    assert len(ways)
    assert np.allclose(ways / np.linalg.norm(ways, axis=1)[:, None], (0, 0, -1), atol=AGREE)
    assert not chief_rays(guide(name), Orders(1, 1)).is_open.any()


@pytest.mark.parametrize(
    "name", ["point_lens", "holographic_sight", "hud_combiner", "grating_rainbow", "compact_disc"]
)
def test_scene_goes_on_as_the_model_says(name: str) -> None:
    spec = scene(name)
    pieces = chief_rays(spec, Orders(-2, 2), corners=True)
    elements = [each for each in spec.elements if isinstance(each, HologramElement)]
    assert len(elements) == 1
    listed = elements[0].hologram.efficiency.branches(
        elements[0].hologram.orders, elements[0].hologram.pattern.wavelength_nm
    )
    behind = np.flatnonzero(pieces.parent != NO_PARENT)
    checked = 0
    for reflected in {way.reflected for way in listed}:
        for order in set(pieces.order[behind].tolist()):
            own = behind[pieces.order[behind] == order]
            before = pieces.ends_mm[pieces.parent[own]]
            way = np.diff(before, axis=1)[:, 0]
            way /= np.linalg.norm(way, axis=1)[:, None]
            hit, onward = pass_hologram(
                elements[0], before[:, 0], way, pieces.nm[own], order, reflected=reflected
            )
            after = np.diff(pieces.ends_mm[own], axis=1)[:, 0]
            after /= np.linalg.norm(after, axis=1)[:, None]
            front = np.asarray(rotation_of(elements[0]))[:, 2]
            same = (np.sum(after * front, axis=1) * np.sum(way * front, axis=1) < 0) == reflected
            checked += int(same.sum())
            assert np.max(np.abs(onward[same] - after[same]), initial=0.0) < AGREE
            assert np.max(np.abs(hit[same] - before[same, 1]), initial=0.0) < AGREE
    assert checked == len(behind)


def test_lens_goes_on_as_the_model_says() -> None:
    spec = scene("diffractive_achromat")
    pieces = chief_rays(spec, Orders(1, 1), corners=True)
    lens = next(
        each
        for each in spec.elements
        if isinstance(each, LensElement) and (each.front.hologram or each.back.hologram)
    )
    turn, origin = rotation_of(lens), np.asarray(lens.position_mm)
    ends = (pieces.ends_mm - origin) @ turn
    inside = np.flatnonzero(
        (np.abs(ends).max(axis=(1, 2)) <= lens.diameter_mm) & (pieces.parent != NO_PARENT)
    )
    checked = 0
    for last in np.flatnonzero(np.isin(pieces.parent, inside)):
        within = pieces.parent[last]
        first = ends[pieces.parent[within]]
        way = (first[1] - first[0]) / np.linalg.norm(first[1] - first[0])
        face = "front" if lens.front.hologram else "back"
        _, out = through_lens(lens, first[:1], way[None], pieces.nm[last : last + 1], {face: 1})
        after = ends[last, 1] - ends[last, 0]
        if np.isfinite(out).all() and pieces.order[last] == 1:
            assert np.max(np.abs(after / np.linalg.norm(after) - out[0])) < AGREE
            checked += 1
    assert checked >= 5


def test_wavelengths_are_those_of_the_light() -> None:
    assert chief_wavelengths_nm(guide("two_hologram_ar")) == pytest.approx((625, 532, 465), abs=2)
    assert chief_wavelengths_nm(scene("laser_grating")) == pytest.approx((632.8,), abs=0.01)
    assert chief_wavelengths_nm(scene("grating_rainbow")) == (610.0, 550.0, 460.0)


def test_orders_that_are_not_traced_are_left_out() -> None:
    assert not chief_rays(scene("holographic_sight"), Orders(2, 5), corners=True).order.any()
    found = chief_rays(scene("grating_rainbow"), Orders(-2, -1)).order
    assert set(found.tolist()) == {0, -1, -2}, "0 only on the way from the eye"


def test_scene_without_holograms_has_no_rays() -> None:
    spec = scene("point_lens")
    kept = tuple(each for each in spec.elements if not isinstance(each, HologramElement))
    assert len(chief_rays(msgspec.structs.replace(spec, elements=kept), Orders()).nm) == 0
