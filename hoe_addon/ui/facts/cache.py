# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facts about datablocks, worked out when something changes and only shown by panels.

A panel asks for the facts of what it shows. The first time there are none: a timer works them out
a moment later and draws the panel anew. From then on they follow every change of the datablock.
Blender runs no timers in background mode: scripts call ``update_now``.
"""

from collections.abc import Callable, Iterable

import bpy
from bpy.app.handlers import persistent

from ...blender.props import changes
from ..sparing import Sparing

_REGIONS = {"VIEW_3D": "UI", "PROPERTIES": "WINDOW"}
"""Region, by editor, that shows facts."""
_UNDONE = ("undo_post", "redo_post")


class Facts[B: bpy.types.ID, F]:
    """Facts of all datablocks of one kind that panels have asked for."""

    def __init__(
        self,
        blocks: str,
        work_out: Callable[[B], F],
        *,
        of_any_change: bool = False,
        stamp: Callable[[B], object] | None = None,
    ) -> None:
        """Know nothing yet.

        Args:
            blocks: Collection of ``bpy.data`` that holds the datablocks.
            work_out: Works out what is shown of one; what a user can mend is no error but a fact.
            of_any_change: Whether they depend on other datablocks, such as a scene's on its
                holograms: then every change counts.
            stamp: What they depend on beside properties, such as the place of an object; asked
                soon after anything in the scene has changed.
        """
        self._blocks = blocks
        self._work_out = work_out
        self._of_any_change = of_any_change
        self._stamp = stamp
        self._known: dict[int, F | None] = {}
        self._stamps: dict[int, object] = {}
        self._wanted: set[int] = set()
        # Blender knows callbacks by identity, and each access makes another bound method.
        self._timer = self._catch_up
        self._listener = self._hear
        self._undo_handler = persistent(lambda *_: self._want(self._known))
        self._load_handler = persistent(lambda *_: self._forget())
        self._comparing = Sparing(self._compare_stamps)
        self._depsgraph_handler = persistent(lambda *_: self._comparing.ask())

    def shown(self, block: B) -> F | None:
        """Look up what is known, and ask for it where nothing is.

        Args:
            block: The datablock.

        Returns:
            The last facts, or None until a timer has worked them out.
        """
        name = block.session_uid
        if name not in self._known:
            self._want((name,))
        return self._known.get(name)

    def update_now(self, block: B) -> F:
        """Work out the facts of one datablock.

        Args:
            block: The datablock.

        Returns:
            The facts, which are shown from now on.
        """
        name = block.session_uid
        self._wanted.discard(name)
        # Should working them out fail, that is told once and not at every redraw.
        self._known.setdefault(name, None)
        if self._stamp is not None:
            self._stamps[name] = self._stamp(block)
        found = self._work_out(block)
        self._known[name] = found
        return found

    def register(self) -> None:
        """Follow changes, undo, and files that are opened."""
        changes.listen(self._listener)
        for event in _UNDONE:
            getattr(bpy.app.handlers, event).append(self._undo_handler)
        bpy.app.handlers.load_post.append(self._load_handler)
        if self._stamp is not None:
            bpy.app.handlers.depsgraph_update_post.append(self._depsgraph_handler)

    def unregister(self) -> None:
        """Undo ``register``, and know nothing any more."""
        changes.stop(self._listener)
        for event in _UNDONE:
            getattr(bpy.app.handlers, event).remove(self._undo_handler)
        bpy.app.handlers.load_post.remove(self._load_handler)
        if self._stamp is not None:
            bpy.app.handlers.depsgraph_update_post.remove(self._depsgraph_handler)
        self._comparing.stop()
        for timer in (self._timer, _tag_regions):
            if bpy.app.timers.is_registered(timer):
                bpy.app.timers.unregister(timer)
        self._forget()

    def _hear(self, changed: frozenset[int]) -> None:
        self._wanted |= self._known.keys() if self._of_any_change else self._known.keys() & changed
        self._catch_up()

    def _compare_stamps(self) -> None:
        assert self._stamp is not None
        for block in self._found(self._known):
            if self._stamp(block) != self._stamps.get(block.session_uid):
                self._want((block.session_uid,))

    def _want(self, names: Iterable[int]) -> None:
        self._wanted.update(names)
        if self._wanted and not bpy.app.timers.is_registered(self._timer):
            bpy.app.timers.register(self._timer, first_interval=0.0)

    def _catch_up(self) -> None:
        blocks = self._found(self._wanted)
        self._wanted.clear()
        for block in blocks:
            self.update_now(block)
        if blocks:
            redraw()

    def _found(self, names: Iterable[int]) -> list[B]:
        asked = set(names)
        if not asked:
            return []
        return [block for block in getattr(bpy.data, self._blocks) if block.session_uid in asked]

    def _forget(self) -> None:
        self._known.clear()
        self._stamps.clear()
        self._wanted.clear()


def redraw() -> None:
    """Draw all panels anew, and once more when Blender has moved those below one that grew."""
    _tag_regions()
    if not bpy.app.background and not bpy.app.timers.is_registered(_tag_regions):
        bpy.app.timers.register(_tag_regions, first_interval=_ONCE_MORE_S)


_ONCE_MORE_S = 0.5


def _tag_regions() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if region.type == _REGIONS.get(area.type):
                    region.tag_redraw()
