"""What somebody types for one value at the command line: a number in a unit, or an expression over the dimensions."""

from __future__ import annotations

import contextlib
import math
import unicodedata
from dataclasses import dataclass

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import Call, Node, Symbol, symbols, walk
from livesheet.said import say, say_count
from mechsheet.description import dimensions
from mechsheet.description.asked import synthesis
from mechsheet.description.head import scope_of
from mechsheet.description.kinds import unit_kind
from mechsheet.description.report import BAD, Report, listed
from mechsheet.description.schema import DESCRIPTION
from mechsheet.description.scope import Scope
from mechsheet.description.shape import fit
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import typed_number
from mechsheet.description.text.rewrite import number_text
from mechsheet.description.text.source import Source
from mechsheet.diagnostics import quoted
from mechsheet.units import Unit

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
    value = None if tree is None else _value(tree, text, unit, scope)
    return None if value is None else number_text(float(f"{value:.{DIGITS}g}"))


def _looks_like_one(text: str, scope: Scope) -> bool:
    """Whether it is a number to Python and no expression: nan, inf, 1_000."""
    with contextlib.suppress(ValueError):
        float(text)
        return text.strip() not in scope.units
    return False


def _value(tree: Node, text: str, unit: Unit, scope: Scope) -> float | None:
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
