# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pairs of plane and spherical waves: what is found in double precision before the shader runs."""

import re

import numpy as np
import pytest

from hoe_addon.model.waves import PlaneWaveSpec, PointSourceSpec
from hoe_addon.shading.part import ShaderPart
from hoe_addon.shading.wave_pair import pair_part

REACH_MM = 10.0
EPS = float(np.finfo(np.float64).eps)
PLANE = PlaneWaveSpec((0.0, 0.6, 0.8), 1.5)
FAR = PointSourceSpec((3e8, 0.0, -4e8))
FAR_BEYOND = PointSourceSpec((-3e8, 0.0, 4e8), "converging")
NEAR = PointSourceSpec((0.0, 3.0, -4.0))


def pair(
    first: PlaneWaveSpec | PointSourceSpec,
    second: PlaneWaveSpec | PointSourceSpec,
    units_per_mm: float = 1.0,
) -> ShaderPart:
    return pair_part(first, second, units_per_mm, REACH_MM)


def test_nearly_equal_directions_are_subtracted_in_double_precision() -> None:
    aside = PointSourceSpec((3e8, 1.0, -4e8))
    found = np.array(pair(FAR, aside).sockets["origin_gradient"])
    np.testing.assert_allclose(found, (0.0, 2e-9, 0.0), atol=4 * EPS)


def test_a_beam_from_a_point_and_one_toward_its_mirror_image_are_equal_at_the_origin() -> None:
    sockets = pair(FAR, FAR_BEYOND).sockets
    assert sockets["origin_gradient"] == (0.0, 0.0, 0.0)
    assert sockets["object_direction"] == sockets["reference_direction"]
    assert sockets["object_curvature"] == pytest.approx(2e-9, rel=4 * EPS)
    assert sockets["reference_curvature"] == pytest.approx(-2e-9, rel=4 * EPS)


def test_a_near_source_keeps_its_place() -> None:
    """Its wave may have no direction at the origin, and turns by more than one there."""
    sockets = pair(NEAR, PLANE).sockets
    assert sockets["object_direction"] == (0.0, 0.0, 0.0)
    assert sockets["object_position"] == (0.0, 3.0, -4.0)
    np.testing.assert_allclose(sockets["origin_gradient"], (0.0, -0.9, -1.2), atol=4 * EPS)


def test_curvature_is_in_scene_units() -> None:
    assert pair(FAR, PLANE, 1e-3).sockets["object_curvature"] == pytest.approx(2e-6, rel=4 * EPS)


@pytest.mark.parametrize("second", [PLANE, NEAR])
def test_numbers_travel_in_sockets(second: PlaneWaveSpec | PointSourceSpec) -> None:
    """A source that comes nearer compiles nothing."""
    far, near = pair(FAR, second), pair(NEAR, second)
    assert (far.parameters, far.code) == (near.parameters, near.code)
    declared = re.findall(r"(?:float|int|vector) (\w+) = ", far.parameters)
    assert sorted(declared) == sorted(far.sockets) == sorted(near.sockets)
