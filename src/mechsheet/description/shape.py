"""Checks data against the schema, key by key, and hands on what is usable.

Values that do not fit are reported once and replaced by BAD; so are required keys that are missing. What comes back has
only known keys, and every value in it has the shape the schema promises, or is BAD.
"""

from __future__ import annotations

import math
import unicodedata
from typing import Any

from livesheet.diagnostics import near_miss
from livesheet.said import say
from mechsheet.description.grammar import (
    Either,
    Integer,
    Items,
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
from mechsheet.description.kinds import plain_unit
from mechsheet.description.report import BAD, Report, alternatives, found, listed, suggestion
from mechsheet.description.schema import MEANT, REASONS, TAKES_MEANT
from mechsheet.description.text.index import Path, key_text
from mechsheet.description.text.numbers import LARGEST, SMALLEST, measured, typed_number, with_points
from mechsheet.diagnostics import quoted
from mechsheet.words.catalogue import ENGLISH, LANGUAGES


def fit(value: Any, shape: Shape, path: Path, report: Report) -> Any:
    """`value` as far as it fits `shape`; BAD (and a fault) where it does not."""
    if not _same_type(value, shape):
        report.at(
            path,
            say("expected {shape}, found {value}", shape=allowed(shape), value=found(value)),
            _type_hint(value, shape, path),
        )
        return BAD
    match shape:
        case Either(shapes):
            return fit(value, next(one for one in shapes if _same_type(value, one)), path, report)
        case Number() | Quantity() | Integer() if not isinstance(value, str):
            return _number(value, shape, path, report)
        case WithUnit():
            return measured(value)
        case Text():
            return _text(value, shape, path, report)
        case Words(longest, lines):
            return _words(value, Text(longest=longest, lines=lines), path, report)
        case Items():
            return _items(value, shape, path, report)
        case Named():
            return _named(value, shape, path, report)
        case Table():
            return _table(value, shape, path, report)
        case Kinds():
            return _kinds(value, shape, path, report)
    return value


def _same_type(value: Any, shape: Shape) -> bool:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    match shape:
        case Either(shapes):
            return any(_same_type(value, one) for one in shapes)
        case Number():
            return number
        case Integer():
            return number and isinstance(value, int)
        case YesNo():
            return isinstance(value, bool)
        case Quantity():
            return number or isinstance(value, str)
        case Text():
            return isinstance(value, str)
        case WithUnit():
            return isinstance(value, str) and measured(value) is not None
        case Words():
            return isinstance(value, str | dict)
        case Items():
            return isinstance(value, list)
        case _:
            return isinstance(value, dict)


def allowed(shape: Shape) -> str:
    """What a shape allows, in words."""
    match shape:
        case Either(shapes):
            return alternatives([allowed(one) for one in shapes if not isinstance(one, WithUnit)])
        case Number():
            return say("a number")
        case Integer(least, most):
            return (
                say("the whole number {least}", least=least)
                if least == most
                else say("a whole number from {least} to {most}", least=least, most=most)
            )
        case YesNo():
            return say("true or false")
        case Quantity():
            return say("a number or an expression in quotes")
        case Text(choices):
            return listed(choices, "or") if choices else say("a text in quotes")
        case Words():
            return say('a text in quotes or { en = "…", tr = "…" }')
        case Items(Table() | Kinds()):
            return say("tables with a heading in double brackets")
        case Items(_, _, _, note):
            return say(note) if note else say("a list")
        case _:
            return say("a table")


def _type_hint(value: Any, shape: Shape, path: Path) -> str:
    if isinstance(value, str) and _wants_number(shape) and (number := typed_number(value)):
        return number.hint if number.unit else say("{hint}, without quotes", hint=number.hint)
    match shape:
        case Items(Table() | Kinds()) if isinstance(value, dict):
            return say("write [[{key}]] instead of [{key}]", key=path[-1])
        case Table() if isinstance(value, list) and path == ("driver",):
            return say("write [driver] once; what is driven besides stands under [[drivers]]")
        case Items(Text()) if isinstance(value, str):
            return say("write [{value}], with brackets", value=quoted(value))
        case Either((Number(), WithUnit(), Table())) if isinstance(value, str):
            return say('a derived dimension is written { formula = "…" }')
        case Table(keys) if isinstance(value, str) and "formula" in keys:
            return say('write { formula = "…" }')
        case Named(Number()) if isinstance(value, str | list):
            return say("write {key} = {{ {name} = 1 }}", key=path[-1], name=_first_name(value))
        case Named(Items(Number(), note=note)) if isinstance(value, str | list):
            return say(
                "write {key} = {{ {name} = [{numbers}] }}", key=path[-1], name=_first_name(value), numbers=say(note)
            )
        case Named(_, what) if isinstance(value, list):
            return say("write one heading for each {what}: [{key}.name]", what=say(what), key=path[-1])
    return ""


def _first_name(value: str | list[Any]) -> str:
    """The first key of a table for somebody who has listed its keys only."""
    names = [one for one in ([value] if isinstance(value, str) else value) if isinstance(one, str)]
    return key_text(names[0]) if names else "…"


def _wants_number(shape: Shape) -> bool:
    shapes = shape.shapes if isinstance(shape, Either) else (shape,)
    return any(isinstance(one, Number | Integer) for one in shapes)


def _number(value: Any, shape: Number | Quantity | Integer, path: Path, report: Report) -> Any:
    if isinstance(value, float) and not math.isfinite(value):
        report.at(path, say("expected a finite number, found {value}", value=value))
    elif value and not SMALLEST <= abs(value) <= LARGEST:
        report.at(
            path,
            say(
                "{value} is out of range: sizes from {smallest:g} to {largest:g} are allowed",
                value=found(value),
                smallest=SMALLEST,
                largest=LARGEST,
            ),
        )
    elif isinstance(shape, Integer):
        if shape.least <= value <= shape.most:
            return value
        report.at(path, say("expected {shape}, found {value}", shape=allowed(shape), value=value))
    elif isinstance(shape, Number) and shape.least is not None and value < shape.least:
        report.at(
            path, say("expected a number from {least:g} on, found {value}", least=shape.least, value=found(value))
        )
    else:
        return float(value)
    return BAD


def _text(value: str, shape: Text, path: Path, report: Report) -> Any:
    if shape.choices and value not in shape.choices:
        report.at(
            path,
            say("expected {shape}, found {value}", shape=allowed(shape), value=quoted(value)),
            _choice_hint(value, shape),
        )
    elif not value.strip():
        report.at(path, say("the text is empty"))
    elif len(value) > shape.longest:
        report.at(
            path,
            say(
                "the text has {count} characters; at most {longest} are allowed",
                count=len(value),
                longest=shape.longest,
            ),
        )
    elif unfit := [sign for sign in value if _unfit(sign) and not (shape.lines and sign == "\n")]:
        name = say("a tab") if unfit[0] == "\t" else say("a character that a workbook cannot carry")
        report.at(path, say("the text holds {name}: U+{code:04X}", name=name, code=ord(unfit[0])))
    else:
        return value
    return BAD


def _choice_hint(value: str, shape: Text) -> str:
    plain = plain_unit(value)
    if plain in shape.choices:
        return say('write "{plain}"', plain=plain)
    spoken = value.strip().lower()
    if (take := TAKES_MEANT.get(spoken)) in shape.choices:
        return say('did you mean "{name}"?', name=take)
    meant = MEANT.get(spoken, "") if "prismatic" in shape.choices else ""
    return say(meant) if meant else near_miss(value, shape.choices)


def _unfit(sign: str) -> bool:
    """Control characters and line breaks, lone surrogates, and the two that XML forbids."""
    return unicodedata.category(sign) in ("Cc", "Cs", "Zl", "Zp") or sign in "\ufffe\uffff"


def _words(value: Any, text: Text, path: Path, report: Report) -> Any:
    if isinstance(value, str):
        one = _text(value, text, path, report)
        return BAD if one is BAD else {ENGLISH: one}
    for key in value:
        if key not in LANGUAGES:
            report.at((*path, key), say("unknown language"), suggestion(key, LANGUAGES, "languages"))
    if ENGLISH not in value:
        report.at(path, say("{keys} is missing", keys=quoted(ENGLISH)), say("one text in quotes serves all languages"))
        return BAD
    return {key: fit(value[key], text, (*path, key), report) for key in LANGUAGES if key in value}


def _items(value: list[Any], shape: Items, path: Path, report: Report) -> Any:
    if not shape.least <= len(value) <= shape.most:
        count = say("a list of {count}", count=shape.least) if value else say("at least one item")
        count = say("at most {most:,} items", most=shape.most) if len(value) > shape.most else count
        report.at(
            path,
            say("expected {shape}, found {value}", shape=say(shape.note) if shape.note else count, value=found(value)),
            _commas_hint(shape, path, report),
        )
        return BAD
    return [fit(item, shape.item, (*path, place), report) for place, item in enumerate(value)]


def _commas_hint(shape: Items, path: Path, report: Report) -> str:
    """For `[50,5, 55,2]` where two numbers are meant."""
    spot = report.source.spots.get(path)
    items = with_points(report.source.text[spot.start : spot.end]) if spot else None
    if items is None or not shape.least <= len(items) <= shape.most:
        return ""
    return say("the decimal sign is a point: write [{items}]", items=", ".join(items))


def _named(value: dict[str, Any], shape: Named, path: Path, report: Report) -> Any:
    too_many = shape.most is not None and len(value) > shape.most
    if too_many and shape.most != shape.least:  # so many that nobody wants them listed
        message = say("expected at most {most} {what}s, found {found}", most=shape.most, what=say(shape.what),
                      found=len(value))  # fmt: skip
        report.at(path, message)
        return BAD
    if too_many or len(value) < shape.least:
        pattern = "expected at least {least} {what}, found {found}"
        if shape.least == shape.most:
            pattern = "expected exactly {least} {what}, found {found}"
        pattern = pattern.replace("{what}", "{what}s") if shape.least > 1 else pattern
        given = say("{count}: {names}", count=len(value), names=listed(value)) if value else len(value)
        report.at(path, say(pattern, least=shape.least, what=say(shape.what), found=given))
        if shape.most is not None:
            return BAD
    return {
        key: fit(item, shape.keys[key].shape if key in shape.keys else shape.item, (*path, key), report)
        for key, item in value.items()
    }


def _table(value: dict[str, Any], shape: Table, path: Path, report: Report) -> Any:
    result = {}
    refused: dict[tuple[str, str], str] = {}
    for key, item in value.items():
        if key in shape.keys:
            result[key] = fit(item, shape.keys[key].shape, (*path, key), report)
        elif key in shape.later:
            refused.setdefault(REASONS[key], key)
        else:
            report.at((*path, key), say("unknown key"), suggestion(key, shape.keys, "keys"))
    for key, rule in shape.keys.items():
        if rule.required and key not in value:
            only = rule.shape.least if isinstance(rule.shape, Integer) and rule.shape.least == rule.shape.most else None
            hint = say("write {key} = {value} in the first line", key=key, value=only) if only is not None else say("")
            report.at((*path, key), say("is missing: {note}", note=say(rule.note)), hint)
            result[key] = BAD
    for (why, instead), key in refused.items():
        report.at((*path, key), say(why), say(instead))
    for groups in () if refused else shape.ways:  # what is missing is what should stand in their place
        _one_way(value, groups, path, report)
    return result


def _one_way(value: dict[str, Any], ways: tuple[tuple[str, ...], ...], path: Path, report: Report) -> None:
    needed = [tuple(key for key in way if not key.endswith("?")) for way in ways]
    allowed_in = [{key.rstrip("?") for key in way} for way in ways]
    of_one = [[key for key in group if sum(key in other for other in allowed_in) == 1] for group in needed]
    given = [[key for key in own if key in value] for own in of_one]
    begun = [place for place, keys in enumerate(given) if keys]
    begun = begun or [place for place, group in enumerate(needed) if any(key in value for key in group)][:1]
    single = all(len(group) == 1 for group in needed)
    choice = alternatives([listed(group) for group in needed], long=not single)
    foreign = (
        [key for group in needed for key in group if key in value and key not in allowed_in[begun[0]]] if begun else []
    )
    if not begun:
        report.at(path, say("is not complete: give {choice}", choice=choice))
    elif len(begun) > 1 or foreign:
        both = listed(dict.fromkeys([*(key for keys in given for key in keys), *foreign]))
        report.at(path, say("{both} exclude each other: give {choice}", both=both, choice=choice))
    elif absent := [key for key in needed[begun[0]] if key not in value]:
        report.at(
            path,
            say("{keys} are missing: give {choice}", keys=listed(absent), choice=choice)
            if len(absent) > 1
            else say("{keys} is missing: give {choice}", keys=listed(absent), choice=choice),
        )


def _kinds(value: dict[str, Any], shape: Kinds, path: Path, report: Report) -> Any:
    if shape.key not in value:
        report.at((*path, shape.key), say("is missing: {note}", note=listed(shape.tables, "or")))
        return BAD
    kind = fit(value[shape.key], Text(tuple(shape.tables)), (*path, shape.key), report)
    return BAD if kind is BAD else _table(value, shape.tables[kind], path, report)
