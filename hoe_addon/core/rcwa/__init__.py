# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigorous coupled-wave analysis of one-dimensional gratings in conical mount."""

from .convergence import Converged as Converged
from .convergence import Structure as Structure
from .convergence import converge as converge
from .factorisation import SingularError as SingularError
from .light import PlaneWaves as PlaneWaves
from .light import Solution as Solution
from .profiles import Polygon as Polygon
from .profiles import polygon_layers as polygon_layers
from .solve import Progress as Progress
from .solve import solve as solve
from .stack import BACK as BACK
from .stack import FRONT as FRONT
from .stack import Lamellar as Lamellar
from .stack import Layer as Layer
from .stack import Repeat as Repeat
from .stack import Smooth as Smooth
from .stack import Stack as Stack
from .stack import Uniform as Uniform
from .volume import volume_layers as volume_layers
