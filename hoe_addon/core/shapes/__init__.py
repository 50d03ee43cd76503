# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of surfaces: where a ray meets them, their normal, and their height over a plane."""

from .asphere import EvenAsphere
from .mesh import MeshShape
from .quadric import Conic, Cylinder, Plane
from .shape import Shape

__all__ = ["Conic", "Cylinder", "EvenAsphere", "MeshShape", "Plane", "Shape"]
