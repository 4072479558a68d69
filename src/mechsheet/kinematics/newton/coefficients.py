"""Influence coefficients of a group that Newton's method solves, as columns: D, its unknowns', its links'."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Node, Symbol, renamed
from livesheet.formula.vectors import NOWHERE, Vector, minus, negative
from livesheet.said import Words
from mechsheet.kinematics.cell_lengths import LONGEST
from mechsheet.kinematics.equations import System
from mechsheet.kinematics.newton.rates import Closing, Own, dead, known_sides, own_rate, solved, without
from mechsheet.kinematics.rates.motions import PointRate
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS, RateColumns, order_words
from mechsheet.units import LENGTH, NUMBER, Unit
from mechsheet.words.equations import phrase


class ChainColumns:
    """Of one group."""

    def __init__(
        self, columns: RateColumns, system: System, closings: Sequence[Closing], points: dict[str, PointRate]
    ) -> None:
        """`points`: the rates of points that have columns; more are added."""
        self.columns, self.system, self.closings, self.points = columns, system, closings, points
        self.owns = [(place, closing.own) for place, closing in enumerate(closings) if closing.own is not None]
        self.gaps: list[Vector] = [NOWHERE] * len(closings)

    def write(self) -> tuple[Symbol, list[str]]:
        """D, and the symbols of which there are coefficients now."""
        system, columns = self.system, self.columns
        slides = [
            next(eq for eq in columns.ledger.columns if eq.symbol == name).unit == LENGTH for name in system.variables
        ]
        columns.angles.update(name for name, slide in zip(system.variables, slides, strict=True) if not slide)
        label = phrase("determinant")
        alive = dead(system, slides, columns.ledger.size(), lambda node: columns.define("r", node, NUMBER, label))
        det = columns.define("D", Symbol(system.determinant), NUMBER, label, alive)
        for order in (1, 2):
            names = [f"{name}{COEFFICIENTS[order - 1]}" for name in system.variables]
            self._unknowns(det, names, order)
            for place, own in self.owns:
                self._own(place, own, names, order)
        for closing in self.closings:
            if closing.point:
                parts = [[Symbol(f"{closing.point}.{axis}{part}") for axis in "xy"] for part in COEFFICIENTS]
                self.points[closing.point] = PointRate((parts[0][0], parts[0][1]), (parts[1][0], parts[1][1]))
        return det, [*system.variables, *(own.symbol for _, own in self.owns)]

    def _unknowns(self, det: Symbol, names: Sequence[str], order: int) -> None:
        columns = self.columns
        label = phrase("newton_minor")
        found = solved(self.system, self._right_sides(names, order))
        minors = {name: columns.define(name, node, NUMBER, label).name for name, node in found.minors}
        for name, node in zip(self.system.variables, found.numerators, strict=True):
            numerator = columns.within(renamed(node, minors), "n", NUMBER, label)
            columns.coefficient(name, order, al.div(numerator, det))

    def _right_sides(self, names: Sequence[str], order: int) -> list[Node]:
        """-F' or -F''; each is read for every unknown: in columns, unless it is simple."""
        found: list[Node] = []
        for place, closing in enumerate(self.closings):

            def write(free: Vector, closing: Closing = closing) -> list[Node]:
                return known_sides(closing, free, order)

            self.gaps[place] = self._short(place, order, without(self._free(place, order), names), write)
            for node in write(self.gaps[place]):
                base = f"{'uk'[order - 1]}{len(found) + 1}"
                label = phrase("known_side_of", number=str(len(found) + 1), order=order_words(order))
                found.append(self._column(base, node, self._unit(closing, order), label))
        return found

    def _own(self, place: int, own: Own, names: Sequence[str], order: int) -> None:
        """The rate of a link between two carriers, when those of the unknowns are known: they add what is linear in them."""
        free: list[Node] = []
        for known, whole in zip(self.gaps[place], self._free(place, order), strict=True):
            free.append(al.total([known, *(al.mul(derivative(whole, name), Symbol(name)) for name in names)]))

        def write(gap: Vector) -> list[Node]:
            return [own_rate(own, gap)]

        gap = free[0], free[1]
        point = self.closings[place].point
        if point:
            gap = negative(self.columns.point(point, order, minus(NOWHERE, gap)))
        else:
            gap = self._short(place, order, gap, write)
        self.columns.coefficient(own.symbol, order, own_rate(own, gap))

    def _free(self, place: int, order: int) -> Vector:
        free = self.closings[place].free
        return free.first if order == 1 else free.second

    def _short(self, place: int, order: int, gap: Vector, write: Callable[[Vector], list[Node]]) -> Vector:
        """The gap between the two ways to a place, in columns where what is written with it becomes long."""
        if max(map(self.columns.length, write(gap))) <= LONGEST:
            return gap
        parts = []
        for axis, node in zip("xy", gap, strict=True):
            label = phrase("gap_part", number=str(place + 1), axis=axis, order=order_words(order))
            parts.append(self._column(f"g{place + 1}_{axis}", node, self.columns.unit(1, order), label))
        return parts[0], parts[1]

    def _column(self, base: str, node: Node, unit: Unit, label: Words) -> Node:
        """In a column of its own, unless it is simple."""
        if al.is_simple(node):
            return node
        return self.columns.define(base, self.columns.within(node, base, unit, label), unit, label)

    def _unit(self, closing: Closing, order: int) -> Unit:
        """Of an equation: a distance is asked as a square, an offset or a pin as a length, a gear as an angle."""
        squared = closing.own is not None and closing.own.square != al.ONE
        return self.columns.unit(2 if squared else closing.power, order)
