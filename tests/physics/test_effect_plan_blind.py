# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the plan's rays cannot know, nothing is left out; a changed file is a changed document."""

from pathlib import Path
from typing import Any

import numpy as np

from hoe_addon.model.document import device_from, load_device, to_document
from hoe_addon.model.effects import Effect, plan_effects

LASER = {"kind": "line", "centre_nm": 632.8, "fwhm_nm": 0.002}


def rainbow(**lamp: Any) -> dict[str, Any]:
    """The lamp behind a grating, in the dark; with another lamp, or light."""
    document = to_document(load_device("grating_rainbow", ["room.kind=none"]))
    found = next(each for each in document["elements"] if each["name"] == "lamp")
    found.update(lamp)
    return document


def test_lamp_that_no_ray_meets_keeps_all_effects() -> None:
    """A laser needs no wavelengths; of a lamp that is too small to be met nobody knows."""
    seen = plan_effects(device_from(rainbow(spectrum=LASER)))
    assert not seen.is_on(Effect.DISPERSION)
    unseen = plan_effects(device_from(rainbow(spectrum=LASER, size_mm=[0.1, 0.1])))
    assert unseen.is_on(Effect.DISPERSION)
    assert not unseen.left_out


def test_lamp_beside_the_field_keeps_haze() -> None:
    """A disc as bright as a lit window in the sun, 25 degrees aside, veils all of the picture."""
    document = rainbow(size_mm=[60.0, 420.0], luminance_cd_m2=70.0)
    hologram = document["elements"][0]["hologram"]
    hologram["orders"], efficiency = [0], hologram["efficiency"]
    efficiency["table"] = {"T": {"0": 0.8}, "R": {}}
    efficiency["haze"] = {"share": 1e-5, "width_deg": 10.0}
    document["eye"]["field_deg"] = 30.0
    assert not plan_effects(device_from(document)).is_on(Effect.HAZE, "grating")
    sun = {
        **next(each for each in document["elements"] if each["name"] == "lamp"),
        "name": "sun",
        "shape": "disc",
        "size_mm": [300.0, 300.0],
        "position_mm": [900.0, 0.0, -1960.0],
        "luminance_cd_m2": 1e6,
    }
    document["elements"].append(sun)
    assert plan_effects(device_from(document)).is_on(Effect.HAZE, "grating")


def test_other_numbers_in_a_file_of_the_same_name_make_another_plan(tmp_path: Path) -> None:
    """Full depth of a wave sends light into order +1; no depth at all leaves it in order 0."""
    relief = tmp_path / "relief.txt"
    phase = (np.arange(64) + 0.5) / 64
    document = rainbow(spectrum=LASER)
    hologram = document["elements"][0]["hologram"]
    hologram["efficiency"] = {
        "model": "kinoform",
        "levels": 0,
        "design_wavelength_nm": 632.8,
        "relief": 1.5,
        "profile": {"shape": "sampled", "file": str(relief)},
    }
    hologram["orders"] = [0, 1]
    traced = []
    for depth in (1.0, 1e-9):
        np.savetxt(relief, depth * phase)
        plan = plan_effects(device_from(document))
        traced.append([each.on for each in plan.decisions if each.effect == Effect.ORDERS])
    assert traced[0] != traced[1]
