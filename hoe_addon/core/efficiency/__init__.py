# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light goes into each order: one model a file, all functions of an `Incidence`."""

from .incidence import Incidence as Incidence
from .incidence import Polarization as Polarization
from .incidence import RecordedWaves as RecordedWaves
from .incidence import meet as meet
from .model import EfficiencyModel as EfficiencyModel
