"""Rows that people fill down and insert: every row of a table holds one formula, and what is said of the rows stays true."""

import math
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from edited import filled_down, moved
from placed import places_of

from folders import TEMPLATE_NAMES
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet import reference
from mechsheet.checking.edited.inserted_rows import Shift
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.sheet.checks.checks import sheets_in_rows
from mechsheet.sheet.plan import MEANING

MORE = 5


@cache
def once(name, layout, rows=None):
    """The description in a layout, with its own number of rows or another, by the same step."""
    text = template_text(name)
    if rows is not None:
        start, second = once(name, layout).plan.driver[:2]
        stop = loads(text).driver.unit.written(start + (rows - 1) * (second - start))
        text = re.sub(r"(?m)^stop = .*", f"stop = {stop!r}", text)
    return Compiled(replace(loads(text), layout=layout))


@cache
def values_of(name, layout, rows=None):
    """The columns of the table of a description as it is built."""
    made = once(name, layout, rows)
    return columns(made.plan, evaluate(book_of(made.layout)), made.plan.at.first, made.plan.rows)


def columns(plan, values, first, rows):
    """All columns of numbers and of words, of so many rows."""
    spots = {"status": plan.places.status}
    spots |= {column.symbol: plan.at.spots[column.symbol] for column in plan.columns if column.symbol}
    return {
        symbol: [values.get(spot.sheet, first + row, spot.col) for row in range(rows)] for symbol, spot in spots.items()
    }


def same(found, expected, plan):
    """Angles may be whole turns off, the same ones in all rows: from which turn they count is decided in building."""
    for symbol, column in expected.items():
        turn = 360.0 if symbol in plan.at.spots and plan.at.spots[symbol].degrees else math.tau
        numbers = [pair for pair in zip(found[symbol], column, strict=True) if isinstance(pair[1], float)]
        off = turn * round((numbers[0][0] - numbers[0][1]) / turn) if numbers and symbol in angles(plan) else 0.0
        for one, other in zip(found[symbol], column, strict=True):
            if isinstance(other, float):
                assert one - off == pytest.approx(other, rel=1e-9, abs=1e-9), symbol
            else:
                assert str(one) == str(other), symbol


def angles(plan):
    """Symbols of angles."""
    return {each.symbol for each in plan.equations.columns if each.unit.kind == "angle" and not each.unit.per}


def as_the_reference(plan, found):
    """Angles, displacements and points as Newton's method on poses has them, at the driver's values of the rows."""
    mechanism = plan.mechanism
    driver = np.array(found[mechanism.driver.symbol])
    driver = np.radians(driver) if mechanism.driver.unit.in_degrees else driver
    theirs = reference.reached(reference.solve(mechanism, values=driver))
    for symbol, column in theirs.items():
        if symbol not in found:
            continue
        degrees = plan.at.spots[symbol].degrees
        for one, other in zip(found[symbol], column, strict=True):
            if not isinstance(one, float):
                assert not math.isfinite(other), symbol
                continue
            way = (math.radians(one) if degrees else one) - other
            way = math.remainder(way, math.tau) if symbol in angles(plan) else way
            assert way == pytest.approx(0, abs=1e-8), symbol


def tables(plan):
    """Where the sheets with a row for each position begin: title, row, columns."""
    page = plan.mechanism.layout == "page"
    width = {plan.table: len(plan.columns)}
    beside = {"rates": plan.rates, "forces": plan.forces, "iterations": plan.iterations, "tolerance": plan.bands}
    width |= {plan.at.titles[key]: each[-1].col + 1 for key, each in beside.items() if each}
    found = [(plan.table, plan.at.first, width[plan.table])]
    if not page:
        found += [(title, top.row, width.get(title, 99)) for title, top in sheets_in_rows(plan).items()]
    return found


def line(plan, values):
    spot = places_of(plan)["verdict"]
    return values.get(spot.sheet, spot.row, spot.col)


@pytest.mark.cases(14)
@pytest.mark.parametrize("layout", ["sheets", "page"])
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_every_row_has_the_same_formula(name, layout):
    try:
        workbook, plan = once(name, layout).layout, once(name, layout).plan
    except MechanismError:
        pytest.skip("no page can hold it")
    sheets = {sheet.title: sheet for sheet in workbook.sheets}
    for title, first, width in tables(plan):
        inputs = {(cell.row, cell.col) for cell in sheets[title].cells if isinstance(cell.content, float)}
        for fill in sheets[title].fills:
            if fill.col >= width or not fill.row < first + plan.rows or fill.row + fill.rows <= first:
                continue
            if (first, fill.col) not in inputs and not plan.mechanism.driver.values:
                assert (fill.row, fill.rows) == (first, plan.rows), (title, fill)


CASES = [("four-bar", "sheets"), ("four-bar", "page"), ("drag-link", "sheets"), ("drag-link", "page"),
         ("quick-return-lever", "sheets"), ("quick-return-lever", "page"), ("chebyshev", "sheets")]  # fmt: skip
FIXED = [("stephenson-iii-output", "sheets"), ("engine", "sheets")]
"""Of Newton's method, whose links do not reach much farther, and with a flywheel, which needs a whole turn."""


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "layout"), [*CASES, *FIXED])
def test_the_first_row_filled_down_over_the_table(name, layout):
    made = once(name, layout)
    plan, workbook = made.plan, made.layout
    for title, first, width in tables(plan):
        workbook = filled_down(workbook, title, first, first + plan.rows - 1, width)
    values = evaluate(book_of(workbook))
    found = columns(plan, values, plan.at.first, plan.rows)
    same(found, values_of(name, layout), plan)
    as_the_reference(plan, found)
    assert line(plan, values) == line(plan, evaluate(book_of(made.layout)))


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "layout"), CASES)
def test_the_last_row_filled_further_down(name, layout):
    made = once(name, layout)
    plan, workbook = made.plan, made.layout
    for title, first, width in tables(plan):
        last = first + plan.rows - 1
        workbook = filled_down(workbook, title, last, last + MORE, width)
    values = evaluate(book_of(workbook))
    found = columns(plan, values, plan.at.first, plan.rows + MORE)
    same(found, values_of(name, layout, plan.rows + MORE), plan)
    as_the_reference(plan, found)
    if layout == "page":
        assert f" {plan.rows + MORE} positions" in line(plan, values)
    else:
        assert line(plan, values) == line(plan, evaluate(book_of(made.layout)))


def inserted(plan, workbook, place, count=MORE):
    """Rows inserted before row `place` of each table, and the row above them filled down over them and the next one."""
    for title, first, width in tables(plan):
        workbook = moved(workbook, title, Shift(first + place, count))
        workbook = filled_down(workbook, title, first + place - 1, first + place + count, width)
    return workbook


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "layout"), CASES)
def test_rows_inserted_at_three_places(name, layout):
    made = once(name, layout)
    plan, workbook = made.plan, made.layout
    rows = plan.rows
    for place in (1, plan.rows // 2, plan.rows - 1):
        workbook = inserted(plan, workbook, place + rows - plan.rows)
        rows += MORE
    values = evaluate(book_of(workbook))
    found = columns(plan, values, plan.at.first, rows)
    same(found, values_of(name, layout, rows), plan)
    as_the_reference(plan, found)
    longer = once(name, layout, rows)
    assert line(plan, values) == line(longer.plan, evaluate(book_of(longer.layout)))


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_a_mean_counts_rows_inserted_below_the_first(layout):
    """The halves of neighbouring rows were of different lengths then, and the mean #N/A."""
    made = once("six-link-dwell", layout)
    plan = made.plan
    values = evaluate(book_of(inserted(plan, made.layout, 1)))
    (mean,) = (each for each in plan.mechanism.summaries if each.symbol == "mean")
    spot, shown = plan.at.spots[mean.of], plan.places.summaries["mean"]
    column = np.array([values.get(spot.sheet, spot.row + row, spot.col) for row in range(plan.rows + MORE)], float)
    wanted = np.mean((column[1:] + column[:-1]) / 2)
    assert values.get(shown.sheet, shown.row, shown.col) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_rows_inserted_over_the_first(layout):
    """They come before the start: nothing is said of them, and what is said of the others stays."""
    made = once("drag-link", layout)
    plan, workbook = made.plan, made.layout
    for title, first, _ in tables(plan):
        workbook = moved(workbook, title, Shift(first, 2))
    values = evaluate(book_of(workbook))
    same(columns(plan, values, plan.at.first + 2, plan.rows), values_of("drag-link", layout), plan)
    assert line(plan, values) == line(plan, evaluate(book_of(made.layout)))


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "tr"])
def test_rows_inserted_in_one_sheet_alone_are_told(language):
    """The other sheets would say what they say of other rows."""
    made = Compiled(loads(template_text("quick-return-lever"), overrides=Overrides(language=language)))
    plan, workbook = made.plan, made.layout
    place, (title, first, width) = 9, tables(plan)[0]
    workbook = filled_down(moved(workbook, title, Shift(first + place, MORE)), title, first + place - 1,
                           first + place + MORE, width)  # fmt: skip
    values = evaluate(book_of(workbook))
    said = line(plan, values)
    assert said == plan.text("verdict.gap.apart", notes=plan.at.titles["notes"])
    assert values.get(plan.main, plan.blocks["verdicts"].rows["largest_gap"], MEANING) == said
    workbook = inserted(plan, made.layout, place)
    assert str(plan.rows + MORE) in line(plan, evaluate(book_of(workbook)))
