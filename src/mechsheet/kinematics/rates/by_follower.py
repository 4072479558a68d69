"""How everything moves with the variable of what a cam drives, while the cam and all else that is driven stand.

By the cam's angle every first derivative is linear in that of the follower's variable v. So its derivative by v.d,

    dX/dv = sum of d(X.d)/d(Y.d) dY/dv,      dv/dv = 1,

follows from the formulas that stand there already, whatever kind of group they are of; and it is there at a dwell, too,
where v.d and X.d are 0. Source: the chain rule; Soeylemez, Mechanisms, section 5.3 (virtual work).
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Node, Symbol, symbols
from livesheet.formula.vectors import Vector
from mechsheet.kinematics.equations import CAM, RATES, Equation
from mechsheet.kinematics.rates.motions import Motions
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS, RateColumns
from mechsheet.model import FurtherDriver
from mechsheet.words.equations import phrase


class ByFollower:
    """Writes the columns down that are read."""

    def __init__(self, follower: FurtherDriver, motions: Motions, columns: RateColumns) -> None:
        """`motions`: by the cam's angle, all of whose columns are written down."""
        self.follower, self.motions, self.columns = follower, motions, columns
        self._rates = {each.symbol: each for each in columns.ledger.columns if each.role in RATES}
        self._known: dict[str, Node] = {f"{follower.symbol}{COEFFICIENTS[0]}": al.ONE}

    def of_place(self, link: str, at: Vector) -> Vector:
        """How the place of a link moves that is at some coordinates now."""
        x, y = self.motions.motion[link](at).first
        return self._of(x), self._of(y)

    def of_angle(self, link: str) -> Node:
        """How a link turns."""
        return self._of(self.motions.turning[link].first)

    def _of(self, node: Node) -> Node:
        parts = [al.mul(derivative(node, name), self._of_symbol(name)) for name in symbols(node)]
        return al.total(part for part in parts if not al.is_zero(part))

    def _of_symbol(self, name: str) -> Node:
        if name not in self._known:
            equation = self._rates.get(name)  # what is no rate of a body is a place: it stands
            self._known[name] = al.ZERO if equation is None else self._column(equation)
        return self._known[name]

    def _column(self, equation: Equation) -> Node:
        node = self._of(equation.expression)
        if al.is_simple(node):
            return node
        ledger, variable = self.columns.ledger, self.follower.symbol
        symbol = equation.symbol.removesuffix(COEFFICIENTS[0])
        group, ledger.group = ledger.group, CAM
        base = f"{symbol.replace('.', '_')}_by_{variable}"
        unit = self.columns.per_length(equation.unit) if self.follower.joint else equation.unit
        label = phrase("by_follower", symbol=symbol, follower=variable)
        found: Symbol = self.columns.define(base, self.columns.within(node, base, unit, label), unit, label)
        ledger.group = group
        return found
