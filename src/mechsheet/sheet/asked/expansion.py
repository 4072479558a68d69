"""One formula from many: a quantity written out in dimensions, modes, the driver and one dimension that varies.

A table has no columns for intermediate symbols, so each is replaced by its equation, over and over, until only cells are
left. An equation that reads the row above (the turns that an angle has gone through) is taken as in the first row of a
sweep: every cell of a table is a sweep of its own. Where a formula would grow longer than wanted, the symbols that make it
long get cells of their own: the helpers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, children, symbols, transform, walk
from livesheet.formula.printer import extra_characters, longest_spelling, print_formula
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.model import Mechanism
from mechsheet.sheet.columns.lowering import Assignments

LIMITS = (250, 1_000, 7_500)
"""Characters of one formula in the language where it has most: what can be read, or more where there is no room for so many
helpers. Excel takes 8,192 of the text as its user reads it."""

DEEPEST = 60
"""Levels of one formula, below the 64 that a spreadsheet takes."""


SHORT = 30
"""A formula of so many characters is no shorter as a reference to a helper."""

MANY = 4
"""Arguments from which on a largest or smallest of many has two halves."""


@dataclass(frozen=True, slots=True)
class Expansion:
    """Bound formulas, as the top-left cell of each block has them.

    formula  of the quantity asked for
    helpers  (symbol, formula) of each block of helper cells, in the order in which they are computed
    """

    formula: Node
    helpers: tuple[tuple[str, Node], ...]


def definitions(mechanism: Mechanism, equations: Assignments) -> dict[str, Node]:
    """What every symbol that is not given equals in the first row of a sweep, in order of solution."""
    given = {dim.symbol: dim.value for dim in mechanism.dimensions if not isinstance(dim.value, float)}
    found = {symbol: given[symbol] for symbol in dimension_order(mechanism) if symbol in given}
    for equation in equations.all:
        found[equation.symbol] = equation.expression if equation.first is None else equation.first
    return found


def varying(rules: Mapping[str, Node], free: Iterable[str]) -> set[str]:
    """The symbols whose value depends on those in `free`, and these themselves."""
    found = set(free)
    for symbol, rule in rules.items():
        if not found.isdisjoint(symbols(rule)):
            found.add(symbol)
    return found


def expand(
    wanted: str,
    rules: Mapping[str, Node],
    bound: Callable[[str], Node],
    helper: Callable[[int], Node],
    apart: Sequence[str] = (),
    limit: int = LIMITS[-1],
) -> Expansion:
    """The formula of the symbol `wanted`.

    rules   what a symbol equals, in order of solution; a symbol without a rule is a leaf
    bound   the cell (or name) of a leaf
    helper  the cell of the n-th block of helpers, as the top-left cell of any block reads it
    apart   symbols that get the first blocks of helpers, in this order, however short they are
    limit   characters of a formula
    """
    work = _Work(rules, bound, helper, apart, limit)
    used = needed(wanted, rules)
    for symbol, rule in rules.items():
        if symbol in used:
            work.expand(symbol, rule)
    return Expansion(work.form(wanted), tuple(work.helpers))


def needed(wanted: str, rules: Mapping[str, Node]) -> set[str]:
    """The symbols that a quantity depends on by the rules, and itself."""
    stack, found = [wanted], {wanted}
    while stack:
        rule = rules.get(stack.pop())
        fresh = [] if rule is None else [name for name in symbols(rule) if name not in found]
        found.update(fresh)
        stack += fresh
    return found


class _Work:
    """The forms found so far, with their length and depth."""

    def __init__(
        self,
        rules: Mapping[str, Node],
        bound: Callable[[str], Node],
        helper: Callable[[int], Node],
        apart: Sequence[str],
        limit: int,
    ) -> None:
        self.limit = limit
        self.rules = rules
        self.bound = bound
        self.helper = helper
        self.forms: dict[str, Node] = {}
        self.lengths: dict[str, int] = {}
        self.depths: dict[str, int] = {}
        self.apart = {symbol: index for index, symbol in enumerate(apart)}
        self.helpers: list[tuple[str, Node]] = [(symbol, Symbol(symbol)) for symbol in apart]

    def form(self, symbol: str) -> Node:
        """The formula of a symbol; a leaf's is its cell."""
        if symbol not in self.forms:
            self._set(symbol, self.bound(symbol))
        return self.forms[symbol]

    def _set(self, symbol: str, form: Node) -> None:
        self.forms[symbol] = form
        self.lengths[symbol] = longest_spelling(form)
        self.depths[symbol] = depth(form)

    def expand(self, symbol: str, rule: Node) -> None:
        """Write a symbol out; what makes it too long becomes a block of helpers first."""
        uses = Counter(part.name for part in walk(rule) if isinstance(part, Symbol))
        for name in uses:
            self.form(name)
        plain = len(print_formula(rule, "text")) + extra_characters(rule)
        while self._too_long(rule, uses, plain):
            movable = [name for name in uses if name in self.rules and self.lengths[name] > SHORT]
            if not movable:
                rule = self._in_halves(symbol, rule)
                break
            self._move_out(max(movable, key=lambda name: uses[name] * self.lengths[name]))
        self._set(symbol, substituted(rule, self.forms))
        if symbol in self.apart:
            index = self.apart[symbol]
            self.helpers[index] = (symbol, self.forms[symbol])
            self._set(symbol, self.helper(index))

    def _too_long(self, rule: Node, uses: Counter[str], plain: int) -> bool:
        length = plain + sum(count * (self.lengths[name] + 2 - len(name)) for name, count in uses.items())
        return length > self.limit or depth(rule) + max((self.depths[name] for name in uses), default=0) > DEEPEST

    def _in_halves(self, symbol: str, rule: Node) -> Node:
        """The rule with the first half of what it takes the largest or smallest of in helpers of its own."""
        many = [part for part in walk(rule) if isinstance(part, Call) and part.name in ("MAX", "MIN")]
        longest = max(many, key=lambda call: len(call.args), default=None)
        if longest is None or len(longest.args) < MANY:
            return rule
        middle = len(longest.args) // 2
        half = Symbol(f"{symbol} half")
        self._set(half.name, self.helper(len(self.helpers)))
        self.helpers.append((symbol, substituted(Call(longest.name, longest.args[:middle]), self.forms)))
        shorter = Call(longest.name, (half, *longest.args[middle:]))
        return transform(rule, lambda part: shorter if part == longest else part)

    def _move_out(self, symbol: str) -> None:
        cell = self.helper(len(self.helpers))
        self.helpers.append((symbol, self.forms[symbol]))
        self._set(symbol, cell)


def substituted(rule: Node, forms: Mapping[str, Node]) -> Node:
    """The rule with its symbols replaced and tidied: what a form of 0 or 1 makes needless is left out."""

    def change(part: Node) -> Node:
        match part:
            case Symbol(name):
                return forms[name]
            case Binary("^", Call("SQRT", (square,)), Number(2.0)):
                return square
            case Binary("/", _, _):
                return part
        return al.tidied(part)

    return transform(rule, change)


def depth(node: Node) -> int:
    """Levels of a tree."""
    deepest, stack = 0, [(node, 1)]
    while stack:
        part, level = stack.pop()
        deepest = max(deepest, level)
        stack += [(child, level + 1) for child in children(part)]
    return deepest
