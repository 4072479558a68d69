"""The JSON Schema of a description (draft 2020-12), for editors that complete and check keys; made from `schema.py`.

It says what can be said of a key alone. Names that must exist, circles and rows are judged by the reader, which refuses
everything that this schema refuses.
"""

from __future__ import annotations

import json
from typing import Any

from mechsheet.description.grammar import (
    Either,
    Integer,
    Items,
    Key,
    Kinds,
    Named,
    Number,
    Quantity,
    Shape,
    Table,
    Text,
    WithUnit,
    Words,
    YesNo,
)
from mechsheet.description.schema import DESCRIPTION
from mechsheet.words.catalogue import LANGUAGES

DRAFT = "https://json-schema.org/draft/2020-12/schema"
FILE = "mechsheet.schema.json"
"""The name by which the templates call it: `#:schema mechsheet.schema.json` in their first line."""

Json = dict[str, Any]


def json_schema() -> Json:
    """The schema of a whole description as JSON data."""
    head = {
        "$schema": DRAFT,
        "title": "mechsheet description",
        "description": "A planar mechanism, compiled into a spreadsheet workbook by mechsheet.",
    }
    return head | _table(DESCRIPTION)


def json_schema_text() -> str:
    """The same as text, as it stands in `templates/`."""
    return json.dumps(json_schema(), indent=1, ensure_ascii=False) + "\n"


def _of(shape: Shape) -> Json:
    """The schema of one shape."""
    match shape:
        case Number(least):
            return {"type": "number"} | ({} if least is None else {"minimum": least})
        case Integer(least, most):
            return {"type": "integer", "minimum": least, "maximum": most}
        case YesNo():
            return {"type": "boolean"}
        case Quantity():
            return {"type": ["number", "string"]}
        case WithUnit():
            return {"type": "string", "pattern": "[0-9]"}
        case Text(choices=choices, longest=longest):
            return {"type": "string", "enum": list(choices)} if choices else {"type": "string", "maxLength": longest}
        case Words(longest):
            text = {"type": "string", "maxLength": longest}
            both = {"type": "object", "properties": dict.fromkeys(LANGUAGES, text), "additionalProperties": False}
            return {"anyOf": [text, both | {"minProperties": 1}]}
        case Items(item, least, most, note):
            found: Json = {"type": "array", "items": _of(item), "minItems": least, "maxItems": most}
            return found | ({"description": note} if note else {})
        case Named(item, what, least, most, keys):
            found = {"type": "object", "additionalProperties": _of(item), "description": f"{what} = …"}
            found |= {"properties": {name: _key(key) for name, key in keys.items()}} if keys else {}
            found |= {"minProperties": least} if least else {}
            return found | ({} if most is None else {"maxProperties": most})
        case Table():
            return _table(shape)
        case Kinds():
            return _kinds(shape)
        case Either(shapes):
            return {"anyOf": [_of(part) for part in shapes]}


def _key(key: Key) -> Json:
    return _of(key.shape) | {"description": key.note}


def _table(table: Table) -> Json:
    """Fixed keys; of the alternatives exactly one, whole: (("start", "stop", "step"), ("values",))."""
    found: Json = {
        "type": "object",
        "properties": {name: _key(key) for name, key in table.keys.items()},
        "additionalProperties": False,
    }
    required = [name for name, key in table.keys.items() if key.required]
    if required:
        found["required"] = required
    if table.ways:
        found["allOf"] = [{"oneOf": [_whole(way, ways) for way in ways]} for ways in table.ways]
    return found


def _whole(way: tuple[str, ...], ways: tuple[tuple[str, ...], ...]) -> Json:
    """All keys of one way, none of the others."""
    own = {name.rstrip("?") for name in way}
    others = [name for other in ways if other != way for name in other if name not in own and not name.endswith("?")]
    return {
        "required": [name for name in way if not name.endswith("?")],
        "not": {"anyOf": [{"required": [name]} for name in others]},
    }


def _kinds(kinds: Kinds) -> Json:
    """One of several tables, told by the text of a key."""
    tables = []
    for name, table in kinds.tables.items():
        found = _table(table)
        found["properties"][kinds.key] = {"const": name, "description": table.keys[kinds.key].note}
        tables.append(found)
    return {"oneOf": tables, "required": [kinds.key]}
