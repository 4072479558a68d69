"""A mechanism as a program in any language would hold it: what is given, what follows once, and the columns in order.

Everything is an expression tree of the equations list; a language prints it with its own dialect and its own names. What is
no function of spreadsheets becomes a call of a helper that each language brings along: `CONTINUOUS` takes the jumps out of
an angle over the rows, `TRIANGLE` is the angle of a triangle opposite the first of its sides.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from importlib.resources import files
from itertools import chain, count

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Number, Symbol
from livesheet.formula.printer import print_formula
from mechsheet.compiled import Compiled
from mechsheet.exporting.lowering import Step, columns_of, constants_of
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.doubts.sketched import tell
from mechsheet.kinematics.equations import Equation, Equations, Group
from mechsheet.kinematics.newton.changed_dimensions import LEAP, STEADY, TREND
from mechsheet.kinematics.newton.system import CLOSED, FIRST_PASSES, LED, SETTLED
from mechsheet.model import TIME, Dimension, Law, Mechanism, Quantity
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import NOTHING
from mechsheet.words.symbols import GREEK

_SPELLED = str.maketrans({"ı": "i", "İ": "I", "ß": "ss", "ø": "o", "Ø": "O", "æ": "ae", "Æ": "AE", "ł": "l", "Ł": "L"})
_GREEK = str.maketrans({letter: name for name, letter in GREEK.items()})


def ascii_word(text: str) -> str:
    """The text in letters, digits and _ of ASCII, beginning with a letter: `C.x` is C_x, `çıkış` is cikis, `θ13` theta13."""
    plain = unicodedata.normalize("NFC", text).translate(_SPELLED).translate(_GREEK)
    plain = "".join(letter for letter in unicodedata.normalize("NFKD", plain) if not unicodedata.combining(letter))
    plain = re.sub(r"[^A-Za-z0-9_]", "_", plain)
    return plain if plain[:1].isalpha() else f"x{plain}" if plain.strip("_") else "x"


def identifiers(symbols: Iterable[str], reserved: Collection[str]) -> dict[str, str]:
    """Symbol -> its name. Names differ by more than case (some languages do not see it), also from all of `reserved`."""
    taken = {word.casefold() for word in reserved}
    found: dict[str, str] = {}
    for symbol in symbols:
        plain = ascii_word(symbol)
        candidates = chain([plain, f"{plain}_"], (f"{plain}_{number}" for number in count(2)))
        found[symbol] = next(name for name in candidates if name.casefold() not in taken)
        taken.add(found[symbol].casefold())
    return found


WIDTH = 100
"""Characters of a line of a program that has a comment."""


@dataclass(frozen=True, slots=True)
class Program:
    """The parts in order.

    given      dimensions that a user may change;  derived  those that follow, and the constants of the equations
    modes      assembly modes, +1 or -1;  assemblies  what the values of each mode mean
    start, stop, step, or values  the driver's, as expressions; neither where it moves by a law
    listed     what is listed beside `values`, by symbol: speeds, accelerations
    exists     true in a row that every group closes
    shown      driver, variables, points, rates and outputs: what the program hands back
    names      symbol -> its name in the language
    """

    mechanism: Mechanism
    equations: Equations
    given: tuple[Step, ...]
    derived: tuple[Step, ...]
    modes: tuple[Step, ...]
    assemblies: Mapping[str, str]
    sweep: tuple[Node, Node, Node] | None
    values: tuple[Node, ...]
    listed: Mapping[str, tuple[Node, ...]]
    columns: tuple[Step, ...]
    exists: Node
    shown: tuple[str, ...]
    names: dict[str, str]

    @property
    def given_by_row(self) -> tuple[str, ...]:
        """The driver, and what has a value in each row beside it."""
        return self.mechanism.driver.symbol, *self.mechanism.given_by_row

    @property
    def asked_by_row(self) -> tuple[str, ...]:
        """What a caller may give row by row: by a motion law the time, from which the driver follows."""
        return self.given_by_row if self.law is None else (TIME,)

    @property
    def law(self) -> Law | None:
        """The motion law, if the driver has one."""
        return self.mechanism.driver.law

    def unit_shown(self, symbol: str) -> Unit:
        """The unit in which people read a symbol's value."""
        return self.mechanism.shown(self.equations.unit_of(self.mechanism, symbol))

    def unit_of(self, symbol: str) -> str:
        """The unit of a shown symbol's value: "rad", the length unit, an output's own label, or ""."""
        return self.unit_shown(symbol).internal.text

    def words(self, step: Step | Equation) -> str:
        """What a step is, on one line."""
        return self.assemblies.get(step.symbol) or one_line(step.label.of(self.mechanism.language))

    def unit(self, step: Step) -> str:
        """The unit of what is given or derived, "" of a plain number."""
        return self.mechanism.shown(step.unit.internal).text

    def print(self, node: Node, dialect: str, calls: Mapping[str, str]) -> str:
        """The text of an expression; `calls` spell the helpers, `{0}` being the first argument."""
        return print_formula(node, dialect, lambda part: self.names[part.name], calls)


def heading(program: Program, number: int) -> str:
    """What stands over the columns of a group."""
    if number <= 0:
        return "outputs" if number < 0 else "driver's side"
    group = program.equations.groups[number - 1]
    return f"group {number} ({group.kind}): {one_line(group.label.of(program.mechanism.language))}"


_NUMBERS = {
    "CLOSED": CLOSED, "FIRST": FIRST_PASSES, "LED": LED, "STEADY": STEADY, "SETTLED": SETTLED, "TREND": TREND, "LEAP": LEAP,
}  # fmt: skip
"""Of Newton's method, by their marks in what languages bring along."""


def brought(name: str) -> str:
    """What a language brings along, a file of that language, with the numbers of Newton's method in it."""
    text = files("mechsheet.exporting").joinpath("brought", name).read_text(encoding="utf-8")
    for mark, number in _NUMBERS.items():
        text = text.replace(f"@@{mark}@@", repr(number))
    return text


def commented(code: str, words: str, mark: str) -> list[str]:
    """A line of code with its comment behind it, or over it where there is no room."""
    if not words:
        return [code]
    if len(code) + len(words) + 4 <= WIDTH:
        return [f"{code}  {mark} {words}"]
    indent = " " * (len(code) - len(code.lstrip()))
    return [f"{indent}{mark} {words}", code]


def program_of(compiled: Compiled, reserved: Collection[str]) -> Program:
    """The program of a mechanism; no name in it is one of `reserved`. Raises MechanismError."""
    mechanism, equations = compiled.mechanism, compiled.equations
    tell(mechanism, equations)
    dimensions = {dim.symbol: dim for dim in mechanism.dimensions}
    order = [dimensions[symbol] for symbol in dimension_order(mechanism)]
    modes = [group for group in equations.groups if group.mode]
    found = tuple(Step(group.mode, group.follows) for group in modes if group.follows is not None)
    driver = mechanism.driver
    sweep = (
        None
        if not driver.stepped
        else tuple(quantity(part, driver.unit) for part in (driver.start, driver.stop, driver.step))
    )
    columns = columns_of(mechanism, equations)
    kept = [eq.symbol for eq in equations.columns if eq.role in ("variable", "point", "rate", "force", "output")]
    given = (driver.symbol, *mechanism.given_by_row)
    lists = dict(zip(mechanism.driver_rates, (driver.speeds, driver.accelerations), strict=True))
    listed = {name: tuple(quantity(each, NUMBER) for each in values) for name, values in lists.items() if values}
    listed |= {
        each.symbol: tuple(quantity(one, each.unit) for one in each.values) for each in mechanism.drivers if each.values
    }
    order_of_names = [group.mode for group in sorted(modes, key=lambda group: group.follows is not None)]
    wanted = [*given, *dimensions, *order_of_names, *(eq.symbol for eq in equations.all)]
    wanted += [column.symbol for column in columns]
    return Program(
        mechanism,
        equations,
        tuple(_dimension(dim) for dim in order if not dim.derived),
        (*(_dimension(dim) for dim in order if dim.derived), *found, *constants_of(mechanism, equations)),
        tuple(Step(group.mode, Number(float(group.mode_value))) for group in modes if group.follows is None),
        {group.mode: _assemblies(group, mechanism.language) for group in modes},
        (sweep[0], sweep[1], sweep[2]) if sweep else None,
        tuple(quantity(value, driver.unit) for value in driver.values),
        listed,
        columns,
        _exists(equations),
        tuple(dict.fromkeys([*given, *kept])),
        identifiers(dict.fromkeys(wanted), reserved),
    )


def _assemblies(group: Group, language: str) -> str:
    """What each value of a mode means."""
    pairs = zip(group.mode_values, group.assemblies, strict=True)
    if group.system is None:
        return ", ".join(f"{value:+d}: {words.of(language)}" for value, words in pairs)
    return "; ".join(f"{value}: {words.of(language)}" for value, words in pairs)


def _dimension(dim: Dimension) -> Step:
    return Step(dim.symbol, quantity(dim.value, dim.unit), None, dim.label or NOTHING, dim.unit)


def quantity(value: Quantity, unit: Unit) -> Node:
    """A quantity of the model; a plain number of degrees as RADIANS(30), which a person can read."""
    if not isinstance(value, float):
        return value
    number = al.number(unit.written(value))
    return Call("RADIANS", (number,)) if unit.in_degrees and not al.is_zero(number) else number


def one_line(text: str) -> str:
    """A text of the description on one line, free of control characters: it may stand in a comment."""
    return "".join(letter for letter in " ".join(text.split()) if letter.isprintable())


def _exists(equations: Equations) -> Node:
    """True in a row that every group closes."""
    tests = tuple(Call("ISNUMBER", (Symbol(group.closes),)) for group in equations.groups if group.closes)
    return Call("AND", tests) if tests else Call("ISNUMBER", (al.ZERO,))
