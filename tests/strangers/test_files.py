# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files from strangers: tables, grids, reliefs, meshes, rays, pictures, and documents as bytes."""

import random
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import pytest

from tests.strangers.damage import damaged
from tests.strangers.judging import Case, assert_faultless, judge
from tests.strangers.samples import SAMPLES, Sample

FEW, MANY = 50, 900


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """What is in a good file of each kind; each is read once, so that all is imported."""
    folder = tmp_path_factory.mktemp("good")
    found: dict[str, bytes] = {}
    for sample in SAMPLES:
        path = folder / f"{len(found)}{sample.suffix}"
        sample.make(path)
        sample.read(path)
        found[sample.name] = path.read_bytes()
    return found


def cases(
    sample: Sample, good: dict[str, bytes], folder: Path, seed: int, count: int
) -> Iterator[Case]:
    """Damaged files; each has a name of its own, for readers keep what they have read."""
    rng = random.Random(f"{sample.name} {seed}")
    others = list(good.values())
    for number in range(count):
        data = damaged(rng, good[sample.name], others, is_text=sample.is_text)
        path = folder / f"{seed}_{number}{sample.suffix}"
        path.write_bytes(data)
        yield Case(f"{sample.name}: {number}", partial(sample.read, path), data)
        assert path.read_bytes() == data
        path.unlink()


def check(sample: Sample, good: dict[str, bytes], folder: Path, seed: int, count: int) -> None:
    least_valid = 0.005 if count == MANY else 0.0
    assert_faultless(judge(cases(sample, good, folder, seed, count)), count, least_valid)
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.name)
def test_damaged_files(sample: Sample, good: dict[str, bytes], tmp_path: Path) -> None:
    check(sample, good, tmp_path, 1, FEW)


@pytest.mark.slow
@pytest.mark.parametrize("sample", SAMPLES, ids=lambda sample: sample.name)
def test_many_damaged_files(sample: Sample, good: dict[str, bytes], tmp_path: Path) -> None:
    check(sample, good, tmp_path, 2, MANY)
