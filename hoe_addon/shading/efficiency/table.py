# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A table of shares in the shader: constant arrays in the text, read between their nodes.

The table is indexed by the ray that the shader walks. Cycles walks backward, so its table holds,
for each way out, the share of the light that takes it (the reversed pair); a walk along the light
takes the table of the light itself. Either way the cell is found once per hit, for all ways out.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import FloatArray
from ...core.efficiency.baking import LARGEST
from ...core.efficiency.table import EfficiencyTable
from ...core.errors import SpecError
from ...core.orders import Branch
from ...core.units import m_to_mm, m_to_nm
from ..part import SocketValues, parameter
from ..source import array
from .part import EfficiencyPart

_DRAW_WAY = 0
"""Dimension of the number that draws the way out; those of the axes follow it."""

_SIDES = ("front", "back")
"""What `from_back` counts."""

_SCALE_SOCKET = "mm_per_unit"
_SCALE = parameter("float", _SCALE_SOCKET, "1.0", "Scale", "Millimetres in one scene unit")


@dataclass(frozen=True)
class _Axis:
    """One axis of the table.

    Attributes:
        name: Its name in the text.
        value: OSL expression of where the walked ray is on it.
        is_place: Whether it is a place on the element, which is always clamped.
    """

    name: str
    value: str
    is_place: bool = False


_AXES = (
    _Axis("wavelength", "wavelength_nm"),
    _Axis("along", "dot(tangential, grating_x) / index_in"),
    _Axis("across", "dot(tangential, grating_y) / index_in"),
    _Axis("x", "position[0] * mm_per_unit", is_place=True),
    _Axis("y", "position[1] * mm_per_unit", is_place=True),
)


def table_part(
    table: EfficiencyTable, branches: Sequence[Branch], *, drawn: bool
) -> EfficiencyPart:
    """The shader's part for a table.

    Args:
        table: Indexed by the walked ray; see above.
        branches: The ways out that are asked for; one that the table does not hold gets no light.
        drawn: Draw one node by its weight and then one way out by its share there; else all ways
            out get their interpolated shares.

    Returns:
        Its part; its sockets are those of `table_sockets`.

    Raises:
        SpecError: The table is too large for a text.
    """
    held = tuple(way for way in dict.fromkeys(branches) if way in table.branches)
    values = table.values[..., [table.branches.index(way) for way in held]]
    if values.size > LARGEST:
        raise SpecError(
            f"efficiency: its table has {values.size} numbers for the shader, which takes at most "
            f"{LARGEST}; raise lookup.tolerance, trace fewer orders, or give fewer nodes"
        )
    if not values.size:
        return EfficiencyPart({})
    axes = _Axes(table, values.shape)
    choice = _drawn_way(axes, held) if drawn else axes.corners()
    return EfficiencyPart(
        shares=_drawn_shares(held) if drawn else axes.means(held),
        parameters=_SCALE if _varies_by_place(table) else "",
        prepare=f"{axes.cell(values)} {choice}",
        drawn="X(table_steps, table_side, table_weight)" if drawn else "",
    )


def table_sockets(table: EfficiencyTable, units_per_mm: float) -> SocketValues:
    """The numbers of a table that are not in the text.

    Args:
        table: The table.
        units_per_mm: Scene units in one mm.

    Returns:
        Value by socket identifier.
    """
    return {_SCALE_SOCKET: 1.0 / units_per_mm} if _varies_by_place(table) else {}


def _varies_by_place(table: EfficiencyTable) -> bool:
    return max(len(table.x), len(table.y)) > 1


class _Axes:
    """The axes of a table that are not collapsed, and the text that finds the cell on them."""

    def __init__(self, table: EfficiencyTable, shape: tuple[int, ...]) -> None:
        self.table = table
        scales = (m_to_nm, None, None, m_to_mm, m_to_mm)
        nodes = [
            np.asarray(scale(axis)) if scale else axis
            for scale, axis in zip(scales, table.axes, strict=True)
        ]
        strides = [int(np.prod(shape[place + 1 :])) for place in range(len(shape))]
        kept = [place for place, axis in enumerate(nodes) if len(axis) > 1]
        self.active = [(_AXES[place], nodes[place]) for place in kept]
        self.strides = [strides[1 + place] for place in kept]
        self.side_stride = strides[0]
        self.ways = shape[-1]

    def cell(self, values: FloatArray) -> str:
        """Statements that find the lowest node of the cell, and how far the ray is beyond it."""
        count = max(1, len(self.active))
        lines = [
            f"float table_shares[{values.size}] = {array(values.ravel())};",
            f"int table_strides[{count}] = {{ {', '.join(map(str, self.strides or [0]))} }};",
            f"float table_parts[{count}];",
            "int table_lowest = 0;",
            f"int table_holds = {self._side_given()};",
        ]
        if len(self.table.sides) > 1:
            first = _SIDES.index(self.table.sides[0])
            lines.append(f"table_lowest = (from_back != {first}) * {self.side_stride};")
        for number, (axis, nodes) in enumerate(self.active):
            lines += self._locate(number, axis, nodes)
        return " ".join(lines)

    def corners(self) -> str:
        """Statements that weigh the neighbouring nodes."""
        count = 2 ** len(self.active)
        return (
            f"float table_weights[{count}]; int table_places[{count}]; "
            f"hoe_table_corners(table_parts, table_strides, {len(self.active)}, table_lowest, "
            "table_weights, table_places);"
        )

    def means(self, held: Sequence[Branch]) -> dict[Branch, str]:
        """OSL expression of the interpolated share of each way out."""
        corners = 2 ** len(self.active)
        read = "hoe_table_mean(table_shares, table_weights, table_places"
        return {
            way: f"(table_holds ? {read}, {corners}, {number}) : 0.0)"
            for number, way in enumerate(held)
        }

    def _side_given(self) -> str:
        first = _SIDES.index(self.table.sides[0])
        return "1" if len(self.table.sides) > 1 else f"from_back == {first}"

    def _locate(self, number: int, axis: _Axis, nodes: FloatArray) -> list[str]:
        name, count, stride = f"table_{axis.name}", len(nodes), self.strides[number]
        lines = [
            f"float {name}_nodes[{count}] = {array(nodes)};",
            f"float {name} = {axis.value};",
            f"int {name}_cell = hoe_table_cell({name}_nodes, {count}, {name});",
            f"table_parts[{number}] = hoe_table_part({name}_nodes, {name}_cell, {name});",
            f"table_lowest += {name}_cell * {stride};",
        ]
        if self.table.beyond == "zero" and not axis.is_place:
            lines.append(f"if (!hoe_table_holds({name}_nodes, {count}, {name})) table_holds = 0;")
        return lines


def _drawn_way(axes: _Axes, held: Sequence[Branch]) -> str:
    """Statements that draw a node, and then a way out or none."""
    steps = array(way.steps for way in held)
    sides = ", ".join("HOE_REFLECTED" if way.reflected else "HOE_TRANSMITTED" for way in held)
    node = (
        f"hoe_table_node(table_parts, table_strides, {len(axes.active)}, table_lowest, "
        "table_hit, table_crossed)"
    )
    draw = f"hoe_drawn(table_hit, table_crossed, HOE_FOR_TABLE, {_DRAW_WAY})"
    return (
        f"float table_each_steps[{len(held)}] = {steps}; "
        f"int table_each_side[{len(held)}] = {{ {sides} }}; "
        "int table_crossed; float table_hit = hoe_hit(table_crossed); float table_weight = 1.0; "
        f"int table_way = hoe_table_draw(table_shares, {node}, {len(held)}, {draw}); "
        "if (table_way < 0 || !table_holds) { table_way = 0; table_weight = 0.0; } "
        "float table_steps = table_each_steps[table_way]; "
        "int table_side = table_each_side[table_way];"
    )


def _drawn_shares(held: Sequence[Branch]) -> dict[Branch, str]:
    """OSL expression of what each way out gets: all, or nothing."""
    return {way: f"(table_way == {number} ? table_weight : 0.0)" for number, way in enumerate(held)}
