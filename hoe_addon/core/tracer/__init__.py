# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference ray tracer through planar surfaces: gratings, dielectrics, mirrors, ideal lenses.

`walk_sequence` follows rays through a given list of surfaces, and `walk_sequence_backward` takes
them back. `walk_tree` finds the surfaces itself and splits each ray into all its branches.
"""

from .geometry import Aperture, Circle, Frame, Rays, Rectangle
from .sequence import SequenceWalk, Step, walk_sequence, walk_sequence_backward
from .surfaces import Absorber, Dielectric, Grating, IdealLens, Mirror, PlanarSurface, Receiver
from .tree import EnergyBalance, Landed, TreeWalk, walk_tree

__all__ = [
    "Absorber",
    "Aperture",
    "Circle",
    "Dielectric",
    "EnergyBalance",
    "Frame",
    "Grating",
    "IdealLens",
    "Landed",
    "Mirror",
    "PlanarSurface",
    "Rays",
    "Receiver",
    "Rectangle",
    "SequenceWalk",
    "Step",
    "TreeWalk",
    "walk_sequence",
    "walk_sequence_backward",
    "walk_tree",
]
