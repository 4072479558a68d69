"""Which blocks read which, and in what order they can be computed."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from ..formula.book import Block
from ..formula.nodes import Binary, Call, CellRef, FunctionRef, Node, RangeRef, Text, children, walk
from .layout import Area, Layout

Functions = Mapping[FunctionRef, Node]
_NONE: Functions = {}
_CELLS = (CellRef, RangeRef)

_UNREAD = frozenset(
    ("ROW", "COLUMN", "ROWS", "COLUMNS", "AREAS", "ISREF", "ISFORMULA", "FORMULATEXT", "SHEET", "SHEETS", "OFFSET")
)
"""Functions that take a reference in their first argument without looking at its values."""
ANYWHERE = frozenset(("OFFSET", "INDIRECT"))
"""Functions whose reference is known only when they are computed."""


def references(node: Node, functions: Functions = _NONE) -> Iterator[CellRef | RangeRef]:
    """Every reference whose values a tree reads, a range as one, in reading order; with those of the functions it calls."""
    stack = [node]
    seen: set[FunctionRef] = set()
    while stack:
        part = stack.pop()
        if isinstance(part, _CELLS):
            yield part
        elif isinstance(part, FunctionRef):
            if part in functions and part not in seen:
                seen.add(part)
                stack.append(functions[part])
        else:
            below = children(part)
            if isinstance(part, Call) and part.name == "CELL" and _is_about_place(part):
                continue
            if isinstance(part, Call) and part.name in _UNREAD and below and isinstance(below[0], CellRef | RangeRef):
                below = below[1:]
            stack.extend(reversed(below))


def _is_about_place(call: Call) -> bool:
    """Whether CELL asks where a cell is, not what it holds."""
    return isinstance(call.args[0], Text) and call.args[0].value.strip().lower() in ("address", "row", "col")


def reads_anywhere(node: Node, functions: Functions = _NONE) -> bool:
    """Whether what a tree reads is known only when it is computed: OFFSET, INDIRECT, `A1:INDEX(...)`."""
    waiting, seen = [node], set[FunctionRef]()
    while waiting:
        for part in walk(waiting.pop()):
            if isinstance(part, Call) and part.name in ANYWHERE:
                return True
            if isinstance(part, Binary) and part.op == ":" and not _part_of_a_range(part):
                return True
            if isinstance(part, FunctionRef) and part in functions and part not in seen:
                seen.add(part)
                waiting.append(functions[part])
    return False


def _part_of_a_range(part: Binary) -> bool:
    """`INDEX(range, i):INDEX(range, j)`: whatever i and j are, it reads no cells but those of the range."""
    sides = (part.left, part.right)
    ranges = [side.args[0] for side in sides if isinstance(side, Call) and side.name == "INDEX" and side.args]
    return len(ranges) == 2 and isinstance(ranges[0], RangeRef) and ranges[0] == ranges[1]


def seen_from(block: Block) -> Block:
    """The cells that a block's references are seen from: of an array formula only the first one."""
    return block if block.kind == "fill" else Block(block.row, block.col, 1, 1, block.formula, block.kind)


def area_read(reference: CellRef | RangeRef, block: Block, sheets: dict[str, int]) -> Area | None:
    """All cells that a reference means anywhere in a block, None where it means none."""
    if isinstance(reference, CellRef):  # most references are
        if reference.sheet is None or reference.row < 0 or reference.col < 0:
            return None
        rows_down = 1 if reference.row_abs else block.rows
        cols_right = 1 if reference.col_abs else block.cols
        return Area(sheets[reference.sheet], reference.row, reference.col, rows_down, cols_right)
    corners = (reference.start, reference.end)
    rows: list[int] = []
    cols: list[int] = []
    for ref in corners:
        if not isinstance(ref, CellRef):
            return None
        rows += (ref.row, ref.row if ref.row_abs else ref.row + block.rows - 1)
        cols += (ref.col, ref.col if ref.col_abs else ref.col + block.cols - 1)
    first = corners[0]
    if not isinstance(first, CellRef) or first.sheet is None or min(rows) < 0 or min(cols) < 0:
        return None
    return Area(sheets[first.sheet], min(rows), min(cols), max(rows) - min(rows) + 1, max(cols) - min(cols) + 1)


def producers_read(layout: Layout, number: int, formula: Node, functions: Functions) -> set[int]:
    """The producers that a block reads (`Layout.producers`), itself among them when it reads its own cells."""
    return set[int]().union(*map(layout.producers, _areas_read(layout, number, formula, functions)))


def reads_area(layout: Layout, number: int, formula: Node, functions: Functions, area: Area) -> bool:
    """Whether a block reads any cell of an area."""
    return any(area.overlaps(read) for read in _areas_read(layout, number, formula, functions))


def _areas_read(layout: Layout, number: int, formula: Node, functions: Functions) -> Iterator[Area]:
    block = seen_from(layout.blocks[number])
    areas = (area_read(reference, block, layout.sheets) for reference in references(formula, functions))
    return (area for area in areas if area is not None)


def dependents(blocks: Iterable[int], reads: Sequence[set[int]]) -> set[int]:
    """The blocks themselves, and all that depend on them, at any remove."""
    readers: dict[int, list[int]] = {}
    for number, read in enumerate(reads):
        for producer in read:
            readers.setdefault(producer, []).append(number)
    found: set[int] = set()
    waiting = list(blocks)
    while waiting:
        number = waiting.pop()
        if number not in found:
            found.add(number)
            waiting += readers.get(number, ())
    return found


def ordered(reads: Sequence[set[int]], blocks: Collection[int]) -> list[list[int]]:
    """Some blocks in an order in which everything read comes first; blocks that read each other stand together.

    reads  by block the numbers of what it reads: other blocks, which come before all of these, and constants

    Strongly connected components (Tarjan, 1972), which graphlib does not give: it stops at the first circle.
    """
    count = len(reads)
    index = [-1] * count
    low = [0] * count
    on_stack = [False] * count
    stack: list[int] = []
    groups: list[list[int]] = []
    clock = 0
    for root in sorted(blocks):
        if index[root] >= 0:
            continue
        work = [(root, iter(sorted(n for n in reads[root] if n in blocks)))]
        index[root] = low[root] = clock
        clock += 1
        stack.append(root)
        on_stack[root] = True
        while work:
            node, below = work[-1]
            following = next(below, None)
            if following is None:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    group: list[int] = []
                    while not group or group[-1] != node:
                        group.append(stack.pop())
                        on_stack[group[-1]] = False
                    groups.append(sorted(group))
            elif index[following] < 0:
                index[following] = low[following] = clock
                clock += 1
                stack.append(following)
                on_stack[following] = True
                work.append((following, iter(sorted(n for n in reads[following] if n in blocks))))
            elif on_stack[following]:
                low[node] = min(low[node], index[following])
    return groups
