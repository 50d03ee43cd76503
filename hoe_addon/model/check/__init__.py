# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same element by every efficiency model that applies, and which of them hold."""

from .bragg import usual_light as usual_light
from .light import light_on as light_on
from .light import recorded_place_mm as recorded_place_mm
from .report import Report as Report
from .report import check_hologram as check_hologram
