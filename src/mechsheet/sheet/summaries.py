"""The block of summaries on the first sheet: one number of a whole sweep, and the driver's value where it occurs."""

from __future__ import annotations

from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text
from mechsheet.model import Summary
from mechsheet.sheet import styles
from mechsheet.sheet.blocks import Writer, shown_unit, value_style
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE, Plan
from mechsheet.sheet.rows import first_row, last_row
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Area, Conditional


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
        writer.line(row, rich(summary.symbol), shown_unit(plan, summary.of), None)
        writer.formula(row, MEANING, _meaning(plan, summary, label), styles.LABEL)
        partial = Binary("<>", CellRef(row, MEANING, True, True), Text(label))
        writer.conditionals.append(Conditional(Area(row, MEANING, row, MEANING), partial, styles.WARN))
        driver = plan.mechanism.driver.symbol
        kind = "angle" if summary.of == driver else plan.equations.of(summary.of).unit.kind
        writer.formula(row, VALUE, _where_any(plan, summary, _summary(plan, summary)), value_style(plan, kind))
        where = _where(plan, summary)
        if where is not None:
            writer.formula(row, TOLERANCE, _where_any(plan, summary, where), value_style(plan, "angle"))


def values_of(plan: Plan, summary: Summary, sheet: str) -> RangeRef:
    """The column of a summary: values, or empty texts in rows without one, which MAX, MIN and AVERAGE pass over."""
    return plan.at.area(plan.at.shown[f"#blank {summary.of}"], sheet)


def _where_any(plan: Plan, summary: Summary, node: Node) -> Node:
    """#N/A over nothing: MAX and MIN would say 0, which somebody who looks for the smallest would take."""
    nothing = Binary("=", Call("COUNT", (values_of(plan, summary, plan.main),)), Number(0.0))
    return Call("IF", (nothing, Call("NA"), node))


def _meaning(plan: Plan, summary: Summary, label: str) -> Node:
    """What it is; where only a part of the sweep has a value, of how many positions."""
    count = Call("COUNT", (values_of(plan, summary, plan.main),))
    before, after = plan.text("summary.part", count="#", rows=plan.rows).split("#")
    part = Binary("&", Binary("&", Text(f"{label}: {before}"), count), Text(after))
    return Call("IF", (Binary("=", count, Number(float(plan.rows))), Text(label), part))


def _summary(plan: Plan, summary: Summary) -> Node:
    """The number."""
    area = values_of(plan, summary, plan.main)
    shown = plan.at.column(summary.of, plan.main)
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
            return Call("INDEX", (shown, first_row(plan)))
        case "last":
            return Call("INDEX", (shown, last_row(plan)))


def _where(plan: Plan, summary: Summary) -> Node | None:
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
