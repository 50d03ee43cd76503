# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers, choices and words of single properties."""

from typing import Any

import bpy
import numpy as np
import pytest

from hoe_addon.blender import ids
from hoe_addon.blender.props import values
from hoe_addon.core.media import CATALOGUE
from hoe_addon.model.characteristic import CHARACTERISTICS
from hoe_addon.model.efficiency import EFFICIENCIES
from hoe_addon.model.surface import SURFACES
from hoe_addon.model.waves import WAVES

ROUNDED_DOWN = 2.4e-7
"""Two units in the last place of a float32: the next smaller one may have to be taken."""

CHOICES = (*ids.Choice.__subclasses__(),)


def test_shortest_decimal() -> None:
    assert values.shortest(np.float32(532.1)) == 532.1
    assert values.shortest(-0.0) == 0.0
    for exponent in range(-3, 9):
        for mantissa in (1000001, 1999999, 2097153, 5368711, 8388607, 9999999):
            value = float(f"{mantissa}e{exponent - 6}")
            assert values.shortest(np.float32(value)) == value


@pytest.mark.parametrize("share", [0.0, 1.0, 0.1, 0.7, 0.6543217, 1 / 3, 2 / 3, 1e-9])
def test_shares_are_rounded_down(share: float) -> None:
    stored = values.rounded_down(share)
    assert np.float32(stored) == stored
    assert share * (1 - ROUNDED_DOWN) <= values.shortest(stored) <= share


def test_choices_are_those_of_the_documents() -> None:
    def tags(*structs: Any) -> set[str]:
        return {struct.__struct_config__.tag for struct in structs}

    assert {kind.value for kind in ids.WaveKind} == tags(*WAVES)
    assert {kind.value for kind in ids.CharacteristicKind} == tags(*CHARACTERISTICS)
    assert {shape.value for shape in ids.Shape} == tags(*SURFACES)
    assert {model.value for model in ids.EfficiencyModel} == tags(*EFFICIENCIES)
    assert [name for name, *_ in ids.catalogue_items()] == list(CATALOGUE)


@pytest.mark.parametrize(
    "items",
    [*(choice.items() for choice in CHOICES), ids.catalogue_items()],
    ids=[*(choice.__name__ for choice in CHOICES), "catalogue"],
)
def test_stored_numbers_are_distinct(items: list[ids.EnumItem]) -> None:
    assert len({number for *_, number in items}) == len(items)


def test_stored_number_of_a_glass_never_changes() -> None:
    """Files hold this number."""
    stored = {name: number for name, _, _, number in ids.catalogue_items()}
    assert stored["N-BK7"] == 731319481


def test_every_property_has_its_words(registered: Any) -> None:
    groups = [c for c in bpy.types.PropertyGroup.__subclasses__() if c.__name__.startswith("HOE_")]
    assert groups
    for group in groups:
        for prop in group.bl_rna.properties:
            if prop.identifier in group.__annotations__:
                assert prop.name
                assert prop.description
                assert not prop.description.endswith("."), "Blender adds the full stop"
