# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples that compare a light guide's luminance in Cycles with that of a walk in numpy."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .claims import Claim
from .example import provenance

if TYPE_CHECKING:
    from ..blender.build.device import DeviceScene
    from ..blender.pictures.eyebox import FieldLuminance

_RELATIVE_TOLERANCE = 0.05
_STANDARD_ERRORS = 3.0
_REASON = (
    "the two engines are promised to agree within 5 %; on top of it the noise "
    "of the render, so that few samples are enough"
)
_SOURCE = (
    "hoe_addon.model.device_walk.eyebox_luminance: rays from the display "
    "forward to the pupil, numpy, float64, without Cycles"
)


@dataclass(frozen=True)
class ForwardWalk:
    """A walk from the display to some pupils, which shares no code with Cycles.

    Attributes:
        preset: The light guide.
        pupils_mm: Middles of the pupils, in the frame of the guide.
        rays: Number of rays.
        seed: Seed of the walk.
        weight_cut: A branch ends below this part of its ray's power.
    """

    preset: str
    pupils_mm: tuple[tuple[float, float, float], ...]
    rays: int
    seed: int = 1
    weight_cut: float = 1e-6

    def document(self, folder: Path) -> dict[str, Any]:
        """Walk, and make of it what expected.json holds.

        Args:
            folder: Folder of the example.

        Returns:
            The document.
        """
        from ..model.device import LightGuideSpec
        from ..model.device_walk import eyebox_luminance
        from ..model.document import load_device

        spec = load_device(self.preset)
        assert isinstance(spec, LightGuideSpec), "only light guides have an eyebox"
        walk = eyebox_luminance(
            spec, self.pupils_mm, rays=self.rays, seed=self.seed, weight_cut=self.weight_cut
        )
        return {
            "provenance": {
                **provenance(folder, _SOURCE, self.preset),
                "rays": self.rays,
                "seed": self.seed,
                "digits": "means to 0.1 cd/m2, standard errors to 0.01 cd/m2",
            },
            "tolerance": {
                "relative": _RELATIVE_TOLERANCE,
                "standard_errors": _STANDARD_ERRORS,
                "reason": _REASON,
            },
            "pupils": [
                {
                    "position_mm": list(position),
                    "mean_cd_m2": round(float(mean), 1),
                    "standard_error_cd_m2": round(float(error), 2),
                }
                for position, mean, error in zip(
                    self.pupils_mm, walk.mean_cd_m2, walk.error_cd_m2, strict=True
                )
            ],
        }


def seen_luminances(
    device: "DeviceScene", expected: dict[str, Any], samples: int
) -> list[tuple[Claim, "FieldLuminance"]]:
    """Measure a white display in Cycles at the pupils of expected.json.

    Args:
        device: The light guide in its scene.
        expected: What expected.json holds.
        samples: Samples per cell of the measurement, at least 4.

    Returns:
        For each pupil the claim, in cd/m2, and all that was measured.
    """
    from ..blender.pictures.eyebox import fields_at
    from ..model.eyebox import PupilPosition

    rows, tolerance = expected["pupils"], expected["tolerance"]
    places = [PupilPosition(n, 0, tuple(row["position_mm"])) for n, row in enumerate(rows)]
    found: list[tuple[Claim, FieldLuminance]] = []
    for row, field in zip(rows, fields_at(device, places, samples), strict=True):
        wanted, (x, y, _) = row["mean_cd_m2"], row["position_mm"]
        allowed = tolerance["relative"] * wanted
        allowed += tolerance["standard_errors"] * field.standard_error_cd_m2
        name = f"pupil at {x:g}, {y:g} mm"
        found.append((Claim(name, "cd/m2", wanted, field.mean_cd_m2, allowed), field))
    return found
