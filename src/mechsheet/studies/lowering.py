"""The equations of a mechanism as a program over (designs x places): the one lowering of this edge.

exists, beside an equation   a mask; of each group the mask says where it closes
Direction(y, x)              arctan2, and where somebody reads its whole turns, without jumps along the rows; at other
                             places than rows within half a turn of a row's
TriangleAngle(a, b, c)       arctan2 of four areas and b^2 + c^2 - a^2; angles of one triangle share the area
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Direction, Node, Symbol, TriangleAngle, Unary, children, symbols
from mechsheet.kinematics.equations import Condition, Equation, Equations
from mechsheet.kinematics.inputs import Asked
from mechsheet.studies.program import DESIGN, ONE, PLACE, WHOLE, Program, Running, Value, Width, kept, near, unwrapped

ANCHOR = "{symbol} of a row"
"""What is given, at other places than rows, for an angle without jumps: its value in a row near by."""

THERE, MARGIN = "there", "margin {group}"


@dataclass(frozen=True, slots=True)
class Lowered:
    """A program for some symbols.

    there    the key of the mask: every group closes;  margins: keys of what each group that can come apart has left
    anchors  symbols of the angles without jumps whose turns are read
    """

    run: Running
    anchors: tuple[str, ...]
    margins: tuple[str, ...]


class Lowering:
    """What is known of a mechanism's equations before a program is written.

    fixed    values of the dimensions that do not vary, and of the assembly modes
    varied   symbols of those that vary;  derived  those that follow from them, in order, with their expressions
    given    what is given row by row, the driver first
    asked    what is asked of them: no row of a design for which it does not hold claims a position
    """

    def __init__(
        self,
        equations: Equations,
        fixed: Mapping[str, float],
        varied: Iterable[str],
        derived: Sequence[tuple[str, Node]],
        given: Iterable[str],
        asked: Sequence[Asked] = (),
    ) -> None:
        self.equations = equations
        self.fixed = fixed
        self.varied = tuple(varied)
        self.derived = tuple(derived)
        self.given = tuple(given)
        self.asked = tuple(asked)
        self.modes = frozenset(group.mode for group in equations.groups)
        self.margins = {
            equation.group: condition
            for equation in reversed(equations.columns)
            for condition in equation.exists
            if condition.reach
        }
        self._sums = {
            equation.symbol: equation.expression
            for equation in equations.columns
            if equation.unit.kind == "angle" and not equation.exists and isinstance(equation.expression, Binary)
        }
        outputs = [equation for equation in equations.all if equation.role == "output"]
        self.cancelled = {equation.symbol: self._cancelled(equation.expression) for equation in outputs}

    def constants(self, symbols_: Iterable[str], nodes: Mapping[str, Node]) -> Running:
        """A program for what rows do not change: values of symbols, and of expressions by names of their own."""
        writer = _Writer(self, True, frozenset(), constants=True)
        found = {symbol: writer.known[symbol] for symbol in symbols_}
        return writer.program.running(found | {name: writer.value(node) for name, node in nodes.items()})

    def columns(
        self,
        wanted: Sequence[str],
        rows: bool,
        closing: bool = False,
        anchors: bool = False,
        nodes: Mapping[str, Node] | None = None,
    ) -> Lowered:
        """A program for columns: in the rows, which all designs share, or at places of each design's own.

        closing  also margins
        anchors  in the rows: also what a program at other places is given of them
        nodes    also expressions over what those wanted read, by names of their own
        """
        writer = _Writer(self, rows, self._turning(wanted))
        found = {symbol: writer.known[symbol] for symbol in wanted}
        found |= {name: writer.value(node) for name, node in (nodes or {}).items()}
        found[THERE] = writer.there()
        margins = {}
        if closing:
            for group, condition in sorted(self.margins.items()):
                margins[MARGIN.format(group=group)] = writer.value(condition.margin)
        found |= margins
        if anchors:
            found |= {ANCHOR.format(symbol=symbol): writer.known[symbol] for symbol in writer.anchored}
        return Lowered(writer.program.running(found), tuple(writer.anchored), tuple(margins))

    def _turning(self, wanted: Iterable[str]) -> frozenset[str]:
        """Symbols whose whole turns matter: those wanted, and what these are sums of; not what only sines read."""
        by_symbol = {equation.symbol: equation for equation in self.equations.columns}
        matter: dict[str, bool] = {}
        stack = [*((symbol, True) for symbol in wanted), *((group.closes, False) for group in self.equations.groups)]
        while stack:
            symbol, turns = stack.pop()
            if symbol not in by_symbol or matter.get(symbol) in (True, turns):
                continue
            matter[symbol] = turns
            equation = by_symbol[symbol]
            self._read(self.cancelled.get(symbol, equation.expression), turns, stack)
            for condition in equation.exists:
                stack += [(name, True) for name in (*symbols(condition.margin), *symbols(condition.least))]
        return frozenset(symbol for symbol, turns in matter.items() if turns)

    def _read(self, node: Node, turns: bool, stack: list[tuple[str, bool]]) -> None:
        """The symbols that an expression reads, and whether their whole turns matter if those of the expression do."""
        match node:
            case Symbol(name):
                stack.append((name, turns))
            case Call("SIN" | "COS" | "TAN"):
                turns = False
            case Binary("+" | "-") | Unary("-" | "+"):
                pass
            case Binary("*", Symbol(name), _) if name in self.modes:
                pass
            case _:
                turns = True
        for child in children(node):
            self._read(child, turns, stack)

    def _cancelled(self, expression: Node) -> Node:
        """A sum of angles without what is added and taken away again: of theta14 - theta13 the angle between the links is
        left, and nobody computes the directions of both."""
        terms: dict[Node, int] = {}
        self._add_terms(expression, 1, terms)
        left = {node: count for node, count in terms.items() if count}
        if len(left) == len(terms) or not left or any(abs(count) > 1 for count in left.values()):
            return expression
        total: Node = al.ZERO
        for node, count in left.items():
            total = al.add(total, node) if count > 0 else al.sub(total, node)
        return total

    def _add_terms(self, node: Node, sign: int, terms: dict[Node, int]) -> None:
        match node:
            case Binary("+" | "-" as op, one, other):
                self._add_terms(one, sign, terms)
                self._add_terms(other, sign if op == "+" else -sign, terms)
            case Unary("-", operand):
                self._add_terms(operand, -sign, terms)
            case Symbol(name) if name in self._sums:
                self._add_terms(self._sums[name], sign, terms)
            case _:
                terms[node] = terms.get(node, 0) + sign


class _Writer:
    """One program while it is written; `constants`: one for what rows do not change."""

    def __init__(self, lowering: Lowering, rows: bool, turning: frozenset[str], constants: bool = False) -> None:
        self.program = Program()
        self.rows = rows
        self.turning = turning
        self._constants = constants
        self.anchored: list[str] = []
        self._masks: dict[tuple[Condition, ...], Value] = {}
        self._areas: dict[frozenset[Value], Value] = {}
        self._equations = lowering.equations
        self._cancelled = lowering.cancelled
        wide: Width = PLACE if rows else WHOLE
        self.known = {symbol: Value(ONE, number=number) for symbol, number in lowering.fixed.items()}
        self.known |= {symbol: self.program.given(symbol, DESIGN) for symbol in lowering.varied}
        for symbol, node in lowering.derived:
            self.known[symbol] = self.value(node)
        self.known |= {symbol: self.program.given(symbol, wide) for symbol in lowering.given}
        self._possible = self._can_be(lowering.asked)
        if self._possible.width != ONE and not constants:
            driver = lowering.given[0]
            self.known[driver] = self.program.step(kept, self.known[driver], self._possible)
        for equation in lowering.equations.all:
            self.known[equation.symbol] = self._equation(equation)

    def value(self, node: Node, rooted: bool = False) -> Value:
        """The value of an expression over symbols before it."""
        return self.program.value(node, self.known, rooted)

    def _equation(self, equation: Equation) -> Value:
        if equation.symbol == self._equations.tolerance:
            return self._tolerance(equation)
        match equation.expression:
            case Direction(y, x):
                value = self._direction(equation.symbol, self.value(y), self.value(x))
            case TriangleAngle(opposite, beside, other):
                value = self._angle(*(self.value(side) for side in (opposite, beside, other)))
            case _ if equation.role == "output":
                value = self.value(self._cancelled[equation.symbol])
            case expression:
                value = self.value(expression, rooted=bool(equation.exists))
        if not equation.exists:
            return value
        mask = self._mask(equation.exists)
        return value if mask.width == ONE and mask.number else self.program.step(kept, value, mask)

    def _can_be(self, asked: Sequence[Asked]) -> Value:
        """Whether all holds that is asked of inputs, one value for a design."""
        tests = [
            self.program.step(
                np.greater_equal if each.zero else np.greater, self.value(each.margin), Value(ONE, number=0.0)
            )
            for each in asked
        ]
        return self.program.fold(np.logical_and, tests or [Value(ONE, number=1.0)])

    def _tolerance(self, equation: Equation) -> Value:
        """No number where a length between joints is none, be it a driven one in its row: then no row claims a position."""
        lengths = [self.known[name] for name in self._equations.positive if name in self.known]
        if self._constants:
            lengths = [length for length in lengths if not length.width & PLACE]
        value = self.value(equation.expression)
        if not lengths:
            return value
        least = self.program.fold(np.minimum, lengths)
        fine = self.program.step(np.greater, least, Value(ONE, number=0.0))
        return value if fine.width == ONE and fine.number else self.program.step(kept, value, fine)

    def _direction(self, symbol: str, y: Value, x: Value) -> Value:
        raw = self.program.step(np.arctan2, y, x)
        if not raw.width & PLACE or symbol not in self.turning:
            return raw
        self.anchored.append(symbol)
        if self.rows:
            return self.program.step(unwrapped, raw)
        return self.program.step(near, raw, self.program.given(ANCHOR.format(symbol=symbol), WHOLE))

    def _angle(self, opposite: Value, beside: Value, other: Value) -> Value:
        """The angle of a triangle: Heron's area as Kahan writes it, once for all angles of the triangle."""
        step = self.program.step
        key = frozenset((opposite, beside, other))
        if key not in self._areas:
            both, less = step(np.add, beside, other), step(np.subtract, beside, other)
            product = step(np.multiply, step(np.add, both, opposite), step(np.subtract, both, opposite))
            product = step(np.multiply, product, step(np.add, opposite, less))
            product = step(np.multiply, product, step(np.subtract, opposite, less))
            self._areas[key] = self.program.root(product)
        squares = [step(np.multiply, side, side) for side in (beside, other, opposite)]
        cosine = step(np.subtract, step(np.add, squares[0], squares[1]), squares[2])
        return step(np.arctan2, self._areas[key], cosine)

    def _mask(self, exists: tuple[Condition, ...]) -> Value:
        """Where all conditions hold; never where something they read is no number."""
        if exists not in self._masks:
            tests = [
                self.program.step(np.greater_equal, self.value(each.margin), self.value(each.least)) for each in exists
            ]
            self._masks[exists] = self.program.fold(np.logical_and, tests)
        return self._masks[exists]

    def there(self) -> Value:
        """Where every group closes."""
        found = [] if self._possible.width == ONE else [self._possible]
        for group in self._equations.groups:
            equation = self._equations.of(group.closes)
            if equation.exists:
                found.append(self._mask(equation.exists))
            else:
                found.append(self.program.step(np.isfinite, self.known[equation.symbol]))
        return self.program.fold(np.logical_and, found or [Value(ONE, number=1.0)])
