"""What a caller changes in a description: `Overrides`; its values as typed are checked, then written into the text.

The text is changed first and read afterwards, so what is read is what the workbook will carry.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.description.asked.task_values import task_names, task_place, with_task_value
from mechsheet.description.report import suggestion
from mechsheet.description.text.index import Path
from mechsheet.description.text.rewrite import with_value
from mechsheet.description.text.source import Source
from mechsheet.description.typed_value import scope_for, typed_value
from mechsheet.diagnostics import quoted
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
