"""Which blocks read which, and in what order they can be computed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..formula.book import Block
from ..formula.nodes import CellRef, Node, RangeRef, children
from .layout import Area, Layout


def references(node: Node) -> Iterator[CellRef | RangeRef]:
    """Every reference of a tree, a range as one, in reading order."""
    stack = [node]
    while stack:
        part = stack.pop()
        if isinstance(part, CellRef | RangeRef):
            yield part
        else:
            stack.extend(reversed(children(part)))


def area_read(reference: CellRef | RangeRef, block: Block, sheets: dict[str, int]) -> Area | None:
    """All cells that a reference means anywhere in a block, None where it means none."""
    corners = (reference.start, reference.end) if isinstance(reference, RangeRef) else (reference,)
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


def dependencies(layout: Layout, formulas: Sequence[Node]) -> list[set[int]]:
    """For every block the producers that it reads (`Layout.producers`), itself among them when it reads its own cells."""
    sheets = {title: index for index, title in enumerate(layout.titles)}
    found: list[set[int]] = []
    for block, formula in zip(layout.blocks, formulas, strict=True):
        reads: set[int] = set()
        for reference in references(formula):
            area = area_read(reference, block, sheets)
            if area is not None:
                reads |= layout.producers(area)
        found.append(reads)
    return found


def ordered(reads: Sequence[set[int]]) -> list[list[int]]:
    """Blocks in an order in which everything read comes first; blocks that read each other stand together (Tarjan, 1972)."""
    count = len(reads)
    index = [-1] * count
    low = [0] * count
    on_stack = [False] * count
    stack: list[int] = []
    groups: list[list[int]] = []
    clock = 0
    for root in range(count):
        if index[root] >= 0:
            continue
        work = [(root, iter(sorted(n for n in reads[root] if n < count)))]
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
                work.append((following, iter(sorted(n for n in reads[following] if n < count))))
            elif on_stack[following]:
                low[node] = min(low[node], index[following])
    return groups
