"""The block of summaries on the first sheet: one number of the whole motion, and the driver's value where it occurs."""

from __future__ import annotations

from mechsheet.formula.nodes import CellRef, Node, RangeRef, Symbol
from mechsheet.model import Summary
from mechsheet.sheet import styles
from mechsheet.sheet.checks.extremes import Way, about
from mechsheet.sheet.checks.limits import STRETCHES
from mechsheet.sheet.first.blocks import Writer, shown_unit, value_style
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE, Plan
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.table.positions import places_of
from mechsheet.sheet.workbook import Area, Conditional


def write_summaries(writer: Writer) -> None:
    """Fill the block in, when the description asks for summaries."""
    plan = writer.plan
    if "summary" not in plan.blocks:
        return
    writer.heading("summary", plan.text("head.at"))
    for summary in plan.mechanism.summaries:
        _write(writer, summary)


def _write(writer: Writer, summary: Summary) -> None:
    plan = writer.plan
    row = plan.blocks["summary"].rows[summary.symbol]
    label = (
        summary.label.of(plan.language)
        if summary.label
        else plan.text(f"take.{summary.take}", symbol=plain(summary.of))
    )
    closed = plan.at.bind(Symbol("#rows_closed"), plan.main)
    before, after = plan.text("summary.part", count="#", rows=plan.rows).split("#")
    part = joined(f"{label}: {before}", closed, after)
    words = formula("IF(closed=rows,label,part)", closed=closed, rows=plan.rows, label=label, part=part)
    refined: dict[str, tuple[Way, ...]] = {"min": ("min",), "max": ("max",), "range": ("min", "max")}
    if summary.take in refined and summary.of != plan.mechanism.driver.symbol:
        words = plan.at.bind(joined(words, about(plan, summary.of, refined[summary.take])), plan.main)
    writer.line(row, rich(summary.symbol), shown_unit(plan, summary.of), None)
    writer.formula(row, MEANING, words, styles.LABEL)
    partial = formula("closed<rows", closed=closed, rows=plan.rows)
    writer.conditionals.append(Conditional(Area(row, MEANING, row, MEANING), partial, styles.WARN))
    unit = plan.mechanism.given_unit(summary.of) or plan.equations.of(summary.of).unit
    style = styles.decimals(styles.RESULT, places_of(plan, unit)) if unit.per else value_style(plan, unit.kind)
    if plan.mechanism.bands and summary.symbol in plan.mechanism.bands.summaries and summary.of in plan.band_places:
        style = styles.decimals(styles.RESULT, plan.band_places[summary.of])
    value, where = _of(plan, summary)
    # over nothing: no number, and no 0 that somebody who looks for the smallest would take
    found = formula("IF(closed=0,NA(),IFERROR(value,NA()))", closed=closed, value=value)
    writer.formula(row, VALUE, plan.at.bind(found, plan.main), style)
    if where is not None:
        found = formula("IF(closed=0,NA(),IFERROR(where,NA()))", closed=closed, where=where)
        writer.formula(row, TOLERANCE, plan.at.bind(found, plan.main), value_style(plan, "angle"))


def _of(plan: Plan, summary: Summary) -> tuple[Node, Node | None]:
    """The number, and the driver's value where it occurs."""
    driver = plan.mechanism.driver.symbol
    column, drivers = Symbol(ALL + summary.of), Symbol(ALL + driver)
    extremes: dict[str, Node] = {way: Symbol(f"#{way}_{summary.of}") for way in ("min", "max")}
    at: dict[str, Node] = {way: Symbol(f"#{way}_at_{summary.of}") for way in ("min", "max")}
    if summary.of == driver and summary.take in ("min", "max", "range"):
        extremes = {way: formula(f"{way.upper()}(drivers)", drivers=drivers) for way in ("min", "max")}
        at = extremes
    last = formula("MAX(rows)", rows=_ends(plan, "last"))
    match summary.take:
        case "min" | "max" as way:
            return extremes[way], at[way]
        case "range":
            return formula("high-low", high=extremes["max"], low=extremes["min"]), None
        case "mean":
            return _mean(plan, column), None
        case "first":
            return (
                formula("INDEX(column,_first_1)", column=column),
                formula("INDEX(drivers,_first_1)", drivers=drivers),
            )
        case "last":
            return (
                formula("INDEX(column,last)", column=column, last=last),
                formula("INDEX(drivers,last)", drivers=drivers, last=last),
            )


def _ends(plan: Plan, key: str) -> RangeRef:
    """The column in which Checks keeps an end of every stretch: one range, so that it reads back as it was written."""
    top, bottom = (plan.at.spots[f"#{key}_{number}"] for number in (1, STRETCHES))
    return RangeRef(*(CellRef(spot.row, spot.col, True, True, spot.sheet) for spot in (top, bottom)))


def _mean(plan: Plan, column: Node) -> Node:
    """The mean of the rows that exist."""
    said, ok = Symbol(f"{ALL}#status"), plan.text("status.ok")
    return formula("AVERAGEIF(said,ok,column)", said=said, ok=ok, column=column)
