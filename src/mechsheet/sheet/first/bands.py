"""The block of tolerances on the first sheet: of each quantity and summary asked for its band, and what matters most."""

from __future__ import annotations

from mechsheet.formula.nodes import Call, Node, Symbol
from mechsheet.sheet import styles
from mechsheet.sheet.first.blocks import Writer, shown_unit
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.table.bands import ROOT, WORST, part_of
from mechsheet.sheet.table.tolerance import Line, Tolerance


def write_bands(writer: Writer, tolerance: Tolerance) -> None:
    """Fill the block in, where the description asks for tolerances."""
    if "bands" not in writer.plan.blocks:
        return
    writer.heading("bands", writer.plan.text("bands.head.root"))
    for line in tolerance.lines:
        _write(writer, tolerance, line)


def _write(writer: Writer, tolerance: Tolerance, line: Line) -> None:
    plan, summary = writer.plan, line.summary
    key = summary.symbol if summary else line.quantity
    row = plan.blocks["bands"].rows[key]
    unit = shown_unit(plan, line.quantity)
    writer.line(row, rich(key), unit, None)
    style = styles.decimals(styles.RESULT, plan.band_places.get(line.quantity, 4) + 1)
    where = f"{'of' if summary else 'in'} {key}"
    for col, part in ((VALUE, WORST), (TOLERANCE, ROOT)):
        value = formula("IFERROR(value,NA())", value=Symbol(f"#{part} {where}"))
        writer.formula(row, col, plan.at.bind(value, plan.main), style)
    writer.formula(row, MEANING, plan.at.bind(_words(writer, tolerance, line), plan.main), styles.LABEL)


def _words(writer: Writer, tolerance: Tolerance, line: Line) -> Node:
    """`26.2° ± 0.1°; mostly a3 (45 %)`; of a quantity the position shown, and where its band is largest."""
    plan, summary = writer.plan, line.summary
    unit = shown_unit(plan, line.quantity)
    gap = unit if unit in ("", "°") else f" {unit}"
    shares, names = tolerance.shares(line)
    most = formula("MAX(shares)", shares=shares)
    name = formula("INDEX(names,MATCH(most,shares,0))", names=names, most=most, shares=shares)
    percent = formula("ROUND(100*most,0)", most=most)
    before, between, after = plan.text("bands.mostly", name="#", share="#").split("#")
    mostly = joined(before, name, between, percent, after)
    if summary is not None:
        value: Node = Symbol(f"#summary {summary.symbol}")
        return _or_nothing(writer, joined(_with_band(value, Symbol(f"#{WORST} of {summary.symbol}"), gap), "; ", mostly))
    worst = Symbol(ALL + part_of(line.quantity, WORST))
    value, band = (formula("INDEX(column,_position+1)", column=column) for column in (Symbol(ALL + line.quantity), worst))
    driver = plan.mechanism.driver
    drivers = Symbol(ALL + driver.symbol)
    where = formula("INDEX(drivers,MATCH(most,worst,0))", drivers=drivers, worst=worst,
                    most=Symbol(f"#{WORST} in {line.quantity}"))  # fmt: skip
    own = driver.unit.text
    tail = own if own in ("", "°") else f" {own}"
    start, end = plan.text("bands.largest.at", driver=plain(driver.symbol), place="#").split("#")
    at = joined(start, formula("ROUND(where,4)", where=where), tail + end)
    here = formula("IFERROR(said,none)", said=_with_band(value, band, gap), none=plan.text("bands.none"))
    return _or_nothing(writer, joined(plan.text("bands.here"), here, "; ", at, "; ", mostly))


def _with_band(value: Node, band: Node, unit: str) -> Node:
    """`26.2 ± 0.1 mm`: the last digit is the band's first."""
    digits = formula("MAX(0,-INT(LOG10(band)))", band=band)
    shown, wide = (Call("FIXED", (each, digits, formula("TRUE"))) for each in (value, band))
    return joined(shown, f"{unit} ± ", wide, unit)


def _or_nothing(writer: Writer, words: Node) -> Node:
    return formula("IFERROR(words,none)", words=words, none=writer.plan.text("bands.none"))
