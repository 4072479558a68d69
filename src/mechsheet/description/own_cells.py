"""Numbers that a description gives elsewhere than among its dimensions, as cells of their own."""

from __future__ import annotations

from typing import Any

from livesheet.formula.nodes import Node, Symbol
from livesheet.said import say
from mechsheet.description.kinds import ANGLE
from mechsheet.description.report import BAD
from mechsheet.description.scope import Scope
from mechsheet.description.text.index import Path
from mechsheet.model import Dimension
from mechsheet.units import Unit


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
