# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A layout that records what a panel draws, so that panels are drawn without a window.

It is as strict as Blender's own: properties, operators, menus, lists and icons must exist.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import bpy

SETTINGS = frozenset(
    {
        "active",
        "activate_init",
        "active_default",
        "alert",
        "alignment",
        "emboss",
        "enabled",
        "operator_context",
        "scale_x",
        "scale_y",
        "ui_units_x",
        "ui_units_y",
        "use_property_decorate",
        "use_property_split",
    }
)
ICONS = frozenset(bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items.keys())


@dataclass
class Call:
    """One item of a panel.

    Attributes:
        kind: Function of the layout.
        name: Property, operator or menu; of a label its text.
        owner: Datablock or group of a property.
        text: Text in the place of its own; None where it was not given.
        enabled: Whether it can be clicked, as far as its layout goes.
        alert: Whether it is drawn in red.
        options: All else that was given.
        assigned: Properties of an operator that were set.
    """

    kind: str
    name: str
    owner: Any = None
    text: str | None = None
    enabled: bool = True
    alert: bool = False
    options: dict[str, Any] = field(default_factory=dict)
    assigned: dict[str, Any] = field(default_factory=dict)


class Assigned:
    """The properties of an operator that a button sets; only those that it has can be set."""

    def __init__(self, idname: str, into: dict[str, Any]) -> None:
        object.__setattr__(self, "_known", operator_rna(idname).properties)
        object.__setattr__(self, "_into", into)

    def __setattr__(self, name: str, value: Any) -> None:
        assert name in self._known, f"operator has no property {name}"
        self._into[name] = value

    def __getattr__(self, name: str) -> Any:
        return self._into[name]


def operator_rna(idname: str) -> Any:
    """RNA of an operator; fails when it is not registered."""
    module, _, name = idname.partition(".")
    return getattr(getattr(bpy.ops, module), name).get_rna_type()


class Layout:
    """A part of a panel; all parts write into one list, in the order of drawing."""

    def __init__(self, calls: list[Call] | None = None, parent: "Layout | None" = None) -> None:
        known = vars(parent) if parent is not None else {}
        object.__setattr__(self, "calls", [] if calls is None else calls)
        for name in SETTINGS:
            default = {"enabled": True, "active": True}.get(name, False)
            object.__setattr__(self, name, known.get(name, default))

    def __setattr__(self, name: str, value: Any) -> None:
        assert name in SETTINGS, f"UILayout has no setting {name}"
        object.__setattr__(self, name, value)

    def _part(self, *_arguments: Any, **_options: Any) -> "Layout":
        return Layout(self.calls, self)

    row = column = box = split = grid_flow = column_flow = menu_pie = _part

    def _note(self, kind: str, name: str, **fields: Any) -> Call:
        call = Call(kind, name, enabled=self.enabled, alert=bool(self.alert), **fields)
        icon = call.options.get("icon", "NONE")
        assert icon in ICONS, f"no icon {icon}"
        self.calls.append(call)
        return call

    def label(self, *, text: str = "", **options: Any) -> None:
        self._note("label", text, text=text, options=options)

    def separator(self, **_options: Any) -> None:
        pass

    separator_spacer = separator

    def prop(self, data: Any, property: str, *, text: str | None = None, **options: Any) -> None:
        self._prop("prop", data, property, text, options)

    def prop_search(
        self,
        data: Any,
        property: str,
        search_data: Any,
        search_property: str,
        *,
        text: str | None = None,
        **options: Any,
    ) -> None:
        assert search_property in search_data.bl_rna.properties
        self._prop("prop_search", data, property, text, options)

    def prop_enum(
        self, data: Any, property: str, value: str, *, text: str | None = None, **options: Any
    ) -> None:
        assert value in data.bl_rna.properties[property].enum_items
        self._prop("prop_enum", data, property, text, options | {"value": value})

    def _prop(
        self, kind: str, data: Any, name: str, text: str | None, options: dict[str, Any]
    ) -> None:
        assert data is not None
        assert name in data.bl_rna.properties, f"{data.bl_rna.identifier} has no property {name}"
        getattr(data, name)  # a getter of our own has to work
        self._note(kind, name, owner=data, text=text, options=options)

    def operator(self, operator: str, *, text: str | None = None, **options: Any) -> Assigned:
        operator_rna(str(operator))
        call = self._note("operator", str(operator), text=text, options=options)
        return Assigned(str(operator), call.assigned)

    def operator_menu_enum(
        self, operator: str, property: str, *, text: str | None = None, **options: Any
    ) -> Assigned:
        assert property in operator_rna(str(operator)).properties
        return self.operator(operator, text=text, **options)

    def menu(self, menu: str, *, text: str | None = None, **options: Any) -> None:
        assert hasattr(bpy.types, menu), f"no menu {menu}"
        self._note("menu", str(menu), text=text, options=options)

    def popover(self, panel: str, *, text: str | None = None, **options: Any) -> None:
        assert hasattr(bpy.types, panel), f"no panel {panel}"
        self._note("popover", str(panel), text=text, options=options)

    def panel(self, idname: str, *, default_closed: bool = False) -> tuple["Layout", "Layout"]:
        self._note("panel", idname, options={"default_closed": default_closed})
        return self._part(), self._part()

    def template_list(
        self,
        listtype_name: str,
        list_id: str,
        dataptr: Any,
        propname: str,
        active_dataptr: Any,
        active_propname: str,
        **options: Any,
    ) -> None:
        """Draw the list and each of its items, as Blender does."""
        assert hasattr(bpy.types, listtype_name), f"no list {listtype_name}"
        assert propname in dataptr.bl_rna.properties
        assert active_propname in active_dataptr.bl_rna.properties
        self._note("template_list", propname, owner=dataptr, options=options)
        kind = getattr(bpy.types, listtype_name)
        drawer = SimpleNamespace(layout_type="DEFAULT", list_id=list_id, filter_name="")
        for place, item in enumerate(getattr(dataptr, propname)):
            kind.draw_item(
                drawer,
                bpy.context,
                self._part(),
                dataptr,
                item,
                0,
                active_dataptr,
                active_propname,
                place,
                0,
            )

    def template_icon(self, icon_value: int, *, scale: float = 1.0) -> None:
        self._note("template_icon", str(icon_value), options={"scale": scale})

    def progress(self, *, text: str = "", factor: float = 0.0, **options: Any) -> None:
        self._note("progress", text, text=text, options=options | {"factor": factor})

    def template_ID(self, data: Any, property: str, **options: Any) -> None:  # noqa: N802
        for value in (options.get(name) for name in ("new", "open", "unlink")):
            if value:
                operator_rna(value)
        self._prop("template_ID", data, property, options.pop("text", None), options)

    def template_image(self, data: Any, property: str, image_user: Any, **options: Any) -> None:
        self._prop("template_image", data, property, None, options)


@dataclass
class Drawn:
    """What a panel has drawn."""

    calls: list[Call]

    def of(self, kind: str) -> list[Call]:
        """All items of a kind."""
        return [call for call in self.calls if call.kind == kind]

    def properties(self) -> list[str]:
        """Names of all properties, in order."""
        return [call.name for call in self.calls if call.owner is not None]

    def operators(self) -> list[str]:
        """Names of all operators, in order."""
        return [call.name for call in self.of("operator")]

    def words(self) -> str:
        """All labels, with spaces between."""
        return " ".join(call.name for call in self.of("label"))


def draw(panel: Any, context: Any = None) -> Drawn | None:
    """Draw a panel.

    Args:
        panel: Its class.
        context: What it is drawn for; the present one unless given.

    Returns:
        What it drew; None where its poll says that there is nothing to show.
    """
    context = bpy.context if context is None else context
    if not panel.poll(context):
        return None
    layout = Layout()
    own = {
        name: getattr(panel, name)
        for name in dir(panel)
        if name.startswith("bl_") and name != "bl_rna"
    }
    drawer = SimpleNamespace(layout=layout, **own)
    for name in ("draw_header", "draw_header_preset", "draw"):
        function = getattr(panel, name, None)
        if callable(function) and "hoe_addon" in getattr(function, "__module__", "").split("."):
            function(drawer, context)
    return Drawn(layout.calls)


def own_panels() -> Iterator[Any]:
    """All registered panels of the add-on."""
    for name in dir(bpy.types):
        if name.startswith("HOE_PT_"):
            yield getattr(bpy.types, name)
