"""The blocks of the first sheet, each of rows of symbol, value, unit, tolerance, meaning side by side.

Summaries are one number of the whole motion each, and the driver's value where it occurs; outputs may follow from them.
Bands are what tolerances come to, of each quantity and summary asked for. The last blocks are words that the tables look
up, and whether the other sheets are there: cells that need one that was deleted are empty.
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import Call, CellRef, Node, Symbol, Text, transform
from livesheet.workbook import Area, Content, Fill, Style
from mechsheet.model import WAYS, Output, Summary, Way
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells, height_of, label_lines
from mechsheet.sheet.checks.boundless import may_grow
from mechsheet.sheet.checks.extremes import about, has_column, where_bounded
from mechsheet.sheet.columns.bands import ROOT, WORST, part_of
from mechsheet.sheet.deleted import FIRST_OF_ALL, TELLS_OF_ROWS, are_there, cells_read, missing_words, sheets_of
from mechsheet.sheet.over_rows import END_ROWS, mean_of_rows, with_torn
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import LEGEND_ROW, MARGIN, MEANING, SYMBOL, TOLERANCE, UNIT, VALUE, VERDICT_ROW, Plan
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.shown import rich, shown_unit, unit_of_column
from mechsheet.sheet.table.positions import decimals_of_kind, decimals_of_unit
from mechsheet.sheet.table.rates import dead_words
from mechsheet.sheet.table.status import words_looked_up
from mechsheet.sheet.table.tolerance import Line, Tolerance, shown_line
from mechsheet.sheet.transmission import same_angle
from mechsheet.units import ANGLE, Unit, behind_number
from mechsheet.words.symbols import plain

MEANING_WIDTH = 44
"""Characters of the column that says what a line is; a longer label is broken into lines, it would run under the drawing."""

COLUMN = 7
"""Least pixels of a character of a column's width: Excel's."""


class Writer(Cells):
    """Collects the cells of the sheet; `heights` of rows with a label of several lines.

    needs        by row the keys of other sheets that its cells need, though no formula there reads them
    says_itself  cells that say themselves what is left without another sheet
    """

    def __init__(self, plan: Plan, title: str) -> None:
        super().__init__(plan, title)
        self.needs: dict[int, set[str]] = {}
        self.says_itself: set[tuple[int, int]] = set()

    def line(self, row: int, symbol: Content, unit: str | None, meaning: str | None) -> None:
        """The fixed parts of an entry: everything but its value (and its unit or meaning, when that is a formula: None)."""
        self.put(row, SYMBOL, symbol, styles.SYMBOL)
        if unit is not None:
            self.put(row, UNIT, unit, styles.UNIT)
        if meaning is not None:
            self.meaning(row, meaning)

    def meaning(self, row: int, meaning: str) -> None:
        """A label in as many lines as it takes: what went on over the next column would be printed on a page of its own."""
        lines = label_lines(meaning, COLUMN * MEANING_WIDTH)
        self.put(row, MEANING, meaning, styles.LABEL if lines == 1 else styles.LABEL_LINES)
        if lines > 1:
            self.heights[row] = height_of(lines)

    def heading(self, key: str, over_tolerance: str | None = None) -> None:
        """The heading of a block, across its columns; a block may use the tolerance's column for something else."""
        row = self.plan.blocks[key].row
        self.put(row, SYMBOL, self.plan.text(f"block.{key}"), styles.SECTION)
        for col in range(SYMBOL + 1, MEANING + 1):
            self.put(row, col, over_tolerance if col == TOLERANCE else None, styles.SECTION)


def write_legend(cells: Cells) -> None:
    """What the colours mean, in one row."""
    text = cells.plan.text
    cells.put(LEGEND_ROW, SYMBOL, text("legend.input"), styles.numbered(styles.INPUT, "@"))
    cells.put(LEGEND_ROW, VALUE, text("legend.result"), styles.RESULT)


def value_style(plan: Plan, unit: Unit) -> Style:
    """The style of a result in this unit: one decimal more than the tolerances justify for lengths."""
    return styles.decimals(
        styles.RESULT, decimals_of_kind(plan, unit.kind, unit.symbol) + (1 if unit.kind == "length" else 0)
    )


def quantity_style(plan: Plan, unit: Unit) -> Style:
    """The same of any quantity: of a rate as many decimals as its size wants."""
    return styles.decimals(styles.RESULT, decimals_of_unit(plan, unit)) if unit.per else value_style(plan, unit)


def write_summaries(writer: Writer) -> None:
    """Fill the block in, when the description asks for summaries."""
    plan = writer.plan
    if "summary" not in plan.blocks:
        return
    writer.heading("summary", plan.text("head.at"))
    for summary in plan.mechanism.summaries:
        _write_summary(writer, summary)
    for output in plan.mechanism.motion_outputs:
        _write_output(writer, output)


def _write_summary(writer: Writer, summary: Summary) -> None:
    plan = writer.plan
    row = plan.blocks["summary"].rows[summary.symbol]
    words = _with_part(plan, summary_words(plan, summary))
    searched = summary.take.ways and summary.of != plan.mechanism.driver.symbol and has_column(plan, summary.of)
    gaps = plan.equations.equations.range_has_gaps(summary.of, summary.take)
    if searched:
        same = same_angle(plan, summary.of)
        ways = ("min", "max") if same else summary.take.ways
        none = _has_none(plan, summary) if plan.rows_only or may_grow(plan, summary.of) else None
        doubt = about(plan, same.group.transmission if same else summary.of, ways, none=none)
        if gaps:
            several = plan.text("verdict.several")
            doubt = formula(
                "IF(stretches>1,several,doubt)", stretches=plan.searched.count.cell, several=several, doubt=doubt
            )
        words = joined(words, doubt)
    if "mean" in summary.take.parts and has_column(plan, summary.of):
        words = joined(with_torn(plan, words, plan.at.column(summary.take.column(summary.of), plan.main)))
    writer.line(row, rich(summary.symbol), shown_unit(plan, summary.of), None)
    _said(writer, row, words)
    style = quantity_style(plan, plan.unit_of(summary.of))
    if plan.mechanism.bands and summary.symbol in plan.mechanism.bands.summaries and summary.of in plan.band_decimals:
        style = styles.decimals(styles.RESULT, plan.band_decimals[summary.of])
    value, where = _of(plan, summary)
    writer.needs[row] = sheets_of(plan, summary.of)
    if searched and not same_angle(plan, summary.of):
        value = where_bounded(plan, summary.of, value, summary.take.ways)
        if gaps:
            value = formula("IF(stretches>1,NA(),value)", stretches=plan.searched.count.cell, value=value)
        writer.colour(Area(row, MEANING, row, MEANING), _has_none(plan, summary), styles.WARN)
    writer.formula(row, VALUE, where_it_closes(plan, value), style)
    if where is not None:
        writer.formula(row, TOLERANCE, where_it_closes(plan, where), value_style(plan, ANGLE))


def _has_none(plan: Plan, summary: Summary) -> Node:
    """Whether the line of a summary has no number although the links close."""
    row = plan.blocks["summary"].rows[summary.symbol]
    return formula("AND(closed>0,ISNA(value))", closed=plan.places.closed.cell, value=CellRef(row, VALUE, True, True))


def where_it_closes(plan: Plan, value: Node) -> Node:
    """Over nothing: no number, and no 0 that somebody who looks for the smallest would take."""
    return formula("IF(closed=0,NA(),IFERROR(value,NA()))", closed=plan.places.closed.cell, value=value)


def _with_part(plan: Plan, label: str) -> Node:
    """The label; where only a part of the sweep exists, of how many positions."""
    closed, rows = plan.places.closed.cell, plan.places.rows.cell
    before, between, after = plan.text("summary.part", count="#", rows="#").split("#")
    part = joined(f"{label}: {before}", closed, between, rows, after)
    return formula("IF(closed=rows,label,part)", closed=closed, rows=rows, label=label, part=part)


def _said(writer: Writer, row: int, words: Node) -> None:
    """The words of a line, amber where only a part of the sweep exists."""
    plan = writer.plan
    writer.formula(row, MEANING, words, styles.LABEL_SAID)
    partial = formula("closed<rows", closed=plan.places.closed.cell, rows=plan.places.rows.cell)
    writer.colour(Area(row, MEANING, row, MEANING), partial, styles.WARN)


def _write_output(writer: Writer, output: Output) -> None:
    """A line of an output of summaries."""
    plan = writer.plan
    row = plan.blocks["summary"].rows[output.symbol]
    writer.line(row, rich(output.symbol), plan.mechanism.shown(output.unit).text, None)
    _said(writer, row, _with_part(plan, output_words(plan, output)))
    writer.formula(row, VALUE, where_it_closes(plan, over_summaries(plan, output)), value_style(plan, output.unit))


def summary_words(plan: Plan, summary: Summary) -> str:
    """What a summary is called: its label, or what it takes of what."""
    return (
        summary.label.of(plan.language)
        if summary.label
        else plan.text(f"take.{summary.take.key}", symbol=plain(summary.of))
    )


def output_words(plan: Plan, output: Output) -> str:
    """What an output of summaries is called: its label, or its formula."""
    return output.label.of(plan.language) if output.label else f"= {' '.join(output.written.split())}"


def over_summaries(plan: Plan, output: Output) -> Node:
    """An output of summaries, as people read it, over the cells of the summaries: angles in them are read as radians."""
    taken = {summary.symbol: summary for summary in plan.mechanism.summaries}

    def change(part: Node) -> Node:
        if not isinstance(part, Symbol) or part.name not in taken:
            return part
        cell, unit = plan.places.summaries[part.name].cell, unit_of_column(plan, taken[part.name].of)
        return Call("RADIANS", (cell,)) if unit.in_degrees else cell

    tree = transform(output.formula, change)
    return Call("DEGREES", (tree,)) if plan.mechanism.shown(output.unit).in_degrees else tree


def _of(plan: Plan, summary: Summary) -> tuple[Node, Node | None]:
    """The number, and the driver's value where it occurs."""
    driver = plan.mechanism.driver.symbol
    if not has_column(plan, summary.of):  # it is the same in every row
        return summary.take.of_constant(Symbol(SHOWN + summary.of)), None
    column, drivers = Symbol(ALL + summary.of), Symbol(ALL + driver)

    def found(part: str) -> tuple[Node, Node | None]:
        """A part of the motion, and the driver's value where it is."""
        if part == "mean":
            return mean_of_rows(plan, summary.take.column(summary.of), plan.main), None
        if part in WAYS:
            return _extreme(plan, summary, WAYS[part])
        row = END_ROWS[part](plan)
        value, where = (formula("INDEX(column,row)", column=each, row=row) for each in (column, drivers))
        return value, where

    place = summary.take.occurs_with
    return summary.take.over(lambda part: found(part)[0]), found(place)[1] if place else None


def _extreme(plan: Plan, summary: Summary, way: Way) -> tuple[Node, Node]:
    """The smallest or largest value, and where."""
    if summary.of == plan.mechanism.driver.symbol:
        end = formula(f"{way.upper()}(drivers)", drivers=Symbol(ALL + summary.of))
        return end, end
    same = same_angle(plan, summary.of)
    if same is not None:
        return same.extreme(plan.searched.extremes, way)
    found = plan.searched.extremes[way, summary.of]
    return found.value.cell, found.occurs.cell


def write_below(writer: Writer) -> None:
    """Fill the blocks in."""
    plan = writer.plan
    for key, said in (("reasons", words_looked_up(plan)), ("dead", dead_words(plan))):
        if said:
            writer.heading(key)
            for row, words in enumerate(said, plan.blocks[key].row + 1):
                writer.meaning(row, words)
    writer.heading("sheets")
    for key, place in (("well", plan.places.well), ("left", plan.places.left)):
        writer.line(there(place).row, plan.text(f"sheets.{key}"), "", None)
    for key, spot in plan.places.sheets.items():
        title = plan.at.titles[key]
        writer.line(spot.row, title, "", plan.text("sheets.there"))
        found = formula("ISREF(cell)*1", cell=CellRef(0, 0, True, True, title))
        if key == TELLS_OF_ROWS:
            found = formula("ISNUMBER(MAX(begun))*1", begun=plan.checked.begun.whole())
        writer.formula(spot.row, VALUE, found, styles.decimals(styles.RESULT, 0))


def while_sheets_are_there(writer: Writer) -> list[Fill]:
    """The sheet's formulas: those that need other sheets are empty where one of these was deleted, words say so."""
    needs, kept = _Needs(writer), []
    places = writer.plan.places
    own = {*(spot.row for spot in places.sheets.values()), places.lines["sheets"].row, there(places.left).row}
    own |= {VERDICT_ROW, LEGEND_ROW}
    for fill in writer.fills:
        needed = needs.of(fill.row, fill.col)
        if fill.col == MEANING:
            needed = needed | needs.of(fill.row, VALUE)
        if (fill.row, fill.col) in writer.says_itself:
            needed = needed & {*FIRST_OF_ALL}
        present = are_there(writer.plan, needed)
        if present is None or fill.row in own or fill.col == MARGIN:
            kept.append(fill)
            continue
        otherwise = missing_words(writer.plan) if fill.col == MEANING else Text("")
        node = formula("IF(present,own,otherwise)", present=present, own=fill.formula, otherwise=otherwise)
        kept.append(replace(fill, formula=writer.plan.at.bind(node, writer.title)))
    return kept


class _Needs:
    """Which other sheets the cells of the first sheet need."""

    def __init__(self, writer: Writer) -> None:
        plan = writer.plan
        self.keys = {plan.at.titles[key]: key for key in plan.places.sheets}
        self.first_of_all = {key for key in FIRST_OF_ALL if key in plan.places.sheets}
        self.table, self.title, self.further = plan.table, writer.title, writer.needs
        self.names = {name.name: name for name in plan.names}
        self.fills = {(fill.row, fill.col): fill for fill in writer.fills}
        # what says whether a sheet is there needs none
        self.found: dict[tuple[int, int], set[str]] = {
            (spot.row, spot.col): set() for spot in plan.places.sheets.values()
        }

    def of(self, row: int, col: int) -> set[str]:
        """The keys of what a cell needs, itself or by cells of its sheet that it reads."""
        place = row, col
        if place not in self.found:
            found = self.found[place] = {*self.further.get(row, ())} if place in self.fills else set()
            for sheet, *cell in cells_read(self.fills[place].formula, self.names) if place in self.fills else ():
                if sheet in (None, self.title):
                    found |= self.of(*cell)
                elif sheet == self.table:
                    found |= self.first_of_all
                elif sheet in self.keys:
                    found |= {self.keys[sheet]} | self.first_of_all
        return self.found[place]


def write_bands(writer: Writer, tolerance: Tolerance) -> None:
    """Fill the block in, where the description asks for tolerances."""
    if "bands" not in writer.plan.blocks:
        return
    writer.heading("bands", writer.plan.text("bands.head.root"))
    for line in tolerance.lines:
        if line.kind != "shown":
            _write_band(writer, tolerance, line)


def _write_band(writer: Writer, tolerance: Tolerance, line: Line) -> None:
    plan = writer.plan
    row = plan.blocks["bands"].rows[line.key]
    unit = shown_unit(plan, line.quantity)
    writer.line(row, rich(line.key), unit, None)
    for col, part in ((VALUE, WORST), (TOLERANCE, ROOT)):
        _band(writer, row, col, line, part)
    words = formula("IFERROR(words,none)", words=_words(tolerance, line), none=plan.text("bands.none"))
    writer.formula(row, MEANING, words, styles.LABEL_SAID)


def _words(tolerance: Tolerance, line: Line) -> Node:
    """`78.9° ± 0.3°; mostly a2 (66 %)`; of a quantity where its band is largest."""
    plan = tolerance.plan
    shares, names = tolerance.shares(line)
    most = formula("MAX(shares)", shares=shares)
    # the row is said, too: of a range of one row gnumeric takes a single number as the row's
    name = formula("INDEX(names,1,MATCH(most,shares,0))", names=names, most=most, shares=shares)
    before, between, after = plan.text("bands.mostly", name="#", share="#").split("#")
    mostly = joined(before, name, between, formula("ROUND(100*most,0)", most=most), after)
    if line.summary is not None:
        value = plan.places.summaries[line.key].cell
        return joined(
            _with_band(value, line.spot(plan, WORST).cell, behind_number(shown_unit(plan, line.quantity))), "; ", mostly
        )
    driver = plan.mechanism.driver
    worst, drivers = Symbol(ALL + part_of(line.quantity, WORST)), Symbol(ALL + driver.symbol)
    where = formula(
        "INDEX(drivers,MATCH(most,worst,0))", drivers=drivers, worst=worst, most=line.spot(plan, WORST).cell
    )
    start, end = plan.text("bands.largest.at", driver=plain(driver.symbol), place="#").split("#")
    return joined(start, formula("ROUND(where,4)", where=where), behind_number(driver.unit.text) + end, "; ", mostly)


def _with_band(value: Node, band: Node, unit: str) -> Node:
    """`26.2 ± 0.1 mm`: the last digit is the band's first."""
    digits = formula("MAX(0,-INT(LOG10(band)))", band=band)
    shown, wide = (Call("FIXED", (each, digits, formula("TRUE"))) for each in (value, band))
    return joined(shown, f"{unit if unit == '°' else ''} ± ", wide, unit)


def band_here(writer: Writer, symbol: str, row: int) -> None:
    """Beside a quantity at the position shown its band there."""
    if symbol in writer.plan.banded:
        _band(writer, row, TOLERANCE, shown_line(writer.plan, symbol), WORST)


def _band(writer: Writer, row: int, col: int, line: Line, part: str) -> None:
    """A quantity's worst case or root sum of squares, with a digit more than its band shows."""
    plan = writer.plan
    style = styles.decimals(styles.RESULT, plan.band_decimals.get(line.quantity, 4) + 1)
    value = formula("IFERROR(value,NA())", value=line.spot(plan, part).cell)
    writer.formula(row, col, value, style)
