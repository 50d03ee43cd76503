# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Job: the map and the table that a hologram needs, made into the cache."""

from typing import Any

from .session import Work

_MAP_SHARE = 0.1
"""Of the work, where there is a map; most holograms need a map or a table, not both."""


def run(work: Work) -> dict[str, Any]:
    """Make what is not in the cache.

    Args:
        work: The job; its setting ``material`` is the name of a material of this file.

    Returns:
        What the window shows of it.
    """
    import bpy

    from ...blender.props.followed import read_followed
    from ...blender.props.sync import read_spec
    from ...blender.shaders.following import waves_of
    from ...blender.shaders.maps import prepare_map
    from ...blender.shaders.tables import prepare_table

    name = work.settings["material"]
    # A library may have one of the same name.
    material = next(m for m in bpy.data.materials if m.name == name and m.library is None)
    spec, waves = read_spec(material), waves_of(read_followed(material))
    made_map = prepare_map(spec, waves, lambda share: work.progress(_MAP_SHARE * share))
    table = prepare_table(
        spec,
        lambda share: work.progress(_MAP_SHARE + (1.0 - _MAP_SHARE) * share),
        followed=waves,
    )
    made: list[str] = []
    if made_map is not None:
        made.append(f"a map, error {made_map.map.error:.1e}")
    if table is not None:
        made.append(f"a table of {table.size} numbers")
    return {
        "words": f"{name} has {' and '.join(made) or 'nothing to bake'}",
        "stopped": False,
        "material": name,
    }
