"""What a caller changes in a description: `Overrides`; its values as typed are checked, then written into the text.

The text is changed first and read afterwards, so what is read is what the workbook will carry. A value is a number in a
unit, or an expression over the dimensions (`typed_value`). It is that of a dimension, or of the task of a synthesis:
`theta.2=95`, `psi=[60,80,105]`, `A.moving.1=3`; what the task does not say yet can be set, too: `round=0.5`; and another of
its ways, in place of the one that is written: `lam=4` instead of `best = true`.
"""

from __future__ import annotations

import contextlib
import math
import tomllib
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Call, Node, Symbol, symbols, walk
from livesheet.said import say, say_count
from mechsheet.description import dimensions
from mechsheet.description.asked import synthesis
from mechsheet.description.asked.schema import SYNTHESIS
from mechsheet.description.asked.synthesis import unit_in
from mechsheet.description.grammar import Items, Shape, Table, Text, YesNo
from mechsheet.description.kinds import unit_kind
from mechsheet.description.report import BAD, Report, listed, suggestion
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.scope import Scope, scope_of
from mechsheet.description.shape import fit
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.rewrite import number_text, with_value, without_key
from mechsheet.description.text.source import Source
from mechsheet.diagnostics import quoted
from mechsheet.synthesis.kinds import KINDS
from mechsheet.units import NUMBER, Unit
from mechsheet.words.catalogue import LANGUAGES

LAYOUTS = ("sheets", "page")

Values: TypeAlias = Mapping[str, str] | Sequence[tuple[str, str]]
"""Name and value as typed, in their order; a name may come again."""


@dataclass(frozen=True, slots=True)
class Overrides:
    """What stands in place of what a description says; nothing of all that is not given.

    values            of dimensions, of the task of a synthesis, of assembly modes: {"a1": "65"}; see `with_values`
    rows, step        of the driver's sweep, as typed: see `with_sweep`
    language, layout  of the workbook: one of `LANGUAGES`, "sheets" or "page"
    tolerance         bands of all outputs and summaries, where the description asks for none
    """

    values: Values = ()
    rows: str | None = None
    step: str | None = None
    language: str | None = None
    layout: str | None = None
    tolerance: bool = False

    @property
    def pairs(self) -> Sequence[tuple[str, str]]:
        """The values as pairs."""
        return list(self.values.items()) if isinstance(self.values, Mapping) else self.values

    @property
    def faults(self) -> list[Fault]:
        """What no description can have."""
        found = []
        if self.language not in (None, *LANGUAGES):
            message = say("unknown language {language}", language=quoted(str(self.language)))
            found.append(
                Fault(message, hint=say("languages: {languages}", languages=", ".join(map(quoted, LANGUAGES))))
            )
        if self.layout not in (None, *LAYOUTS):
            message = say("unknown layout {layout}", layout=quoted(str(self.layout)))
            found.append(Fault(message, hint=say('layouts: "sheets", "page"')))
        return found


AS_IT_IS = Overrides()


def option_of(given: str) -> str:
    """What the faults of `a1=65` have as their key."""
    return f"overrides: {given}"


def name_of(given: str) -> str:
    """A name as the description spells it."""
    return unicodedata.normalize("NFC", given.strip())


def with_values(source: Source, pairs: Iterable[tuple[str, str]]) -> tuple[Source, list[Fault]]:
    """The source with other values, (name, value as typed) each, and what is wrong with these.

    A value is a number in the dimension's own unit, or an expression (see `typed_value`): names in it mean the dimensions
    after the changes before it.
    """
    faults: list[Fault] = []
    for given, value in pairs:
        source, found = _with_value(source, name_of(given), value, option_of(f"{given}={value}"))
        faults += found
    return source, faults


def _derived(entry: Mapping[str, object]) -> bool:
    return "formula" in entry or "synthesis" in entry


def _with_value(source: Source, name: str, value: str, option: str) -> tuple[Source, list[Fault]]:
    entries = source.data.get("dimensions")
    entries = entries if isinstance(entries, dict) else {}
    inputs = [name for name, entry in entries.items() if not (isinstance(entry, dict) and _derived(entry))]
    place_of_task = task_place(source, name)
    if place_of_task is not None and name not in inputs:
        return with_task_value(source, place_of_task, value, option)
    if name not in entries:
        if "synthesis" in source.data:
            inputs += task_names(source)
        hint: str = suggestion(name, inputs, "inputs")
        return source, [
            Fault(say("no dimension is called {name}", name=quoted(name)), source.file, key=option, hint=hint)
        ]
    if name not in inputs:
        message = say("the dimension {name} is derived from others", name=quoted(name))
        hint = say("change the dimensions in its formula instead; {inputs}", inputs=suggestion(name, inputs, "inputs"))
        if "synthesis" in entries[name]:
            message = say("the dimension {name} is found by the synthesis", name=quoted(name))
            hint = say("change its task instead: {names}", names=", ".join(task_names(source)))
        return source, [Fault(message, source.file, key=option, hint=hint)]
    scope = scope_for(source, option)
    text = typed_value(value, scope.units[name], "the dimension's", scope)
    place: Path = ("dimensions", name, "value") if isinstance(entries[name], dict) else ("dimensions", name)
    if text is not None and place in source.spots:  # without a value the reader will complain
        source = with_value(source, place, text)
    return source, scope.report.faults


# --- what is typed for one value --------------------------------------------------------------------------------------

DIGITS = 15
"""As many digits as a decimal number keeps through binary: 40*1.1 is written 44, not 44.00000000000001."""


@dataclass(slots=True)
class AtOption(Report):
    """Faults of what was typed for an option: told with its name, whatever they are about."""

    option: str = ""

    def at(self, path: Path, message: str, hint: str = "") -> None:
        """Report a fault of the option."""
        self.faults.append(Fault(message, self.source.file, key=self.option, hint=hint))


def table_of(source: Source, name: str) -> dict[str, object]:
    """A part of the description as far as it is usable; what is wrong with it is the reader's to tell."""
    found = fit(source.data.get(name, {}), DESCRIPTION.keys[name].shape, (name,), Report(source))
    return {} if found is BAD else dict(found)


def scope_for(source: Source, option: str) -> Scope:
    """The units and dimensions of a description, with their values; what is reported from now on is the option's."""
    scope = scope_of(table_of(source, "mechanism"), Report(source))
    given = dimensions.spelled_out(table_of(source, "dimensions"), scope)
    others = (*table_of(source, "outputs"), *table_of(source, "summary"))
    task = synthesis.read(table_of(source, "synthesis") or None, given, scope, others)
    dimensions.declare(given, scope, task.units)
    dimensions.read(given, scope, task)
    scope.report = AtOption(source, option=option)
    return scope


def typed_value(text: str, unit: Unit, whose: str, scope: Scope) -> str | None:
    """The number in `unit` that is meant, as TOML writes it; None, and a fault in `scope.report`, where there is none.

    A plain number stays as it was typed. An expression of numbers, `+ - * / ^` and parentheses is in `unit`. One with
    functions, `pi` or names of dimensions computes as in a description, angles in radians; its value is brought into
    `unit`. Both are rounded to DIGITS digits. `whose` unit it is stands in messages: "the dimension's".
    """
    text = unicodedata.normalize("NFC", text)  # as the description's names are
    number = typed_number(text)
    if number is not None and not number.unit and not number.why and math.isfinite(float(number.text)):
        return number.text
    plain = scope.plain(text, unit.text, ())
    if plain is not text:  # with its unit
        return None if plain is BAD else number_text(float(f"{plain:.{DIGITS}g}"))
    if number is not None or not text.strip() or _looks_like_one(text, scope):
        understood = number is not None and not number.unit and math.isfinite(float(number.text))
        hint = (
            number.hint
            if number and understood
            else say("a plain number in {whose} own unit, or an expression", whose=whose)
        )
        scope.report.at((), say("expected a number, found {text}", text=quoted(text.strip())), hint)
        return None
    tree = scope.parse(text, ())
    value = None if tree is None else _value_of_tree(tree, text, unit, scope)
    return None if value is None else number_text(float(f"{value:.{DIGITS}g}"))


def _looks_like_one(text: str, scope: Scope) -> bool:
    """Whether it is a number to Python and no expression: nan, inf, 1_000."""
    with contextlib.suppress(ValueError):
        float(text)
        return text.strip() not in scope.units
    return False


def _value_of_tree(tree: Node, text: str, unit: Unit, scope: Scope) -> float | None:
    """The value of an expression in `unit`."""
    if not any(isinstance(node, Call | Symbol) for node in walk(tree)):
        return scope.value(tree, ())
    if not scope.only_dimensions(tree, text, ()) or not scope.fits(tree, text, unit_kind(unit), ()):
        return None
    if missing := [name for name in symbols(tree) if name not in scope.numbers]:
        one, many = "has no value: {names} has none", "has no value: {names} have none"
        scope.report.at((), say_count(one, many, len(missing), names=listed(missing)))
        return None
    value = scope.value(tree, ())
    return None if value is None else unit.to_shown(value)


# --- the task of a synthesis ------------------------------------------------------------------------------------------


def _numbers(value: Any, place: Path) -> Iterator[Path]:
    """Where the numbers below a key stand, the lists of them first."""
    if isinstance(value, list):
        yield place
        for index, item in enumerate(value):
            yield from _numbers(item, (*place, index))
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from _numbers(item, (*place, key))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield place


def _places(source: Source) -> dict[str, Path]:
    """`theta`, `theta.2`, `stroke` -> where it stands below [synthesis], or would stand; items count from 1."""
    task = source.data.get("synthesis")
    said = _numbers(task, ()) if isinstance(task, dict) else ()
    places = (*said, *_shapes(source))
    return {".".join(str(part + 1) if isinstance(part, int) else part for part in place): place for place in places}


def _tables(source: Source) -> dict[Path, Table]:
    """The tables of keys that a task of its kind can have, the outer one and those in it, by where they stand."""
    task = source.data.get("synthesis")
    outer = SYNTHESIS.tables.get(str(task.get("kind"))) if isinstance(task, dict) else None
    if outer is None:
        return {}
    return {(): outer} | {(key,): each.shape for key, each in outer.keys.items() if isinstance(each.shape, Table)}


def _shapes(source: Source) -> dict[Path, Shape]:
    """Where a number, list of numbers or choice can stand: `lam`, `round`, `A.moving` -> its shape."""
    return {
        (*around, key): entry.shape
        for around, table in _tables(source).items()
        for key, entry in table.keys.items()
        if not isinstance(entry.shape, Table | Text)
    }


def task_names(source: Source) -> list[str]:
    """What of the task can be changed: what it says, then what it could say."""
    return list(_places(source))


def task_place(source: Source, name: str) -> Path | None:
    """Where the task has what is called so, or could have it; None where its kind has nothing of that name."""
    return _places(source).get(name)


def with_task_value(source: Source, place: Path, value: str, option: str) -> tuple[Source, list[Fault]]:
    """The source with another number, list of numbers or choice in its task, instead of a way that excludes it; and what
    is wrong with it."""
    path: Path = ("synthesis", *place)
    shape = _shapes(source).get(place)
    if isinstance(shape, YesNo):
        changed, faults = _with_choice(source, path, value, option)
    else:
        changed, faults = _with_numbers(source, place, value, option, isinstance(shape, Items))
    return (source, faults) if faults else (_without_others(changed, place), [])


def _without_others(source: Source, place: Path) -> Source:
    """The source without the keys that exclude what stands there."""
    *around, key = place
    table = _tables(source).get(tuple(around))
    for ways in table.ways if table else ():
        own = next((way for way in ways if key in way), None)
        for way in ways if own else ():
            for other in way if way != own else ():
                source = without_key(source, ("synthesis", *around, other))
    return source


def _with_choice(source: Source, path: Path, value: str, option: str) -> tuple[Source, list[Fault]]:
    if value.strip() != "true":
        return source, [
            Fault(say("expected true, found {value}", value=quoted(value.strip())), source.file, key=option)
        ]
    return with_value(source, path, "true"), []


def _with_numbers(source: Source, place: Path, value: str, option: str, whole_list: bool) -> tuple[Source, list[Fault]]:
    path: Path = ("synthesis", *place)
    is_list, wants_list = value.strip().startswith("["), whole_list or (*path, 0) in source.spots
    if is_list or wants_list:
        return _with_list(source, path, value, option, is_list and wants_list)
    scope = scope_for(source, option)
    kind = KINDS.get(str(source.data["synthesis"].get("kind")))
    unit = unit_in(place, kind, scope) if kind else NUMBER  # without a kind the reader will complain
    text = typed_value(value, unit, "its", scope)
    return (source if text is None else with_value(source, path, text)), scope.report.faults


def _with_list(source: Source, path: Path, value: str, option: str, fits: bool) -> tuple[Source, list[Fault]]:
    hint: str = say("for example --set psi=[60,80,105], or --set psi.2=80 for one of them")
    try:
        found = tomllib.loads(f"value = {value}")["value"] if fits else None
    except tomllib.TOMLDecodeError:
        found = None
    if not isinstance(found, list) or not all(_plain(item) for item in found):
        message = say("expected a list of numbers, found {value}", value=quoted(value.strip()))
        if not fits and value.strip().startswith("["):
            message, hint = say("expected a number, found the list {value}", value=quoted(value.strip())), ""
        return source, [Fault(message, source.file, key=option, hint=hint)]
    return with_value(source, path, value.strip()), []


def _plain(item: Any) -> bool:
    """A number, or a list of them (a pose)."""
    if isinstance(item, list):
        return all(_plain(part) for part in item)
    return isinstance(item, int | float) and not isinstance(item, bool)
