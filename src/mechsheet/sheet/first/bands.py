"""The block of tolerances on the first sheet: of each quantity and summary asked for its band, and what matters most."""

from __future__ import annotations

from livesheet.formula.nodes import Call, Node, Symbol
from mechsheet.sheet import styles
from mechsheet.sheet.columns.bands import ROOT, WORST, part_of
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.tolerance import Line, Tolerance, shown_line
from mechsheet.units import behind_number
from mechsheet.words.symbols import plain


def write_bands(writer: Writer, tolerance: Tolerance) -> None:
    """Fill the block in, where the description asks for tolerances."""
    if "bands" not in writer.plan.blocks:
        return
    writer.heading("bands", writer.plan.text("bands.head.root"))
    for line in tolerance.lines:
        if line.kind != "shown":
            _write(writer, tolerance, line)


def _write(writer: Writer, tolerance: Tolerance, line: Line) -> None:
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
