# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan: what is simulated and why, and one click to decide otherwise."""

from itertools import groupby

import bpy

from ...blender.document.chosen_effects import is_chosen
from ...blender.document.held import has_device
from ..facts import plans
from ..facts.effects import WHOLE, EffectLine, PlanFacts
from ..facts.scenes import DEVICE_FACTS
from ..ids import Op
from .base import SCENE, SIDEBAR, Body, panel_registrars, wrapped
from .tables import problem

_MOST_NAMES = 3


class Effects(Body):
    """The plan, one line for each effect that is there."""

    name = "effects"
    bl_label = "Effects"
    bl_order = 30
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_device(context.scene)

    def draw(self, context: bpy.types.Context) -> None:
        layout, scene = self.layout, context.scene
        plan, facts = plans.plan_of(scene), DEVICE_FACTS.shown(scene)
        planning = plans.is_planning(scene)
        if facts is not None and facts.foreign:
            _draw_foreign(layout, context, facts.foreign)
        row = layout.row(align=True)
        row.enabled = not planning
        row.operator(Op.PLAN, text=_button(plan, planning), icon="FILE_REFRESH")
        if scene.hologram.render.effects:
            row.operator(Op.BACK_TO_PLAN, text="", icon="LOOP_BACK")
        if plan is None:
            return
        if facts is not None and facts.digest != plan.digest and not planning:
            wrapped(layout, context, "The scene has changed since this plan", "INFO")
        if plan.problem:
            problem(layout, context, plan.problem)
            return
        wrapped(layout, context, f"{plan.summary}.")
        for hologram, lines in groupby(plan.lines, key=lambda line: line.hologram):
            box = layout.box().column(align=True)
            _draw_heading(box, hologram)
            for line in lines:
                _draw_line(box, context, line)


def _button(plan: PlanFacts | None, planning: bool) -> str:
    if planning:
        return "Working out the Plan..."
    return "Work out the Plan" if plan is None else "Work out the Plan Again"


def _draw_foreign(
    layout: bpy.types.UILayout, context: bpy.types.Context, names: tuple[str, ...]
) -> None:
    """Say that nothing is left out, and because of what."""
    shown = ", ".join(names[:_MOST_NAMES])
    if len(names) > _MOST_NAMES:
        shown += f" and {len(names) - _MOST_NAMES} more"
    words = f"Nothing is left out: the plan does not know the light of {shown}."
    wrapped(layout, context, words, "INFO")


def _draw_heading(layout: bpy.types.UILayout, hologram: str) -> None:
    row = layout.row()
    row.label(text=hologram or WHOLE, icon="TEXTURE" if hologram else "SCENE_DATA")
    column = row.row()
    column.alignment = "RIGHT"
    column.label(text="error without")


def _draw_line(layout: bpy.types.UILayout, context: bpy.types.Context, line: EffectLine) -> None:
    row = layout.row(align=True)
    switch = row.row()
    switch.alignment = "LEFT"
    chosen = is_chosen(context.scene, line.effect, line.hologram)
    switch.enabled = line.can_change or chosen
    icon = "CHECKBOX_HLT" if line.on else "CHECKBOX_DEHLT"
    button = switch.operator(Op.OVERRIDE, text=line.label, icon=icon, emboss=False)
    button.effect, button.hologram, button.on = line.effect, line.hologram, not line.on
    cost = row.row()
    cost.alignment = "RIGHT"
    cost.label(text=line.error, icon="USER" if chosen else "NONE")
    reasons = layout.column(align=True)
    reasons.active = False
    for sentence in line.why:
        wrapped(reasons, context, sentence, "BLANK1")


register, unregister = panel_registrars((SIDEBAR, SCENE), (Effects,))
