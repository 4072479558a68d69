"""Columns that read each other row by row: what the interpreter gives cell by cell, bit for bit, and by a loop over rows."""

import math

import numpy as np
import pytest
from drawn_trees import numeric, plain, same, values
from hypothesis import given, settings
from hypothesis import strategies as st

from chosen import examples
from livesheet.engine import FAST, PORTABLE, compile_book
from livesheet.engine.fast import scalars
from livesheet.engine.fast.lowered_functions import UFUNCS
from livesheet.engine.kernels.math import rounded, rounded_one
from livesheet.engine.ordering import row_by_row as row_by_row_module
from livesheet.engine.ordering import schedule as schedule_module
from livesheet.engine.ordering.cell_by_cell import Together
from livesheet.engine.ordering.row_by_row import RowByRow
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Binary, Boolean, Call, CellRef, ErrorValue, Number, RangeRef, Text
from livesheet.formula.parser import parse_formula

ROWS, FIRST, ELSEWHERE = 14, 3, 5
"""Rows of the set; its first row on sheet S, and on sheet T."""

# S!A and T!A hold data; S!B, S!C, T!B, T!C are the set; S!H1, S!H2 single cells.
singles = st.builds(lambda row: CellRef(row, 7, True, True, "S"), st.integers(0, 1))
data = st.just(CellRef(FIRST, 0, sheet="S")) | st.just(CellRef(ELSEWHERE - 1, 0, sheet="T"))
above = st.builds(
    lambda up, col, there: CellRef(ELSEWHERE - up, col, sheet="T") if there else CellRef(FIRST - up, col, sheet="S"),
    st.sampled_from([1, 1, 1, 2, 3]),
    st.integers(1, 2),
    st.booleans(),
)
numbers = st.sampled_from([0.0, 1.0, 2.0, 0.5, 1e-12, 1e308, 90.0, 12.0]).map(Number)
odd = st.sampled_from([Text("abc"), Text("3"), Text(""), Boolean(True), ErrorValue("#N/A"), ErrorValue("#REF!")])


def trees(cells):
    """Formulas over some cells, with what a loop of floats cannot say among it."""
    leaves = cells | above | above | above | data | singles | numbers
    window = st.builds(lambda up: RangeRef(CellRef(FIRST - up, 1, sheet="S"), CellRef(FIRST - 1, 1, sheet="S")),
                       st.integers(1, 3))  # fmt: skip

    def deeper(below):
        return (
            numeric(below, above)
            | st.builds(lambda c, a, b: Call("IF", (Binary("<", c, a), a, b)), below, below, below | odd)
            | st.builds(lambda a, b: Call("IF", (Call("ISERROR", (a,)), b, a)), above, below)
            | st.builds(lambda a, b: Call("IF", (Binary("=", a, Text("")), Text(""), b)), above | odd, below)
            | st.builds(lambda name, a, b: Call(name, (a, b)), st.sampled_from(["IFERROR", "IFNA"]), below, below)
            | st.builds(lambda a: Call("ROUND", (a, Number(-1.0))), below)
            | st.builds(lambda w: Call("SUM", (w,)), window)
            | st.builds(lambda a, b: Binary("&", a, b), below, odd)
        )

    return st.recursive(leaves, deeper, max_leaves=7)


first, second, third = (CellRef(FIRST, 1, sheet="S"), CellRef(ELSEWHERE, 1, sheet="T"), CellRef(FIRST, 2, sheet="S"))
formulas = st.tuples(
    trees(st.nothing()), trees(st.just(first)), trees(st.sampled_from([first, second])), trees(st.just(third))
)
starts = st.lists(plain | plain | values, min_size=4, max_size=4)
columns = st.lists(plain, min_size=ROWS + 1, max_size=ROWS + 1) | st.lists(values, min_size=ROWS + 1, max_size=ROWS + 1)


def book_of(four, column, other, start, single, short):
    builder = BookBuilder()
    sheet, there = builder.sheet("S"), builder.sheet("T")
    sheet.constants.extend(FIRST, 0, column[:ROWS])
    there.constants.extend(ELSEWHERE - 1, 0, other)
    for row, value in enumerate(single):
        sheet.constant(row, 7, value)
    for place, (where, row, col) in zip(start, ((sheet, FIRST, 1), (there, ELSEWHERE, 1), (sheet, FIRST, 2),
                                                (there, ELSEWHERE, 2)), strict=True):  # fmt: skip
        if place is not None:
            where.constant(row - 1, col, place)
    sheet.block(FIRST, 1, ROWS, 1, four[0])
    there.block(ELSEWHERE, 1, ROWS, 1, four[1])
    sheet.block(FIRST, 2, ROWS - short, 1, four[2])
    there.block(ELSEWHERE, 2, ROWS, 1, four[3])
    return builder.build()


def cell_by_cell(book, arithmetic=FAST):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(schedule_module, "row_by_row", lambda *_: None)
        return compile_book(book, arithmetic).evaluate()


@pytest.mark.slow
@settings(max_examples=examples(250), deadline=None)
@given(formulas, columns, columns, starts, st.tuples(plain, values), st.sampled_from([0, 0, 0, 1, 4]), st.booleans(),
       st.sampled_from([FAST, PORTABLE]))  # fmt: skip
def test_row_by_row_equals_the_interpreter(four, column, other, start, single, short, slow, arithmetic):
    book = book_of(four, column, other, start, single, short)
    expected = cell_by_cell(book, arithmetic)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(row_by_row_module, "_FEW_CELLS", 0)
        patch.setattr(row_by_row_module, "_FEW_ROWS", ROWS if slow else 0)  # only values of any kind, or floats first
        patch.setattr(row_by_row_module, "_FEW_SLOW", 0)
        patch.setattr(row_by_row_module, "_FIRST_ROWS", 5)
        same(compile_book(book, arithmetic).evaluate(), expected)


def lines_book(rows, *texts, start=1.0):
    """Columns A, B, ... from row 2 on, formulas as seen from there; a start above each."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, text in enumerate(texts):
        sheet.constant(0, col, start)
        sheet.block(1, col, rows, 1, parse_formula(text))
    return builder.build()


def steps_of(plan, kind):
    return [step for step in plan.steps if isinstance(step, kind)]


def taken(book):
    """Values by the loop of floats alone, which must be the interpreter's."""
    plan = compile_book(book)
    (step,) = steps_of(plan, RowByRow)
    plan.evaluate()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(row_by_row_module._Part, "_row", lambda *_: pytest.fail("a row was not computed as floats"))
        values = plan.evaluate()
    same(values, cell_by_cell(book))
    return step, values


def test_a_filter_is_one_loop():
    step, _ = taken(lines_book(40, "A1+B1/8", "B1-(C2-1)/4", "SIN(A2)+D1/2", "ROUND(C2,3)"))
    assert [len(part.lines) for part in step.parts] == [4]


def test_a_text_that_a_formula_asks_for_stops_no_loop():
    taken(lines_book(40, 'IF(B1="","",B1-5)', 'IF(A2="","",A2*0.9)', start=1e4))


def test_sheets_that_read_each_other_row_by_row_and_start_in_different_rows():
    """Iterations start from the positions of the row above, which follow from the iterations of that row."""
    builder = BookBuilder()
    positions, steps = builder.sheet("Positions"), builder.sheet("Iterations")
    positions.constants.extend(8, 0, [0.01 * n for n in range(60)])
    positions.constant(7, 1, 0.739)
    positions.block(8, 1, 60, 1, parse_formula("Iterations!B5+0"))
    steps.block(
        4, 0, 60, 1, parse_formula("Positions!B8-(Positions!B8-COS(Positions!B8)-Positions!A9)/(1+SIN(Positions!B8))")
    )
    steps.block(4, 1, 60, 1, parse_formula("A5-(A5-COS(A5)-Positions!A9)/(1+SIN(A5))"))
    _, values = taken(builder.build())
    for angle, found in zip(values.column("Positions", 0, 8, 67), values.column("Positions", 1, 8, 67), strict=True):
        assert found - math.cos(found) == pytest.approx(angle, abs=1e-9)


def test_a_field_whose_rows_follow_from_the_row_above():
    """Heat in a rod: each cell from three cells above."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col in range(12):
        sheet.constant(0, col, float(col == 6))
    sheet.constants.extend(1, 0, [0.0] * 30)
    sheet.constants.extend(1, 11, [0.0] * 30)
    sheet.block(1, 1, 30, 10, parse_formula("B1+(A1+C1-2*B1)/4"))
    taken(builder.build())


def test_columns_of_different_heights():
    """A balance whose first row is an amount, beside the interest of all rows; the balance ends two rows later."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 0, 1000.0)
    sheet.block(1, 0, 32, 1, parse_formula("A1+B1-7"))
    sheet.block(0, 1, 31, 1, parse_formula("A1*0.01"))
    book = builder.build()
    same(compile_book(book).evaluate(), cell_by_cell(book))
    assert steps_of(compile_book(book), RowByRow)


def test_rows_after_an_error_and_after_the_end_of_a_loan():
    """Errors last; texts are told from numbers; numbers come back."""
    texts = ['IF(B1="","",B1-5)', 'IF(A2="","",IF(A2<=0,"",A2+IFERROR(C1,0)/9))',
             "IF(ISERROR(C1),1,1/(MOD(ROW(),7)+0*A2))"]  # fmt: skip
    book = lines_book(80, *texts, start=200.0)
    plan = compile_book(book)
    expected = cell_by_cell(book)
    for _ in range(2):
        same(plan.evaluate(), expected)
    assert {"", ErrorValue("#DIV/0!"), ErrorValue("#VALUE!"), 1.0} <= {
        value for col in range(3) for value in expected.column("S", col, 1, 80)
    }


def test_an_input_that_is_a_text_and_back():
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 3, 2.0)
    sheet.constant(0, 0, 1.0)
    sheet.constant(0, 1, 1.0)
    sheet.block(1, 0, 50, 1, parse_formula("A1/2+B1"))
    sheet.block(1, 1, 50, 1, parse_formula("A2/$D$1"))
    plan = compile_book(builder.build())
    numbers = plan.evaluate()
    assert plan.evaluate({("S", 0, 3): "x"}).get("S", 50, 0) == ErrorValue("#VALUE!")
    same(plan.evaluate(), numbers)


def test_a_circle_is_still_a_circle():
    plan = compile_book(lines_book(20, "A1+B2", "A2+B1"))
    assert not steps_of(plan, RowByRow)
    assert steps_of(plan, Together)
    assert plan.evaluate().get("S", 5, 0) == ErrorValue("#REF!")


bits = st.floats(allow_nan=False, allow_infinity=False, width=64) | st.floats(-10, 10)


@settings(max_examples=examples(60), deadline=None)
@given(bits, bits, st.integers(1, 307), st.booleans(), st.sampled_from([3.0, 0.5, -1.0, 1 / 3, -2.5]))
def test_single_numbers_have_the_bits_of_arrays(x, y, digits, before, exponent):
    places = -digits if before else digits
    with np.errstate(all="ignore"):
        cases = [
            (scalars.scalar(op), getattr(np, op)(x), (x,)) for op in UFUNCS.values() if op not in ("sign", "floor")
        ]
        cases += [
            (scalars.scalar("arctan2"), np.arctan2(y, x), (y, x)),
            (scalars.scalar_power(exponent, FAST), np.power(np.float64(x), np.float64(exponent)), (x,)),
            (scalars.sign, np.sign(x), (x,)),
            (scalars.trunc, np.trunc(x), (x,)),
            (lambda x: rounded_one(x, places), rounded(np.float64(x), places), (x,)),
        ]  # fmt: skip
        for function, expected, numbers in cases:
            try:
                found = function(*numbers)
            except (ValueError, ArithmeticError):
                assert not np.isfinite(expected)
            else:
                assert np.array_equal(found, expected, equal_nan=True)
