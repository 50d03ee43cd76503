# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The artist's tutorial, step by step, by the operators that its menus and buttons call.

Claim: after the source of the sight's recording was moved by half a metre, the reticle is seen
where the source is; and a display behind a pane with a hologram on one face is seen as large as a
lens of 100 mm shows it.
"""

import math
import shutil
import sys
from functools import partial
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1]))

import bpy  # noqa: E402
import numpy as np  # noqa: E402

import hoe_addon  # noqa: E402
from hoe_addon.blender.api import refresh_changed  # noqa: E402
from hoe_addon.blender.quiet import forget_removed_engines  # noqa: E402
from hoe_addon.cli.claims import Row, compare, report, row  # noqa: E402
from hoe_addon.cli.example import (  # noqa: E402
    Example,
    read_arguments,
    read_expected,
    write_expected,
)
from hoe_addon.files import writable_folder  # noqa: E402

PRESET: str = "holographic_sight"
SAMPLES: int = 48
MEASURING: int = 64
"""Samples of the pictures that are measured; those that are shown have the number of the option."""
SIZE: tuple[int, int] = (400, 300)
SMALL: tuple[int, int] = (240, 180)
RETICLE, PANE = "reticle, to the right", "width of the display, tan"
ASIDE_MM, AWAY_MM, EYE_MM = 500.0, 50000.0, 220.0
EYE_TO_PANE_MM, PANE_TO_DISPLAY_MM, FOCAL_MM = 150.0, 60.0, 100.0
SPOT_MM: float = 10.0
GREEN_NM: float = 532.0
SMALL_PUPIL_MM: float = 0.5
RETICLE_ALLOWED_DEG: float = 0.06
PANE_ALLOWED: float = 0.03
SOURCE: str = (
    "geometry: a source 500 mm aside, 50 m beyond a window that is 220 mm from the eye; a lens of "
    "100 mm that shows a display 60 mm behind it 2.5 times as large, 150 mm behind it"
)
REASON: str = (
    "0.06 degrees: two thirds of a pixel, and noise; 3 % of the width: a pixel of the picture"
)


def sight(folder: Path, samples: int) -> float:
    """First part: a preset, another source, a picture.

    Args:
        folder: Folder for sight.png.
        samples: Samples per pixel of it.

    Returns:
        Degrees to the right at which the reticle is seen.
    """
    bpy.ops.hologram.add_preset(preset=PRESET, place="SCENE")
    scene = next(each for each in bpy.data.scenes if each.hologram.kind == "scene")
    with bpy.context.temp_override(scene=scene):
        bpy.ops.hologram.look_through_eye()
        window = scene.objects["window"].active_material.hologram
        window.recording.object.position_mm = (ASIDE_MM, 0.0, -AWAY_MM)
        refresh_changed()
        rendered(scene, folder, "sight", SIZE, samples)
        scene.hologram.room.kind = "none"
        refresh_changed()
        luminance = rendered(scene, folder, "", SMALL, MEASURING)
    middle = luminance.sum(axis=0) @ (np.arange(SMALL[0]) + 0.5) / luminance.sum()
    half = math.radians(scene.hologram.eye.field_deg / 2.0)
    return math.degrees(math.atan((2.0 * middle / SMALL[0] - 1.0) * math.tan(half)))


def pane(folder: Path, samples: int) -> float:
    """Second part: a hologram on one face of a pane in an empty scene.

    Args:
        folder: Folder for pane.png.
        samples: Samples per pixel of it.

    Returns:
        Tangent of the angle that a white display of 10 mm takes in green light.
    """
    bpy.ops.wm.read_factory_settings()
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.ops.hologram.add_eye(at_infinity=False, focus_mm=300.0, field_deg=25.0)
    bpy.ops.mesh.primitive_grid_add(
        x_subdivisions=3,
        y_subdivisions=3,
        size=120.0,
        location=(0.0, EYE_TO_PANE_MM, 0.0),
        rotation=(math.radians(90.0), 0.0, 0.0),
    )
    choose_face(bpy.context.object, 4)
    bpy.ops.hologram.hologram_on_faces()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.hologram.add_display(
        picture="speed",
        size_mm=(24.0, 13.5),
        luminance_cd_m2=100.0,
        location=(0.0, EYE_TO_PANE_MM + PANE_TO_DISPLAY_MM, 0.0),
    )
    display = bpy.context.object.hologram.display
    scene = bpy.context.scene
    scene.hologram.room.kind = "living_room"
    refresh_changed()
    rendered(scene, folder, "pane", SIZE, samples)
    scene.hologram.room.kind = "none"
    scene.hologram.render.mode = "preview"
    scene.hologram.render.preview_wavelength_nm = GREEN_NM
    scene.hologram.eye.pupil_diameter_mm = SMALL_PUPIL_MM
    display.picture, display.size_mm = "white", (SPOT_MM, SPOT_MM)
    refresh_changed()
    luminance = rendered(scene, folder, "", SMALL, MEASURING)
    line = luminance[SMALL[1] // 2 - 2 : SMALL[1] // 2 + 2].sum(axis=0)
    # The sky of Blender's first scene shines, too: what is below a quarter does not count.
    plateau = np.median(line[line > line.max() / 2.0])
    wide = np.clip((line / plateau - 0.25) / 0.5, 0.0, 1.0).sum()
    half = math.radians(scene.hologram.eye.field_deg / 2.0)
    return float(wide / SMALL[0] * 2.0 * math.tan(half))


def choose_face(item: bpy.types.Object, face: int) -> None:
    """Select one face in Edit Mode, as a click does."""
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    item.data.polygons[face].select = True
    bpy.ops.object.mode_set(mode="EDIT")


def rendered(
    scene: bpy.types.Scene, folder: Path, name: str, size: tuple[int, int], samples: int
) -> Any:
    """Press Render through the Eye, and take the picture of the image editor.

    Args:
        scene: The scene.
        folder: Folder for the picture.
        name: Name of its file; empty keeps none.
        size: Pixels.
        samples: Samples per pixel.

    Returns:
        Luminance, scene-linear, top row first.
    """
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.hologram.render.goal = "samples"
    scene.cycles.samples = samples
    results = folder / "results"
    bpy.ops.hologram.render(folder=str(results))
    image = bpy.data.images["Hologram Render"]
    pixels = np.empty(size[0] * size[1] * 4, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    if name:
        shutil.copy(results / "view.png", folder / f"{name}.png")
    bpy.data.images.remove(image)
    shutil.rmtree(results)
    rows = pixels.reshape(size[1], size[0], 4)[::-1, :, :3].astype(float)
    return rows @ (0.2126, 0.7152, 0.0722)


def measure(folder: Path, samples: int) -> dict[str, float]:
    """Do both parts.

    Args:
        folder: Folder for sight.png and pane.png.
        samples: Samples per pixel.

    Returns:
        Numbers by name.
    """
    forget_removed_engines()
    bpy.ops.wm.read_factory_settings()
    hoe_addon.register()
    return {RETICLE: sight(folder, samples), PANE: pane(folder, samples)}


def expected_numbers() -> list[Row]:
    """Directions of the moved source, and of the edges of the display's image."""
    aside = math.degrees(math.atan(ASIDE_MM / (AWAY_MM + EYE_MM)))
    image_mm = 1.0 / (1.0 / PANE_TO_DISPLAY_MM - 1.0 / FOCAL_MM)
    seen = SPOT_MM * image_mm / PANE_TO_DISPLAY_MM / (EYE_TO_PANE_MM + image_mm)
    return [
        row(RETICLE, "deg", round(aside, 4), RETICLE_ALLOWED_DEG),
        row(PANE, "1", round(seen, 5), round(PANE_ALLOWED * seen, 5)),
    ]


def main(output: Path, samples: int) -> int:
    """Do the steps and compare.

    Args:
        output: Folder for sight.png, pane.png and numbers.json.
        samples: Samples per pixel.

    Returns:
        0 if the numbers are as expected, else 1.
    """
    folder = writable_folder(output).resolve()
    found = measure(folder, samples)
    return report(compare(read_expected(HERE), found), folder / "numbers.json")


EXAMPLE = Example(HERE, PRESET, SOURCE, REASON, partial(measure, HERE, SAMPLES), expected_numbers)

if __name__ == "__main__":
    arguments = read_arguments(HERE, __doc__, SAMPLES)
    if arguments.renew:
        sys.exit(write_expected(HERE, EXAMPLE.document()))
    sys.exit(main(arguments.out, arguments.samples))
