# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Problems in the words of the panels."""

import pytest

from hoe_addon.ui.wording import in_plain_words, is_question


@pytest.mark.parametrize(
    ("told", "plain"),
    [
        ('efficiency.file: must not be empty, got ""', "Choose a table file."),
        ("efficiency.file: is missing", "Choose a table file."),
        ('surface.file: must not be empty, got ""', "Choose a file."),
        (
            "recording.object.target: must be an object of the scene, got null",
            "The object wave follows no object: choose its source, or untick Follow.",
        ),
        (
            "recording.reference.target: Lamp is in no scene; its last place counts",
            "Lamp, the source of the reference wave, was deleted; its last place counts. Choose "
            "another, or untick Follow.",
        ),
        (
            "recording.object.position_mm[2]: must be finite, got null",
            "Object Wave > Position 3: must be finite",
        ),
        ("orders: must not be empty, got []", "Orders: must not be empty, got []"),
        ("holograms[1].center_mm: must be inside", "Holograms 2 > Center: must be inside"),
        (
            "holograms[1] (out.2).size_mm[0]: must be above 0, got 0",
            "Holograms out.2 > Size 1: must be above 0, got 0",
        ),
        ("This file is newer: get the new add-on", "This file is newer: get the new add-on"),
        ("Problem in the Recording of window", "Problem in the Recording of window"),
    ],
)
def test_paths_become_labels(told: str, plain: str) -> None:
    assert in_plain_words(told) == plain


def test_what_was_not_chosen_yet_is_no_fault() -> None:
    assert is_question('efficiency.file: must not be empty, got ""')
    assert not is_question("recording.object.target: must be an object of the scene, got null")
