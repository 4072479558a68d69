"""What slips of the hand may have made of a formula, taken back: every single change of it, and two at once.

The kinds are what a lecturer would say of the slip; `weight` orders them: of two mends the lighter one is likelier meant.
"""

from __future__ import annotations

import heapq
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from livesheet.formula.nodes import (
    Binary,
    Call,
    CellRef,
    NameRef,
    Node,
    Number,
    RangeRef,
    Unary,
    children,
    rebuilt,
    walk,
)
from livesheet.formula.slips import FUNCTIONS, LEFT_OUT, SWAPPED, neighbours

MOST = 4000
"""Candidates for one formula."""

_TRIGONOMETRIC = frozenset(("SIN", "COS", "TAN"))
_INVERSE = frozenset(("ASIN", "ACOS", "ATAN", "ATAN2"))
_ALSO: dict[str, tuple[str, ...]] = {
    "SIN": ("TAN",), "COS": ("TAN",), "TAN": ("COS", "ATAN"), "ASIN": ("ATAN", "SIN"), "ACOS": ("ATAN", "COS"),
    "ATAN": ("ACOS", "ASIN"), "ABS": ("SQRT", "SIGN"),
}  # fmt: skip
_PI = Call("PI")
_OF_DEGREES = (Binary("/", Number(180.0), _PI), 180 / math.pi), (Binary("/", _PI, Number(180.0)), math.pi / 180)
"""What 57.3 and 0.01745 stand for."""
_NUMBERS = (0.0, 1.0, 2.0, 0.5, 180.0, 90.0, 360.0)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A formula with one change; see the module."""

    formula: Node
    kind: str
    weight: float


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What else the formula could have read: `single` cells or names, and cells of the same `row`, as it would write them.

    numbers  of single cells, what they hold: a typed number may stand for one of them
    columns  whole columns of the table, for a cell that reads ranges
    """

    single: tuple[Node, ...]
    row: tuple[Node, ...]
    numbers: tuple[float, ...]
    columns: tuple[RangeRef, ...] = ()


def candidates(formula: Node, around: Surroundings) -> list[Candidate]:
    """Every single change of a formula, each formula once, the lightest first; no more than MOST."""
    paths = _paths(formula)
    parts = list(paths)
    angles = _angles(formula)
    arguments = {arg for part in parts for arg in _sums(part)}
    summed = set(terms(formula)) | {term for arg in arguments for term in terms(arg)}
    found: dict[Node, Candidate] = {}

    def add(whole: Node, kind: str, weight: float) -> None:
        known = found.get(whole)
        if whole != formula and (known is None or weight < known.weight):
            found[whole] = Candidate(whole, kind, weight)

    for part in parts:
        for new, kind, weight in _variants(part, formula, angles, summed, arguments, around):
            if new != part:
                for whole in _put(formula, paths[part], new):
                    add(whole, kind, weight)
    for whole in _exchanged(formula, paths):
        add(whole, "reference", 1.4)
    return sorted(found.values(), key=lambda one: one.weight)[:MOST]


_Path = tuple[int, ...]


def _paths(formula: Node) -> dict[Node, list[_Path]]:
    """Where each part stands, by the number of the operand to go to on each level; what stands in a range is left out."""
    found: dict[Node, list[_Path]] = {}
    waiting: list[tuple[Node, _Path]] = [(formula, ())]
    while waiting:
        node, path = waiting.pop()
        found.setdefault(node, []).append(path)
        if not isinstance(node, RangeRef):
            waiting += [(part, (*path, number)) for number, part in enumerate(children(node))]
    return {node: sorted(paths) for node, paths in sorted(found.items(), key=lambda item: min(item[1]))}


def _put(formula: Node, paths: Sequence[_Path], new: Node) -> Iterator[Node]:
    """The formula with `new` in all these places; and where they are several, in each of them alone."""
    whole = formula
    for path in paths:
        whole = _put_at(whole, path, new)
    yield whole
    if 1 < len(paths) <= 4:
        yield from (_put_at(formula, path, new) for path in paths)


def _put_at(node: Node, path: _Path, new: Node) -> Node:
    """A tree with another node at a path; what does not stand on the path is the same object."""
    if not path:
        return new
    below = list(children(node))
    below[path[0]] = _put_at(below[path[0]], path[1:], new)
    return rebuilt(node, tuple(below))


def _exchanged(formula: Node, paths: Mapping[Node, Sequence[_Path]]) -> Iterator[Node]:
    """The formula with two of the cells that it reads taken for each other, everywhere or in one of its sums."""
    read = [node for node in paths if isinstance(node, CellRef | NameRef)][:12]
    sums = [path for node, places in paths.items() if isinstance(node, Binary) and node.op in "+-" for path in places]
    for inside in dict.fromkeys([(), *sums[:6]]):
        for one, other in itertools.combinations(read, 2):
            whole = formula
            for old, new in ((one, other), (other, one)):
                for path in paths[old]:
                    if path[: len(inside)] == inside:
                        whole = _put_at(whole, path, new)
            yield whole


def terms(node: Node) -> Iterator[Node]:
    """The terms of a sum; a product is one."""
    match node:
        case Binary("+" | "-", left, right):
            yield from terms(left)
            yield from terms(right)
        case Unary("-" | "+", operand):
            yield from terms(operand)
        case _:
            yield node


def _sums(part: Node) -> Iterator[Node]:
    """Arguments, numerators and denominators: what may be a sum with a term too few."""
    match part:
        case Call(_, args):
            yield from args
        case Binary("/", left, right):
            yield left
            yield right
        case Binary("*", left, right):
            yield left
            yield right
        case _:
            return


def _angles(formula: Node) -> set[Node]:
    """Parts that are angles: the whole, arguments of sines and cosines, their terms, what arcs give."""
    found = {formula, *terms(formula)}
    for part in walk(formula):
        if isinstance(part, Call) and part.name in _TRIGONOMETRIC and part.args:
            found |= {part.args[0], *terms(part.args[0])}
        if isinstance(part, Call) and part.name in _INVERSE:
            found.add(part)
    return found


_Variant = tuple[Node, str, float]


def _variants(
    part: Node, formula: Node, angles: set[Node], summed: set[Node], arguments: set[Node], around: Surroundings
) -> Iterator[_Variant]:
    """(what may have been meant by a part, what kind of slip it is, its weight)."""
    if isinstance(part, RangeRef):
        yield from _of_range(part, around)
        return
    match part:
        case Binary("+" | "-"):
            yield from _of_sum(part)
        case Binary("*" | "/"):
            yield from _of_product(part)
        case Binary("^", base, exponent):
            yield base, "exponent", 1.5
            yield from ((Binary("^", base, Number(value)), "exponent", 1.5) for value in (2.0, 3.0, 0.5))
            if isinstance(base, Unary):
                yield Unary("-", Binary("^", base.operand, exponent)), "sign of a square", 1.0
        case Unary("-", operand):
            yield operand, "sign", 1.0
        case Call():
            yield from _of_call(part)
        case Number(value):
            yield from _of_number(value, around)
        case CellRef() | NameRef():
            yield from _of_reference(part, around)
    if isinstance(part, Binary):
        yield from _rebracketed(part)
    if not isinstance(part, Number | Unary):
        yield Unary("-", part), "sign", 1.2
    if isinstance(part, CellRef | NameRef | Call) or part == formula:
        yield from _of_any(part)
    if part in angles and not isinstance(part, Number):
        yield from _of_angle(part)
    if part in summed or isinstance(part, CellRef | NameRef):
        yield from _with_factor(part, around)
    if part == formula or part in arguments:
        yield from _with_term(part, around)


def _of_sum(part: Binary) -> Iterator[_Variant]:
    left, right = part.left, part.right
    yield Binary("-" if part.op == "+" else "+", left, right), "sign", 1.0
    yield left, "term too many", 1.1
    yield right if part.op == "+" else Unary("-", right), "term too many", 1.1
    yield right, "term too many", 1.3
    if part.op == "-":
        yield Binary("-", right, left), "order of a difference", 1.0
    for op in "*/":
        yield Binary(op, left, right), "operator", 1.4


def _of_product(part: Binary) -> Iterator[_Variant]:
    left, right = part.left, part.right
    yield Binary("/" if part.op == "*" else "*", left, right), "operator", 1.0
    yield left, "factor too many", 1.3
    yield right, "factor too many", 1.3
    if part.op == "/":
        yield Binary("/", right, left), "order of a quotient", 1.0
        yield Binary("/", Number(1.0), right), "factor too many", 1.6
    for op in "+-":
        yield Binary(op, left, right), "operator", 1.4
    yield Binary("^", left, right), "operator", 1.5
    yield from ((new, "brackets", 1.0) for new in _divided(part))


def _divided(part: Binary) -> Iterator[Node]:
    """`a/b*c` as a/(b*c), and `a/(b*c)` as a/b*c, for products of any length."""
    chain: list[tuple[str, Node]] = []
    node: Node = part
    while isinstance(node, Binary) and node.op in "*/":
        chain.insert(0, (node.op, node.right))
        node = node.left
    slash = next((index for index, (op, _) in enumerate(chain) if op == "/"), None)
    if slash is None:
        return
    head = node
    for op, factor in chain[:slash]:
        head = Binary(op, head, factor)
    below = chain[slash][1]
    for _, factor in chain[slash + 1 :]:
        below = Binary("*", below, factor)
    if len(chain) > slash + 1:
        yield Binary("/", head, below)
    factors: list[Node] = []
    inner = chain[-1][1] if chain[-1][0] == "/" else Number(1.0)
    while isinstance(inner, Binary) and inner.op == "*":
        factors.insert(0, inner.right)
        inner = inner.left
    if factors:
        whole: Node = Binary("/", part.left, inner)
        for factor in factors:
            whole = Binary("*", whole, factor)
        yield whole


def _rebracketed(part: Binary) -> Iterator[_Variant]:
    """The same signs in the same order with brackets elsewhere."""
    if part.op not in "+-*/^":
        return
    match part.left:
        case Binary(op, a, b) if op in "+-*/":
            yield Binary(op, a, Binary(part.op, b, part.right)), "brackets", 1.1
        case Call(name, (inner,)):
            yield Call(name, (Binary(part.op, inner, part.right),)), "brackets", 1.2
        case Unary("-", inner):
            yield Unary("-", Binary(part.op, inner, part.right)), "brackets", 1.1
    match part.right:
        case Binary(op, b, c) if op in "+-*/^":
            yield Binary(op, Binary(part.op, part.left, b), c), "brackets", 1.1
        case Call(name, (inner,)):
            yield Call(name, (Binary(part.op, part.left, inner),)), "brackets", 1.4
    if isinstance(part.left, Binary) and isinstance(part.right, Binary):
        (a, b), (c, d) = (part.left.left, part.left.right), (part.right.left, part.right.right)
        inner = Binary(part.op, b, c)
        yield Binary(part.right.op, Binary(part.left.op, a, inner), d), "brackets", 1.3


def _of_call(part: Call) -> Iterator[_Variant]:
    name, args = part.name, part.args
    for other in (*((FUNCTIONS[name],) if name in FUNCTIONS else ()), *_ALSO.get(name, ())):
        kind = "radians and degrees" if name in ("RADIANS", "DEGREES") else "function"
        yield Call(other, args), kind, 1.0
    if name in LEFT_OUT and args:
        yield args[0], "radians and degrees" if name in ("RADIANS", "DEGREES") else "function", 1.0
    order = SWAPPED.get(name, ())
    if order and len(args) == len(order):
        yield Call(name, tuple(args[index] for index in order)), "order of arguments", 0.9
    match part:
        case Call("ATAN", (Binary("/", y, x),)):
            yield Call("ATAN2", (x, y)), "quadrant", 0.9
        case Call("MAX" | "MIN", (RangeRef() as column,)):
            low, high = Call("MIN", (column,)), Call("MAX", (column,))
            yield Binary("-", high, low), "term missing", 1.8
        case Call("ATAN2", (x, y)):
            yield Call("ATAN2", (Unary("-", x), Unary("-", y))), "order of a difference", 1.2
        case Call(_, (Binary(op, left, right),)) if op in "+-*/":
            yield Binary(op, Call(name, (left,)), right), "brackets", 1.2
            yield Binary(op, left, Call(name, (right,))), "brackets", 1.3
    if name == "SQRT" and args:
        yield Binary("^", part, Number(2.0)), "square root", 1.2


def _of_number(value: float, around: Surroundings) -> Iterator[_Variant]:
    near_pi = next((k for k in (1.0, 2.0, 0.5) if value and abs(value - k * math.pi) < 0.01 * math.pi), None)
    if near_pi is not None:
        yield (_PI if near_pi == 1 else Binary("*", Number(near_pi), _PI)), "value of pi", 0.8
    for meant, wanted in _OF_DEGREES:
        if abs(abs(value) - wanted) < 0.01 * wanted:
            yield (meant if value > 0 else Unary("-", meant)), "value of pi", 0.8
    for node, number in zip(around.single, around.numbers, strict=True):
        if number and abs(abs(value) - abs(number)) <= 1e-6 * abs(number):
            yield (node if value * number > 0 else Unary("-", node)), "typed number", 0.7
    yield Number(-value), *(("sign", 1.0) if value < 0 else ("typed number", 1.5))
    for other in dict.fromkeys((*_NUMBERS, value - 1, float(round(value)), 1 / value if value else 0.0)):
        yield Number(other), "typed number", 1.6
    yield from ((node, "typed number", 1.9) for node in around.single)


def _of_reference(part: CellRef | NameRef, around: Surroundings) -> Iterator[_Variant]:
    yield from ((node, "reference", 1.5) for node in around.single)
    yield from ((node, "reference", 1.6) for node in around.row)
    if isinstance(part, CellRef):
        for row_abs, col_abs in ((not part.row_abs, part.col_abs), (not part.row_abs, not part.col_abs)):
            yield replace(part, row_abs=row_abs, col_abs=col_abs), "anchor", 1.0
        yield from ((cell, "reference", 1.7) for cell in neighbours(part))


def _of_range(part: RangeRef, around: Surroundings) -> Iterator[_Variant]:
    """A column of the table from end to end, anchored as the range is: the same column, then another."""
    if not (isinstance(part.start, CellRef) and isinstance(part.end, CellRef)):
        return
    for column in around.columns:
        if isinstance(column.start, CellRef) and isinstance(column.end, CellRef):
            start = replace(column.start, row_abs=part.start.row_abs, col_abs=part.start.col_abs)
            end = replace(column.end, row_abs=part.end.row_abs, col_abs=part.end.col_abs, sheet=part.end.sheet)
            yield RangeRef(start, end), "range", 1.0 if start.col == part.start.col else 1.5


def _of_any(part: Node) -> Iterator[_Variant]:
    yield Binary("^", part, Number(2.0)), "exponent", 1.5
    yield Binary("*", Number(2.0), part), "factor missing", 1.6
    yield Binary("/", part, Number(2.0)), "factor missing", 1.6
    yield Call("RADIANS", (part,)), "radians and degrees", 1.0
    yield Call("DEGREES", (part,)), "radians and degrees", 1.0
    yield Call("SQRT", (part,)), "square root", 1.4


def _of_angle(part: Node) -> Iterator[_Variant]:
    """The other root, and angles from another zero."""
    yield Binary("-", _PI, part), "other root", 1.2
    yield Binary("+", part, _PI), "other root", 1.4
    yield Binary("-", Number(180.0), part), "other root", 1.5
    yield Binary("+", part, Number(180.0)), "other root", 1.6
    for zero in (Binary("/", _PI, Number(2.0)), Number(90.0)):
        yield Binary("-", zero, part), "other root", 1.7
        yield Binary("+", part, zero), "other root", 1.8
        yield Binary("-", part, zero), "other root", 1.8


def _with_factor(part: Node, around: Surroundings) -> Iterator[_Variant]:
    for node in (*around.single, *around.row):
        yield Binary("*", node, part), "factor missing", 2.1
        yield Binary("/", part, node), "factor missing", 2.2


def _with_term(part: Node, around: Surroundings) -> Iterator[_Variant]:
    squares = any(isinstance(term, Binary) and term.op == "^" for term in terms(part))
    for node in (*around.single, *around.row):
        term = Binary("^", node, Number(2.0)) if squares else node
        yield Binary("+", part, term), "term missing", 2.0
        yield Binary("-", part, term), "term missing", 2.0


# --- two changes -----------------------------------------------------------------------------------------------------


MOST_PAIRS = 5000
"""Pairs for one formula."""
LIGHT = 1.6
"""The heaviest change that is tried with another one."""
MOST_FIRST = 150
"""Changes after which a second one is tried."""

KIND = "two changes"


def pairs(formula: Node, around: Surroundings) -> list[Candidate]:
    """Two changes of a formula, each formula once, the lightest first; single ones are not among them.

    Of eight four-bars with two slips in one formula seven are mended with them, six without, in 13 s and in 11 s.

    A typed number or a term that is missing is not tried together with another change: there would be too many. Nor is an
    anchor: a cell held fast in a row where it happens to be 0 puts right whatever it is added to.
    """
    single = [one for one in candidates(formula, around) if one.weight <= LIGHT and one.kind != "anchor"]
    seen = {formula, *(one.formula for one in single)}
    found = heapq.nsmallest(MOST_PAIRS, _pairs(single, around, seen), key=lambda one: one.weight)
    return list({one.formula: one for one in reversed(found)}.values())[::-1]


def _pairs(single: list[Candidate], around: Surroundings, seen: set[Node]) -> Iterator[Candidate]:
    for first in single[:MOST_FIRST]:
        for second in candidates(first.formula, around):
            if second.weight > LIGHT:
                break
            if second.formula not in seen and second.kind != "anchor":
                yield Candidate(second.formula, KIND, first.weight + second.weight)
