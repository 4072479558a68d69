"""Quantities that grow without bound: at a limit position, or at a place between two rows where they change sign.

Probes come as near to such a place as one likes and find a number as large as one likes: it is no extreme. So the sheet
says it in a word. At a limit the probes lead far beyond all that the rows have; at a pole between two rows the reciprocal
of the quantity goes through 0 in a nearly straight line. An absolute value has no sign that could change, so a quantity
that is divided by one is looked at with the sign of what stands in it: of y = a/|b| that is a/b.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from functools import reduce

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import KEEP_BOUNDS, WITHIN_BOUNDS
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary, symbols, transform, walk, with_symbols
from mechsheet.kinematics.equations import Equations, Group
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS
from mechsheet.model import Mechanism, touched_by
from mechsheet.sheet.checks.search_rules import BESIDE_HERE
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula

GROWN = 30.0
"""The probes of a quantity without bound lead beyond the best row by more than so many ranges of the rows."""

STRAIGHT = 0.3
"""How much a reciprocal may bend over three rows around a pole, as a part of its change."""

STRAIGHT_SIGNED = 0.5
"""The same where the sign is that of what stands in an absolute value, which is known to change. Where the quantity only
seems to be divided by 0, as a/|b| is where a is 0 too, it is nearly 1."""

LEAST_ROWS = 6
"""Fewer rows say too little of the range."""

BEYOND_ROWS = formula(
    "AND(last-first>=least,ABS(extreme-of_rows)>grown*ABS(of_rows-other))", least=LEAST_ROWS - 1, grown=GROWN
)
"""Whether an extreme is far beyond the rows: `of_rows` and `other` are the best and the worst of those from the `first` to
the `last` one of the stretch."""

MIDDLE = formula("IF(wraps>0,here,MAX(first+1,MIN(last-1,here)))")
"""The middle one of three rows: that from which the search begins, or its neighbour at an end of the stretch."""

NEIGHBOURS = tuple(with_symbols(tree, {"here": Symbol("middle")}) for tree in BESIDE_HERE)
"""The rows beside it: the first row's neighbour is the last, where the motion goes around."""

SIGNED = formula("value*SIGN(there*here)")
"""A value beside the middle row with the sign of what stands in an absolute value, `there` and `here`."""


def at_pole(signed: bool) -> Node:
    """Whether a quantity has a pole beside the middle one of three rows, over its values there: `before`, `here`, `after`.

    signed  whether their signs are those of what stands in an absolute value
    """
    return formula(
        "IFERROR(AND(MIN(before*here,after*here)<0,ABS(1/before-2/here+1/after)<straight*ABS(1/before-1/after)),FALSE)",
        straight=STRAIGHT_SIGNED if signed else STRAIGHT,
    )


def may_grow(plan: Plan, symbol: str) -> bool:
    """Whether a quantity can be without bound, and the sheet would know."""
    return not plan.rows_only and symbol not in bounded(
        plan.mechanism, plan.equations.equations, plan.found.transmission
    )


def seen_by_rates(mechanism: Mechanism, rates: Collection[str], symbol: str) -> bool:
    """Whether a quantity has columns of both its derivatives by the driver: it is an angle or a place then, and changes its
    sign where it likes."""
    return mechanism.driver.law is None and all(symbol + each in rates for each in COEFFICIENTS)


def bounded(mechanism: Mechanism, equations: Equations, transmission: Iterable[Group]) -> set[str]:
    """Quantities that cannot be without bound: the angles of links and between them, places of points, what is of a cam;
    and outputs that follow from these by functions that keep what is bounded so."""
    found = {link.angle_symbol for link in mechanism.links} | {group.transmission for group in transmission}
    found |= {equation.symbol for equation in equations.all if equation.role == "point"}
    driven = {*mechanism.driven_symbols, *mechanism.given_by_row}
    columns = driven | {equation.symbol for equation in equations.columns}
    found |= _of_cam(mechanism, equations, columns)
    outputs = (each.symbol for each in mechanism.outputs)
    return found | {
        symbol for symbol in outputs
        if symbol in columns and _keeps_bounds(equations.of(symbol).expression, columns, found | driven)
    }  # fmt: skip


def _of_cam(mechanism: Mechanism, equations: Equations, columns: set[str]) -> set[str]:
    """How the follower moves, which laws without poles say, the pressure angle, the curvature of a roller's way, which has
    no pole where that goes on, and what a face that does not turn shows: where segments meet these leap, and rows around a
    leap look like those around a pole."""
    cam, follower = mechanism.cam, mechanism.follower
    found = {*follower.by_angle, *follower.by_time} if follower is not None else set()
    touched = None if cam is None else touched_by(cam, mechanism.links)
    if cam is None or touched is None:
        return found
    stays = cam.radius is None and columns.isdisjoint(symbols(equations.of(touched.angle_symbol).expression))
    return found | {"alpha", *(() if cam.radius is None else ("kappa",)), *(("rho", "contact") if stays else ())}


def _keeps_bounds(node: Node, columns: Collection[str], known: Collection[str]) -> bool:
    """Whether an expression is bounded: over columns that are known to be, and divided by none."""
    match node:
        case Number():
            return True
        case Symbol(name):
            return name in known or name not in columns
        case Binary("/", left, right):
            return _keeps_bounds(left, columns, known) and not any(name in columns for name in symbols(right))
        case Binary("^", left, Number(power)):
            return power >= 0 and _keeps_bounds(left, columns, known)
        case Binary("+" | "-" | "*"):
            parts: Sequence[Node] = (node.left, node.right)
        case Unary():
            parts = (node.operand,)
        case Call("IF"):
            parts = node.args[1:]
        case Call(name):
            if name in WITHIN_BOUNDS:
                return True
            if name not in KEEP_BOUNDS:
                return False
            parts = node.args
        case _:
            return False
    return all(_keeps_bounds(part, columns, known) for part in parts)


def unsigned_divisor(plan: Plan, symbol: str) -> Node | None:
    """What an output is divided by only as an absolute value, over columns of the tables: b of a/|b|; None without."""
    return divisor_of(plan.equations.of(symbol).expression, lambda each: bool(_columns_of(plan, each)))


def divisor_of(expression: Node, varies: Callable[[Node], bool]) -> Node | None:
    """What an expression is divided by only as an absolute value, of factors that vary along the rows; None without."""
    found = [each for each in _factors(expression, False, False) if varies(each)]
    return reduce(al.mul, found) if found else None


def in_row(plan: Plan, node: Node, row: Node) -> Node:
    """An expression over columns, in the row of that number (from 1)."""
    columns = _columns_of(plan, node)

    def change(part: Node) -> Node:
        if not (isinstance(part, Symbol) and part.name in columns):
            return part
        cell = formula("INDEX(column,row)", column=Symbol(ALL + part.name), row=row)
        return Call("RADIANS", (cell,)) if plan.at.spots[part.name].degrees else cell

    return transform(node, change)


def _columns_of(plan: Plan, node: Node) -> set[str]:
    return {part.name for part in walk(node) if isinstance(part, Symbol) and plan.at.spots[part.name].column}


def _factors(node: Node, below: bool, absolute: bool) -> list[Node]:
    """The factors of a product that stand below its fraction line and in an absolute value.

    below, absolute  whether the node itself does
    """
    match node:
        case Binary("*", left, right):
            return _factors(left, below, absolute) + _factors(right, below, absolute)
        case Binary("/", left, right):
            return _factors(left, below, absolute) + _factors(right, not below, absolute)
        case Unary("-", operand):
            return _factors(operand, below, absolute)
        case Call("ABS", (operand,)):
            return _factors(operand, below, True)
    return [node] if below and absolute else []
