# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light each order gets: the efficiency models of a document, one a file."""

from .constant import ConstantSpec as ConstantSpec
from .constant import ShareTable as ShareTable
from .haze import HazeSpec as HazeSpec
from .kinoform import KinoformSpec as KinoformSpec
from .orders import settle_orders as settle_orders
from .specs import EFFICIENCIES as EFFICIENCIES
from .specs import EfficiencySpec as EfficiencySpec
