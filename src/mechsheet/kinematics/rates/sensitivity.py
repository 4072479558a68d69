"""How much a quantity changes with a dimension while the driver stands: the design's own derivatives, for tolerances.

The loop closure of a group, left minus right, is a gap g(u, known, d) = 0 in its unknowns u. A gap held open in the loop
would move a quantity Q, by so much per unit of it:

    lambda_x w1_x + lambda_y w1_y = - dQ/du1,   lambda_x w2_x + lambda_y w2_y = - dQ/du2,   w = dg/du, D = w1 x w2

which Cramer's rule solves with the same D as velocities have. Groups that are solved later read the unknowns of earlier
ones: they go first, as with joint forces, and what they pass on is counted to dQ/du. A dimension opens the gap by dg/dd, so

    dQ/dd = (what Q's own formula says) + sum over the groups of lambda_x dg_x/dd + lambda_y dg_y/dd

This is the derivative by the dimension in place of the driver, at two columns a group instead of two a group and dimension.
Source: R. E. Knappe, A technique for analyzing mechanism tolerances, Machine Design, 1963 (the same by virtual work);
Soeylemez, Mechanisms, section 4.3, for the differentiated loop closure.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Node, Symbol, symbols, transform, walk, with_symbols
from livesheet.formula.vectors import cross
from mechsheet.kinematics.equations import Equations, Group
from mechsheet.kinematics.rates.rate_columns import terms_of
from mechsheet.model import Dimension, Mechanism

WRITTEN_OUT = 25
"""A derivative of a constant with more nodes than this has a cell of its own."""

SHORT, LONGEST = 12, 34
"""Nodes of what is written where it is read, and of what a cell holds."""


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """Of one quantity.

    inner  in order, symbol -> expression: lambda_x and lambda_y of each group, last group first, and parts of long sums;
           over positions, determinants and those before them
    by     by symbol of a dimension that it depends on: dQ/dd in internal units
    """

    quantity: str
    inner: Mapping[str, Node]
    by: Mapping[str, Node]


@dataclass(frozen=True, slots=True)
class Sensitivities:
    """Of several quantities of one mechanism.

    constants  derivatives of constants that stand in cells of their own: symbol -> expression over dimensions
    groups     numbers of the groups whose determinants are read
    """

    constants: Mapping[str, Node]
    groups: tuple[int, ...]
    of: tuple[Sensitivity, ...]


NO_BANDS = Sensitivities({}, (), ())
"""Of a mechanism of which nobody asks."""


def determinant_symbol(group: int) -> str:
    """What the determinant of a group is called in the formulas."""
    return f"det:{group}"


def gap_symbols(quantity: str, group: int) -> tuple[str, str]:
    """What a quantity's lambda_x and lambda_y of a group are called."""
    return f"{quantity}:gap {group}.x", f"{quantity}:gap {group}.y"


def loop_symbol(group: int, axis: int) -> str:
    """What the gap of a group's loop, along x (0) or y (1), is called."""
    return f"loop {group}.{'xy'[axis]}"


def by_symbol(quantity: str, dimension: str) -> str:
    """What the derivative of a quantity, or of a constant, by a dimension is called."""
    return f"{quantity}:{dimension}"


def toleranced(mechanism: Mechanism) -> tuple[Dimension, ...]:
    """The dimensions that have a tolerance."""
    return tuple(dim for dim in mechanism.free_dimensions if dim.tolerance)


def sensitivities(mechanism: Mechanism, equations: Equations, quantities: Sequence[str]) -> Sensitivities:
    """The derivatives of quantities by all dimensions that have a tolerance; a dimension that changes nothing is left out.

    Raises ValueError for a mechanism with a group that Newton's method solves, and where a formula has no derivative.
    """
    partials = _Partials(mechanism, equations)
    dimensions = [dim.symbol for dim in toleranced(mechanism)]
    found, read = [], set()
    for quantity in quantities:
        writer = _Writer(quantity, partials)
        writer.solve(equations.groups)
        found.append(writer.result(dimensions))
        read |= {group.number for group, _ in writer.held}
    return Sensitivities(partials.constants, tuple(sorted(read)), tuple(found))


def of_constant(mechanism: Mechanism, equations: Equations, node: Node) -> dict[str, Node]:
    """The derivatives of what follows from dimensions alone, written out, by all that have a tolerance and change it."""
    partials = _Partials(mechanism, equations)
    found = {}
    for dim in toleranced(mechanism):
        slope = partials.of(node, dim.symbol)
        while not partials.constants.keys().isdisjoint(symbols(slope)):
            slope = with_symbols(slope, partials.constants)
        if not al.is_zero(slope):
            found[dim.symbol] = slope
    return found


class _Partials:
    """Derivatives of expressions by the groups' unknowns and by dimensions, by the chain rule over what is computed between:
    points, angles that follow from others, derived dimensions."""

    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        opaque = {name for group in equations.groups for name in group.unknowns}
        self.forms: dict[str, Node] = {
            each.symbol: each.expression for each in equations.all if each.symbol not in opaque
        }
        derived = {dim.symbol: dim.value for dim in mechanism.dimensions if not isinstance(dim.value, float)}
        self.forms |= derived
        self.fixed = {equation.symbol for equation in equations.constants} | derived.keys()
        self.inputs = {dim.symbol for dim in mechanism.dimensions}
        self.constants: dict[str, Node] = {}
        self._known: dict[tuple[str, str], Node] = {}

    def of(self, node: Node, by: str) -> Node:
        """d node / d by, the unknowns and other dimensions held."""
        parts = []
        for name in symbols(node):
            inner = self._of_symbol(name, by)
            if not al.is_zero(inner):
                parts.append(al.mul(derivative(node, name), inner))
        return al.total(parts)

    def of_gap(self, group: Group, axis: int, by: str) -> Node:
        """d gap / d by of a group's loop; where it is long and the same in every row, a cell of its own."""
        found = self.of(group.closure.gap[axis], by)
        if _size(found) <= SHORT or not self.inputs | self.fixed >= set(symbols(found)):
            return found
        symbol = by_symbol(loop_symbol(group.number, axis), by)
        self.constants[symbol] = found
        return Symbol(symbol)

    def _of_symbol(self, name: str, by: str) -> Node:
        if name == by:
            return al.ONE
        if name not in self.forms:
            return al.ZERO
        if (name, by) not in self._known:
            form = self.forms[name]
            # the derivative of an angle of a triangle reads the angle itself
            found = transform(self.of(form, by), lambda part: Symbol(name) if part == form else part)
            if name in self.fixed and _size(found) > WRITTEN_OUT:
                symbol = by_symbol(name, by)
                self.constants[symbol] = found
                found = Symbol(symbol)
            self._known[name, by] = found
        return self._known[name, by]


def _size(node: Node) -> int:
    return sum(1 for _ in walk(node))


class _Writer:
    """The derivatives of one quantity; `held`: the groups whose gaps move it, with lambda_x and lambda_y."""

    def __init__(self, quantity: str, partials: _Partials) -> None:
        self.quantity, self.partials = quantity, partials
        self.inner: dict[str, Node] = {}
        self.held: list[tuple[Group, tuple[Node, Node]]] = []

    def solve(self, groups: Sequence[Group]) -> None:
        """lambda of each group, by Cramer's rule; the last group first."""
        for group in reversed(groups):
            if group.determinant is None:
                raise ValueError(f"group {group.number} has no closure to differentiate")
            one, other = (self._part(self.changes(unknown)) for unknown in group.unknowns)
            if al.is_zero(one) and al.is_zero(other):
                continue
            (x1, y1), (x2, y2) = (
                [self.partials.of(part, unknown) for part in group.closure.gap] for unknown in group.unknowns
            )
            right = cross((other, one), (y2, y1)), cross((one, other), (x1, x2))
            if max(map(_size, right)) > LONGEST:
                x1, y1, x2, y2 = map(self._part, (x1, y1, x2, y2))
                right = cross((other, one), (y2, y1)), cross((one, other), (x1, x2))
            det = Symbol(determinant_symbol(group.number))
            names = gap_symbols(self.quantity, group.number)
            along = [self._column(name, al.div(node, det)) for name, node in zip(names, right, strict=True)]
            self.held.append((group, (along[0], along[1])))

    def result(self, dimensions: Sequence[str]) -> Sensitivity:
        """By all dimensions that change it."""
        by = {name: self._short(self.changes(name)) for name in dimensions}
        return Sensitivity(self.quantity, self.inner, {name: node for name, node in by.items() if not al.is_zero(node)})

    def changes(self, by: str) -> Node:
        """What changes the quantity with `by`: by its own formula, and through the gaps of the groups found so far."""
        parts = [self.partials.of(Symbol(self.quantity), by)]
        for group, factors in self.held:
            for axis, factor in enumerate(factors):
                if not al.is_zero(factor):
                    parts.append(al.mul(factor, self.partials.of_gap(group, axis, by)))
        return al.total(parts)

    def _column(self, name: str, node: Node) -> Node:
        """A column, where it is more than a number."""
        if al.is_simple(node):
            return node
        self.inner[name] = node
        return Symbol(name)

    def _part(self, node: Node) -> Node:
        """What is read twice: in a column where it is long."""
        if _size(node) <= SHORT:
            return node
        short = self._short(node)
        return self._column(self._fresh(), short)

    def _short(self, node: Node) -> Node:
        """A sum of which no cell holds more than can be read: its first terms stand in a column of their own."""
        if _size(node) <= LONGEST:
            return node
        chunks: list[Node] = [al.ZERO]
        for term in terms_of(node):
            longer = al.add(chunks[-1], term)
            chunks[-1:] = [longer] if _size(longer) <= LONGEST else [chunks[-1], term]
        return al.total([*(self._column(self._fresh(), chunk) for chunk in chunks[:-1]), chunks[-1]])

    def _fresh(self) -> str:
        return f"{self.quantity}:part {sum(':part ' in name for name in self.inner) + 1}"
