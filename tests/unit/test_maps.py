# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of grad V in the cache: what names them, and what makes them anew."""

import copy
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from hoe_addon.core.errors import CancelledError
from hoe_addon.files import OutputError
from hoe_addon.model import map_cache
from hoe_addon.model.contents import with_contents
from hoe_addon.model.map_source import MapSource
from hoe_addon.model.maps import MapRequest, map_file
from hoe_addon.model.surface import PlaneSurface, SphereSurface
from hoe_addon.model.waves import WaveSpec

SECOND_USE = 0.1
"""s; a map that is there must not be felt."""

WAVE: dict[str, Any] = {
    "kind": "system",
    "source": {"kind": "point", "position_mm": [0, 0, -60]},
    "surfaces": [
        {
            "shape": "sphere",
            "vertex_mm": [0, 0, -20],
            "radius_mm": 60,
            "semi_diameter_mm": 15,
            "medium": "N-BK7",
        }
    ],
}
REQUEST = MapRequest(
    MapSource(((1, msgspec.convert(WAVE, WaveSpec)),)), PlaneSurface((6.0, 4.0)), 532.0
)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path / "maps"))
    return tmp_path / "maps"


def points(rng):
    return rng.uniform(-1.0, 1.0, (500, 3)) * (0.003, 0.002, 0.0)


def test_a_map_comes_back_from_its_file(folder, rng):
    path, made = map_file(REQUEST)
    again, kept = map_file(REQUEST)
    assert path == again and path.parent == folder
    assert [item.name for item in folder.iterdir()] == [path.name]
    assert (kept.origin, kept.pitch, kept.error) == (made.origin, made.pitch, made.error)
    np.testing.assert_array_equal(kept.texels, made.texels.astype(np.float32))
    exact = REQUEST.gradient(points(rng))
    rng = np.random.default_rng(1)
    where = points(rng)
    exact = REQUEST.gradient(where)
    # float32 of numbers up to 1.5, and the map's own error.
    assert np.abs(kept.gradient(where) - exact).max() < 3e-7 + 2.0 * made.error


def test_second_use_of_the_largest_map_is_quick():
    largest = replace(REQUEST, surface=PlaneSurface((6.0, 4.5)))
    key = largest.key
    _, small = map_file(REQUEST)
    texels = np.random.default_rng(0).random((512, 512, 4))
    big = replace(small, texels=texels)
    path = map_cache.map_path(map_cache.cache_folder(), key)
    map_cache.write_map(path, key, big)
    start = time.perf_counter()
    _, kept = map_file(largest)
    elapsed = time.perf_counter() - start
    assert kept.texels.shape == (512, 512, 4)
    assert elapsed < SECOND_USE


@pytest.mark.parametrize(
    "spoil",
    [
        lambda data: b"",
        lambda data: data[: len(data) // 2],
        lambda data: data[:-200] + bytes(200),
        lambda data: b"not a picture",
    ],
    ids=["empty", "cut", "overwritten", "other"],
)
def test_a_damaged_file_is_made_anew(spoil):
    path, made = map_file(REQUEST)
    good = path.read_bytes()
    path.write_bytes(spoil(good))
    _, again = map_file(REQUEST)
    np.testing.assert_array_equal(again.texels, made.texels)
    assert map_cache.read_map(path, REQUEST.key) is not None


def test_another_map_under_this_name_is_not_taken(folder):
    path, _ = map_file(REQUEST)
    other = folder / f"map-{map_cache.FORMAT}-{'0' * 64}.exr"
    path.rename(other)
    assert map_cache.read_map(other, "0" * 64) is None


def changed(wave: dict[str, Any]) -> MapRequest:
    return replace(REQUEST, source=MapSource(((1, msgspec.convert(wave, WaveSpec)),)))


def test_the_name_depends_on_all_that_the_map_does():
    moved = copy.deepcopy(WAVE)
    moved["source"]["position_mm"][0] = 1e-9
    glass = copy.deepcopy(WAVE)
    glass["surfaces"][0]["medium"] = "N-SF66"
    wave = REQUEST.source.terms[0][1]
    others = [
        changed(moved),
        changed(glass),
        replace(REQUEST, wavelength_nm=533.0),
        replace(REQUEST, surface=PlaneSurface((6.0, 4.1))),
        replace(REQUEST, surface=SphereSurface((6.0, 4.0), 50.0)),
        replace(REQUEST, source=MapSource(((-1, wave),))),
        replace(REQUEST, source=MapSource(((1, wave), (-1, wave)))),
    ]
    assert len({REQUEST.key, *(other.key for other in others)}) == len(others) + 1
    assert changed(WAVE).key == REQUEST.key


def test_the_content_of_a_file_counts_not_its_name(tmp_path):
    (tmp_path / "a.npy").write_bytes(b"1")
    (tmp_path / "b.npy").write_bytes(b"1")
    first, second = ({"terms": [{"file": str(tmp_path / name)}]} for name in ("a.npy", "b.npy"))
    assert with_contents(first) == with_contents(second)
    (tmp_path / "b.npy").write_bytes(b"2")
    assert with_contents(first) != with_contents(second)


def test_stopped_work_leaves_no_file(folder):
    def stop(_share: float) -> None:
        raise CancelledError("stopped")

    with pytest.raises(CancelledError):
        map_file(REQUEST, progress=stop)
    assert not folder.exists() or not list(folder.iterdir())


def test_a_folder_that_cannot_be_made_is_told(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("HOE_CACHE_DIR", str(tmp_path / "file"))
    with pytest.raises(OutputError, match="cannot be written"):
        map_file(REQUEST)


def test_the_folder_of_the_cache(tmp_path, monkeypatch):
    own = tmp_path / "own"
    assert map_cache.cache_folder(own) == tmp_path / "maps"
    monkeypatch.delenv("HOE_CACHE_DIR")
    assert map_cache.cache_folder(own) == own
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert map_cache.cache_folder() == tmp_path / "hoe_addon"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.delenv("LOCALAPPDATA", raising=False)
    assert map_cache.cache_folder() == Path.home() / ".cache" / "hoe_addon"


@pytest.mark.slow
def test_a_large_map_through_four_surfaces_is_quick():
    """A part stays dark, so the map has 512 texels along a side: under 20 s on one core alone."""
    wave = copy.deepcopy(WAVE)
    face = wave["surfaces"][0] | {"semi_diameter_mm": 4}
    more = [
        face | {"vertex_mm": [0, 0, z], "radius_mm": radius, "medium": medium}
        for z, radius, medium in ((-17, -50, "N-SF15"), (-15, -200, 1.0), (-10, 90, 1.6))
    ]
    wave["surfaces"] = [face, *more]
    start = time.process_time()
    _, made = map_file(replace(changed(wave), surface=PlaneSurface((8.0, 8.0))))
    elapsed = time.process_time() - start
    assert made.texels.shape == (512, 512, 4)
    assert 0.2 < made.texels[..., 3].mean() < 0.9
    assert made.error < 1e-6
    assert elapsed < 20.0
