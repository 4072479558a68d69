"""What the first sheet says of the mechanism, live: a block of lines, a line under the title, and marks.

Every line is a finding and has a named cell. All is said of the motion between the first and the last value of the driver
as they stand there, rows that exist only; whether these make a whole turn is asked of the cells.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, RangeRef, Text, transform
from livesheet.workbook import Area, Conditional, Merge
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells, height_of
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.deleted import missing_words
from mechsheet.sheet.findings.finding import LEVELS, MARKS, Finding, Line
from mechsheet.sheet.findings.listing import findings_of, title_levels, title_words, words_where_well
from mechsheet.sheet.findings.other_sheets import left_words
from mechsheet.sheet.findings.reading import Reading, SheetReading
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import LEGEND_ROW, MEANING, SYMBOL, TOLERANCE, UNIT, VALUE, VERDICT_ROW
from mechsheet.sheet.quoted import formula, joined

BESIDE = replace(styles.UNIT, name="", align="right")
"""What stands beside a number, and is no place in the motion."""

WELL_LINES = 4
"""What the line under the title says where nothing is wrong, two lines there, takes so many in the column of words."""


def write_verdicts(writer: Writer, checks: Checks, extremes: Extremes) -> None:
    """Fill the block and the line under the title in."""
    plan = writer.plan
    on, findings = SheetReading(plan, checks, extremes), findings_of(plan.mechanism, plan.found)
    writer.heading("verdicts", plan.text("head.at"))
    lines = {on.rows[finding.key]: _while_it_can_be_said(on, finding) for finding in findings}
    for row, line in lines.items():
        _write(writer, on, row, line)
    writer.needs |= {on.rows[finding.key]: {*finding.needs} for finding in findings}
    well = there(plan.places.well)
    writer.formula(well.row, MEANING, words_where_well(on, findings), styles.LABEL_LINES)
    writer.heights[well.row] = height_of(WELL_LINES)
    writer.formula(there(plan.places.left).row, MEANING, left_words(on, findings), styles.LABEL_SAID)
    _write_marks(writer, lines)
    write_title_line(writer, on, title_words(on, findings, well.cell), lines.values(), MEANING)


def write_title_line(cells: Cells, on: Reading, words: Node, lines: Iterable[Line], last: int) -> None:
    """The line under the title, as far as a column."""
    cells.formula(VERDICT_ROW, SYMBOL, words, styles.LINE)
    area = Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, last)
    cells.merges.append(Merge(area))
    for level in title_levels(on, lines):
        cells.colour(area, level.test, LEVELS[level.kind])


def write_value(cells: Cells, row: int, line: Line, words: Area) -> None:
    """The value of a finding's line, its unit where a formula says it, and the colours of its words."""
    if not isinstance(line.unit, str):
        cells.formula(row, UNIT, line.unit, styles.numbered(styles.UNIT, '"/ "0'))
    cells.formula(row, VALUE, line.value, line.value_style)
    for level in line.levels:
        cells.colour(words, level.test, LEVELS[level.kind])
    cells.conditionals.extend(line.rules)


def _while_it_can_be_said(on: Reading, finding: Finding) -> Line:
    """A finding's line; it is neither good nor bad where its words are that another sheet was deleted, which has a line of
    its own."""
    line, said = finding.line(on), on.words(finding.key)
    missing = missing_words(on.plan)
    if said == missing:
        return line
    levels = [
        replace(level, test=formula("AND(said<>missing,test)", said=said, missing=missing, test=level.test))
        for level in line.levels
    ]
    return replace(line, levels=levels)


def _write(writer: Writer, on: Reading, row: int, line: Line) -> None:
    writer.line(row, line.symbol, line.unit if isinstance(line.unit, str) else None, None)
    write_value(writer, row, line, Area(row, MEANING, row, MEANING))
    writer.formula(row, MEANING, line.words, styles.LABEL_SAID)
    if line.occurs is not None:
        writer.formula(row, TOLERANCE, line.occurs, styles.decimals(styles.RESULT, on.driver_decimals()))
    if line.beside is not None:
        writer.formula(row, TOLERANCE, line.beside.value, BESIDE)
    writer.says_itself |= {(row, {"value": VALUE, "words": MEANING}[cell]) for cell in line.itself}


def _beside(node: Node, row: int, sheet: str) -> Node:
    """A formula that reads the cells of its own row as every line reads its own: so equal tests are equal formulas."""

    def change(part: Node) -> Node:
        if isinstance(part, CellRef) and part.row == row and part.sheet in (None, sheet):
            return replace(part, row_abs=False)
        return part

    return transform(node, change)


def _write_marks(writer: Writer, lines: dict[int, Line]) -> None:
    """Beside each line that is red or amber a mark; under the line under the title which the first of them is, and
    where: it may be far below."""
    for row, line in lines.items():
        mark: Node = Text("")
        for level in reversed(line.levels):
            mark = formula("IF(test,level,mark)", test=level.test, level=MARKS[level.kind], mark=mark)
        if line.levels:
            beside = _beside(formula('IFERROR(mark,"")', mark=mark), row, writer.plan.main)
            writer.formula(row, MEANING + 1, beside, styles.MARK)
    rows = list(lines)
    column, symbols = (
        RangeRef(CellRef(rows[0], col, True, True), CellRef(rows[-1], col, True, True)) for col in (MEANING + 1, SYMBOL)
    )
    missing = writer.plan.text("legend.missing")
    said: Node = Text(missing)
    marks = {kind: mark for kind, mark in MARKS.items() if mark}
    for sign in reversed(marks.values()):
        place = formula("MATCH(sign,column,0)", sign=sign, column=column)
        words = joined(f"{sign} ", formula("INDEX(symbols,place)", symbols=symbols, place=place), ": E",
                       formula("ROW(first)+place-1", first=column.start, place=place), f" · {missing}")  # fmt: skip
        said = formula("IFERROR(words,said)", words=words, said=said)
    writer.formula(LEGEND_ROW, MEANING, said, styles.LEGEND)
    area, cell = Area(LEGEND_ROW, MEANING, LEGEND_ROW, MEANING), CellRef(LEGEND_ROW, MEANING, True, True)
    writer.conditionals += [
        Conditional(area, formula("LEFT(cell,1)=mark", cell=cell, mark=mark), LEVELS[kind])
        for kind, mark in marks.items()
    ]
