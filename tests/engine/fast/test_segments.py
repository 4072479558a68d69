"""The fast path gives what the interpreter gives, bit for bit, and is really taken."""

import numpy as np
import pytest
from drawn_trees import FIRST, ROWS, columns, data_refs, numbers, numeric, plain, refs, values
from hypothesis import given, settings
from hypothesis import strategies as st

from chosen import examples
from livesheet.engine import FAST, PORTABLE, compile_book
from livesheet.engine.fast import segments as segments_module
from livesheet.engine.fast.segments import Segment
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Binary, Call, CellRef, ErrorValue, Number
from livesheet.formula.parser import parse_formula

data_trees = st.recursive(data_refs | data_refs | numbers, lambda below: numeric(below, data_refs), max_leaves=8)
trees = st.recursive(refs | refs | numbers, lambda below: numeric(below, refs), max_leaves=8)


def same(first, second):
    """Values of two evaluations are equal to the last bit (a zero's sign apart)."""
    assert np.array_equal(first._codes, second._codes)
    good = first._codes == 0
    assert np.array_equal(first._numbers[good], second._numbers[good])


def never(*_):
    raise AssertionError("the interpreter was used")


@pytest.mark.slow
@settings(max_examples=examples(300), deadline=None, report_multiple_bugs=False)
@given(
    st.lists(columns, min_size=3, max_size=3),
    st.tuples(plain, values),
    data_trees,
    trees,
    trees,
    st.sampled_from(["", "sum", "held"]),
    st.sampled_from([FAST, PORTABLE]),
)
def test_fast_equals_the_interpreter(data, singles, first, second, third, recurrence, arithmetic):
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, column in enumerate(data):
        sheet.constants.extend(FIRST - 1, col, column)
    for row, value in enumerate(singles):
        sheet.constant(row, 7, value)
    sheet.block(FIRST, 3, ROWS, 1, first)
    sheet.block(FIRST, 4, ROWS, 1, second)
    sheet.block(0, 9, 1, 1, parse_formula("SUM(D4:D10)+MAX(E4:E10)"))
    sheet.block(1, 9, 1, 1, parse_formula('IF(H1>0,"up","down")'))
    sheet.block(2, 9, 1, 1, parse_formula("J2"))
    sheet.block(FIRST, 10, ROWS, 1, parse_formula('IF(A4>B4,"more","less")'))
    sheet.block(FIRST, 11, ROWS, 1, parse_formula("IF(AND(ISTEXT(K4),ISTEXT($J$3)),MAX(B3,B5)+COUNT(C2,C4),K4)"))
    sheet.block(0, 10, 1, 3, parse_formula("INDEX($K$4:$K$10,ABS(A3)+1)"))
    sheet.block(1, 10, 1, 3, parse_formula("MAX(A$4:A$10)+$H$1"))
    sheet.block(FIRST, 6, ROWS, 3, parse_formula("$D4*G$3-$E4"))
    sheet.constants.extend(2, 6, [1.5])
    sheet.constants.extend(2, 8, [2.5])
    sheet.constant(2, 5, 1.0)
    above = CellRef(FIRST - 1, 5)
    formula = {
        "": third,
        "sum": Binary("+", above, third),
        "held": Call("IF", (Binary(">", third, Number(0)), second, above)),
    }[recurrence]
    sheet.block(FIRST, 5, ROWS, 1, formula)
    plan = compile_book(builder.build(), arithmetic)
    same(plan.evaluate(), plan.evaluate())


@pytest.fixture
def small_chunks(monkeypatch):
    monkeypatch.setattr(segments_module, "CHUNK", 256)


def four_columns(rows, extra=()):
    """start + n*step, a sine, a running sum and a held value; `extra` are further columns."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [0.25, 0.125])
    texts = ["$A$1+ROW()*$A$2", "SIN(B5)", "D4+ROUND(C5*3,0)", "IF(C5>0.5,B5,E4)", *extra]
    sheet.constant(3, 3, 0.0)
    sheet.constant(3, 4, 0.0)
    sheet.constant(3, 5, 0.0)
    for col, text in enumerate(texts, 1):
        sheet.block(4, col, rows, 1, parse_formula(text))
    return builder.build()


@pytest.mark.parametrize("rows", [1, 2, 255, 256, 257, 1000])
def test_chunks(rows, small_chunks, monkeypatch):
    plan = compile_book(four_columns(rows))
    interpreted = plan.evaluate()
    if rows > 1:
        monkeypatch.setattr(Segment, "_interpreted", never)
    same(interpreted, plan.evaluate())


def test_rows_around_an_error_are_computed_interpreted_and_the_others_fast(small_chunks, monkeypatch):
    plan = compile_book(four_columns(1000, ["1/(ROW()-400)", "F5+D5", "F4+1"]))
    interpreted = plan.evaluate()
    ranges = []
    original = Segment._interpreted

    def noted(segment, ev, dirty, start, stop):
        if segment.rows > 1:
            ranges.append((start, stop))
        original(segment, ev, dirty, start, stop)

    monkeypatch.setattr(Segment, "_interpreted", noted)
    fast = plan.evaluate()
    same(interpreted, fast)
    assert fast.get("S", 399, 5) == ErrorValue("#DIV/0!")
    assert ranges
    assert all(start <= 395 < stop <= start + 64 for start, stop in ranges)


def test_rows_of_a_large_chunk_are_tried_in_parts(monkeypatch):
    """One row in 30,000 that has no value, and a sum that is snapped, in a column of several chunks."""
    rows = 30_000
    plan = compile_book(four_columns(rows, [f"1/(ROW()-{rows // 2})", "(ROW()/10)-0.1-(ROW()-1)/10", "G5-F5*0"]))
    interpreted = plan.evaluate()
    ranges = []
    original = Segment._interpreted

    def noted(segment, ev, dirty, start, stop):
        ranges.append(stop - start)
        original(segment, ev, dirty, start, stop)

    with monkeypatch.context() as patch:
        patch.setattr(Segment, "_fast", lambda *_: False)
        expected = plan.evaluate()
    same(interpreted, expected)
    monkeypatch.setattr(Segment, "_interpreted", noted)
    same(expected, plan.evaluate())
    assert 0 < sum(ranges) <= 3 * 4096
    zeros = plan.evaluate().column("S", 6, 4, rows + 3)
    assert 0.0 in zeros


def test_a_running_sum_that_cancels_is_snapped_in_each_row():
    """-0.3 + 0.1 + 0.1 + 0.1 ends at exactly 0, as it does in cells that snap one by one."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constant(0, 0, -0.3)
    sheet.block(1, 0, 6, 1, parse_formula("A1+0.1"))
    plan = compile_book(builder.build())
    for _ in range(2):
        assert plan.evaluate().column("S", 0, 3, 4) == [0.0, 0.1]


def test_a_status_column_is_a_text_without_leaving_the_fast_path(monkeypatch):
    plan = compile_book(four_columns(300, ['IF(ISNUMBER(C5),"ok","does not close")', "IF(ISNUMBER(C5),1,0)"]))
    plan.evaluate()
    monkeypatch.setattr(Segment, "_interpreted", never)
    values = plan.evaluate()
    assert set(values.column("S", 5, 4, 303)) == {"ok"}
    assert set(values.column("S", 6, 4, 303)) == {1.0}


def test_other_inputs_another_way(monkeypatch):
    """An input that is no number sends what reads it to the interpreter, and back."""
    plan = compile_book(four_columns(300))
    numbers = plan.evaluate()
    wrong = plan.evaluate({("S", 0, 0): "x"})
    assert wrong.get("S", 4, 1) == ErrorValue("#VALUE!")
    assert plan.evaluate({("S", 0, 0): True}).get("S", 4, 1) == 1 + 5 * 0.125
    same(numbers, plan.evaluate())
    monkeypatch.setattr(Segment, "_interpreted", never)
    same(numbers, plan.evaluate())
