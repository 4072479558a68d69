"""The sheet of Newton's method: a block of columns for each pass, in the rows of the positions; its start to the right.

All blocks but the last are folded. The start is a small table of its own (`start_table`).
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.workbook import Column, Fill, Sheet
from mechsheet.kinematics.equations import Group, System
from mechsheet.kinematics.newton.system import SETTLED
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.columns.lowering import in_pass
from mechsheet.sheet.plan import BLOCKS, Plan, TableColumn
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.positions import FORMULA_ROW, SYMBOL_ROW
from mechsheet.sheet.table.rates import sheet_beside
from mechsheet.sheet.table.start_table import StartTable

NUMBER_WIDTH = 11.0


def iterations_sheet(plan: Plan) -> Sheet:
    """The sheet."""
    said = plan.places.status.in_row(plan.at.first)
    sheet = sheet_beside(plan, "iterations", plan.iterations, said, "9CA3AF", lambda number: _block_title(plan, number))
    writer = _Writer(plan, sheet.title)
    for group in plan.equations.groups:
        if group.system is not None:
            writer.needed(group, group.system)
            writer.start(StartTable(plan, group, group.system))
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


class _Writer(Cells):
    """Collects what stands beside the blocks."""

    def start(self, table: StartTable) -> None:
        """Where a group begins."""
        table.write()
        self.cells += table.cells
        self.fills += table.fills
        self.merges += table.merges

    def needed(self, group: Group, system: System) -> None:
        """How many passes each row took until its residual was nothing but rounding."""
        plan = self.plan
        col = plan.places.starts[group.number].needed.col
        self.put(SYMBOL_ROW, col, plan.text("iterations.needed"), styles.HEAD)
        self.put(FORMULA_ROW, col, None, styles.FORMULA_TEXT)
        residuals = [Symbol(in_pass(system.residual, number)) for number in range(1, system.passes + 1)]
        count: Node = al.ZERO
        for residual in (*residuals, Symbol(system.residual)):
            count = al.add(count, formula("(residual>settled)", residual=residual, settled=SETTLED))
        node = formula("IF(ISNUMBER(there),count,NA())", there=Symbol(system.variables[0]), count=count)
        bound = plan.at.bind(node, self.title, plan.at.first)
        self.fills.append(Fill(plan.at.first, col, bound, styles.decimals(styles.INNER, 0), rows=plan.rows))
