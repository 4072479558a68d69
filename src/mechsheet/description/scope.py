"""What the names of a description mean while it is read: units, values of dimensions, variables; and its expressions.

The units are those of the part [mechanism]. A number that stands elsewhere than among the dimensions may have a cell of its
own (`own_cell`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from graphlib import CycleError, TopologicalSorter
from typing import Any

from livesheet.diagnostics import FormulaError
from livesheet.formula.names import folded, name_fault
from livesheet.formula.nodes import Node, Symbol, Unary, children, symbols, transform
from livesheet.formula.parser import RESERVED, parse_description
from livesheet.formula.scalar import evaluate
from livesheet.said import Said, Words, reason, say
from mechsheet.description.kinds import (
    ANGLE,
    ANY,
    DEGREES,
    LENGTH,
    is_number_of_degrees,
    kind_of,
    length_as_angle,
    length_for_angle,
    meant_in_degrees,
    plain_unit,
)
from mechsheet.description.report import BAD, Report, listed, suggestion
from mechsheet.description.text.index import Path
from mechsheet.description.text.numbers import (
    EXAMPLES,
    Measured,
    home,
    labels_of,
    like,
    measured,
    spelled,
    typed_number,
    unit_behind,
    unit_named,
)
from mechsheet.diagnostics import quoted
from mechsheet.model import POINT_RATES, Dimension, Label, Quantity, Take
from mechsheet.units import DEG, NUMBER, Unit, unit_of
from mechsheet.words.catalogue import ENGLISH

DEEPEST = 200
"""Operators below one another in one expression; a workbook formula of more would not fit a cell anyway."""

_CASE = say("names must differ by more than case and the dots of i and ı")

REPORTED = math.nan
"""Stands for a quantity whose fault has been reported. It never leaves: a description with faults makes no model."""


@dataclass(slots=True)
class Space:
    """Names that must differ by more than case. `taken`: folded name -> (name, what it is, where)."""

    report: Report
    taken: dict[str, tuple[str, str, Path]] = field(default_factory=dict)

    def claim(self, name: str, what: str, path: Path, hint: str = "") -> None:
        """Take `name` for `what` ("dimension"), or report the clash with both places."""
        owner = self.taken.setdefault(folded(name), (name, what, path))
        if owner[2] == path:
            return
        other, other_what, other_path = owner
        spot = self.report.source.spots.get(other_path)
        line = say(" (line {line})", line=spot.line) if spot else ""
        message = say(
            "the name {name} is taken by the {what}{line}",
            name=quoted(name),
            what=other_what if isinstance(other_what, Said) else say(other_what),
            line=line,
        )
        if other != name:
            message = say(
                "the name {name} differs too little from {other}, the {what}{line}",
                name=quoted(name),
                other=quoted(other),
                what=other_what if isinstance(other_what, Said) else say(other_what),
                line=line,
            )
        case = _CASE
        if path[:1] == other_path[:1] == ("links",) and len(path) == len(other_path) > 2:  # two points
            case = say('did you mean "{name}"? {case}', name=other, case=_CASE)
        self.report.at(path, message, hint or (case if other != name else ""))


@dataclass(slots=True)
class Scope:
    """Everything that has a name, as far as it has been read.

    units      dimension -> its unit;  inputs: the dimensions that are not derived
    numbers    dimension -> its value in internal units, where it has one
    kinds      dimension or variable -> ANGLE, LENGTH or ANY
    variables  symbols of angles, displacements and the driver
    points     point -> the links that name it;  fixed: those that the ground names
    outputs    symbols of outputs;  complete: False when variables may be missing because of an earlier fault
    solved     False when steps of a synthesis are missing because of a fault in its task
    summaries  name of a summary -> the quantity that it is of;  takes: -> what it takes of it
    motion_outputs  outputs whose formulas name summaries -> the formula over summaries and dimensions in the units shown
    rates      names of angular and sliding velocities and accelerations;  moves: True when the driver has a speed
    of_cam     columns of a cam's profile, which are rates that need no speed
    of_rates   names of outputs that read rates
    forces     names of joint forces, of the driver's effort and what else masses and loads bring -> what it is
    force_units  -> what stands behind its numbers
    slides     name of a sliding joint -> the symbol of its displacement
    undriven   names of efforts that no driver has -> the link that it would turn, and against which
    charted    columns that follow from all rows together: charts may show them
    centers    G3 of a mass centre that is a point of its link -> that point
    """

    report: Report
    length_unit: str = "mm"
    angle_unit: Unit = DEG
    units: dict[str, Unit] = field(default_factory=dict)
    inputs: list[str] = field(default_factory=list)
    numbers: dict[str, float] = field(default_factory=dict)
    kinds: dict[str, str] = field(default_factory=dict)
    variables: list[str] = field(default_factory=list)
    points: dict[str, list[str]] = field(default_factory=dict)
    fixed: set[str] = field(default_factory=set)
    outputs: list[str] = field(default_factory=list)
    summaries: dict[str, Any] = field(default_factory=dict)
    takes: dict[str, Take] = field(default_factory=dict)
    motion_outputs: dict[str, Node] = field(default_factory=dict)
    complete: bool = True
    solved: bool = True
    rates: dict[str, None] = field(default_factory=dict)
    moves: bool = False
    of_cam: set[str] = field(default_factory=set)
    of_rates: set[str] = field(default_factory=set)
    forces: dict[str, str] = field(default_factory=dict)
    force_units: dict[str, str] = field(default_factory=dict)
    centers: dict[str, str] = field(default_factory=dict)
    slides: dict[str, str] = field(default_factory=dict)
    undriven: dict[str, tuple[str, str]] = field(default_factory=dict)
    charted: dict[str, None] = field(default_factory=dict)
    symbols: Space = field(init=False)
    cells: Space = field(init=False)

    def __post_init__(self) -> None:
        self.symbols = Space(self.report)
        self.cells = Space(self.report)

    @property
    def length(self) -> Unit:
        """The unit of lengths."""
        return unit_of(self.length_unit, self.length_unit)

    # ---- names

    def add_variable(self, symbol: str, kind: str, what: str, path: Path, hint: str = "") -> None:
        """A new variable, whose name must be free."""
        self.symbols.claim(symbol, what, path, hint)
        self.variables.append(symbol)
        self.kinds.setdefault(symbol, kind)

    def can_vary(self, symbol: str, path: Path) -> bool:
        """True for an input; what is derived, or no dimension, is reported."""
        if symbol in self.inputs:
            return True
        message = say("no dimension is called {name}", name=quoted(symbol))
        if symbol in self.units:
            message = say("the dimension {name} is derived; only an input can vary", name=quoted(symbol))
        self.report.at(path, message, suggestion(symbol, self.inputs, "inputs"))
        return False

    def symbol_is_good(self, name: str, path: Path) -> bool:
        """True when `name` can stand in an expression; reports why not."""
        reason = symbol_fault(name)
        if reason:
            self.report.at(path, say("the name {name} {reason}", name=quoted(name), reason=reason))
        return not reason

    def cell(self, table: dict[str, Any], path: Path) -> str | None:
        """The cell name that `table` gives, checked."""
        name, place = table.get("cell"), (*path, "cell")
        if name is None or name is BAD:
            return None
        reason = name_fault(name)
        if reason:
            self.report.at(place, say("the cell name {name} {reason}", name=quoted(name), reason=reason))
        self.cells.claim(name, "cell", place)
        return str(name)

    def meant(self, name: str) -> Said | None:
        """What to write in place of a name that is none, where that can be said: of a joint its displacement's symbol."""
        owner, dot, part = name.partition(".")
        if owner in self.slides:
            new = self.slides[owner] + dot + part
            return say(
                "the joint {joint} slides by {symbol}: write {new}",
                joint=quoted(owner),
                symbol=self.slides[owner],
                new=new,
            )
        if name in self.undriven:
            link, against = self.undriven[name]
            return say(
                "it is there where a driver turns {link} against {against}: [[drivers]]",
                link=quoted(link),
                against=quoted(against),
            )
        return None

    @property
    def coordinates(self) -> list[str]:
        """The names of all coordinates of points."""
        return [f"{point}.{axis}" for point in self.points for axis in "xy"]

    @property
    def rates_there(self) -> Iterable[str]:
        """The rates that formulas may name: none where the driver has no speed."""
        return self.rates if self.moves else ()

    def is_rate(self, name: str) -> bool:
        """True for omega13, s14.v, theta13.d, C.vx."""
        owner, dot, part = name.partition(".")
        if name in self.rates:
            return True
        return bool(dot) and (
            (owner in self.variables and part in ("d", "dd")) or (owner in self.points and part in POINT_RATES)
        )

    def reads_rates(self, name: str) -> bool:
        """True for a rate, a force, or an output that reads one."""
        return self.is_rate(name) or name in self.forces or name in self.of_rates

    def no_point(self, name: str, path: Path) -> None:
        """Report a point that no link has."""
        self.report.at(
            path, say("no point is called {name}", name=quoted(name)), suggestion(name, self.points, "points")
        )

    def no_point_of(self, link: str, point: str, points: Iterable[str], path: Path) -> None:
        """Report a point that a link does not have; `points`: those that it may have there."""
        message = say("the link {link} has no point {point}", link=quoted(link), point=quoted(point))
        self.report.at(path, message, suggestion(point, points, say("points of {link}", link=link)))

    def still(self, message: Said, path: Path) -> None:
        """Report a point of the ground where one is needed that moves."""
        moving = [point for point in self.points if point not in self.fixed]
        self.report.at(path, message, suggestion("", moving, "moving points"))

    # ---- expressions

    def parse(self, text: str, path: Path) -> Node | None:
        """The tree of an expression, which computes in radians; None when it does not parse, or takes degrees or a length
        for an angle."""
        tree = self._parsed(text, path)
        if tree is None:
            return None
        slip = meant_in_degrees(tree, self.kinds) or self._length_for_angle(tree)
        if slip is None:
            return tree
        message, hint = slip
        self.report.at(path, say("in {text}: {message}", text=quoted(text), message=message), hint)
        return None

    def _parsed(self, text: str, path: Path) -> Node | None:
        """The tree of a text; None when it does not parse."""
        try:
            tree = parse_description(text)
        except FormulaError as error:
            if number := typed_number(text):
                self.report.at(path, say("found {text}: {why}", text=quoted(text), why=number.why), number.hint)
                return None
            if (unit := unit_behind(text)) and not set(re.findall(r"\w+", unit)) & {*self.units, *self.variables}:
                self.unknown_unit(unit, path)
                return None
            for fault in error.faults:
                self.report.at(path, say("in {text}: {message}", text=quoted(text), message=fault.message), fault.hint)
            return None
        if _deeper_than(tree, DEEPEST):
            self.report.at(path, say("the expression has more than {most} operators below one another", most=DEEPEST))
            return None
        return tree

    def condition_side(self, text: str, path: Path) -> Node | None:
        """The tree of one side of a condition, in which quantities are in their units: an output of summaries is its
        formula."""
        tree = self._parsed(text, path)
        if tree is None:
            return None
        return transform(
            tree, lambda part: self.motion_outputs.get(part.name, part) if isinstance(part, Symbol) else part
        )

    def only_dimensions(self, tree: Node, text: str, path: Path, besides: str = "") -> bool:
        """True when all symbols are dimensions (or the one `besides`); reports the others."""
        others = [name for name in symbols(tree) if name not in self.units and name != besides]
        for name in others:
            point, dot, _ = name.partition(".")
            if name in self.outputs:
                message = say("{name} is an output; only dimensions are allowed here", name=quoted(name))
            elif name in self.variables or (dot and point in self.points):
                message = say("{name} differs from row to row; only dimensions are allowed here", name=quoted(name))
            elif not self.solved:
                continue  # it may be a step
            else:
                message = say("{name} is not a dimension", name=quoted(name))
            if name != text.strip():
                message = say("in {text}: {message}", text=quoted(text), message=message)
            self.report.at(path, message, suggestion(name, self.units, "dimensions"))
        return not others

    def value(self, tree: Node, path: Path) -> float | None:
        """The value of an expression over dimensions, or None; reports why there is none."""
        names = symbols(tree)
        if any(name not in self.numbers for name in names):
            return None  # a dimension without a value has been reported already
        try:
            return evaluate(tree, self.numbers)
        except (ArithmeticError, ValueError) as error:
            used = ", ".join(f"{name} = {self.in_unit(name)}" for name in names)
            self.report.at(
                path, say("has no value: {error}", error=reason(error)), say("with {used}", used=used) if used else ""
            )
            return None

    def in_unit(self, dimension: str) -> str:
        """The value of a dimension as a person reads it."""
        unit = self.units[dimension]
        shown = unit.to_shown(self.numbers[dimension])
        return f"{shown:.6g}" + ("" if unit == NUMBER else f" {unit.symbol}")

    def fits(self, tree: Node, text: str, wanted: str, path: Path, instead: str = "") -> bool:
        """True unless the expression surely is of another kind than `wanted`; `instead`: what to do about an angle or a
        length in its place."""
        kind = kind_of(tree, self.kinds)
        needed = say("an angle") if wanted == ANGLE else say("a length")
        if wanted != ANY and (label := self.label_of(tree)):
            message = say("{text} is in {unit} where {needed} is needed", text=quoted(text), unit=label, needed=needed)
            self.report.at(path, message)
            return False
        length = length_as_angle(tree, self.kinds) if wanted == ANGLE else None
        if length is None and (ANY in (kind, wanted) or kind == wanted):
            return True
        hint = say("expressions compute in radians: leave degrees() out") if kind == DEGREES and wanted == ANGLE else ""
        hint = instead if kind in (ANGLE, LENGTH) else hint
        if length is not None:
            kind, hint = LENGTH, hint or self._as_angle(length)
        is_now = say("an angle") if kind == ANGLE else say(f"a {kind}")
        self.report.at(
            path,
            say(
                "{text} is {kind} where {needed} is needed",
                text=quoted(text),
                kind=is_now,
                needed=needed,
            ),
            hint,
        )
        return False

    def _length_for_angle(self, tree: Node) -> tuple[Said, Said] | None:
        """What is wrong with an expression that takes a length for an angle, and what to write; None where nothing is."""
        found = length_for_angle(tree, self.kinds)
        return (found[1], self._as_angle(found[0])) if found else None

    def _as_angle(self, length: Node) -> Said:
        """What to write for a length that stands for an angle; its unit was forgotten, as a rule."""
        name = length.name if isinstance(length, Symbol) else ""
        if name in self.inputs and name in self.numbers:
            new = f'{name} = {{ value = {self.numbers[name]:.15g}, unit = "deg" }}'
            return say('if it is an angle, write {new}, or unit = "rad"', new=new)
        if name in self.units:
            return say('if {name} is an angle, give it unit = "deg"', name=quoted(name))
        return say('a length over a length makes an angle: an arc over its radius, "s/r"')

    def is_in_radians(self, tree: Node, text: str, unit: Unit, path: Path) -> bool:
        """True unless an angle that people type in degrees is numbers alone, "30": these would be radians."""
        if not unit.in_degrees or not is_number_of_degrees(tree):
            return True
        message = say("{text} in quotes is an expression, and angles in expressions are in radians", text=quoted(text))
        hint = say("write {degrees} for degrees", degrees=quoted(f"radians({text.strip()})"))
        if plain := typed_number(text):
            radians = quoted(f"{plain.text} rad")
            hint = say("write {degrees}, without quotes, or {radians}", degrees=plain.text, radians=radians)
        self.report.at(path, message, hint)
        return False

    def label_of(self, tree: Node) -> str:
        """The unit of a dimension that is a force, a mass or the like and stands alone but for a sign; "" for all else."""
        match tree:
            case Unary(_, operand):
                return self.label_of(operand)
            case Symbol(name) if name in self.units and self.units[name].kind == "label":
                return self.units[name].text
        return ""

    def in_its_unit(self, tree: Node, text: str, unit: Unit, path: Path) -> None:
        """Report a dimension whose unit is known and is another one than that of its place."""
        label = self.label_of(tree)
        own, needed = unit_named(label), unit_named(unit.text)
        if own is not None and needed is not None and own != needed:
            message = say("{text} is in {own} where {unit} are needed", text=quoted(text), own=label, unit=unit.text)
            self.report.at(path, message)

    def quantity(self, value: Any, wanted: str, path: Path, unit: Unit | None = None) -> Quantity:
        """A number or expression over dimensions as the model holds it, in internal units; REPORTED if it is faulty.

        A plain number that is an angle is in `unit`, or in the file's angle unit. What is neither angle nor length is in
        `unit`, too, or has none.
        """
        own = unit or self.angle_unit
        plain = {ANGLE: own.symbol, LENGTH: self.length_unit}.get(wanted, unit.text if unit else "1")
        value = self.plain(value, plain, path)
        if value is BAD:
            return REPORTED
        if not isinstance(value, str):
            return (unit or self.angle_unit).to_internal(value) if wanted == ANGLE else float(value)
        tree = self.parse(value, path)
        if tree is None or not self.only_dimensions(tree, value, path):
            return REPORTED
        if not self.fits(tree, value, wanted, path) or (
            wanted == ANGLE and not self.is_in_radians(tree, value, own, path)
        ):
            return REPORTED
        known = all(name in self.numbers for name in symbols(tree))
        return REPORTED if known and self.value(tree, path) is None else tree

    def plain(self, value: Any, unit: str, path: Path) -> Any:
        """A number with its unit ("2 kN") as the number that it is in `unit`, BAD where it is of another kind; whatever
        else stands there as it is."""
        found = measured(value) if isinstance(value, str) else None
        if found is None:
            return value
        number = found.in_unit(unit or "1")
        if number is None:
            self._misfit(found, value, unit, path)
        return BAD if number is None else number

    def _misfit(self, found: Measured, text: str, unit: str, path: Path) -> None:
        if found.unit in self.units:
            message = say("{text} is neither a number nor an expression", text=quoted(text))
            self.report.at(path, message, say("write {new}", new=f'"{found.number}*{found.unit}"'))
        elif unit_named(found.unit) is None:
            self.unknown_unit(found.unit, path)
        elif unit in ("", "1"):
            self.report.at(path, say("{text} has a unit where a plain number is needed", text=quoted(text)))
        else:
            self.report.at(path, say("{text} where {unit} are needed", text=quoted(text), unit=unit))

    def unknown_unit(self, unit: str, path: Path) -> None:
        """Report it."""
        hint = say("units that are known: {units}", units=EXAMPLES)
        if near := like(unit):
            hint = say("{near} {all}", near=say('did you mean "{name}"?', name=near), all=hint)
        self.report.at(path, say("unknown unit {unit}", unit=quoted(unit)), hint)

    def number(self, quantity: Quantity) -> float:
        """The value of what `quantity` returned, or of what follows from it; nan where it is not known or out of reach."""
        if isinstance(quantity, float):
            return quantity
        if any(name not in self.numbers for name in symbols(quantity)):
            return REPORTED
        try:
            return evaluate(quantity, self.numbers)
        except (ArithmeticError, ValueError):
            return math.nan

    def unit(self, table: dict[str, Any], path: Path) -> Unit:
        """The unit of a dimension: the length unit (the default), degrees, radians, none, or a label (`labels_of`)."""
        unit = table.get("unit", self.length_unit)
        choices = ("deg", "rad", "1", self.length_unit)
        if unit is BAD or unit == self.length_unit:
            return self.length
        if plain_unit(unit) in choices:
            return unit_of(plain_unit(unit), self.length_unit)
        labels = labels_of(self.length_unit)
        label = next((label for label in labels if spelled(label) == spelled(unit)), None)
        if label is not None:
            return unit_of(label, self.length_unit)
        value = table.get("value")
        at_home = home(Measured(repr(value), spelled(unit)), self.length_unit) if isinstance(value, float) else None
        if at_home is not None:
            message = say("a number in {unit} is written with its unit behind it", unit=quoted(unit))
            self.report.at((*path, "unit"), message, say("write {new}", new=f'value = "{value:.12g} {unit}"'))
        else:
            hint = suggestion(unit, (*choices, *labels), "units")
            self.report.at((*path, "unit"), say("unknown unit {unit}", unit=quoted(unit)), hint)
        return NUMBER  # fits everywhere


def symbol_fault(name: str) -> str:
    """Why `name` cannot stand in an expression, as the end of a sentence; "" when it can."""
    if not name or not name[0].isalpha() or not all(sign.isalnum() or sign == "_" for sign in name):
        return say("must begin with a letter and go on with letters, digits and _")
    if len(name) > 60:
        return say("is longer than 60 characters")
    if name in RESERVED:
        return say("means something else in expressions")
    return ""


def words(value: Any) -> Words | None:
    """A text in its languages, from data that fits the schema."""
    if not isinstance(value, dict):
        return None
    return Label(str(value[ENGLISH]), tuple((key, str(text)) for key, text in value.items() if key != ENGLISH))


def cycles(edges: Mapping[str, Iterable[str]]) -> tuple[list[str], list[list[str]]]:
    """(an order in which every name comes after those it needs, the circles that had to be left out of it)."""
    remaining = {name: [other for other in needs if other in edges] for name, needs in edges.items()}
    places = {name: place for place, name in enumerate(edges)}
    circles: list[list[str]] = []
    while True:
        try:
            order = [name for name in TopologicalSorter(remaining).static_order() if name in remaining]
        except CycleError as error:
            members = error.args[1][:0:-1]  # each needs the next; the first is named twice
            start = members.index(min(members, key=places.__getitem__))
            circles.append(members[start:] + members[:start])
            remaining = {name: needs for name, needs in remaining.items() if name not in members}
        else:
            return order, circles


def circle_message(members: list[str], what: str) -> Said:
    """`a1, b1 and c1 depend on one another in a circle`."""
    if len(members) == 1:
        return say("{name} depends on itself", name=quoted(members[0]))
    return say("{what} {names} depend on one another in a circle", what=say(what), names=listed(members))


def _deeper_than(tree: Node, most: int) -> bool:
    level = [tree]
    for _ in range(most):
        level = [child for node in level for child in children(node)]
        if not level:
            return False
    return True


def part(data: Mapping[str, Any], key: str, empty: Any) -> Any:
    """What stands at `key`; `empty` where there is nothing, or nothing usable."""
    value = data.get(key, BAD)
    return empty if value is BAD else value


def choice(table: dict[str, Any], key: str, default: str) -> str:
    """The word at `key`, or the default."""
    value = table.get(key, default)
    return default if value is BAD else str(value)


def scope_of(head: dict[str, Any], report: Report) -> Scope:
    """A scope with the units of the part [mechanism], and no names yet."""
    scope = Scope(report)
    scope.length_unit = _length_unit(head, report)
    scope.angle_unit = unit_of(choice(head, "angle_unit", "deg"), scope.length_unit)
    return scope


def _length_unit(head: dict[str, Any], report: Report) -> str:
    unit = choice(head, "length_unit", "mm")
    if plain_unit(unit) in ("deg", "rad", "1") or unit != unit.strip():
        report.at(("mechanism", "length_unit"), say("{unit} cannot be the unit of lengths", unit=quoted(unit)))
        return "mm"
    return unit


def own_cell(
    scope: Scope, cells: list[Dimension], symbol: str, given: Any, kind: str, unit: Unit, path: Path, what: str
) -> Node:
    """A plain number as a cell `symbol`, added to `cells`; an expression over dimensions as it is.

    kind  ANGLE, LENGTH or ANY, which the expression must be;  unit  in which a plain number is written
    """
    given = scope.plain(given, unit.text, path)
    quantity = scope.quantity(given, kind, path, unit if kind == ANGLE else None)
    if not isinstance(quantity, float):
        return quantity
    if given is BAD or isinstance(given, str):  # its fault has been reported
        return Symbol("")  # which has no value
    scope.symbols.claim(symbol, what, path, say("rename it: the {what} has a cell of that name", what=say(what)))
    scope.numbers[symbol] = quantity
    cells.append(Dimension(symbol, quantity, unit, shown=float(given), path=path))
    return Symbol(symbol)
