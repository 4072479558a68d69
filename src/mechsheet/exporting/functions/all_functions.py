"""All functions of a mechanism with their names: the basic ones, one per variable, and that of its two-way table."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

from livesheet.formula.names import folded, safe_name
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.said import Words
from mechsheet.exporting.functions.library import basics, name_of
from mechsheet.exporting.functions.routines import Routine, Source, with_calls
from mechsheet.exporting.lowering import Step
from mechsheet.model import Label, Mechanism, TableRequest
from mechsheet.units import DEG, NUMBER
from mechsheet.words.catalogue import words

LONGEST_PREFIX = 24
"""A title that makes a longer word is replaced by the mechanism's name in the names of its functions."""

TABLE_KEY = "the function of the table"


IN_RADIANS = "driver in radians"
"""The driver of the table's function (no description can use a name with blanks in it)."""


@dataclass(frozen=True, slots=True)
class Function:
    """A function that a person can call.

    name       in the language wanted, with its letters
    parameters what its parameters are called
    routine    calling other functions by their keys
    basic      a basic function, the same for all mechanisms
    modes      symbols of the configurations at the end of a mechanism's function, with what they are when left out
    """

    name: str
    parameters: tuple[str, ...]
    routine: Routine
    basic: bool = False
    modes: Mapping[str, int] = field(default_factory=dict)

    @property
    def key(self) -> str:
        """What trees call it."""
        return self.routine.key


def variable_key(symbol: str) -> str:
    """What trees call the function of a variable."""
    return f"the function of {symbol}"


@lru_cache(maxsize=1)
def _library() -> tuple[tuple[Words, Routine], ...]:
    """Names and routines of the basic functions, calling each other."""
    return tuple(
        (name, with_calls(routine, [pattern for pattern in patterns() if pattern.key != routine.key]))
        for name, routine in basics()
    )


@lru_cache(maxsize=1)
def patterns() -> tuple[Routine, ...]:
    """The elementary functions, those that say most first."""
    elementary = {routine.key: routine for _, routine in basics() if not routine.steps}
    return tuple(elementary[key] for key in ("triangle area", "triangle angle", "leg", "length", "angle"))


def functions_of(source: Source, language: str, taken: Collection[str] = ()) -> tuple[Function, ...]:
    """Every function, each after those that it calls.

    taken  names that other things have (folded)
    """
    names = _Names(taken)
    found = [
        Function(
            names.take(name.of(language)),
            tuple(name_of(part.symbol).of(language) for part in routine.parameters),
            routine,
            basic=True,
        )
        for name, routine in _library()
    ]
    mechanism = source.mechanism
    prefix = prefix_of(mechanism, language)
    table = main_table(mechanism)
    main = names.take(prefix) if table else ""
    symbols = tuple(part.symbol for part in source.parameters())
    for symbol in source.variables():
        about = source.equations.of(symbol).label
        routine = with_calls(source.routine(variable_key(symbol), symbol, about), patterns())
        found.append(Function(names.take(f"{prefix}_{symbol}".replace(".", "_")), symbols, routine, modes=source.modes))
    if table:
        found.append(Function(main, symbols, table_routine(source, table), modes=source.modes))
    return tuple(found)


def main_table(mechanism: Mechanism) -> TableRequest | None:
    """The two-way table whose function has the mechanism's name, if there is one that a function can compute."""
    return next((request for request in mechanism.tables if is_of_a_function(mechanism, request)), None)


def is_of_a_function(mechanism: Mechanism, request: TableRequest) -> bool:
    """Whether a function can compute a two-way table: of what it takes, and of one position."""
    derived = {dim.symbol for dim in mechanism.dimensions if dim.derived}
    return request.column not in derived and not request.of_summary


def table_routine(source: Source, request: TableRequest) -> Routine:
    """The value of a table's cell: the driver in its own unit, as the table's first column has it."""
    driver = source.mechanism.driver
    arguments = []
    parameters = []
    steps: list[Step] = []
    for part in source.parameters():
        parameters.append(part)
        arguments.append(Symbol(part.symbol))
        if part.symbol == driver.symbol and driver.unit.in_degrees:
            parameters[-1] = replace(part, unit=DEG)
            steps.append(Step(IN_RADIANS, Call("RADIANS", (Symbol(part.symbol),))))
            arguments[-1] = Symbol(IN_RADIANS)
    value: Node = Symbol(request.value)
    unit = NUMBER
    if request.value == driver.symbol:
        value = Symbol(IN_RADIANS) if steps else value
    else:
        value = Call(variable_key(request.value), tuple(arguments))
        unit = source.equations.of(request.value).unit.internal
    if in_degrees(source, request.value):
        value, unit = Call("DEGREES", (value,)), DEG
    title = request.title or Label(request.value)
    return Routine(TABLE_KEY, title, tuple(parameters), tuple(steps), value, unit)


def in_degrees(source: Source, symbol: str) -> bool:
    """True for a quantity that people read in degrees."""
    driver = source.mechanism.driver
    unit = driver.unit if symbol == driver.symbol else source.equations.of(symbol).unit
    return source.mechanism.shown(unit).in_degrees


def prefix_of(mechanism: Mechanism, language: str) -> str:
    """The title in one word (`AyarlıPompa`), or the mechanism's name where the title is long."""
    words = re.findall(r"[^\W_]+", re.sub("['’]", "", mechanism.title.of(language)))
    title = "".join(_capital(word, language) for word in words)
    if title and len(title) <= LONGEST_PREFIX and not title[0].isdigit():
        return title
    return "".join(_capital(word, "en") for word in re.findall(r"[^\W_]+", mechanism.name))


def _capital(word: str, language: str) -> str:
    first = words(language, "letter.i") if word[0] == "i" else word[0].upper()
    return first + word[1:]


class _Names:
    """Names that differ from each other and from those taken."""

    def __init__(self, taken: Collection[str]) -> None:
        self.taken = set(taken)

    def take(self, name: str) -> str:
        found = safe_name(name, self.taken)
        self.taken.add(folded(found))
        return found
