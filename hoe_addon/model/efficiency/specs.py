# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All efficiency models of documents."""

from .constant import ConstantSpec
from .kinoform import KinoformSpec
from .kogelnik import KogelnikSpec
from .rcwa import RcwaSpec
from .table import TableSpec

type EfficiencySpec = KinoformSpec | ConstantSpec | KogelnikSpec | RcwaSpec | TableSpec

EFFICIENCIES = (KinoformSpec, ConstantSpec, KogelnikSpec, RcwaSpec, TableSpec)
