# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""All efficiency models of documents."""

from .constant import ConstantSpec
from .kinoform import KinoformSpec

type EfficiencySpec = KinoformSpec | ConstantSpec

EFFICIENCIES = (KinoformSpec, ConstantSpec)
