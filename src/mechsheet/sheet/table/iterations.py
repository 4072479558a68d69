"""The sheet of Newton's method: a block of columns for each pass, in the rows of the positions; its start to the right.

All blocks but the last are folded. The start is a small table of its own: passes downwards from start values.
"""

from __future__ import annotations

from dataclasses import replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, Previous, RangeRef, Symbol, transform
from mechsheet.kinematics.equations import Group, System
from mechsheet.kinematics.newton.system import FIRST_PASSES, SETTLED
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.plan import BLOCKS, Plan, TableColumn
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.lowering import in_pass
from mechsheet.sheet.table.positions import FORMULA_ROW, GROUP_ROW, SYMBOL_ROW
from mechsheet.sheet.table.rates import sheet_beside
from mechsheet.sheet.workbook import Area, Cell, Column, Content, Fill, Merge, Sheet, Style

NUMBER_WIDTH = 11.0


def iterations_sheet(plan: Plan) -> Sheet:
    """The sheet."""
    sheet = sheet_beside(
        plan, "iterations", plan.iterations, Symbol("#status"), "9CA3AF", lambda number: _block_title(plan, number)
    )
    writer = _Writer(plan)
    for group in plan.equations.groups:
        if group.system is not None:
            writer.needed(group, group.system)
            writer.start(group, group.system)
            writer.starts(group, group.system)
    folded = {column.col: column.group != _last_of(plan, column) for column in plan.iterations}
    columns = [
        replace(column, level=1, hidden=True) if folded.get(column.first) else replace(column, level=0)
        for column in sheet.columns
    ]
    cols = [cell.col for cell in writer.cells] + [fill.col for fill in writer.fills]
    first = plan.iterations[-1].col + 1
    for index, column in enumerate(columns[1:], 1):
        if columns[index - 1].hidden and not column.hidden:
            columns[index] = replace(column, collapsed=True)
    return replace(
        sheet,
        cells=(*sheet.cells, *writer.cells),
        fills=(*sheet.fills, *writer.fills),
        columns=(*columns, Column(first, max(cols), NUMBER_WIDTH)),
        merges=(*sheet.merges, *writer.merges),
        comments=(),
    )


def _last_of(plan: Plan, column: TableColumn) -> int:
    return max(each.group for each in plan.iterations if each.group // BLOCKS == column.group // BLOCKS)


def _block_title(plan: Plan, number: int) -> str:
    """What stands over a block: the number of its pass."""
    group, block = divmod(number, BLOCKS)
    system = plan.equations.groups[group - 1].system
    passes = system.passes if system else 0
    if block > passes:
        return plan.text("iterations.arrived", group=group, number=passes)
    return plan.text("iterations.pass", group=group, number=block)


class _Writer:
    """Collects what stands beside the blocks."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.title = plan.at.titles["iterations"]
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.merges: list[Merge] = []

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def needed(self, group: Group, system: System) -> None:
        """How many passes each row took until its residual was nothing but rounding."""
        plan = self.plan
        col = plan.at.spots[f"#needed_{group.number}"].col
        self.put(SYMBOL_ROW, col, plan.text("iterations.needed"), styles.HEAD)
        self.put(FORMULA_ROW, col, None, styles.FORMULA_TEXT)
        residuals = [Symbol(in_pass(system.residual, number)) for number in range(1, system.passes + 1)]
        count: Node = al.ZERO
        for residual in (*residuals, Symbol(system.residual)):
            count = al.add(count, formula("(residual>settled)", residual=residual, settled=SETTLED))
        node = formula("IF(ISNUMBER(there),count,NA())", there=Symbol(system.variables[0]), count=count)
        bound = plan.at.bind(node, self.title, plan.at.first)
        self.fills.append(Fill(plan.at.first, col, bound, styles.decimals(styles.INNER, 0), rows=plan.rows))

    def start(self, group: Group, system: System) -> None:
        """Passes downwards from the start values of the assembly chosen, in the row at which these were found."""
        plan, first = self.plan, self.plan.at.first
        left = plan.at.spots[f"#start_{group.number}"].col
        symbols = (*system.unknowns, *(each.symbol for each in system.body))
        own = {symbol: Spot(self.title, first, left + index, column=True) for index, symbol in enumerate(symbols)}
        row = first + system.row
        given = {
            name: replace(plan.at.spots[name], row=row, column=False)
            for name in system.given
            if plan.at.spots[name].column
        }
        at = replace(plan.at, spots=plan.at.spots | own | given)
        title = plan.text("iterations.start", group=group.number, number=FIRST_PASSES)
        self.put(GROUP_ROW, left, title, styles.SECTION)
        for col in range(left + 1, left + len(symbols)):
            self.put(GROUP_ROW, col, None, styles.SECTION)
        self.merges.append(Merge(Area(GROUP_ROW, left, GROUP_ROW, left + len(symbols) - 1)))
        for index, symbol in enumerate(symbols):
            self.put(SYMBOL_ROW, left + index, rich(symbol), styles.HEAD)
            self.put(FORMULA_ROW, left + index, None, styles.FORMULA_TEXT)
        starts = plan.at.spots[f"#starts_{group.number}"]
        for index, (unknown, correction) in enumerate(zip(system.unknowns, system.corrections, strict=True)):
            col = left + index
            values = RangeRef(
                CellRef(first, starts.col + 1 + index, True, True),
                CellRef(first + len(system.starts) - 1, starts.col + 1 + index, True, True),
            )
            chosen = formula("INDEX(values,mode)", values=values, mode=Symbol(system.mode))
            if plan.mechanism.shown(
                plan.equations.of(system.variables[index]).unit
            ).in_degrees:  # as `starts` writes it
                chosen = formula("RADIANS(chosen)", chosen=chosen)
            self._fill(at, first, col, chosen, 1)
            self._fill(at, first + 1, col, _above(al.sub(Symbol(unknown), correction), symbols), FIRST_PASSES)
        for index, part in enumerate(system.body, len(system.unknowns)):
            self._fill(at, first, left + index, part.expression, FIRST_PASSES + 1)

    def _fill(self, at: Addresses, row: int, col: int, node: Node, rows: int) -> None:
        self.fills.append(Fill(row, col, at.bind(node, self.title, row), styles.decimals(styles.INNER, 4), rows=rows))

    def starts(self, group: Group, system: System) -> None:
        """The start values of each assembly: inputs."""
        plan, first = self.plan, self.plan.at.first
        left = plan.at.spots[f"#starts_{group.number}"].col
        self.put(SYMBOL_ROW, left, plan.text("iterations.starts"), styles.HEAD)
        self.put(FORMULA_ROW, left, None, styles.FORMULA_TEXT)
        for index, variable in enumerate(system.variables, 1):
            unit = plan.mechanism.shown(plan.equations.of(variable).unit)
            self.put(SYMBOL_ROW, left + index, rich(variable, f" [{unit.text}]"), styles.HEAD)
            self.put(FORMULA_ROW, left + index, None, styles.FORMULA_TEXT)
        for number, start in enumerate(system.starts):
            self.put(first + number, left, float(number + 1), styles.decimals(styles.INNER, 0))
            for index, (variable, value) in enumerate(zip(system.variables, start, strict=True), 1):
                unit = plan.mechanism.shown(plan.equations.of(variable).unit)
                self.put(first + number, left + index, unit.written(value), styles.INPUT)


def _above(node: Node, symbols: tuple[str, ...]) -> Node:
    """The expression over what stands in the row above."""

    def change(part: Node) -> Node:
        return Previous(part.name) if isinstance(part, Symbol) and part.name in symbols else part

    return transform(node, change)
