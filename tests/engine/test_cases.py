"""Every function and operator against the case files: alone, in a column, the second time (on the fast path), and when cells
that are interpreted have code of their own."""

import pytest

from engine_cases import COLUMN, FILES, FIRST_ROW, anchored, array_cases, book_of, cases, same
from livesheet.engine import compile_book, evaluate
from livesheet.engine.fast.segments import _INTERPRETED
from livesheet.engine.kernels.table import kernels_in
from livesheet.formula.book import BookBuilder
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.nodes import Call, shifted, walk
from livesheet.formula.parser import parse_formula

CASES = cases()


@pytest.fixture(scope="module")
def evaluations():
    plan = compile_book(book_of([formula for _, formula, _ in CASES]))
    values = [plan.evaluate() for _ in range(_INTERPRETED + 2)]
    return {"first": values[0], "second": values[1], "later": values[-1]}


@pytest.mark.slow
@pytest.mark.parametrize("time", ["first", "second", "later"])
@pytest.mark.parametrize("file", [path.stem for path in FILES])
def test_cases(evaluations, file, time):
    values = evaluations[time]
    wrong = [
        (formula, value, values.get("S", row, COLUMN))
        for row, (stem, formula, value) in enumerate(CASES, FIRST_ROW)
        if stem == file and not same(values.get("S", row, COLUMN), value)
    ]
    assert wrong == [], time


@pytest.mark.cases(6)
@pytest.mark.parametrize("file", [path.stem for path in FILES])
def test_cases_filled_down_and_right(file):
    """The same values when a formula fills a block of 3 x 2."""
    chosen = [(formula, value) for stem, formula, value in CASES if stem == file]
    book = book_of([])
    sheet = book.sheets[0]
    for index, (formula, _) in enumerate(chosen):
        sheet.block(FIRST_ROW + 4 * index, COLUMN, 3, 2, anchored(parse_formula(formula)))
    plan = compile_book(book)
    for _ in range(2):
        values = plan.evaluate()
        for index, (formula, value) in enumerate(chosen):
            for row in range(3):
                for col in range(2):
                    found = values.get("S", FIRST_ROW + 4 * index + row, COLUMN + col)
                    assert same(found, value), (formula, row, col, found)


def test_every_function_has_cases():
    formulas = [formula for _, formula, _ in [*CASES, *array_cases()]]
    used = {part.name for formula in formulas for part in walk(parse_formula(formula)) if isinstance(part, Call)}
    written_otherwise = {"SINGLE", "ANCHORARRAY"}  # @A1:A9, A1#: test_arrays.py
    assert set(FUNCTIONS) - used - written_otherwise == set()


def test_the_tables_of_functions_and_kernels_have_the_same_names():
    for module in {row.module for row in FUNCTIONS.values()}:
        assert sorted(kernels_in(module)) == sorted(row.name for row in FUNCTIONS.values() if row.module == module)


MOVING = (
    "SUM(A1:B3)", "SUM(A$1:A1)", "MAX($A1:B1)", "INDEX(A1:B3,2,2)", "COUNTIF(A1:A3,A1)", "SUM(A1:A1048576)",
    "AND(A1:B1>0)", "SUMPRODUCT(A1:A3,B1:B3)", "LARGE(A1:B2,2)", "MATCH(3,A1:A5,1)", "AVERAGE(B$1:B$9,A1)",
    "SUM(A1:B2 B1:C3)", "SUM((A1:A2,B$1))", "ROW(A2)+COLUMN(B1)", "ROWS(A$1:A1)", "A1:A9+1", "VLOOKUP(5,A$1:B$5,2,FALSE)",
)  # fmt: skip


@pytest.mark.parametrize("formula", MOVING)
def test_ranges_that_move_with_the_cell(formula):
    """Windows, growing ranges and fixed ones, filled down and right, are what each cell by itself gives."""
    node = parse_formula(formula)
    together, alone = BookBuilder(), BookBuilder()
    sheets = [builder.sheet("S") for builder in (together, alone)]
    for sheet in sheets:
        for col, column in enumerate([[3, 5, 5, 9, 2], [1, 9, 3, 7, 3], [4, 2, 5, 9, 8], [1, 6, 8, 3, 4]]):
            sheet.constants.extend(0, col, [float(value) for value in column])
    sheets[0].block(0, 10, 4, 2, node)
    for row in range(4):
        for col in range(2):
            sheets[1].block(row, 10 + col, 1, 1, shifted(node, row, col))
    ours, theirs = evaluate(together.build()), evaluate(alone.build())
    for row in range(4):
        for col in range(2):
            assert same(ours.get("S", row, 10 + col), theirs.get("S", row, 10 + col)), (row, col)
