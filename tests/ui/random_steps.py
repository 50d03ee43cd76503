# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random steps of a user: operators, buttons and sliders of panels, and what Blender does itself.

A step is chosen, says in words what it is, and may be refused by an operator in one line.
"""

import random
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from hoe_addon.model.document import preset_titles
from hoe_addon.model.effects.names import Effect
from hoe_addon.ui.ids import Op
from tests.ui.layouts import Call, operator_rna
from tests.ui.random_values import random_value
from tests.ui.steps import call

LONG = frozenset(
    {Op.RENDER, Op.EYEBOX, Op.ACCURACY, Op.BAKE_TABLE, Op.CANCEL, Op.JOB_ENDED},
)
"""Work of a process of its own; its operators have tests of their own."""

FILES = frozenset({Op.IMPORT_HOLOGRAM, Op.EXPORT_HOLOGRAM, Op.IMPORT_DEVICE, Op.EXPORT_DEVICE})

REFUSED = ("Error: ", "Operator bpy.ops.")
"""How Blender begins what an operator, or its poll, says where it does nothing."""


class Skipped(Exception):  # noqa: N818 (it is no error)
    """There is nothing to do this to."""


@dataclass
class Steps:
    """Chooses and takes steps.

    Attributes:
        rng: Random numbers.
        folder: For files.
        calls: What panels show.
        called: Operators that were called, whatever came of it.
        taken: The steps, in words.
    """

    rng: random.Random
    folder: Path
    calls: list[Call]
    called: set[str]
    taken: list[str]

    def take(self) -> None:
        """Take one step that is possible."""
        for _ in range(50):
            step = self.rng.choices(list(_STEPS), weights=list(_STEPS.values()))[0]
            self.taken.append(step.__name__)
            with suppress(Skipped, LookupError):
                step(self)
                return
            self.taken.pop()
        raise AssertionError("nothing can be done")

    def say(self, words: str) -> None:
        """Say what the step is, before it is taken."""
        self.taken[-1] = words

    def call(self, name: str, **settings: Any) -> None:
        """Call an operator, which may refuse in one line."""
        given = ", ".join(f"{key}={value!r}" for key, value in settings.items())
        self.say(f"bpy.ops.{name}({given})")
        self.called.add(str(name))
        try:
            done = call(name, **settings)
        except RuntimeError as error:
            said = str(error).strip()
            self.taken[-1] += f"  # {said}"
            assert said.startswith(REFUSED), said
            assert "Traceback" not in said, said
            assert "\n" not in said, said
        else:
            assert done <= {"FINISHED", "CANCELLED", "PASS_THROUGH"}, done

    def settings(self, name: str) -> dict[str, Any]:
        """Choose some of an operator's properties."""
        rna, chosen = operator_rna(name), {}
        for prop in rna.properties:
            if prop.identifier != "rna_type" and self.rng.random() < 0.4:
                with suppress(LookupError):
                    chosen[prop.identifier] = random_value(
                        self.rng, _Defaults(rna), prop.identifier
                    )
        return chosen

    def item(self, kind: str | None = None) -> Any:
        """Choose an object of the scene."""
        found = [each for each in bpy.context.view_layer.objects if kind in (None, each.type)]
        if not found:
            raise Skipped
        return self.rng.choice(found)


class _Defaults:
    """The properties of an operator, all at their defaults."""

    def __init__(self, rna: Any) -> None:
        self.bl_rna = rna

    def __getattr__(self, name: str) -> Any:
        prop = self.bl_rna.properties[name]
        return prop.default_array if getattr(prop, "array_length", 0) else prop.default


# What the add-on does.


def add_element(steps: Steps) -> None:
    """Add > Hologram, with random settings."""
    elements = (Op.ADD_HOLOGRAM, Op.ADD_SLAB, Op.ADD_DISPLAY, Op.ADD_LAMP)
    name = steps.rng.choice((*elements, Op.ADD_IDEAL_LENS, Op.ADD_GLASS, Op.ADD_EYE))
    steps.call(name, **steps.settings(name))


def add_preset(steps: Steps) -> None:
    """Add > Hologram > Scene or Device."""
    preset = steps.rng.choice(list(preset_titles()))
    steps.call(Op.ADD_PRESET, preset=preset, place=steps.rng.choice(("SCENE", "DEVICE", "DEVICE")))


def on_faces(steps: Steps) -> None:
    """Hologram on some faces of a mesh, or on all of them."""
    item = steps.item("MESH")
    if bpy.context.mode != "OBJECT":
        raise Skipped
    bpy.context.view_layer.objects.active = item
    editing = steps.rng.random() < 0.6 and item.visible_get()
    if editing:
        for face in item.data.polygons:
            face.select = steps.rng.random() < 0.4
        bpy.ops.object.mode_set(mode="EDIT")
    steps.call(Op.HOLOGRAM_ON_FACES, **steps.settings(Op.HOLOGRAM_ON_FACES))
    if editing:
        # Edit Mode has undo steps of its own, which hold the mesh alone.
        bpy.ops.object.mode_set(mode="OBJECT")


def any_operator(steps: Steps) -> None:
    """Any operator, whether it is offered or not."""
    name = steps.rng.choice([name for name in Op if name not in LONG | FILES | {Op.ADD_PRESET}])
    settings = steps.settings(name)
    if name == Op.OVERRIDE:
        settings = {"effect": steps.rng.choice(list(Effect)), "on": steps.rng.random() < 0.5}
    steps.call(name, **settings)


def write_and_read(steps: Steps) -> None:
    """Export to a file, or import one that was written before."""
    name = steps.rng.choice(sorted(FILES))
    kind = "device" if "device" in name else "hologram"
    steps.call(name, filepath=str(steps.folder / f"{kind}.json"))


def button(steps: Steps) -> None:
    """Press a button that a panel shows."""
    kinds = LONG | FILES
    found = [
        each
        for each in steps.calls
        if each.kind == "operator" and each.enabled and each.name in set(Op) - kinds
    ]
    if not found:
        raise Skipped
    chosen = steps.rng.choice(found)
    steps.call(chosen.name, **chosen.assigned)


def slider(steps: Steps) -> None:
    """Change what a panel shows."""
    found = [each for each in steps.calls if each.owner is not None and each.enabled]
    if not found:
        raise Skipped
    chosen = steps.rng.choice(found)
    value = random_value(steps.rng, chosen.owner, chosen.name)
    owner = chosen.owner
    path = f"{owner.id_data!r}.{owner.path_from_id() if owner != owner.id_data else ''}"
    steps.say(f"{path}.{chosen.name} = {value!r}")
    setattr(owner, chosen.name, value)


# What Blender does.


def select(steps: Steps) -> None:
    """Click on an object, and perhaps on a further one."""
    item = steps.item()
    if bpy.context.mode != "OBJECT":
        raise Skipped
    steps.say(f"select {item.name}")
    if steps.rng.random() < 0.7:
        for other in bpy.context.view_layer.objects:
            other.select_set(False)
    item.select_set(True)
    bpy.context.view_layer.objects.active = item


def select_slot(steps: Steps) -> None:
    """Choose another slot of the active object."""
    item = bpy.context.object
    if item is None or not item.material_slots:
        raise Skipped
    item.active_material_index = steps.rng.randrange(len(item.material_slots))
    steps.say(f"slot {item.active_material_index} of {item.name}")


def blender_operator(steps: Steps) -> None:
    """Delete, duplicate, and the like."""
    name, settings = steps.rng.choice(_OF_BLENDER)
    steps.call(name, **settings)


def rename(steps: Steps) -> None:
    """Give something another name."""
    blocks = [*bpy.data.objects, *bpy.data.materials, *bpy.data.scenes]
    block = steps.rng.choice(blocks)
    name = steps.rng.choice(("Mine", "Hologram", block.name + " 2", "x" * 63))
    steps.say(f"{block!r}.name = {name!r}")
    block.name = name


def move(steps: Steps) -> None:
    """Move, turn or scale an object."""
    item = steps.item()
    match steps.rng.randrange(5):
        case 0 | 1:
            item.location = [each + steps.rng.gauss(0.0, 10.0) for each in item.location]
        case 2 | 3:
            item.rotation_euler = [steps.rng.gauss(0.0, 0.5) for _ in range(3)]
        case _:
            item.scale = [steps.rng.uniform(0.5, 2.0)] * 3
    steps.say(f"{item.name} to {item.location[:]}, {item.rotation_euler[:]}, {item.scale[:]}")


def copy_material(steps: Steps) -> None:
    """Make a copy of the active material, for the active object alone; or share it."""
    item = steps.item("MESH")
    material = steps.rng.choice([None, *bpy.data.materials])
    if material is not None and steps.rng.random() < 0.6:
        material = material.copy()
    if item.mode != "OBJECT":
        raise Skipped
    steps.say(f"material of {item.name} is {material and material.name}")
    item.active_material = material


def frame(steps: Steps) -> None:
    """Go to another frame; perhaps with keys of what a panel shows."""
    scene = bpy.context.scene
    number = steps.rng.randrange(1, 30)
    keyed = ""
    found = [each for each in steps.calls if type(each.owner).__name__.startswith("HOE_PG")]
    if found and steps.rng.random() < 0.6:
        chosen = steps.rng.choice(found)
        with suppress(TypeError, RuntimeError):
            chosen.owner.keyframe_insert(chosen.name, frame=number)
            keyed = f", key of {chosen.owner!r}.{chosen.name}"
    steps.say(f"frame {number}{keyed}")
    scene.frame_set(number)


def another_scene(steps: Steps) -> None:
    """Show another scene of the file."""
    if len(bpy.data.scenes) < 2 or bpy.context.mode != "OBJECT":
        raise Skipped
    scene = steps.rng.choice(list(bpy.data.scenes))
    steps.say(f"show {scene.name}")
    bpy.context.window.scene = scene


_OF_BLENDER: tuple[tuple[str, dict[str, Any]], ...] = (
    ("object.delete", {}),
    ("object.delete", {"confirm": False, "use_global": True}),
    ("object.duplicate", {}),
    ("object.duplicate", {"linked": True}),
    ("object.make_single_user", {"object": True, "obdata": True, "material": True}),
    ("object.transform_apply", {}),
    ("object.select_all", {"action": "SELECT"}),
    ("object.parent_clear", {"type": "CLEAR_KEEP_TRANSFORM"}),
    ("object.material_slot_add", {}),
    ("object.material_slot_remove", {}),
    ("object.join", {}),
    ("scene.new", {"type": "FULL_COPY"}),
    ("scene.new", {"type": "LINK_COPY"}),
    ("scene.delete", {}),
    ("mesh.primitive_cube_add", {"size": 20.0}),
    ("outliner.orphans_purge", {"do_recursive": True}),
)

_STEPS: dict[Callable[[Steps], None], float] = {
    add_element: 3.0,
    add_preset: 1.5,
    on_faces: 1.0,
    any_operator: 3.0,
    write_and_read: 1.0,
    button: 4.0,
    slider: 6.0,
    select: 2.0,
    select_slot: 1.0,
    blender_operator: 3.0,
    rename: 1.0,
    move: 1.5,
    copy_material: 1.0,
    frame: 1.0,
    another_scene: 0.5,
}
"""With how often each is chosen."""
