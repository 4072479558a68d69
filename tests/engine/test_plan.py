"""Books as a whole: order, recurrences, circles, names, overrides, what is refused."""

import math

import numpy as np
import pytest

from livesheet.diagnostics import WorkbookError
from livesheet.engine import compile_book, evaluate
from livesheet.engine.kernels.table import KERNELS
from livesheet.engine.ordering.row_by_row import RowByRow
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue, Symbol, shifted
from livesheet.formula.parser import parse_formula

NA, DIV0, VALUE, NUM, NAME, REF = map(ErrorValue, ("#N/A", "#DIV/0!", "#VALUE!", "#NUM!", "#NAME?", "#REF!"))


def book(columns, blocks, names=()):
    """A sheet S: `columns` are constants from row 1 on by letter, `blocks` formulas by area."""
    builder = BookBuilder("book.xlsx")
    sheet = builder.sheet("S")
    for letter, values in columns.items():
        sheet.constants.extend(0, ord(letter) - 65, values)
    for area, text in blocks.items():
        first, _, last = area.partition(":")
        last = last or first
        row, col = int(first[1:]) - 1, ord(first[0]) - 65
        sheet.block(row, col, int(last[1:]) - row, ord(last[0]) - 64 - col, parse_formula(text))
    for name, text in names:
        builder.name(name, parse_formula(text))
    return builder.build()


def column(values, letter, first, last):
    return values.column("S", ord(letter) - 65, first - 1, last - 1)


def test_order_is_found_whatever_the_order_of_the_blocks():
    plan = compile_book(book({"A": [2.0]}, {"E1": "D1*2", "D1": "C1+1", "C1": "B1*B1", "B1": "A1+1"}))
    assert plan.evaluate().get("S", 0, 4) == 20.0


# --- columns that read their own previous row ------------------------------------------------------------------------

RECURRENCES = (
    "A1+B2", "B2+A1", "A1-B2", "IF(B2>0,B2,A1)", "IF(B2>0,A1,B2)", "A1*0.5+B2", "A1+B2+1", "IF(B2>0,A1+1,A1)",
    "MAX(A1,B2)", "SUM(A$1:A1)", "A1&B2", "IF(A1>3,B2,A1)", "B2+3*IFERROR(ROUND((A1-B2)/3,0),0)",
    "B2+2*PI()*IFERROR(ROUND((A1-B2)/(2*PI()),0),0)", "B2+3*IFERROR(ROUND((A1-B2)/2,0),0)", "N(A1)+B2", "B2+N(A1)",
    "N(A1)-B2", "B2+3*IFERROR(ROUND((N(A1)-B2)/3,0),0)", "N(A1+1)+B2", "IF(B2>0,B2,N(A1))",
)  # fmt: skip

DATA = {
    "numbers": [0.1, 0.2, -0.3, 5.0, -5.0, 1e-17, 3.0],
    "errors": [1.0, NA, 2.0, DIV0, 3.0, 4.0, NA],
    "kinds": [1.0, "x", True, None, "3", -1.0, 2.0],
    "half turns": [1.5, 0.0, -1.5, 3.0, 4.5, 6.0, 1.5],
    "turns": [3.0, 0.1, 2.9, 0.2, -2.8, 0.0, 2.7],
    "overflow": [1e308, 1e308, 1e308, -1e308, NA, 1.0, 1.0],
}


@pytest.mark.cases(145)
@pytest.mark.parametrize("start", [0.0, -0.3, "x", NA, None, True, "7"], ids=str)
@pytest.mark.parametrize("data", DATA)
@pytest.mark.parametrize("formula", RECURRENCES)
def test_recurrences_are_what_each_cell_by_itself_gives(formula, data, start):
    values = {"A": [start], "B": [0.0, *DATA[data]]}
    rows = len(DATA[data])
    filled = book(values, {f"A2:A{rows + 1}": formula})
    plan = compile_book(filled)
    alone = book(values, {})
    for row in range(rows):
        alone.sheets[0].block(row + 1, 0, 1, 1, shifted(parse_formula(formula), row))
    expected = column(evaluate(alone), "A", 1, rows + 1)
    for _ in range(2):
        assert column(plan.evaluate(), "A", 1, rows + 1) == expected


def test_a_long_recurrence():
    rows = 100_000
    plan = compile_book(book({"A": [0.0]}, {f"A2:A{rows}": "A1+0.001"}))
    numbers, codes = plan.evaluate().arrays("S", 0, 0, rows - 1)
    assert not codes.any()
    assert np.array_equal(numbers, np.add.accumulate(np.r_[0.0, np.full(rows - 1, 0.001)]))


def test_columns_that_read_each_other():
    """Fibonacci's and Lucas's numbers, each from the other's previous row."""
    plan = compile_book(book({"A": [1.0], "B": [0.0]}, {"A2:A9": "A1+B1", "B2:B9": "A1"}))
    assert any(isinstance(step, RowByRow) for step in plan.steps)
    for _ in range(2):
        assert column(plan.evaluate(), "A", 1, 9) == [1, 1, 2, 3, 5, 8, 13, 21, 34]


def test_a_column_that_reads_the_row_below():
    assert column(evaluate(book({"B": [1.0, 2, 3, 4]}, {"A1:A4": "A2+B1"})), "A", 1, 4) == [10, 9, 7, 4]


def test_a_table_that_reads_above_and_left():
    """Pascal's triangle, filled down and right."""
    values = evaluate(book({"A": [1.0] * 5}, {"B1:E1": "1", "B2:E5": "A2+B1"}))
    assert column(values, "E", 1, 5) == [1, 5, 15, 35, 70]


def test_a_circle_is_remarked_with_its_cells():
    blocks = {"A1": "C1+1", "B1": "A1", "C1": "B1", "D1": "A1+1", "E1": "IFERROR(A1,5)", "F1": "2"}
    values = evaluate(book({}, blocks))
    assert [str(fault) for fault in values.remarks] == [
        "book.xlsx: S!A1: circular reference: S!A1 -> S!C1 -> S!B1 -> S!A1"
    ]
    assert [values.get("S", 0, col) for col in range(6)] == [REF, REF, REF, REF, 5, 2]
    values = evaluate(book({}, {"A3": "SUM(A1:A5)"}))
    assert [fault.message for fault in values.remarks] == ["circular reference: S!A3 -> S!A3"]
    plan = compile_book(book({"A": [1.0]}, {"A2:A9": "B2+A1", "B2:B9": "A2"}))
    for _ in range(2):
        values = plan.evaluate()
        assert values.remarks[0].message == "circular reference: S!A2 -> S!B2 -> S!A2"
        assert values.get("S", 8, 0) == REF


@pytest.mark.slow
def test_a_column_of_circles():
    values = evaluate(book({}, {"A1:A5000": "A1+1", "B1": "1"}))
    assert len(values.remarks) == 20
    assert values.remarks[-1].message.endswith("(and more of them)")
    assert values.get("S", 4999, 0) == REF


# --- names ----------------------------------------------------------------------------------------------------------


def test_names():
    names = [("rate", "S!$A$1"), ("twice", "RATE*2"), ("all", "S!$A$1:$A$3"), ("beside", "S!B1"), ("tau", "2*PI()")]
    blocks = {"C1": "Rate+1", "C2": "twice", "C3": "SUM(all)", "C4:C5": "A1+tau*0+1", "D2:D3": "beside"}
    values = evaluate(book({"A": [3.0, 4.0, 5.0], "E": [7.0, 8.0, 9.0]}, blocks, names))
    assert column(values, "C", 1, 5) == [4, 6, 12, 4, 5]
    # relative to A1 the name means the next column: from D2, that is E2
    assert column(values, "D", 2, 3) == [8, 9]


def test_a_sheet_has_names_of_its_own():
    builder = BookBuilder()
    first, second = builder.sheet("One"), builder.sheet("Two")
    first.constant(0, 0, 1.0)
    second.constant(0, 0, 2.0)
    builder.name("x", parse_formula("One!$A$1"))
    builder.name("x", parse_formula("Two!$A$1"), "Two")
    for sheet in (first, second):
        sheet.block(1, 0, 1, 1, parse_formula("x"))
        sheet.block(2, 0, 1, 1, parse_formula("Two!x+'ONE'!A1"))
    values = evaluate(builder.build())
    assert [values.get(title, row, 0) for title in ("One", "Two") for row in (1, 2)] == [1, 3, 2, 3]


def test_a_sheet_that_does_not_exist():
    assert evaluate(book({}, {"A1": "Nowhere!A1", "A2": "SUM(Nowhere!A1:B2)"})).get("S", 0, 0) == ErrorValue("#REF!")


# --- what is refused ------------------------------------------------------------------------------------------------


def test_all_unknown_things_are_reported_with_their_cells():
    wrong = book({}, {"A1:A3": "FOO(1)+SIN(1,2)", "B1": "bar+1", "C1": "SINN(1)", "D1": "loop", "E1": "IF(1,2,3,4)"},
                 [("loop", "pool"), ("pool", "LOOP+1"), ("bart", "1")])  # fmt: skip
    plan = compile_book(wrong)
    assert [(fault.key, fault.message, fault.hint) for fault in plan.remarks] == [
        ("S!A1:A3", "unknown function FOO", 'did you mean "FLOOR"?'),
        ("S!A1:A3", "SIN takes 1 argument, found 2", ""),
        ("S!B1", "unknown name bar", 'did you mean "bart"?'),
        ("S!C1", "unknown function SINN", 'did you mean "SIN"?'),
        ("S!D1", "the name loop stands for itself: loop -> pool -> loop", ""),
        ("S!E1", "IF takes 1 to 3 arguments, found 4", ""),
    ]
    assert all(fault.file == "book.xlsx" for fault in plan.remarks)
    values = plan.evaluate()
    assert values.remarks == plan.remarks
    assert [values.get("S", 0, col) for col in range(5)] == [NAME, NAME, NAME, NAME, VALUE]


def test_what_a_kernel_cannot_do_is_said_with_the_cell():
    values = evaluate(book({"A": [1.0]}, {"B2": 'CELL("color",A1)', "C2": "A1+1"}))
    assert [str(fault) for fault in values.remarks] == ['book.xlsx: S!B2: CELL("color") is not supported']
    assert [values.get("S", 1, col) for col in (1, 2)] == [VALUE, 2]


def test_two_things_in_one_cell():
    with pytest.raises(WorkbookError, match="S!A2: a cell that is filled twice"):
        compile_book(book({"A": [1.0, 2.0]}, {"A2:A3": "1"}))


def test_a_symbol_is_a_bug():
    builder = BookBuilder()
    builder.sheet("S").block(0, 0, 1, 1, Symbol("a"))
    with pytest.raises(TypeError, match="not bound to a cell"):
        compile_book(builder.build())


def _sine_of_sines(depth):
    found = 1.0
    for _ in range(depth):
        found = math.sin(1 + found)
    return found


@pytest.mark.parametrize(
    "text, value",
    [
        ("SIN(1+" * 60 + "1" + ")" * 60, _sine_of_sines(60)),
        ("IF(A1=1,2," * 60 + "3" + ")" * 60, 3),
        ("IF(A1=5,2," * 60 + "3" + ")" * 60, 2),
        ("-" * 61 + "A1", -5),
    ],
)
def test_deep_formulas(text, value):
    plan = compile_book(book({"A": [5.0]}, {"B1": text}))
    for _ in range(2):
        assert plan.evaluate().get("S", 0, 1) == pytest.approx(value, rel=1e-15)


@pytest.mark.slow
def test_a_sum_of_thousands_of_terms():
    plan = compile_book(book({"A": [1.0, 2.0]}, {"B1:B2": "+".join(["A1"] * 4000)}))
    for _ in range(2):
        assert column(plan.evaluate(), "B", 1, 2) == [4000, 8000]


@pytest.mark.slow
def test_a_sum_of_thousands_of_different_terms():
    plan = compile_book(book({"A": [5.0]}, {"B1": "+".join(f"A$1*{n}" for n in range(1, 3001))}))
    for _ in range(2):
        assert plan.evaluate().get("S", 0, 1) == 5 * 3000 * 3001 / 2


def test_thousands_of_formulas_that_stand_alone():
    """Segments have an end, so that one change does not mean all of them."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [float(row) for row in range(1000)])
    for row in range(1000):
        above = f"+B{row}" if row % 10 else ""
        sheet.block(row, 1, 1, 1, parse_formula(f"A{row + 1}*{row % 7}{above}"))
    plan = compile_book(builder.build())
    assert max(len(step.producers) for step in plan.steps) <= 64
    expected = 0.0
    for _ in range(2):
        values = plan.evaluate()
        for row in range(1000):
            expected = row * (row % 7) + (expected if row % 10 else 0.0)
            assert values.get("S", row, 1) == expected


# --- overrides and values -------------------------------------------------------------------------------------------


def test_overrides():
    plan = compile_book(book({"A": [1.0, 2.0, 3.0], "C": ["x"]}, {"B1:B3": "A1*10", "D1": "SUM(B1:B3)", "E1": "C1&1"}))
    assert plan.evaluate().get("S", 0, 3) == 60
    assert plan.evaluate({("s", 0, 0): 5.0}).get("S", 0, 3) == 100  # titles without regard to case
    assert plan.evaluate({("S", 0, 0): None}).get("S", 0, 3) == 50
    assert plan.evaluate({("S", 0, 0): "x"}).get("S", 0, 3) == VALUE
    assert plan.evaluate({("S", 0, 0): NA}).get("S", 0, 3) == NA
    assert plan.evaluate({("S", 0, 2): True}).get("S", 0, 4) == "TRUE1"
    # a formula's cell and an empty one
    values = plan.evaluate({("S", 1, 1): 7.0, ("S", 8, 8): "new"})
    assert (column(values, "B", 1, 3), values.get("S", 0, 3), values.get("S", 8, 8)) == ([10, 7, 30], 47, "new")
    assert plan.evaluate({("S", 1, 1): 8.0, ("S", 8, 8): "new"}).get("S", 0, 3) == 48
    assert plan.evaluate().get("S", 0, 3) == 60
    with pytest.raises(KeyError, match="no sheet called T"):
        plan.evaluate({("T", 0, 0): 1.0})


def test_an_override_in_the_middle_of_a_table():
    plan = compile_book(book({"A": [1.0, 2.0, 3.0]}, {"B1:D3": "$A1*COLUMN()", "E1:E3": "SUM(B1:D1)"}))
    values = plan.evaluate({("S", 1, 2): 100.0})
    assert column(values, "E", 1, 3) == [9, 4 + 100 + 8, 27]


def test_values():
    values = evaluate(book({"A": [1.5, "x", True, NA, None]}, {"B1:B5": "A1"}))
    assert column(values, "B", 1, 6) == [1.5, "x", True, NA, 0.0, None]
    assert values.get("S", 99, 99) is None
    numbers, codes = values.arrays("S", 1, 0, 5)
    assert np.array_equal(numbers, [1.5, np.nan, 1.0, np.nan, 0.0, np.nan], equal_nan=True)
    assert codes.tolist() == [0, 2, 3, 22, 0, 1]
    assert list(values.items("S"))[:2] == [(0, 0, 1.5), (1, 0, "x")]
    with pytest.raises(KeyError):
        values.get("T", 0, 0)


def test_evaluations_do_not_disturb_each_other():
    plan = compile_book(book({"A": [1.0, 2.0]}, {"B1:B2": "A1*2", "C1": '"n"&B1'}))
    first = plan.evaluate()
    second = plan.evaluate({("S", 0, 0): 9.0})
    assert (first.get("S", 0, 1), second.get("S", 0, 1)) == (2, 18)
    assert (first.get("S", 0, 2), second.get("S", 0, 2)) == ("n2", "n18")


def test_a_blank_result_is_zero_and_a_constant_keeps_its_kind():
    values = evaluate(book({"A": [None]}, {"B1": "A1", "B2": "A1&1", "B3": "TRUE"}))
    assert column(values, "B", 1, 3) == [0.0, "1", True]


def test_nothing():
    assert evaluate(BookBuilder().build()) is not None
    assert list(evaluate(book({}, {})).items("S")) == []


def test_names_nested_deeper_than_the_stack():
    names = [("level_0", "S!$A$1")]
    names += [(f"level_{n}", "IF(1=1," * 20 + f"level_{n - 1}+1" + ",0)" * 20) for n in range(1, 64)]
    values = evaluate(book({"A": [5.0]}, {"B1": "level_63", "B2": "down(900)"},
                           [*names, ("down", "LAMBDA(n,IF(n<1,0,1+down(n-1)))")]))  # fmt: skip
    assert column(values, "B", 1, 2) == [68, 900]
    assert values.remarks == ()


def test_cells_of_a_column_that_cannot_be_computed_leave_the_others_alone():
    what = ["row", "color", "col", "color"]
    blocks = {"B1:B4": "CELL(A1,A1)", "C2:C4": "C1+CELL(A1,A$1)", "D1:D4": "A$1:A$2&1", "E2:E4": "E1+F$1:F$3"}
    values = evaluate(book({"A": what, "C": [0.0], "E": [0.0], "F": [1.0, 2.0, 3.0]}, blocks))
    assert column(values, "B", 1, 4) == [1, VALUE, 1, VALUE]
    assert column(values, "C", 1, 4) == [0, 1, VALUE, VALUE]
    assert column(values, "D", 1, 4) == ["row1", "color1", VALUE, VALUE]
    assert column(values, "E", 1, 4) == [0, 2, 5, VALUE]
    assert [fault.key for fault in values.remarks] == ["S!B2", "S!B4", "S!C3"]


def test_a_fault_of_a_kernel_takes_one_cell(monkeypatch):
    def broken(ev, args, frame, spread):
        if float(np.ravel(ev.value(args[0], frame).numbers)[0]) == 2:
            raise IndexError("broken")
        return ev.value(args[0], frame)

    monkeypatch.setitem(KERNELS, "ABS", broken)
    values = evaluate(book({"A": [1.0, 2.0, 3.0]}, {"B1:B3": "ABS(A1)", "C1": "ABS(2)", "D1": "SUM(B1,B3)"}))
    assert column(values, "B", 1, 3) == [1, 2, 3]
    assert values.get("S", 0, 2) == VALUE
    assert values.get("S", 0, 3) == 4
    assert "not computed, by a fault of this program: IndexError: broken" in values.remarks[-1].message
