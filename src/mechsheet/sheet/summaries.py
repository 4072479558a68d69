"""The block of summaries on the first sheet: one number of a whole sweep, and the driver's value where it occurs."""

from __future__ import annotations

from mechsheet.formula.nodes import Binary, Call, Node, Number
from mechsheet.model import Summary
from mechsheet.sheet.blocks import Writer, shown_unit, value_style
from mechsheet.sheet.plan import TOLERANCE, VALUE, Plan
from mechsheet.sheet.rows import first_row, last_row
from mechsheet.sheet.symbols import plain, rich


def write_summaries(writer: Writer) -> None:
    """Fill the block in, when the description asks for summaries."""
    plan = writer.plan
    if "summary" not in plan.blocks:
        return
    writer.heading("summary", plan.text("head.at"))
    for summary in plan.mechanism.summaries:
        row = plan.blocks["summary"].rows[summary.symbol]
        label = (
            summary.label.of(plan.language)
            if summary.label
            else plan.text(f"take.{summary.take}", symbol=plain(summary.of))
        )
        writer.line(row, rich(summary.symbol), shown_unit(plan, summary.of), label)
        driver = plan.mechanism.driver.symbol
        unit = "angle" if summary.of == driver else plan.equations.of(summary.of).unit
        writer.formula(row, VALUE, _summary(plan, summary), value_style(plan, unit))
        where = _where(plan, summary, row)
        if where is not None:
            writer.formula(row, TOLERANCE, where, value_style(plan, "angle"))


def _summary(plan: Plan, summary: Summary) -> Node:
    """The number. Its column holds values or empty texts, which MAX, MIN and AVERAGE pass over."""
    area = plan.at.area(plan.at.shown[f"#blank {summary.of}"], plan.main)
    match summary.take:
        case "max":
            return Call("MAX", (area,))
        case "min":
            return Call("MIN", (area,))
        case "range":
            return Binary("-", Call("MAX", (area,)), Call("MIN", (area,)))
        case "mean":
            return Call("AVERAGE", (area,))
        case "first":
            return Call("INDEX", (area, first_row(plan)))
        case "last":
            return Call("INDEX", (area, last_row(plan)))


def _where(plan: Plan, summary: Summary, row: int) -> Node | None:
    """The driver's value where it occurs."""
    drivers = plan.at.column(plan.mechanism.driver.symbol, plan.main)
    match summary.take:
        case "max" | "min":
            area = plan.at.area(plan.at.shown[f"#rounded {summary.of}"], plan.main)
            extreme = Call(summary.take.upper(), (area,))
            return Call("INDEX", (drivers, Call("MATCH", (extreme, area, Number(0.0)))))
        case "first":
            return Call("INDEX", (drivers, first_row(plan)))
        case "last":
            return Call("INDEX", (drivers, last_row(plan)))
    return None
