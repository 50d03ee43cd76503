# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much light each order gets: the efficiency models of a document, one a file."""

from .constant import ConstantSpec as ConstantSpec
from .constant import ShareTable as ShareTable
from .fits import check_fits as check_fits
from .haze import HazeSpec as HazeSpec
from .kinoform import KinoformSpec as KinoformSpec
from .kogelnik import ExposureSpec as ExposureSpec
from .kogelnik import KogelnikSpec as KogelnikSpec
from .orders import settle_orders as settle_orders
from .rcwa import RcwaSpec as RcwaSpec
from .specs import EFFICIENCIES as EFFICIENCIES
from .specs import EfficiencySpec as EfficiencySpec
from .table import TableSpec as TableSpec
from .varying import PlaceFormula as PlaceFormula
from .varying import Varying as Varying
