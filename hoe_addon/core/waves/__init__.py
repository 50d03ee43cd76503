# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Recording waves, one kind a file: each knows its eikonal and the gradient of it.

The eikonal of a wave is its optical path length up to a constant; its gradient is ``n s``, the
index of the medium times the unit direction of propagation.
"""

from .plane import PlaneWave
from .point import PointSource
from .wave import Wave

__all__ = ["PlaneWave", "PointSource", "Wave"]
