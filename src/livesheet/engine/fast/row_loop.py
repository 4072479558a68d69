"""Columns that read each other row by row as a loop in generated Python: straight-line code of floats.

Lowering says what a row reads of rows above it as values that are kept from there.
What is the same in all rows is computed before the loop, what several formulas need once a row, what only one needs stands
in its expression. The code stops at the first row in which something is no plain number, with nothing written for it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import count
from struct import Struct
from typing import NamedTuple

from ...formula.book import Block
from ...formula.nodes import Binary, CellRef
from ..graph import area_read
from ..kernels.math import Arithmetic, rounded_one
from ..layout import Area, Layout
from .generated import HELPERS, Singles, TroubleError, roots
from .lowering import Effect, Functions, Lowering, UnsuitableError, Value
from .scalars import SINGLE, scalar, scalar_power, sign, snap, trunc

MOST_ABOVE = 16
"""Rows above a row that are kept: a recurrence reads one, a moving average a dozen."""


class RowBlock(NamedTuple):
    """Rows of one column that are computed: as many as the others', the formula as seen from the first of them."""

    producer: int
    sheet: int
    block: Block
    offset: int


class RowLowering(Lowering):
    """Columns in their order. `columns` says where what is read from other columns lies, `cells` single cells: all are to
    hold numbers. `above`: (column, how many rows above) whose values are kept."""

    def __init__(
        self, layout: Layout, sheets: dict[str, int], functions: Functions, blocks: Sequence[RowBlock], group: set[int]
    ) -> None:
        super().__init__(layout, sheets, functions, set())
        self.blocks = blocks
        self.columns: set[int] = set()
        self.cells: set[int] = set()
        self.above: set[tuple[int, int]] = set()
        self.kept: list[int] = []
        self._at = 0
        # Whatever else reads blocks of the set (ranges, say) is not for this loop.
        self.results = dict.fromkeys(group, -1)
        self._places: dict[tuple[int, int], list[int]] = {}
        for number, (_, sheet, block, _) in enumerate(blocks):
            self._places.setdefault((sheet, block.col), []).append(number)
        for number in range(len(blocks)):
            self._at = number
            self._keep(number)

    @property
    def block(self) -> Block:
        """The rows being lowered."""
        return self.blocks[self._at].block

    def _keep(self, number: int) -> None:
        formula = self.block.formula
        try:
            result = self.lower(formula)
        except RecursionError as problem:
            raise UnsuitableError from problem
        if isinstance(formula, Binary) and formula.op in "+-":
            result = self._snapped(result)
        if self.values[result].kind != "number":
            raise UnsuitableError
        self.kept.append(result)
        self.effect(Effect("keep", result, number))

    def _cell(self, node: CellRef) -> int:
        area = area_read(node, self.block, self.sheets)
        if area is None:
            raise UnsuitableError
        if area.rows > 1:
            return self._column(area)
        place = self.layout.place(area.sheet, area.row, area.col)
        if place < 0 or self._covering(area) is not None:
            raise UnsuitableError
        self.cells.add(place)
        return self.value("cell", (), place)

    def _covering(self, area: Area) -> int | None:
        """The column of the loop that computes the last cell of an area."""
        last = area.row + area.rows - 1
        for number in self._places.get((area.sheet, area.col), ()):
            block = self.blocks[number].block
            if block.row <= last < block.row + block.rows:
                return number
        return None

    def _column(self, area: Area) -> int:
        number = self._covering(area)
        if number is None:
            return self._elsewhere(area)
        above = self.blocks[number].block.row - area.row
        if above == 0:
            return self.kept[number]
        if not 0 < above <= MOST_ABOVE:
            raise UnsuitableError
        self.above.add((number, above))
        return self.value("above", (), (number, above), True)

    def _elsewhere(self, area: Area) -> int:
        """A column that is there before the loop starts."""
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None else column.band_at(area.row)
        if band is None or area.row + area.rows > band.row + band.rows:
            raise UnsuitableError
        place = band.offset + area.row - band.row
        self.columns.add(place)
        return self.value("column", (), place, True)


RowCode = Callable[..., int]

FAILURES = (TroubleError, ArithmeticError, ValueError)
"""What stops a row. numpy's FloatingPointError, ZeroDivisionError and OverflowError are of the second kind."""

_DEEPEST = 24
"""Operations inside one another in one expression: Python's parser takes some ninety."""

_TWICE = frozenset(("square", "minimum", "maximum", "snap", "sign", "trunc"))
"""Operations whose code names an operand more than once."""

_PASSING = frozenset(
    ("add", "subtract", "multiply", "square", "negative", "absolute", "where", "snap", "sqrt", "floor", "radians",
     "degrees", "sin", "cos", "tan", "arcsin", "arccos", "sinh", "cosh", "arcsinh", "log", "log10")
)  # fmt: skip
"""Operations that give nothing finite, or stop, when their first operand (of a sum or product, any) is not finite."""

_GROWING = frozenset(("add", "subtract", "multiply", "divide", "square", "degrees"))
"""Operations of floats that leave the finite numbers in silence."""

_OWN: dict[str, str] = {
    **SINGLE,
    "floor": "{0} // 1.0",
    "snap": "{0} if -(t := {0} * 281474976710656.0) < {1} < t or t < {1} < -t else snap({0}, {1})",
}
"""As `SINGLE`. A sum far above NEAR = 2^-48 of its left operand, as nearly all are, is known by two comparisons."""


def row_code(lowering: RowLowering, layout: Layout, arithmetic: Arithmetic) -> tuple[RowCode, str]:
    """`code(numbers, above, i, j, out)` and its source: computes rows [i, j) into the rows of `out`, until one stops it.

    `above` holds the values of `above_order(lowering)`. Returns how many rows it has computed.
    """
    emitter = _RowEmitter(lowering, layout, arithmetic)
    source = emitter.source()
    try:
        exec(compile(source, "<rows>", "exec"), emitter.namespace)
    except (SyntaxError, RecursionError, MemoryError) as problem:
        raise UnsuitableError from problem
    code: RowCode = emitter.namespace["run"]
    return code, source


def above_order(lowering: RowLowering) -> list[tuple[int, int]]:
    """(column, rows above) of all values that the loop keeps: also those between it and what is read."""
    most: dict[int, int] = {}
    for number, above in lowering.above:
        most[number] = max(above, most.get(number, 0))
    return [(number, above) for number in sorted(most) for above in range(1, most[number] + 1)]


class _RowEmitter(Singles):
    def __init__(self, lowering: RowLowering, layout: Layout, arithmetic: Arithmetic) -> None:
        super().__init__(lowering, layout, arithmetic)
        self.rows = lowering
        self.above = above_order(lowering)
        self.depth: dict[int, int] = {}
        self.unsafe = self._unsafe()
        self.checked = self._checked()
        self.local = self._local()
        struct = Struct(f"{len(lowering.kept)}d")
        self.namespace.update(
            pack=struct.pack_into, width=struct.size, FAILURES=FAILURES, snap=snap, sign=sign, trunc=trunc, count=count
        )

    # which values need a name, and which must be looked at

    def _unsafe(self) -> set[int]:
        """Values that may be no finite number without anybody being told."""
        found: set[int] = set()
        for number, value in enumerate(self.values):
            if value.along and (
                value.op in _GROWING or (value.op in _PASSING and any(arg in found for arg in value.args))
            ):
                found.add(number)
        return found

    @staticmethod
    def _passes(value: Value, place: int) -> bool:
        if value.op == "where":
            return place > 0
        return value.op in _PASSING and (place == 0 or value.op != "snap")

    def _checked(self) -> list[int]:
        """Values whose failure would not be seen in what is computed from them: the cells, and what is compared or divided
        by. Of a sum that is snapped the sum itself is as good."""
        found = {number for number in self.rows.kept if number in self.unsafe}
        for number in self.usage.needed:
            value = self.values[number]
            for place, arg in enumerate(value.args):
                if arg in self.unsafe and not (
                    self._passes(value, place) or (value.op == "divide" and place == 0) or value.op == "snap"
                ):
                    found.add(arg)
        for item in self.usage.items:
            if isinstance(item, Effect) and item.what == "somewhere":
                found.update(number for number in roots(item) if number in self.unsafe)
        return sorted(found)

    def _local(self) -> set[int]:
        found = {*self.checked, *self.rows.kept}
        for number in self.usage.needed:
            value = self.values[number]
            if self.usage.uses[number] > 1:
                found.add(number)
            if value.op in _TWICE:
                found.update(value.args)
        for item in self.usage.items:
            if isinstance(item, Effect) and item.what == "somewhere":
                found.update(roots(item))
        return found

    # code

    def source(self) -> str:
        """The whole function."""
        singles = [item for item in self.usage.items if not self._is_in_rows(item)]
        for item in singles:
            if isinstance(item, Effect):
                self._effect(item, "    ")
            else:
                self.define(item)
        self.check_singles()
        inputs = [number for number in sorted(self.usage.needed) if self.values[number].op in ("column", "count")]
        for number in inputs:
            self.names[number] = f"c{number}"
        for number in sorted(self.usage.needed):
            data = self.values[number].data
            if self.values[number].op == "above" and isinstance(data, tuple):
                self.names[number] = f"p{data[0]}_{data[1]}"
        before = self.lines
        self.lines = []
        for item in self.usage.items:
            if isinstance(item, Effect) and self._is_in_rows(item):
                self._effect(item, "            ")
            elif not isinstance(item, Effect) and self._is_in_rows(item) and item not in self.names:
                self._define_in_row(item)
        head = ["def run(numbers, above, i, j, out):", "    item = numbers.item", "    done = 0"]
        if self.above:
            head.append(f"    {', '.join(f'p{n}_{above}' for n, above in self.above)}, = above")
        names = ", ".join(["k", *(self.names[number] for number in inputs)])
        lists = ", ".join(["range(0, (j - i) * width, width)", *map(self._input, inputs)])
        loop = f"        for {names} in {f'zip({lists})' if inputs else lists}:"
        tail = ["    except FAILURES:", "        pass", "    return done"]
        first = ["    try:", *(f"    {line}" for line in before)]
        return "\n".join([*head, *first, loop, *self.lines, *self._ends(), *tail]) + "\n"

    def _is_in_rows(self, item: int | Effect) -> bool:
        if isinstance(item, Effect):
            return item.what == "keep" or any(self.values[number].along for number in roots(item))
        return self.values[item].along

    def _input(self, number: int) -> str:
        value = self.values[number]
        if value.op == "count":
            return f"count({value.data}.0 + i)"
        return f"numbers[{value.data} + i:{value.data} + j].tolist()"

    def _ends(self) -> list[str]:
        """The end of a row: everything looked at, written, and kept for the rows below."""
        names = [self.names[number] for number in self.checked]
        lines = []
        for start in range(0, len(names), 64):
            lines.append(f"t = {' + '.join(names[start : start + 64])}")
            lines.append("if t - t != 0.0: break")
        kept = [self.names[number] for number in self.rows.kept]
        lines.append(f"pack(out, k, {', '.join(kept)})")
        lines.append("done += 1")
        moved = [(f"p{n}_{above}", kept[n] if above == 1 else f"p{n}_{above - 1}") for n, above in reversed(self.above)]
        if moved and any(name.startswith("p") for name in kept):  # a cell that shows one of them: all at once
            lines.append(f"{', '.join(name for name, _ in moved)}, = {', '.join(value for _, value in moved)},")
        else:
            lines += [f"{name} = {value}" for name, value in moved]
        return [f"            {line}" for line in lines]

    def _define_in_row(self, number: int) -> None:
        value = self.values[number]
        args = [self.names[arg] for arg in value.args]
        depth = 1 + max((self.depth.get(arg, 0) for arg in value.args), default=0)
        text = self._text(value, args)
        if number in self.local or depth > _DEEPEST:
            name = f"v{number}"
            self.lines.append(f"            {name} = {text}")
            self.names[number], self.depth[number] = name, 0
        else:
            self.names[number], self.depth[number] = f"({text})", depth

    def _text(self, value: Value, args: list[str]) -> str:
        op = value.op
        if op in _OWN:
            return _OWN[op].format(*args)
        if op in ("sign", "trunc"):
            return f"{op}({args[0]})"
        if op == "rounded":
            return f"{self._rounded(value.data)}({args[0]})"
        if op == "pick":
            self.namespace[op] = HELPERS[op]
            return f"{op}({', '.join(args)})"
        if op == "power":
            name = f"power{value.args[1]}"
            self.namespace[name] = scalar_power(float(str(self.values[value.args[1]].data)), self.arithmetic)
            return f"{name}({args[0]})"
        self.namespace[op] = scalar(op, self.arithmetic)
        return f"{op}({', '.join(args)})"

    def _rounded(self, data: object) -> str:
        digits = math.trunc(float(str(data)))
        if not 1 <= abs(digits) <= 307:
            raise UnsuitableError
        name = f"rounded{'_' if digits < 0 else ''}{abs(digits)}"
        self.namespace[name] = lambda number: rounded_one(number, digits)
        return name

    def _effect(self, effect: Effect, indent: str) -> None:
        if effect.what == "keep":
            return
        name = self.names[effect.value]
        if effect.what == "somewhere" and isinstance(effect.data, int):
            self.lines.append(f"{indent}if {name} == 0 == {self.names[effect.data]}: raise TroubleError")
        else:
            self.lines.append(f"{indent}if {'' if effect.what == 'never' else 'not '}{name}: raise TroubleError")
