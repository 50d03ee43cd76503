# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The box of an operator that has added an element shows only what applies."""

from types import SimpleNamespace
from typing import Any

import pytest

from hoe_addon.ui.operators.add_emitters import HOE_OT_add_display, HOE_OT_add_lamp
from hoe_addon.ui.operators.add_eye import HOE_OT_add_eye


@pytest.mark.parametrize(
    ("operator", "values", "hidden"),
    [
        (HOE_OT_add_eye, {"at_infinity": True}, {"focus_mm"}),
        (HOE_OT_add_eye, {"at_infinity": False}, set()),
        (HOE_OT_add_lamp, {"light": "D65"}, {"centre_nm"}),
        (HOE_OT_add_lamp, {"light": "LASER"}, set()),
        (HOE_OT_add_display, {}, set()),
    ],
)
def test_own_fields_first_and_only_those_that_apply(
    operator: Any, values: dict[str, Any], hidden: set[str]
) -> None:
    shown: list[str] = []
    layout = SimpleNamespace(prop=lambda _owner, field: shown.append(field))
    # Blender alone makes operators; this has what the drawing asks of one.
    functions = {"left_out": operator.left_out, "__annotations__": operator.__annotations__}
    box = type("Box", (), functions | {"layout": layout} | values)()
    operator.draw(box, None)
    own = [field for field in operator.__annotations__ if field not in hidden]
    assert shown == [*own, "align", "location", "rotation"]
