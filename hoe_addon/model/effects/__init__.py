# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The effect plan: which effects a scene calls for, and the simpler document without the rest."""

from .names import WHOLE_SCENE as WHOLE_SCENE
from .names import Decision as Decision
from .names import Effect as Effect
from .names import EffectPlan as EffectPlan
from .plan import plan_effects as plan_effects
from .plan import plan_hologram as plan_hologram
from .plan import planned as planned
