# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours at the ends of what the eye sees, of lines of almost no width, and of no light at all."""

import json
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from numpy.typing import NDArray

from hoe_addon.blender.build import meshes
from hoe_addon.blender.build.eye import add_eye
from hoe_addon.blender.pictures.render import COMBINED, render_layers
from hoe_addon.blender.pictures.render_settings import set_up
from hoe_addon.blender.shaders import materials
from hoe_addon.blender.shaders.spectral import spectral_scene
from hoe_addon.core import colour, data, spectrum
from hoe_addon.core.errors import SpecError
from hoe_addon.core.spectrum import Spectrum, display_primaries, line, tabulated
from hoe_addon.core.units import nm_to_m
from hoe_addon.core.wavelength_sampling import WavelengthSampling, by_significance, uniform
from hoe_addon.model.device_parts import EyeSpec
from hoe_addon.model.document import load_device

DIGITS = 50

FEW = 1e-13
"""A hundred roundings, relative to the largest of the three."""

NODE_ROUNDING = 1e-15
"""Of a wavelength, as a part of itself: a line of the width f at l keeps the part l / f of it."""

COLOUR = 1e-3
"""In u'v': 512 cells with straight lines between the nodes. The promise for 460 to 630 nm is 5e-4;
at the ends of the visible range, where a scene's sampling has its widest cells, it is this."""

LUMINANCE = 1e-12
"""Emission is scaled by its own luminance."""

WIDTHS_NM = (1.0, 1e-3, 1e-6)
SEEN_NM = (360.0, 360.05, 370.0, 400.0, 431.4567, 532.0, 532.5, 532.123456, 555.0, 700.0, 780.0)
EDGES_NM = (829.9, 830.0)
UNSEEN_NM = (300.0, 359.9, 830.1, 1000.0)


def lines(nm: float, fwhm_nm: float) -> Spectrum:
    return line(nm_to_m(nm), nm_to_m(fwhm_nm), f"laser at {nm:g}")


def exact_xyz(source: Spectrum) -> list[mpf]:
    """Integral in nm of two chains of straight lines, by Simpson's rule between all nodes."""
    table = data.load("cie_1931_2deg_1nm")
    nodes = nm_to_m(table[:, 0])
    low, high = max(nodes[0], source.wavelength[0]), min(nodes[-1], source.wavelength[-1])
    edges = np.union1d(nodes, source.wavelength)
    edges = [mpf(float(edge)) for edge in edges[(edges >= low) & (edges <= high)]]
    total = [mpf(0)] * 3
    for begin, end in pairwise(edges):
        for at, weight in ((begin, 1), ((begin + end) / 2, 4), (end, 1)):
            power = straight(source.wavelength, source.power, at, begin, end)
            for k in range(3):
                eye = straight(nodes, table[:, k + 1], at, begin, end)
                total[k] += weight * (end - begin) / 6 * power * eye * mpf(10) ** 9
    return total


def straight(
    nodes: NDArray[np.float64], values: NDArray[np.float64], at: mpf, begin: mpf, end: mpf
) -> mpf:
    """Value at a point of the interval from `begin` to `end`, which has no node inside."""
    cell = int(np.searchsorted(nodes, float((begin + end) / 2))) - 1
    first, second = (mpf(float(nodes[cell + k])) for k in (0, 1))
    share = (at - first) / (second - first)
    return (1 - share) * mpf(float(values[cell])) + share * mpf(float(values[cell + 1]))


@pytest.mark.parametrize("fwhm_nm", WIDTHS_NM)
@pytest.mark.parametrize("nm", [*SEEN_NM, *EDGES_NM])
def test_tristimulus_values(nm: float, fwhm_nm: float) -> None:
    source = lines(nm, fwhm_nm)
    found = colour.xyz_of(source)
    with mp.workdps(DIGITS):
        expected = np.array([float(value) for value in exact_xyz(source)])
    allowed = FEW + NODE_ROUNDING * nm / fwhm_nm
    assert np.max(np.abs(found - expected)) <= allowed * np.max(expected)
    # The chromaticity has no part in the width.
    assert np.max(np.abs(colour.uv_prime(found) - colour.uv_prime(expected))) < 1e-9


@pytest.mark.parametrize("nm", UNSEEN_NM)
def test_nothing_is_seen_outside(nm: float) -> None:
    assert not colour.xyz_bar(nm_to_m(nm)).any()
    assert not colour.xyz_of(lines(nm, 1e-6)).any()


def test_the_eye_at_and_between_nodes() -> None:
    table = data.load("cie_1931_2deg_1nm")
    for nm in (360.0, 531.0, 532.0, 830.0):
        row = table[table[:, 0] == nm][0, 1:]
        assert np.max(np.abs(colour.xyz_bar(nm_to_m(nm)) - row)) <= FEW
        ends = [colour.xyz_bar(nm_to_m(nm) * (1.0 + sign * 1e-12)) for sign in (1, -1)]
        inside = ends if 360.0 < nm < 830.0 else [ends[0] if nm == 360.0 else ends[1]]
        for end in inside:
            # 1e-12 of 500 nm, times slopes of up to 0.04 a nm.
            assert np.max(np.abs(end - row)) <= 1e-10


@cache
def samplings() -> dict[str, WavelengthSampling]:
    return {
        "uniform": uniform(360e-9, 830e-9),
        "of LEDs": by_significance(display_primaries("led_rgb")),
    }


def check_colour(sampling: WavelengthSampling, source: Spectrum) -> None:
    rgb = sampling.mean_rgb(sampling.emission(source))
    xyz = colour.LINEAR_REC709_TO_XYZ @ rgb
    expected = colour.uv_prime(colour.xyz_of(source))
    assert np.max(np.abs(colour.uv_prime(xyz) - expected)) < COLOUR
    assert xyz[1] == pytest.approx(1.0, rel=LUMINANCE)


@pytest.mark.parametrize("fwhm_nm", WIDTHS_NM)
@pytest.mark.parametrize("nm", [*SEEN_NM, *EDGES_NM])
def test_lines_keep_colour_and_luminance(nm: float, fwhm_nm: float) -> None:
    source = lines(nm, fwhm_nm)
    for sampling in (*samplings().values(), by_significance([source])):
        check_colour(sampling, source)


@pytest.mark.parametrize("name", ["uniform", "of LEDs"])
@pytest.mark.parametrize("fwhm_nm", [1.0, 1e-6])
def test_lines_at_the_seams_of_the_sampling(name: str, fwhm_nm: float) -> None:
    """At nodes, in the middle of cells, and one rounding beside a node."""
    sampling = samplings()[name]
    nodes = sampling.wavelength_nodes
    for cell in (1, 100, 255, 256, 400, 510):
        middle = 0.5 * (nodes[cell] + nodes[cell + 1])
        for at in (nodes[cell], middle, np.nextafter(nodes[cell], 0), np.nextafter(nodes[cell], 1)):
            check_colour(sampling, line(float(at), nm_to_m(fwhm_nm)))


BLACK = tabulated([400e-9, 700e-9], [0.0, 0.0], "emitter")
RED, GREEN = lines(630.0, 1.0), lines(532.0, 1.0)


@pytest.mark.parametrize(
    "source", [BLACK, *(line(nm_to_m(nm), 1e-15, "emitter") for nm in UNSEEN_NM)]
)
@pytest.mark.parametrize(
    "use",
    [
        lambda source: uniform(360e-9, 830e-9).emission(source),
        lambda source: uniform(360e-9, 830e-9).shader_tables([RED, source]),
        lambda source: by_significance([source]),
        lambda source: colour.white_balance((RED, GREEN, source)),
    ],
)
@pytest.mark.filterwarnings("error")
def test_no_visible_power_is_named(use: Callable[[Spectrum], Any], source: Spectrum) -> None:
    with pytest.raises(SpecError, match=r"emitter.* no visible power"):
        use(source)


def test_black_has_no_chromaticity() -> None:
    assert not colour.xyz_of(BLACK).any()
    assert np.isnan(colour.uv_prime(colour.xyz_of(BLACK))).all()


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: line(532e-9, 1e-22, "laser"), "laser.fwhm: must be at least 1e-12"),
        (lambda: spectrum.led(532e-9, 1e-22, "laser"), "laser.fwhm: must be at least 1e-12"),
        (lambda: tabulated([4e-7, 7e-7], [0, 1e300], "lamp"), "lamp.power: the largest must"),
        (lambda: tabulated([4e-7, 7e-7], [0, 1e-300], "lamp"), "lamp.power: the largest must"),
    ],
)
def test_spectra_beyond_double_precision_are_refused(
    make: Callable[[], Spectrum], message: str
) -> None:
    with pytest.raises(SpecError, match=message):
        make()


@pytest.mark.parametrize("scale", [1e-100, 1e100])
@pytest.mark.filterwarnings("error")
def test_the_unit_of_power_does_not_matter(scale: float) -> None:
    nodes, power = [400e-9, 500e-9, 700e-9], np.array((0.1, 1.0, 0.5))
    sampling = samplings()["uniform"]
    expected = sampling.emission(tabulated(nodes, power))
    found = sampling.emission(tabulated(nodes, scale * power))
    np.testing.assert_allclose(found, expected, rtol=LUMINANCE)


def primaries_of(nm: float) -> str:
    return json.dumps([{"centre_nm": at, "fwhm_nm": 1e-3} for at in (630.0, 532.0, nm)])


@pytest.mark.parametrize("nm", UNSEEN_NM)
def test_documents_name_the_field_of_an_unseen_primary(nm: float) -> None:
    with pytest.raises(SpecError, match=r"display\.primaries: .* no visible power"):
        load_device("two_hologram_ar", [f"display.primaries={primaries_of(nm)}"])


@pytest.mark.parametrize(
    ("lamp", "message"),
    [
        ([{"centre_nm": 532, "power": 0}], r"spectrum\.lines\[0\]\.power: must be above 0, got 0"),
        ([{"centre_nm": 300, "power": 1}], r"spectrum\.lines: must have one from 380 to 780"),
        ([], r"spectrum\.lines: must"),
    ],
)
def test_documents_name_the_field_of_a_lamp_without_light(lamp: list[Any], message: str) -> None:
    value = json.dumps({"kind": "lines", "lines": lamp})
    with pytest.raises(SpecError, match=message):
        load_device("grating_rainbow", [f"elements.lamp.spectrum={value}"])


SIDE, SAMPLES = 16, 256

IN_CYCLES = 0.01
"""Share of the largest channel: the promise for a single line. A table's cell and float32 keep to
a tenth of that."""

SIGMAS = 4.0
"""One of 16,000 right values is further off by chance."""

WHITE_LUMINANCE = 2.5
DISPLAYS = {
    "between the nodes": ((630.25, 532.5, 460.7), 1.0),
    "almost no width": ((630.25, 532.123456, 460.7), 1e-6),
    # Drawn so often that the filter's weight would be below what Cycles keeps.
    "lasers of 1e-3 nm": ((638.0, 532.123456, 405.0), 1e-3),
    "dim ends of the spectrum": ((690.0, 555.0, 420.0), 1.0),
}


@pytest.mark.render
@pytest.mark.parametrize("made_for", ["its lines", "uniform"])
@pytest.mark.parametrize("name", DISPLAYS)
def test_lines_of_a_display_in_cycles(clean_scene: Any, name: str, made_for: str) -> None:
    """The hue within the promise at any noise, the luminance within the noise."""
    centres, fwhm_nm = DISPLAYS[name]
    primaries = tuple(lines(nm, fwhm_nm) for nm in centres)
    sampling = by_significance(primaries) if made_for == "its lines" else uniform(360e-9, 830e-9)
    spectral = spectral_scene(sampling, primaries, 550.0)
    clean_scene.camera = add_eye(
        clean_scene.collection, EyeSpec(pupil_diameter_mm=4.0, field_deg=10.0), spectral
    )
    wall = meshes.add(clean_scene.collection, meshes.rectangle("Wall", 100.0, 100.0))
    wall.location.z = -100.0
    wall.data.uv_layers.new(name="UVMap")
    clean_scene.cycles.pixel_filter_type = "BOX"
    shares = colour.white_balance(primaries)
    for lit, nm in enumerate(centres):
        drive = np.eye(3, dtype=np.float32)[lit]
        image = materials.picture("Drive", np.broadcast_to(drive, (2, 2, 3)).copy())
        wall.data.materials.clear()
        wall.data.materials.append(
            materials.display_material(image, primaries, "D65", WHITE_LUMINANCE, spectral)
        )
        xyz = colour.xyz_bar(nm_to_m(nm))
        expected = WHITE_LUMINANCE * shares[lit] * (colour.XYZ_TO_LINEAR_REC709 @ (xyz / xyz[1]))
        set_up(clean_scene, samples=SAMPLES, seed=3, spectral=True, max_bounces=8)
        clean_scene.render.resolution_x = clean_scene.render.resolution_y = SIDE
        pixels = render_layers(clean_scene, (COMBINED,))[COMBINED].astype(np.float64)
        luminances = pixels.reshape(-1, 3) @ colour.LUMINANCE_WEIGHTS
        seen = pixels.reshape(-1, 3).mean(axis=0)
        mean = float(luminances.mean())
        noise = float(luminances.std(ddof=1)) / SIDE
        wanted = float(expected @ colour.LUMINANCE_WEIGHTS)
        assert noise < 0.2 * wanted
        assert abs(mean - wanted) <= SIGMAS * noise + IN_CYCLES * wanted
        hue, right = seen / mean, expected / wanted
        assert np.max(np.abs(hue - right)) <= IN_CYCLES * np.max(np.abs(right))
