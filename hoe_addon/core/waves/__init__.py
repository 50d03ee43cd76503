# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves, one kind a file: each knows its eikonal and the gradient of it.

The eikonal of a wave is its optical path length up to a constant; its gradient is ``n s``, the
index of the medium times the unit direction of propagation.
"""

from .astigmatic import AstigmaticSource
from .extended import ExtendedSource
from .plane import PlaneWave
from .point import PointSource
from .source_shapes import Disc, Line, Rectangle, SourceShape, TriangleMesh
from .wave import Wave
from .window import FlatWindow, WindowSource

__all__ = [
    "AstigmaticSource",
    "Disc",
    "ExtendedSource",
    "FlatWindow",
    "Line",
    "PlaneWave",
    "PointSource",
    "Rectangle",
    "SourceShape",
    "TriangleMesh",
    "Wave",
    "WindowSource",
]
