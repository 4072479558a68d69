"""What the parts of the sheet of synthesis share: cells, formulas over names, headings."""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Symbol, with_symbols
from livesheet.formula.parser import parse_description
from livesheet.workbook import Chart, Content, Style
from mechsheet.kinematics.build_equations import counts_from_driven
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.model import Dimension, Synthesis
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.task_rows import MEANING, REMARK, ROUNDED, SYMBOL, USED, VALUE, Rows
from mechsheet.synthesis.kinds import kind_of

MODE = "mode"
"""The result that is an assembly."""


class Naming:
    """Results mean the mechanism's dimensions where it has them, else, or where asked for, their exact values.

    The assembly is always the one that the mechanism has: that of the loop, where the description takes no other from the
    task, be it sketched or typed.
    """

    def __init__(self, plan: Plan, task: Synthesis, exact: bool = False) -> None:
        self.symbols: Mapping[str, str] = {**task.names, **task.results, **({} if exact else task.used)}
        self.nodes: dict[str, Node] = {name: Symbol(symbol) for name, symbol in self.symbols.items()}
        if MODE in task.results and (mode := _mode(plan, task)) is not None:
            self.nodes[MODE] = mode

    def tree(self, text: str | Node) -> Node:
        """The tree of an expression in the description's notation."""
        tree = parse_description(text) if isinstance(text, str) else text
        return with_symbols(tree, self.nodes)


def _mode(plan: Plan, task: Synthesis) -> Node | None:
    """The mode of the mechanism's cell, counted as the task counts it; None where it has none."""
    groups = plan.equations.groups
    taken = [group for group in groups if group.mode in task.mode]
    of_loop = [groups[loop.group - 1] for loop in plan.found.four_bars]
    group = next(iter((*taken, *of_loop)), None)
    if group is None or not group.mode:
        return None
    mode = Symbol(group.mode)
    return mode if counts_from_driven(plan.mechanism, group.pins) else al.neg(mode)


LARGE = 1e6
"""A number from here on would not fit its cell with six decimals."""


class Page(Cells):
    """Collects the cells."""

    def __init__(self, plan: Plan, task: Synthesis, rows: Rows) -> None:
        super().__init__(plan, plan.at.titles["synthesis"])
        self.given, self.rows = task, rows
        self.kind = kind_of(task)
        self.naming, self.exact_naming = Naming(plan, task), Naming(plan, task, exact=True)
        self.dimensions: dict[str, Dimension] = {dim.symbol: dim for dim in plan.mechanism.dimensions}
        self.charts: list[Chart] = []
        self.nominal = dimension_values(plan.mechanism)

    def text(self, key: str, **parts: object) -> str:
        """A word of the sheet."""
        return self.plan.text(f"synthesis.{key}", **parts)

    def cell(self, symbol: str) -> Node:
        """A quantity as people read it."""
        return self.plan.at.cell(symbol, self.title, None)

    @property
    def used(self) -> dict[str, Node]:
        """Name of a result -> what the mechanism has for it, as people read it."""
        found = {name: self.cell(symbol) for name, symbol in self.given.used.items()}
        if MODE in self.given.results and self.naming.nodes[MODE] != Symbol(self.given.results[MODE]):
            found[MODE] = self.naming.nodes[MODE]
        return found

    def tree(self, text: str | Node, **cells: Node) -> Node:
        """An expression over names of the task, with some of its names standing for cells of this sheet."""
        return with_symbols(self.naming.tree(text), cells)

    def exactly(self, text: str | Node) -> Node:
        """The same expression of the results before they are rounded."""
        return self.exact_naming.tree(text)

    @property
    def rounds(self) -> bool:
        """Whether lengths are rounded before they are used."""
        return bool(self.given.rounding)

    @property
    def degrees(self) -> bool:
        """Whether angles are shown in degrees."""
        return self.plan.mechanism.angle_unit.in_degrees

    def shown(self, node: Node, kind: str) -> Node:
        """A value as people read it, #N/A where there is none."""
        return formula("IFERROR(value,NA())", value=Call("DEGREES", (node,)) if self.is_degrees(kind) else node)

    def read(self, cell: CellRef, kind: str) -> Node:
        """What such a cell holds, in internal units."""
        return Call("RADIANS", (cell,)) if self.is_degrees(kind) else cell

    def is_degrees(self, kind: str) -> bool:
        """Whether a quantity of that kind is shown in degrees."""
        return kind == "angle" and self.degrees

    def unit_text(self, kind: str) -> str:
        """The unit of a kind."""
        if kind == "length":
            return self.plan.mechanism.length_unit
        return self.plan.mechanism.angle_unit.text if kind == "angle" else ""

    def number_style(self, kind: str, style: Style) -> Style:
        """As many decimals as say something: four of a length or an angle in degrees, six of a ratio."""
        return styles.decimals(style, 4 if kind == "length" or self.is_degrees(kind) else 6)

    def dimension_style(self, dim: Dimension, style: Style) -> Style:
        """The same of a dimension; ±1 as it is; one that is large, as it is described, as a power of ten."""
        if dim.symbol in self.given.sides:
            return styles.decimals(style, 0)
        if dim.unit.kind == "number" and abs(self.nominal[dim.symbol]) >= LARGE:
            return styles.numbered(style, "0.00000E+00")
        return styles.decimals(style, 4 if dim.unit.kind == "length" or dim.unit.in_degrees else 6)

    def heading(self, block: str, last: int = MEANING, **columns: str) -> None:
        """The heading of a block across the columns, with what stands over single ones."""
        row = self.rows.heads[block]
        over = {VALUE: "value", ROUNDED: "rounded", USED: "used", MEANING: "meaning", REMARK: "remark"}
        for col in range(SYMBOL, last + 1):
            content = self.text(block) if col == SYMBOL else columns.get(over.get(col, "")) or None
            self.put(row, col, content, styles.SECTION)

    def across(self, row: int, first: int, last: int, content: Content, style: Style) -> None:
        """A text in cells shown as one."""
        self.put(row, first, content, style)
        self._rest(row, first, last, style)

    def formula_across(self, row: int, first: int, last: int, node: Node, style: Style) -> None:
        """A formula in cells shown as one."""
        self.formula(row, first, node, style)
        self._rest(row, first, last, style)

    def _rest(self, row: int, first: int, last: int, style: Style) -> None:
        for col in range(first + 1, last + 1):
            self.put(row, col, None, style)
        self.merge(row, first, last)
