# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of an eyebox study."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import json

from window import Picture, View, hide_room, part, scene, take

RESULT = Path(__file__).resolve().parent / "eyebox.json"
"""What the study of this preset wrote."""


def prepare() -> None:
    """Show the results as if the study had just ended."""
    hide_room()
    report = json.loads(RESULT.read_text(encoding="utf-8"))
    result = {"report": report, "folder": "//renders/eyebox_001"}
    here, facts = scene(), part("ui.facts.device")
    digest = facts.plan_digest(part("blender.document.held").document_of(here))
    kind = part("blender.job_files").JobKind.EYEBOX
    part("ui.facts.study").keep_result(here, kind, result, digest)


take(
    Picture(
        "two_hologram_ar",
        opened=("study", "study_eyebox"),
        view=View((12.0, 10.0, 0.0), 75.0, (62.0, 0.0, 30.0)),
        prepare=prepare,
    )
)
