# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings are given back, whatever happens meanwhile."""

from types import SimpleNamespace

import pytest

from hoe_addon.blender.kept import changed, kept


def test_settings_are_given_back() -> None:
    first, second = SimpleNamespace(a=1, b=2), SimpleNamespace(a=3)
    with changed((first, {"a": 10}), (second, {"a": 30})), kept((first, ("b",))):
        assert (first.a, first.b, second.a) == (10, 2, 30)
        first.b = 20
    assert (first.a, first.b, second.a) == (1, 2, 3)


def test_settings_are_given_back_after_an_error() -> None:
    owner = SimpleNamespace(a=1)
    with pytest.raises(AttributeError), changed((owner, {"a": 2}), (object(), {"a": 3})):
        pass
    with pytest.raises(ZeroDivisionError), changed((owner, {"a": 2})):
        _ = 1 // 0
    assert owner.a == 1
