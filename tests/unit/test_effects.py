# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan: what the user decides, what planning leaves alone, and where rays go."""

import numpy as np
import pytest
from msgspec.structs import replace

from hoe_addon.model.device import DeviceSpec, LightGuideSpec
from hoe_addon.model.device_walk import eyebox_luminance
from hoe_addon.model.document import load_device
from hoe_addon.model.effects import Decision, Effect, EffectPlan, plan_effects, planned
from hoe_addon.model.effects.bodies import box, cylinder, ellipsoid, on_plane, rectangle
from hoe_addon.model.effects.budget import Budget
from hoe_addon.model.effects.by_hand import main_wavelength
from hoe_addon.model.effects.holograms import holograms_of, with_holograms
from hoe_addon.model.effects.light import components_of
from hoe_addon.model.effects.overrides import read_overrides
from hoe_addon.model.effects.places import bodies_of
from hoe_addon.model.effects.sight import Sight, roots_of, sight_of
from hoe_addon.model.efficiency import ConstantSpec
from hoe_addon.model.field_error import FieldError
from hoe_addon.model.medium import medium_from
from hoe_addon.model.scene_view import pass_hologram
from hoe_addon.resources import preset_paths

PRESETS = sorted(preset_paths())
LASER = "laser_grating"

EXACT = 1e-12
"""Of places and directions of the size 1: some roundings of float64."""

FEW_RAYS = 0.35
"""Of the mean luminance of a light guide: 80 places of the picture see few bounces each."""


def with_effects(spec: DeviceSpec, *effects: str) -> DeviceSpec:
    return replace(spec, render=replace(spec.render, effects=effects))


def sight(spec: DeviceSpec) -> Sight:
    roots, pixel = roots_of(spec)
    return sight_of(bodies_of(spec), components_of(spec), roots, pixel)


@pytest.mark.parametrize("name", PRESETS)
def test_everything_on_leaves_the_document_alone(name: str) -> None:
    spec = with_effects(load_device(name), "all")
    plan = plan_effects(spec)
    assert plan.promise == 0.0
    assert planned(spec, plan) == spec
    assert all(plan.is_on(effect) for effect in Effect)


@pytest.mark.parametrize("name", PRESETS)
def test_presets_keep_what_they_show(name: str) -> None:
    """Those that show colours do not go without wavelengths, and the promise is kept."""
    spec = load_device(name)
    plan = plan_effects(spec)
    left = planned(spec, plan)
    assert plan.promise <= 1e-3
    in_colours = name != LASER
    assert plan.is_on(Effect.DISPERSION) == in_colours
    assert left.render.mode == ("spectral" if in_colours else "preview")
    assert holograms_of(left).keys() == holograms_of(spec).keys()


def test_rainbow_needs_little_else() -> None:
    plan = plan_effects(load_device("grating_rainbow"))
    assert plan.is_on(Effect.DISPERSION)
    for effect in (Effect.POSITION, Effect.ANGLE, Effect.WAVELENGTH, Effect.LEVELS, Effect.HAZE):
        assert not plan.is_on(effect, "grating")


def test_plan_is_the_same_each_time() -> None:
    spec = load_device("point_lens")
    assert plan_effects(spec) == plan_effects(with_holograms(spec, holograms_of(spec)))


def test_user_turns_effects_on_and_off() -> None:
    spec = load_device("point_lens")
    plan = plan_effects(with_effects(spec, "-dispersion", "lens:-angle"))
    assert not plan.is_on(Effect.DISPERSION)
    assert not plan.is_on(Effect.ANGLE, "lens")
    assert [each.effect for each in plan.decisions if each.overridden] == [
        Effect.DISPERSION,
        Effect.ANGLE,
    ]
    assert plan.promise > 0.1
    left = planned(spec, plan)
    assert left.render.mode == "preview"
    changed = holograms_of(left)["lens"].efficiency
    assert changed == replace(holograms_of(spec)["lens"].efficiency, angle_dependent=False)


def test_free_things_go_beside_what_the_user_leaves_out() -> None:
    """The user's choice costs all, and still takes nothing from the promise."""
    spec = load_device("grating_rainbow")
    assert not plan_effects(spec).is_on(Effect.BOUNCES)
    plan = plan_effects(with_effects(spec, "-dispersion"))
    assert plan.promise > 1.0
    assert not plan.is_on(Effect.BOUNCES)


def test_promise_of_the_plan_holds_beside_the_users_choice() -> None:
    budget = Budget(1e-3, read_overrides(("-levels",), ("film",)))
    assert budget.decide(Effect.LEVELS, "film", 0.5, "by hand")
    assert budget.decide(Effect.HAZE, "film", 0.9e-3, "small")
    assert not budget.decide(Effect.ANGLE, "film", 0.2e-3, "too much")
    assert budget.decide(Effect.ABSORPTION, "film", 0.0, "free")
    assert budget.used == pytest.approx(0.9e-3)
    assert budget.total == pytest.approx(0.5 + 0.9e-3)


def test_all_but_one() -> None:
    plan = plan_effects(with_effects(load_device("point_lens"), "all", "-angle"))
    assert [each.effect for each in plan.left_out if each.error_without] == [Effect.ANGLE]


def test_later_change_wins_and_a_name_goes_before_all() -> None:
    found = read_overrides(("-haze", "film:+haze", "+angle", "-angle"), ("film", "other"))
    assert found.of(Effect.HAZE, "film") is True
    assert found.of(Effect.HAZE, "other") is False
    assert found.of(Effect.ANGLE, "film") is False
    assert found.of(Effect.ORDERS, "film") is None


def test_quantisation_is_another_word_for_levels() -> None:
    assert read_overrides(("-quantisation",), ()).of(Effect.LEVELS, "film") is False


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("haze", "must be all, or begin with + or -"),
        ("", "must be all, or begin with + or -"),
        ("-hazy", "must name an effect (dispersion, "),
        ("glass:-haze", "must name a hologram before the colon (lens)"),
    ],
)
def test_bad_changes_are_named(text: str, words: str) -> None:
    with pytest.raises(FieldError) as caught:
        plan_effects(with_effects(load_device("point_lens"), "+haze", text))
    assert str(caught.value).startswith("render.effects[1]: ")
    assert words in str(caught.value)


def test_what_must_stay_is_refused() -> None:
    spec = load_device("diffractive_achromat")
    with pytest.raises(FieldError, match="must not leave out"):
        plan_effects(with_effects(spec, "-fresnel"))
    with pytest.raises(FieldError, match="must not leave out"):
        plan_effects(with_effects(spec, "achromat lens back:-position"))
    with pytest.raises(FieldError, match="must not leave out"):
        plan_effects(with_effects(spec, "-position"))


def test_what_no_light_meets_is_not_refused() -> None:
    behind = ["elements.lens.position_mm=[0,0,5000]"]
    spec = load_device("point_lens", behind)
    plan = plan_effects(with_effects(spec, "-orders"))
    assert plan.is_on(Effect.ORDERS, "lens")


def decided(effect: Effect, hologram: str = "", part: str = "") -> EffectPlan:
    """A plan of someone's own."""
    return EffectPlan((Decision(effect, hologram, False, "by hand", 1e-4, part=part),), 1e-4)


def test_decisions_of_ones_own_are_followed() -> None:
    spec = load_device("holographic_sight")
    one = planned(spec, decided(Effect.DISPERSION))
    assert one.render.mode == "preview"
    assert one.render.preview_wavelength_nm == pytest.approx(640.0, abs=0.01)
    assert planned(spec, decided(Effect.PUPIL)).eye.pupil_diameter_mm < 1e-3
    left = holograms_of(planned(spec, decided(Effect.ORDERS, "window")))["window"]
    assert left.orders == (0,)
    left = holograms_of(planned(spec, decided(Effect.ORDERS, "window", "T0")))["window"]
    assert left.orders == (1,)
    assert planned(spec, decided(Effect.HAZE, "window")) == spec


def test_mean_shares_by_hand_are_those_along_the_normal() -> None:
    spec = load_device("point_lens")
    left = holograms_of(planned(spec, decided(Effect.WAVELENGTH, "lens")))["lens"].efficiency
    assert isinstance(left, ConstantSpec)
    nm = main_wavelength(spec)
    index = medium_from("PMMA").index(np.array([532e-9, nm * 1e-9]))
    depth = (index[1] - 1.0) / (index[0] - 1.0) * 532.0 / nm
    assert left.table.T["1"] == pytest.approx(float(np.sinc(depth - 1.0) ** 2), abs=EXACT)


def test_dark_scene_is_left_alone() -> None:
    spec = load_device("grating_rainbow", ["room.kind=none", "elements.lamp.luminance_cd_m2=0"])
    plan = plan_effects(spec)
    assert plan == EffectPlan((), 0.0)
    assert planned(spec, plan) == spec


def test_document_for_one_wavelength_stays_so() -> None:
    spec = load_device("point_lens", ["render.mode=preview"])
    plan = plan_effects(spec)
    assert not plan.is_on(Effect.DISPERSION)
    assert planned(spec, plan).render.preview_wavelength_nm == spec.render.preview_wavelength_nm


def test_picture_of_one_colour_has_one_primary() -> None:
    names = [each.name for each in components_of(load_device("holographic_sight"))]
    assert names == ["the room", "red of reticle"]


def test_walk_meets_where_exact_rays_meet() -> None:
    """Rays of the walk through the window of the sight are those of the exact tracer."""
    spec = load_device("holographic_sight")
    seen = sight(spec)
    element = spec.hologram("window")  # pyright: ignore[reportAttributeAccessIssue]
    (hits,) = seen.walk.hits
    rays = seen.walk.levels[0].rays.pick(hits.rays)
    for place, way in enumerate(hits.ways):
        met, left = pass_hologram(element, rays.start, rays.way, rays.nm, way.order)
        np.testing.assert_allclose(met, seen.walk.levels[0].points[hits.rays], atol=1e-9)
        walked = hits.child[:, place] >= 0
        after = seen.walk.levels[1].rays.way[hits.child[walked, place]]
        np.testing.assert_allclose(after, left[walked], atol=EXACT)


def test_luminance_of_a_guide_is_that_of_the_forward_walk() -> None:
    """The mean over the display's field, walked forward, against few rays walked backward."""
    spec = load_device(
        "two_hologram_ar", ["room.kind=none", "eye.field_deg=19", "eyebox.grid=[1,1]"]
    )
    assert isinstance(spec, LightGuideSpec)
    forward = eyebox_luminance(spec, [spec.eye.position_mm], rays=20_000).mean_cd_m2[0]
    half = np.tan(np.radians(spec.eye.field_deg / 2.0))
    seen = half * half * spec.render.size[1] / spec.render.size[0] * 4.0
    shown = float(np.prod(spec.display.size_mm)) / spec.lens.focal_length_mm**2
    assert sight(spec).means.sum() == pytest.approx(forward * shown / seen, rel=FEW_RAYS)


def test_bodies_are_met_at_their_surface(rng: np.random.Generator) -> None:
    start = 10.0 * rng.standard_normal((500, 3))
    way = -start + rng.standard_normal((500, 3))
    way /= np.linalg.norm(way, axis=1)[:, None]
    size = (3.0, 5.0, 2.0)
    for distance, surface in (
        (box(size), lambda p: np.max(np.abs(p) / (np.asarray(size) / 2.0), axis=1)),
        (ellipsoid(size), lambda p: np.linalg.norm(p / (np.asarray(size) / 2.0), axis=1)),
        (
            cylinder(size),
            lambda p: np.maximum(np.hypot(p[:, 0] / 1.5, p[:, 1] / 2.5), np.abs(p[:, 2])),
        ),
    ):
        outside = surface(start) > 1.01
        far = distance(start[outside], way[outside])
        hit = np.isfinite(far)
        assert hit.sum() > 50
        points = start[outside][hit] + far[hit, None] * way[outside][hit]
        np.testing.assert_allclose(surface(points), 1.0, atol=1e-9)
        # Half way to the hit nothing has been met.
        assert np.all(surface(start[outside][hit] + 0.5 * far[hit, None] * way[outside][hit]) > 1.0)


def test_plane_has_edges() -> None:
    distance = on_plane(rectangle(2.0, 1.0))
    start = np.array([[0.9, 0.0, 1.0], [1.1, 0.0, 1.0], [0.0, 0.6, 1.0], [0.0, 0.0, -1.0]])
    way = np.tile((0.0, 0.0, -1.0), (4, 1))
    # The last ray starts beyond the plane: its distance is below 0, which no walk takes.
    far = distance(start, way)
    np.testing.assert_array_equal(np.isinf(far), [False, True, True, False])
    np.testing.assert_allclose(far[[0, 3]], [1.0, -1.0], atol=EXACT)
