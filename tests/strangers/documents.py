# SPDX-FileCopyrightText: hoe_addon contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Foreign documents: good ones that were changed in places, and others grown from the schemas."""

import copy
import json
import random
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from tests.strangers.texts import some_number, some_text

ROOT = Path(__file__).resolve().parents[2]
PRESETS = ROOT / "presets"
_SCHEMAS = ROOT / "hoe_addon" / "model" / "schema"
_WAVES = ("plane", "point", "window", "astigmatic", "extended", "system")
_ELEMENTS = ("hologram", "lens", "display", "lamp", "card", "block", "holder")
_DEEPEST = 9

type Json = Any
type Slot = tuple[Any, Any]
"""A list or an object, and the index or name of an item."""


@cache
def seeds() -> tuple[Json, ...]:
    """All shipped presets, and holograms with each part that the documentation shows."""
    found = [json.loads(path.read_text("utf-8")) for path in sorted(PRESETS.glob("*.json"))]
    for page in sorted((ROOT / "docs").glob("*.md")):
        for text in re.findall(r"^```json\n(.*?)^```", page.read_text("utf-8"), re.M | re.S):
            part = json.loads(text)
            if "elements" in part or "surface" in part:
                found.append(part)
            elif part.get("kind") not in _ELEMENTS:
                found.append(_hologram_with(part))
    return tuple(found)


def lens() -> Json:
    """The hologram of the README."""
    return json.loads((ROOT / "tests" / "documents" / "lens.json").read_text("utf-8"))


def _hologram_with(part: Json) -> Json:
    """A hologram with a wave, a characteristic function, a model or a surface."""
    document = lens()
    if "model" in part:
        orders = part.get("table", {"T": dict.fromkeys(document["orders"], 0)})
        orders = sorted({int(order) for side in orders.values() for order in side})
        return {**document, "efficiency": part, "orders": orders}
    if "shape" in part and "kind" not in part:
        return {**document, "surface": part}
    if part["kind"] in _WAVES:
        document["recording"]["object"] = part
        return document
    del document["recording"]
    return {**document, "characteristic": part}


@cache
def definitions() -> dict[str, Json]:
    """Every struct of the shipped schemas by its name."""
    found: dict[str, Json] = {}
    for path in sorted(_SCHEMAS.glob("*.json")):
        found |= json.loads(path.read_text("utf-8"))["$defs"]
    return found


def grown(rng: random.Random, rule: Json, depth: int = 0) -> Json:
    """Draw a value that a schema allows, or nearly."""
    if "$ref" in rule:
        return _grown_struct(rng, definitions()[rule["$ref"].rpartition("/")[2]], depth)
    if "anyOf" in rule:
        return grown(rng, rng.choice(rule["anyOf"]), depth)
    if "enum" in rule:
        return rng.choice(rule["enum"])
    match rule.get("type"):
        case "object":
            return _grown_struct(rng, rule, depth)
        case "array":
            return _grown_list(rng, rule, depth)
        case "string":
            return rng.choice(("x^2/100", "r^2/200", "sin(x/9)", "air", "N-BK7", "auto", "a", "b"))
        case "boolean":
            return rng.random() < 0.5
        case "integer":
            return rng.randrange(max(-2, rule.get("minimum", -2)), 6)
        case "number":
            return _grown_number(rng, rule)
        case _:
            return None


def _grown_number(rng: random.Random, rule: Json) -> float:
    if rng.random() < 0.03:
        return some_number(rng)
    low = rule.get("minimum", rule.get("exclusiveMinimum", -20.0))
    high = rule.get("maximum", 100.0)
    return rng.choice((low + (high - low) * rng.random() ** 3, rng.uniform(max(low, 0.1), 2.5)))


def _grown_list(rng: random.Random, rule: Json, depth: int) -> Json:
    if "prefixItems" in rule:
        return [grown(rng, item, depth + 1) for item in rule["prefixItems"]]
    least = rule.get("minItems", 0)
    count = min(rule.get("maxItems", 6), least + rng.randrange(4))
    return [grown(rng, rule.get("items", {}), depth + 1) for _ in range(count)]


def _grown_struct(rng: random.Random, rule: Json, depth: int) -> Json:
    needed = rule.get("required", ())
    made = {
        name: grown(rng, field, depth + 1)
        for name, field in rule.get("properties", {}).items()
        if name in needed or (rng.random() < 0.3 and depth < _DEEPEST)
    }
    more = rule.get("additionalProperties")
    if isinstance(more, dict) and depth < _DEEPEST:
        made |= {
            str(rng.choice((-1, 0, 1, 2, "a", "b"))): grown(rng, more, depth + 1)
            for _ in range(rng.randrange(4))
        }
    return made


def slots(document: Json) -> Iterator[Slot]:
    """List all places of a document."""
    keys = document if isinstance(document, dict) else range(len(document))
    for key in keys:
        yield document, key
        if isinstance(document[key], dict | list):
            yield from slots(document[key])


def mutated(rng: random.Random) -> tuple[str, Json]:
    """Change a good document in one to three places.

    Returns:
        What was done, and the document.
    """
    document = copy.deepcopy(rng.choice(seeds()))
    done: list[str] = []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        change = rng.choice(_CHANGES)
        places = list(slots(document))
        if places:
            change(rng, document, rng.choice(places))
            done.append(change.__name__.strip("_"))
    return "+".join(done), document


def varied(rng: random.Random) -> tuple[str, Json]:
    """Change numbers and kinds of parts of a good document.

    Returns:
        What was done, and the document.
    """
    document = copy.deepcopy(rng.choice(seeds()))
    done: list[str] = []
    for _ in range(rng.choice((1, 1, 2, 3, 5))):
        change = rng.choice((_number, _slightly, _kind))
        change(rng, document, rng.choice(list(slots(document))))
        done.append(change.__name__.strip("_"))
    return "+".join(done), document


def _number(rng: random.Random, document: Json, slot: Slot) -> None:
    numbers = [
        (holder, key)
        for holder, key in slots(document)
        if isinstance(holder[key], int | float) and not isinstance(holder[key], bool)
    ]
    holder, key = rng.choice(numbers or [slot])
    holder[key] = some_number(rng)


def _slightly(rng: random.Random, document: Json, slot: Slot) -> None:
    numbers = [(holder, key) for holder, key in slots(document) if type(holder[key]) is float]
    holder, key = rng.choice(numbers or [slot])
    if type(holder[key]) is float:
        holder[key] *= rng.choice((-1.0, 0.0, 0.5, 1.01, 2.0, 10.0, 1e-3))


def _text(rng: random.Random, document: Json, slot: Slot) -> None:
    texts = [(holder, key) for holder, key in slots(document) if isinstance(holder[key], str)]
    holder, key = rng.choice(texts or [slot])
    holder[key] = some_text(rng)


def _type(rng: random.Random, _document: Json, slot: Slot) -> None:
    wrong = (None, True, False, [], {}, "x", 0, -1, 0.5, [[]], {"a": {}}, [1, "a", None])
    slot[0][slot[1]] = copy.deepcopy(rng.choice(wrong))


def _delete(_rng: random.Random, _document: Json, slot: Slot) -> None:
    del slot[0][slot[1]]


def _add(rng: random.Random, _document: Json, slot: Slot) -> None:
    holder, key = slot
    if isinstance(holder, list):
        holder.insert(key, copy.deepcopy(holder[rng.randrange(len(holder))]))
    else:
        known = [name for each in definitions().values() for name in each.get("properties", ())]
        name = rng.choice(known) if rng.random() < 0.6 else some_text(rng)
        holder[name] = copy.deepcopy(rng.choice((1, "x", {}, [], None, holder[key])))


def _swap(rng: random.Random, document: Json, slot: Slot) -> None:
    other, there = rng.choice(list(slots(document)))
    slot[0][slot[1]] = copy.deepcopy(other[there])


def _graft(rng: random.Random, _document: Json, slot: Slot) -> None:
    other, there = rng.choice(list(slots(rng.choice(seeds()))))
    slot[0][slot[1]] = copy.deepcopy(other[there])


def _grow(rng: random.Random, document: Json, slot: Slot) -> None:
    """Put a struct of a schema where another struct is."""
    structs = [(holder, key) for holder, key in slots(document) if isinstance(holder[key], dict)]
    holder, key = rng.choice(structs or [slot])
    holder[key] = grown(rng, {"$ref": rng.choice(list(definitions()))})


def _kind(rng: random.Random, document: Json, slot: Slot) -> None:
    """Grow a part of another kind in a place where it may stand."""
    found = [(h, k) for h, k in slots(document) if k in _PLACES]
    holder, key = rng.choice(found or [slot])
    holder[key] = grown(rng, rng.choice(_allowed(key)) if key in _PLACES else {})


def _nest(rng: random.Random, _document: Json, slot: Slot) -> None:
    made: Json = slot[0][slot[1]]
    for _ in range(rng.choice((1, 5, 63, 64, 65, 200))):
        made = [made] if rng.random() < 0.5 else {"a": made}
    slot[0][slot[1]] = made


def _many(rng: random.Random, document: Json, slot: Slot) -> None:
    lists = [(h, k) for h, k in slots(document) if isinstance(h[k], list) and h[k]]
    holder, key = rng.choice(lists or [slot])
    if isinstance(holder[key], list) and len(json.dumps(holder[key])) < 2000:
        holder[key] = holder[key] * rng.choice((2, 30, 300))


_PLACES = ("object", "reference", "surface", "efficiency", "recording", "characteristic", "media")


@cache
def _allowed(name: str) -> tuple[Json, ...]:
    """What the schemas allow at fields of a name."""
    found: list[Json] = []
    for struct in definitions().values():
        rule = struct.get("properties", {}).get(name)
        if rule is not None:
            found += rule.get("anyOf", [rule])
    return tuple(rule for rule in found if rule.get("type") != "null")


_CHANGES = (
    *(_number, _number, _slightly, _slightly, _text, _text, _type, _delete, _add, _swap, _graft),
    *(_grow, _kind, _kind, _kind, _nest, _many),
)


def written(rng: random.Random, document: Json) -> str:
    """Write a document as JSON, perhaps a damaged one."""
    text = json.dumps(document, ensure_ascii=rng.random() < 0.5)
    kind = rng.randrange(12)
    place = rng.randrange(len(text))
    if kind == 0:
        return text[:place]
    if kind == 1:
        return text[:place] + some_text(rng) + text[place:]
    if kind == 2:
        return text[:place] + text[place + rng.randrange(1, 9) :]
    if kind == 3:
        return text.replace('{"', '{"kind": "x", "kind": "y", "', rng.randrange(1, 4))
    if kind == 4:
        return text.replace("1", rng.choice(("01", "1e999", "-", "1" * 5000, "0x1", "1_0")), 1)
    return text
