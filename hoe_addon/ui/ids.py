# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Names by which Blender knows operators, panels' tab and menus; each stands here alone."""

from enum import StrEnum, unique

TAB = "Hologram"
"""Tab of the 3-D view's sidebar."""


@unique
class Op(StrEnum):
    """Operators."""

    # adding
    ADD_PRESET = "hologram.add_preset"
    ADD_HOLOGRAM = "hologram.add_hologram"
    HOLOGRAM_ON_FACES = "hologram.hologram_on_faces"
    ADD_SLAB = "hologram.add_slab"
    ADD_DISPLAY = "hologram.add_display"
    ADD_LAMP = "hologram.add_lamp"
    ADD_IDEAL_LENS = "hologram.add_ideal_lens"
    ADD_GLASS = "hologram.add_glass"
    ADD_EYE = "hologram.add_eye"
    # mending
    MEND = "hologram.mend"
    REFRESH = "hologram.refresh"
    # recording and efficiency
    MAKE_HOLOGRAM = "hologram.make_hologram"
    SOURCE_FROM_SELECTION = "hologram.source_from_selection"
    ADD_ORDER = "hologram.add_order"
    REMOVE_ORDER = "hologram.remove_order"
    ADD_SHARE = "hologram.add_share"
    REMOVE_SHARE = "hologram.remove_share"
    BAKE_TABLE = "hologram.bake_table"
    CHECK = "hologram.check"
    # device
    ADD_PATCH = "hologram.add_patch"
    REMOVE_PATCH = "hologram.remove_patch"
    TRUE_SIZE = "hologram.true_size"
    LOOK_THROUGH_EYE = "hologram.look_through_eye"
    # files
    IMPORT_HOLOGRAM = "hologram.import_hologram"
    EXPORT_HOLOGRAM = "hologram.export_hologram"
    IMPORT_DEVICE = "hologram.import_device"
    EXPORT_DEVICE = "hologram.export_device"
    # effects
    PLAN = "hologram.plan"
    OVERRIDE = "hologram.override"
    BACK_TO_PLAN = "hologram.back_to_plan"
    # long work
    RENDER = "hologram.render"
    EYEBOX = "hologram.eyebox"
    ACCURACY = "hologram.accuracy"
    CANCEL = "hologram.cancel"
    JOB_ENDED = "hologram.job_ended"


@unique
class Menu(StrEnum):
    """Menus."""

    ADD = "HOE_MT_add"
    ADD_SCENE = "HOE_MT_add_scene"
    ADD_DEVICE = "HOE_MT_add_device"
