"""Where equations are written down while a mechanism is being solved: unique names, constants told from columns, values.

The values ride along (a few rows of numpy) so that the sketch can pick each group's assembly mode as soon as the group's
equations stand.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from itertools import chain, count

import numpy as np

from mechsheet.formula.names import folded
from mechsheet.formula.nodes import Call, Node, Previous, Symbol, symbols
from mechsheet.kinematics import algebra as al
from mechsheet.kinematics.algebra import Angle
from mechsheet.kinematics.equations import Equation, Kind
from mechsheet.kinematics.numeric import Array, evaluate_column
from mechsheet.model import Words


class Ledger:
    """The growing list of equations.

    constant_symbols  symbols that have one value for all rows
    positive          input dimensions (or the driver's displacement) used as the length of a link between joints
    values            the columns' values over the first `rows` rows, by symbol
    """

    def __init__(self, dimensions: dict[str, float], driver: str, driver_values: Array, taken: Iterable[str]) -> None:
        self.dimensions = dimensions
        self.rows = len(driver_values)
        self.values: dict[str, Array] = {name: np.full(self.rows, number) for name, number in dimensions.items()}
        self.values[driver] = driver_values
        self.driver = driver
        self.constant_symbols = set(dimensions)
        self.constants: list[Equation] = []
        self.columns: list[Equation] = []
        self.positive: dict[str, None] = {}
        self.tolerance: Node = al.ZERO  # set to its symbol by whoever knows the lengths
        self.group = 0
        self._taken = {folded(name) for name in taken} | {folded(name) for name in dimensions} | {folded(driver)}

    def reserve(self, base: str) -> str:
        """A name like `base` that nothing else has: `phi`, in the second group `phi_2`."""
        group = max(self.group, 1)
        first = [base, f"{base}_1"] if group == 1 else [f"{base}_{group}"]
        further = (f"{base}_{group}_{number}" for number in count(2))
        name = next(name for name in chain(first, further) if folded(name) not in self._taken)
        self._taken.add(folded(name))
        return name

    def mode(self) -> Symbol:
        """The assembly mode of the present group, `mode_1`: a constant that is +1 until the sketch says otherwise."""
        name = self.reserve(f"mode_{self.group}" if self.group <= 1 else "mode")
        self.constant_symbols.add(name)
        self.set_mode(name, 1)
        return Symbol(name)

    def set_mode(self, name: str, sign: int) -> None:
        """Let a mode be +1 or -1; columns must be recomputed."""
        self.values[name] = np.full(self.rows, float(sign))

    def is_constant(self, node: Node) -> bool:
        """True when an expression has one value for all rows."""
        return all(name in self.constant_symbols for name in symbols(node))

    def define(
        self, symbol: str, expression: Node, unit: str, label: Words, kind: Kind, first: Node | None = None
    ) -> Symbol:
        """Write `symbol = expression` down and compute it. `kind` "constant" is for all rows, others are columns."""
        equation = Equation(symbol, expression, kind, unit, label, self.group, first)
        if kind == "constant":
            self.constants.append(equation)
            self.constant_symbols.add(symbol)
        else:
            self.columns.append(equation)
        self.values[symbol] = evaluate_column(equation, self.values, self.rows)
        return Symbol(symbol)

    def hoist(self, base: str, expression: Node, unit: str, label: Words) -> Node:
        """The expression itself when it is simple, else a new constant or intermediate column that holds it."""
        if al.is_simple(expression):
            return expression
        kind: Kind = "constant" if self.is_constant(expression) else "intermediate"
        return self.define(self.reserve(base), expression, unit, label, kind)

    def column(self, base: str, expression: Node, unit: str, label: Words) -> Symbol:
        """A new intermediate column."""
        return self.define(self.reserve(base), expression, unit, label, "intermediate")

    def hoist_angle(self, base: str, angle: Angle, label: Words) -> Angle:
        """The angle with its symbolic part made simple."""
        return Angle(self.hoist(base, angle.node, "angle", label), angle.degrees)

    def number(self, node: Node) -> float:
        """Value of a constant expression."""
        probe = Equation("", node, "constant", "number", Words("", ""))
        return float(evaluate_column(probe, self.values, self.rows)[0])

    def is_positive(self, node: Node) -> bool:
        """True for a length that is positive because of what it is made of.

        A symbol counts when it is positive now; it is noted in `positive`, and the workbook then insists on it.
        """
        plain = al.value_of(node)
        if plain is not None:
            return plain > 0
        match node:
            case Symbol(name) if bool(np.all(self.values[name] > 0)):
                if name in self.dimensions or name == self.driver:
                    self.positive[name] = None
                return True
            case Call("SQRT" | "ABS", _):
                return True
        return False

    def direction(self, base: str, x: Node, y: Node, exists: bool, label: Words) -> Symbol:
        """The direction of the vector (x, y) as an angle without jumps: ATAN2 plus as many turns as have gone by.

        exists  True when x and y are numbers in every row; else the last direction known is held over rows without one.
        """
        name = self.reserve(base)
        raw = self.column(f"{base}_0", al.atan2(x, y), "angle", Words(f"{label.en}, within half a turn", label.tr))
        turn = al.mul(al.TWO, al.PI)
        last: Node = Previous(raw.name)
        if not exists:
            number = Call("ISNUMBER", (raw,))
            held_name = self.reserve(f"{base}_held")
            held = self.define(
                held_name,
                Call("IF", (number, raw, Previous(held_name))),
                "angle",
                Words("last direction known", "bilinen son doğrultu"),
                "intermediate",
                first=Call("IF", (number, raw, al.ZERO)),
            )
            last = Previous(held.name)
            step: Node = Call("IF", (number, _turns(last, raw, turn), al.ZERO))
        else:
            # Pins that coincide have no direction: ATAN2(0, 0) is an error in most programs, which must not spread.
            step = Call("IF", (Call("ISNUMBER", (al.sub(last, raw),)), _turns(last, raw, turn), al.ZERO))
        turns_name = self.reserve("turns")
        turns = self.define(
            turns_name,
            al.add(Previous(turns_name), step),
            "number",
            Words("turns gone by", "tamamlanan tur sayısı"),
            "intermediate",
            first=al.ZERO,
        )
        return self.define(name, al.add(raw, al.mul(turn, turns)), "angle", label, "intermediate")

    def first_number(self, symbol: str) -> int | None:
        """The first row in which a column is a number."""
        found = np.flatnonzero(np.isfinite(self.values[symbol]))
        return int(found[0]) if len(found) else None

    def replace_expression(self, symbol: str, expression: Node) -> None:
        """Give a column another expression (used to take whole turns out of an angle)."""
        at = next(index for index, equation in enumerate(self.columns) if equation.symbol == symbol)
        self.columns[at] = replace(self.columns[at], expression=expression)
        self.recompute(at)

    def recompute(self, start: int) -> None:
        """Compute the columns again from the one at position `start` on."""
        for equation in self.columns[start:]:
            self.values[equation.symbol] = evaluate_column(equation, self.values, self.rows)


def _turns(last: Node, raw: Node, turn: Node) -> Node:
    return Call("ROUND", (al.div(al.sub(last, raw), turn), al.ZERO))
