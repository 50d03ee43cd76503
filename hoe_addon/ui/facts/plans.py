# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plans of the open scenes, made in a thread beside the window.

The thread gets a document and gives back text: it never touches Blender's data. A timer in the
window's own thread fetches what is done.
"""

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field

import bpy

from ...model.device import DeviceSpec
from .effects import PlanFacts, plan_facts

_LOOK_EVERY_S = 0.1


@dataclass
class _State:
    """What is known, by the session id of the scene."""

    plans: dict[int, PlanFacts] = field(default_factory=dict[int, PlanFacts])
    works: dict[int, Future[PlanFacts]] = field(default_factory=dict[int, "Future[PlanFacts]"])
    thread: ThreadPoolExecutor | None = None
    told: Callable[[], None] | None = None


_state = _State()


def plan_of(scene: bpy.types.Scene) -> PlanFacts | None:
    """The last plan of a scene.

    Args:
        scene: The scene.

    Returns:
        The plan, perhaps out of date; None where none was made.
    """
    return _state.plans.get(scene.session_uid)


def is_planning(scene: bpy.types.Scene) -> bool:
    """Whether a plan of a scene is being made."""
    return scene.session_uid in _state.works


def plan_now(scene: bpy.types.Scene, spec: DeviceSpec) -> PlanFacts:
    """Make the plan of a scene and wait for it.

    Args:
        scene: The scene.
        spec: Its document.

    Returns:
        The plan.
    """
    found = plan_facts(spec)
    _state.plans[scene.session_uid] = found
    return found


def start(scene: bpy.types.Scene, spec: DeviceSpec, told: Callable[[], None]) -> None:
    """Begin to make the plan of a scene; one that is being made for it counts no more.

    Args:
        scene: The scene.
        spec: Its document.
        told: Called in the window's thread when a plan is there.
    """
    if _state.thread is None:
        _state.thread = ThreadPoolExecutor(1, "effect plan")
    older = _state.works.get(scene.session_uid)
    if older is not None:
        older.cancel()
    _state.works[scene.session_uid] = _state.thread.submit(plan_facts, spec)
    _state.told = told
    if not bpy.app.timers.is_registered(_fetch):
        bpy.app.timers.register(_fetch, first_interval=_LOOK_EVERY_S)


def _fetch() -> float | None:
    """Take what is done; Blender calls it again until nothing is left."""
    for uid in [uid for uid, work in _state.works.items() if work.done()]:
        work = _state.works.pop(uid)
        _state.plans[uid] = work.result()
        if _state.told is not None:
            _state.told()
    return _LOOK_EVERY_S if _state.works else None


def register() -> None:
    """Nothing is needed before the first plan."""


def unregister() -> None:
    """Forget all plans; one that is being made ends by itself, and nobody fetches it."""
    if bpy.app.timers.is_registered(_fetch):
        bpy.app.timers.unregister(_fetch)
    if _state.thread is not None:
        _state.thread.shutdown(wait=False, cancel_futures=True)
    _state.works.clear()
    _state.plans.clear()
    _state.thread, _state.told = None, None
