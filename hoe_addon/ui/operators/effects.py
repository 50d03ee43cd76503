# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan: work it out, decide by hand, and leave it to the plan again."""

import bpy
from bpy.props import BoolProperty, StringProperty

from ...blender.document import chosen_effects
from ...blender.document.held import document_of, has_device
from ...blender.registration import class_registrars
from ...core.errors import HoeError
from ..facts import plans
from ..facts.cache import redraw
from ..facts.effect_words import LABELS, Effect
from ..ids import Op
from ..telling import tells


class _OfDevice:
    """Common part: there is a device to plan."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if context.scene is None or not has_device(context.scene):
            cls.poll_message_set("This scene holds no device; add one with Add > Hologram")
            return False
        return True


def _plan_beside(scene: bpy.types.Scene) -> None:
    """Plan without making the window wait; without a window there is nobody who could wait."""
    if bpy.app.background:
        plans.plan_now(scene, document_of(scene))
    else:
        plans.start(scene, document_of(scene), redraw)


def _plan_again(operator: bpy.types.Operator, scene: bpy.types.Scene) -> None:
    """Plan after a decision, which stands even where the document is not valid at the moment."""
    try:
        _plan_beside(scene)
    except HoeError as error:
        operator.report({"WARNING"}, str(error))
    redraw()


class HOE_OT_plan(_OfDevice, bpy.types.Operator):
    """Work out the effect plan."""

    bl_idname = Op.PLAN
    bl_label = "Work out the Plan"
    bl_description = (
        "Work out which effects this scene needs, and what leaving the others out costs. Takes up "
        "to some seconds, beside your work"
    )
    bl_options = {"REGISTER"}

    @tells
    def execute(self, context):
        _plan_beside(context.scene)
        redraw()
        return {"FINISHED"}


class HOE_OT_override(_OfDevice, bpy.types.Operator):
    """Turn an effect on or off by hand, or leave it to the plan again."""

    bl_idname = Op.OVERRIDE
    bl_label = "Decide about an Effect"
    bl_description = (
        "Turn an effect on or off, whatever the plan says; a second click leaves it to the plan"
    )
    bl_options = {"REGISTER", "UNDO"}

    effect: StringProperty(name="Effect", description="Name of the effect")
    hologram: StringProperty(
        name="Hologram", description="Name of the hologram; empty for the whole scene"
    )
    on: BoolProperty(name="On", description="Whether the effect is simulated", default=True)

    @classmethod
    def description(cls, context, properties):
        """Say what the effect is, and what a click does."""
        if properties.effect not in tuple(Effect):
            return cls.bl_description
        words = LABELS[Effect(properties.effect)][1]
        if chosen_effects.is_chosen(context.scene, properties.effect, properties.hologram):
            return f"{words}.\nYou have decided; click to leave it to the plan again"
        change = "simulate it all the same" if properties.on else "leave it out all the same"
        return f"{words}.\nThe plan has decided; click to {change}"

    @tells
    def execute(self, context):
        scene = context.scene
        if chosen_effects.is_chosen(scene, self.effect, self.hologram):
            chosen_effects.leave_to_plan(scene, self.effect, self.hologram)
        else:
            chosen_effects.choose(scene, self.effect, self.hologram, on=self.on)
        _plan_again(self, scene)
        return {"FINISHED"}


class HOE_OT_back_to_plan(_OfDevice, bpy.types.Operator):
    """Leave all effects to the plan again."""

    bl_idname = Op.BACK_TO_PLAN
    bl_label = "Back to the Plan"
    bl_description = "Take back all that you have decided about effects"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if not context.scene.hologram.render.effects:
            cls.poll_message_set("The plan decides about all effects already")
            return False
        return True

    def execute(self, context):
        chosen_effects.leave_all_to_plan(context.scene)
        _plan_again(self, context.scene)
        return {"FINISHED"}


register, unregister = class_registrars((HOE_OT_plan, HOE_OT_override, HOE_OT_back_to_plan))
