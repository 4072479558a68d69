"""The sheet of Newton's method: a block of columns for each pass, in the rows of the positions; its start to the right.

All blocks but the last are folded. Where a group begins is a small table of its own, passes downwards from the start values.

The start values belong to the dimensions of the description, which stand in the first row. From there the dimensions go in
`LED` equal steps to those of the first sheet, a pass each; the passes that are left are made there. While the determinant
keeps its sign, the unknowns their trend and the residual its size the assembly is the described one; a row where they do
not says 1 in the last column.
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, Previous, RangeRef, Symbol, transform
from livesheet.workbook import Column, Fill, Sheet
from mechsheet.kinematics.equations import Group, System
from mechsheet.kinematics.newton.changed_dimensions import STEADY, trends
from mechsheet.kinematics.newton.system import FIRST_PASSES, LED, SETTLED
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.columns.added import begun, start_columns
from mechsheet.sheet.columns.lowering import in_pass
from mechsheet.sheet.plan import BLOCKS, Plan, TableColumn
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import FORMULA_ROW, GROUP_ROW, SYMBOL_ROW, decimals_of_unit
from mechsheet.sheet.table.rates import sheet_beside
from mechsheet.units import DEG


class StartTable(Cells):
    """Collects the cells of one group's table, and of its start values."""

    def __init__(self, plan: Plan, group: Group, system: System) -> None:
        super().__init__(plan, plan.at.titles["iterations"])
        self.group, self.system = group, system
        self.columns = start_columns(plan.equations, system)
        self.places = plan.places.starts[group.number]
        self.left = self.places.table.col
        self.first, self.row = plan.at.first, plan.at.first + system.row
        self.now = self._at({})
        names = (*self.columns.given, *(each.symbol for each in self.columns.way), *self.columns.passes)
        self.place = {name: self.left + index for index, name in enumerate(names, 1)}
        self.at = self._at({name: self._spot(name) for name in names})

    def _spot(self, symbol: str) -> Spot:
        """A column of the table; what is given stands there as it stands where it comes from."""
        degrees = symbol in self.columns.given and self.plan.at.spots[symbol].degrees
        return Spot(self.title, self.first, self.place[symbol], FIRST_PASSES + 1, degrees)

    def _at(self, own: dict[str, Spot]) -> Addresses:
        """All places, columns of other tables in the row at which the start values were found."""
        spots = {
            name: Spot(spot.sheet, self.row, spot.col, degrees=spot.degrees) if spot.column else spot
            for name, spot in self.plan.at.spots.items()
        }
        at = self.plan.at
        return Addresses(at.titles, at.first, at.last, spots | own)

    def write(self) -> None:
        """Its headings and all its columns, and the start values."""
        self._headings()
        self._way()
        self._passes()
        self._lost()
        self._starts()

    def _fill(self, row: int, col: int, node: Node, rows: int, number_format: str = "0.0000") -> None:
        bound = self.at.bind(node, self.title, row)
        self.fills.append(Fill(row, col, bound, styles.numbered(styles.INNER, number_format), rows=rows))

    def _headings(self) -> None:
        plan, columns = self.plan, self.columns
        last = self.left + columns.width - 1
        title = plan.text("iterations.start", group=self.group.number, led=LED, number=FIRST_PASSES - LED)
        self.put(GROUP_ROW, self.left, title, styles.SECTION)
        for col in range(self.left + 1, last + 1):
            self.put(GROUP_ROW, col, None, styles.SECTION)
        self.merge(GROUP_ROW, self.left, last)
        for symbol, col in self.place.items():
            degrees = symbol in columns.given and self.at.spots[symbol].degrees
            self.put(SYMBOL_ROW, col, rich(symbol, f" [{DEG.text}]" if degrees else ""), styles.HEAD)
        self.put(SYMBOL_ROW, self.left, plan.text("iterations.share"), styles.HEAD)
        self.put(SYMBOL_ROW, last, plan.text("iterations.lost"), styles.HEAD)
        for col in range(self.left, last + 1):
            self.put(FORMULA_ROW, col, None, styles.FORMULA_TEXT)

    def _way(self) -> None:
        """The share of the way, and what is given, from the described values to those that are there."""
        share = formula("MIN(1,(ROW()-ROW(top))/steps)", top=CellRef(self.first, self.left, True, True), steps=LED)
        self._fill(self.first, self.left, share, FIRST_PASSES + 1)
        described = dict(self.system.described)
        for symbol in self.columns.given:
            spot, col = self.at.spots[symbol], self.place[symbol]
            value = DEG.written(described[symbol]) if spot.degrees else described[symbol]
            self.put(self.first, col, value, styles.INPUT)
            begin = CellRef(self.first, col, True, True)
            node = formula("begin+share*(there-begin)", begin=begin, share=CellRef(self.first + 1, self.left, False, True),
                           there=self.now.cell(symbol, self.title, None))  # fmt: skip
            self._fill(self.first + 1, col, node, FIRST_PASSES)
        for each in self.columns.way:
            self._fill(self.first, self.place[each.symbol], begun(each), FIRST_PASSES + 1)

    def _passes(self) -> None:
        """From the start values of the assembly chosen; where no step can be made the unknowns stay."""
        plan, system, first = self.plan, self.system, self.first
        for index, (unknown, correction) in enumerate(zip(system.unknowns, system.corrections, strict=True)):
            col = self.places.values.col + 1 + index
            values = RangeRef(CellRef(first, col, True, True), CellRef(first + len(system.starts) - 1, col, True, True))
            chosen = formula("INDEX(values,mode)", values=values, mode=Symbol(system.mode))
            unit = plan.mechanism.shown(plan.equations.of(system.variables[index]).unit)
            if unit.in_degrees:  # as they are written
                chosen = formula("RADIANS(chosen)", chosen=chosen)
            self._fill(first, self.place[unknown], chosen, 1)
            step = formula("IFERROR(next,last)", next=al.sub(Symbol(unknown), correction), last=Symbol(unknown))
            self._fill(first + 1, self.place[unknown], _above(step, (*self.place,)), FIRST_PASSES)
        for part in system.body:
            style = styles.decimals(styles.INNER, decimals_of_unit(plan, part.unit))
            form = styles.DETERMINANT if part.symbol in plan.determinants else style.number_format
            self._fill(first, self.place[part.symbol], part.expression, FIRST_PASSES + 1, form)

    def _lost(self) -> None:
        """1 in a row to which the assembly cannot be kept: the determinant has another sign than at the beginning, or past
        one end of the assembly to another of the same sign an unknown leaps from its trend, or the residual rises."""
        plan, system = self.plan, self.system
        col = self.places.lost.col
        begin = CellRef(self.first, self.place[system.determinant], True, True)
        keeps = formula("IFERROR(IF(det*begin>0,0,1),1)", det=Symbol(system.determinant), begin=begin)
        self._fill(self.first, col, keeps, 2, "0")
        leaps = []
        for unknown, most in zip(
            system.unknowns, trends(plan.mechanism, plan.equations.equations, system), strict=True
        ):
            here, above, before = (CellRef(self.first + row, self.place[unknown], False, False) for row in (2, 1, 0))
            leaps.append(formula("ABS(here-2*above+before)/most", here=here, above=above, before=before, most=most))
        step = CellRef(self.first + 1, self.place[system.residual], True, True)
        leaps.append(formula("residual/MAX(most*step,least)", residual=Symbol(system.residual), most=STEADY, step=step,
                             least=SETTLED))  # fmt: skip
        node = formula("IFERROR(IF(AND(det*begin>0,leap<1),0,1),1)", det=Symbol(system.determinant), begin=begin,
                       leap=al.largest(leaps))  # fmt: skip
        self._fill(self.first + 2, col, node, FIRST_PASSES - 1, "0")

    def _starts(self) -> None:
        """The start values of each assembly: inputs."""
        plan, system = self.plan, self.system
        left = self.places.values.col
        self.put(SYMBOL_ROW, left, plan.text("iterations.starts"), styles.HEAD)
        self.put(FORMULA_ROW, left, None, styles.FORMULA_TEXT)
        units = [plan.mechanism.shown(plan.equations.of(variable).unit) for variable in system.variables]
        for index, (variable, unit) in enumerate(zip(system.variables, units, strict=True), 1):
            self.put(SYMBOL_ROW, left + index, rich(variable, f" [{unit.text}]"), styles.HEAD)
            self.put(FORMULA_ROW, left + index, None, styles.FORMULA_TEXT)
        for number, start in enumerate(system.starts):
            self.put(self.first + number, left, float(number + 1), styles.decimals(styles.INNER, 0))
            for index, (unit, value) in enumerate(zip(units, start, strict=True), 1):
                self.put(self.first + number, left + index, unit.written(value), styles.INPUT)


def assemblies_lost(plan: Plan) -> Node:
    """In how many rows of the start tables the assembly chosen could not be kept."""
    return al.total(formula("SUM(rows)", rows=starts.lost.whole()) for starts in plan.places.starts.values())


def _above(node: Node, names: tuple[str, ...]) -> Node:
    """The expression over what stands in the row above."""

    def change(part: Node) -> Node:
        return Previous(part.name) if isinstance(part, Symbol) and part.name in names else part

    return transform(node, change)


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
