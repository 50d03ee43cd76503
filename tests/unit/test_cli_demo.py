# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo has no options of a picture, and yet a value for each."""

from hoe_addon.cli import _parser
from hoe_addon.cli.demo import _VIEW
from hoe_addon.cli.picture_options import light_guide_of


def test_demo_reads_its_device() -> None:
    args = _parser().parse_args(["demo"])
    assert light_guide_of(args, _VIEW).name == "two_hologram_ar"
