"""The block of summaries on the first sheet: one number of the whole motion, and the driver's value where it occurs; and
the outputs that follow from these numbers."""

from __future__ import annotations

from livesheet.formula.nodes import Call, CellRef, Node, Symbol, transform
from livesheet.workbook import Area
from mechsheet.model import WAYS, Output, Summary, Way
from mechsheet.sheet import styles
from mechsheet.sheet.checks.boundless import may_grow
from mechsheet.sheet.checks.extremes import about, has_column, where_bounded
from mechsheet.sheet.checks.same_angle import same_angle
from mechsheet.sheet.deleted import sheets_of
from mechsheet.sheet.first.blocks import Writer, value_style
from mechsheet.sheet.over_rows import END_ROWS, mean_of_rows, with_torn
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE, Plan
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.shown import shown_unit, unit_of_column
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import decimals_of_unit
from mechsheet.units import ANGLE
from mechsheet.words.symbols import plain


def write_summaries(writer: Writer) -> None:
    """Fill the block in, when the description asks for summaries."""
    plan = writer.plan
    if "summary" not in plan.blocks:
        return
    writer.heading("summary", plan.text("head.at"))
    for summary in plan.mechanism.summaries:
        _write(writer, summary)
    for output in plan.mechanism.motion_outputs:
        _write_output(writer, output)


def _write(writer: Writer, summary: Summary) -> None:
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
    unit = plan.mechanism.given_unit(summary.of) or plan.equations.of(summary.of).unit
    style = styles.decimals(styles.RESULT, decimals_of_unit(plan, unit)) if unit.per else value_style(plan, unit)
    if plan.mechanism.bands and summary.symbol in plan.mechanism.bands.summaries and summary.of in plan.band_decimals:
        style = styles.decimals(styles.RESULT, plan.band_decimals[summary.of])
    value, where = _of(plan, summary)
    writer.needs[row] = sheets_of(plan, summary.of)
    if searched and not same_angle(plan, summary.of):
        value = where_bounded(plan, summary.of, value, summary.take.ways)
        if gaps:
            value = formula("IF(stretches>1,NA(),value)", stretches=plan.searched.count.cell, value=value)
        writer.colour(Area(row, MEANING, row, MEANING), _has_none(plan, summary), styles.WARN)
    writer.formula(row, VALUE, _where_it_closes(plan, value), style)
    if where is not None:
        writer.formula(row, TOLERANCE, _where_it_closes(plan, where), value_style(plan, ANGLE))


def _has_none(plan: Plan, summary: Summary) -> Node:
    """Whether the line of a summary has no number although the links close."""
    row = plan.blocks["summary"].rows[summary.symbol]
    return formula("AND(closed>0,ISNA(value))", closed=plan.places.closed.cell, value=CellRef(row, VALUE, True, True))


def _where_it_closes(plan: Plan, value: Node) -> Node:
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
    writer.formula(row, VALUE, _where_it_closes(plan, over_summaries(plan, output)), value_style(plan, output.unit))


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
