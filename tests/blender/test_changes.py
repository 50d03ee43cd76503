# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What changes while listeners are told of changes is told them, too."""

from typing import Any

import bpy

from hoe_addon.blender.props import changes


def test_block_that_is_marked_again_is_told_again(registered: Any) -> None:
    told: list[frozenset[int]] = []

    def listener(batch: frozenset[int]) -> None:
        told.append(batch)
        if len(told) == 1:
            changes.mark_block(registered)

    changes.listen(listener)
    try:
        changes.mark_block(registered)
        assert changes._tell() == 0.0, "once more"
        assert changes.is_changed(registered)
        assert changes._tell() is None
    finally:
        changes.stop(listener)
        bpy.app.timers.unregister(changes._tell)
    assert told == [frozenset((registered.session_uid,))] * 2
    assert not changes.is_changed(registered)
