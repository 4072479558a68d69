"""Single cells and small blocks by code for values of any kind: what the interpreter gives, bit for bit."""

import random

import pytest
from drawn_trees import FIRST, ROWS, columns, numbers, numeric, plain, refs, same, values
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from asking import ours
from chosen import examples
from engine_cases import COLUMN, FIRST_ROW
from livesheet.engine import FAST, PORTABLE, compile_book
from livesheet.engine.fast.cell_code import CellCodes
from livesheet.engine.fast.segments import Segment
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Binary, Call, CellRef, ErrorValue, Number, RangeRef, Text
from livesheet.formula.parser import parse_formula
from mechsheet.library.session import Session
from random_formulas import Formulas, random_cells

line = st.builds(
    lambda col, top, rows, moves: RangeRef(
        CellRef(FIRST - 1 + top, col, not moves, True), CellRef(FIRST - 1 + top + rows, col, not moves, True)
    ),
    st.integers(0, 2), st.integers(0, 1), st.integers(0, 4), st.booleans(),
)  # fmt: skip
across = st.just(RangeRef(CellRef(FIRST, 0, False, True), CellRef(FIRST, 2, False, True)))
words = st.sampled_from(["abc", "ABC", "3", "", "no", ">1", "a*", "TRUE", "may"]).map(Text)
near_whole = st.sampled_from([3.0000000000000004, 2.9999999999999996, -0.0, 1e15 + 0.5, 4503599627370497.5]).map(Number)


def lines(below):
    """Functions of a few cells, texts, and what is asked of values."""
    return (
        st.builds(lambda name, r: Call(name, (r,)), st.sampled_from(["SUM", "MIN", "MAX", "COUNT"]), line | across)
        | st.builds(lambda name, r, a: Call(name, (a, r)), st.sampled_from(["MIN", "MAX"]), line, below)
        | st.builds(lambda a, r: Call("MATCH", (a, r, Number(0.0))), below | words, line | across)
        | st.builds(lambda r, a: Call("COUNTIF", (r, a)), line, numbers | words | refs)
        | st.builds(
            lambda r, a, s, b: Call("COUNTIFS", (r, a, s, b)),
            line,
            numbers | words,
            line | across,
            words | numbers | refs,
        )
        | st.builds(
            lambda name, r, s, a: Call(name, (r, s, a)), st.sampled_from(["MINIFS", "MAXIFS"]), line, line, words | refs
        )
        | st.builds(lambda r, s: Call("SUMPRODUCT", (r, s)), line, line)
        | st.builds(lambda r, a: Call("ROW", (r,) * a), refs, st.integers(0, 1))
        | st.builds(lambda r, a, b: _parted("MAX", r, a, b), line, below | numbers, below | numbers)
        | st.builds(lambda a, b, c: Call("MEDIAN", (a, b, c)), below, below, below)
        | st.builds(
            lambda name, a: Call(name, (a,)),
            st.sampled_from(["ISODD", "ISEVEN", "N", "ISNUMBER", "ISTEXT", "LEN"]),
            below | words,
        )
        | st.builds(lambda a, n: Call("ROUNDUP", (a, Number(n))), below | near_whole, st.sampled_from([0.0, 2.0, -1.0]))
        | st.builds(lambda a, b: Call("XOR", (a, b)), refs | words, below)
        | st.builds(lambda a, b: Binary("&", a, b), below, below | words)
        | st.builds(lambda a, b: Call("FIND", (a, b)), words, below | words)
        | st.builds(lambda c, a: Call("AND", (Call("ISNUMBER", (c,)), a)), below, refs | below)
        | st.builds(lambda a, b: Call("POWER", (a, b)), below, below | st.just(Number(0.0)))
    )


def _parted(name, whole, first, last):
    return Call(name, (Binary(":", Call("INDEX", (whole, first)), Call("INDEX", (whole, last))),))


trees = st.recursive(refs | refs | numbers, lambda below: numeric(below, refs) | lines(below), max_leaves=9)


LINE = RangeRef(CellRef(FIRST - 1, 1, True, True), CellRef(FIRST + 6, 1, True, True))
WHOLE_LINE = Call("INDEX", (LINE, CellRef(FIRST, 0)))
"""A place of 0 is the whole line, of which a list of truths takes every cell."""


@pytest.mark.slow
@settings(max_examples=examples(300), deadline=None, report_multiple_bugs=False)
@example(
    [[0.0] * (ROWS + 2), [ErrorValue("#N/A"), *[0.0] * (ROWS + 1)], [0.0] * (ROWS + 2)], (1.0, 0.0), Number(1.0),
    CellRef(FIRST, 0),
    Call("AND", (Call("ISNUMBER", (WHOLE_LINE,)), CellRef(FIRST, 3))), FAST,
)  # fmt: skip
@given(
    st.lists(columns, min_size=3, max_size=3), st.tuples(plain, values), trees, trees, trees,
    st.sampled_from([FAST, PORTABLE]),
)  # fmt: skip
def test_code_gives_what_the_interpreter_gives(data, singles, first, second, lone, arithmetic):
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, column in enumerate(data):
        sheet.constants.extend(FIRST - 1, col, column)
    for row, value in enumerate(singles):
        sheet.constant(row, 7, value)
    sheet.block(FIRST, 3, ROWS, 1, first)
    sheet.block(FIRST, 4, ROWS, 2, second)
    sheet.block(FIRST, 9, 1, 1, lone)
    plan = compile_book(builder.build(), arithmetic)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Segment, "_fast", lambda *_: False)
        patch.setattr(CellCodes, "due", lambda _: False)
        expected = plan.evaluate()
        assume(not expected.kept)  # what the interpreter cannot compute it cannot judge
        for step in plan.steps:
            for member in getattr(step, "members", ()):
                member.singly = True  # what the interpreter computes at once is the same cell by cell
        patch.setattr(CellCodes, "due", lambda _: True)
        for _ in range(2):
            same(plan.evaluate(), expected, signs=True)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [21, 22])
def test_formulas_of_all_functions(seed):
    """Whatever is not said in code is asked of the interpreter, or left to it."""
    chance = random.Random(seed)
    grid, formulas = list(random_cells(chance)), Formulas(chance)
    texts = [formulas.formula() for _ in range(400)]
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, col, value in grid:
        sheet.constant(row, col, value)
    for index, text in enumerate(texts):
        sheet.block(FIRST_ROW + index, COLUMN, 1, 1, parse_formula(text))
    plan = compile_book(builder.build())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(CellCodes, "due", lambda _: True)
        patch.setattr(Segment, "_fast", lambda *_: False)
        for _ in range(2):
            values = plan.evaluate()
            for index, (text, expected) in enumerate(zip(texts, ours(texts, grid), strict=True)):
                found = values.get("S", FIRST_ROW + index, COLUMN)
                assert found == expected or (found, expected) == (None, 0.0), text


def counted(*texts):
    """A session of single cells in column C, computed often enough, and how often the interpreter is asked since."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [1.0, 2.0, ErrorValue("#N/A"), "ok", "no", 6.0])
    sheet.constants.extend(0, 1, [3.0, "ok", 3.5, 4.0, "OK", 6.0])
    for row, text in enumerate(texts):
        sheet.block(row, 2, 1, 1, parse_formula(text))
    session = Session(builder.build())
    for round_ in range(10):
        session["S!B1"] = 3.0 + round_
        session.table("S!C1:C99")
    asked = []
    with pytest.MonkeyPatch.context() as patch:
        result = session._live._evaluator.result
        patch.setattr(session._live._evaluator, "result", lambda *args: asked.append(args) or result(*args))
        session["S!B1"] = 3.25
        found = [row[0] for row in session.table(f"S!C1:C{len(texts)}")]
    return found, len(asked)


def test_short_columns_texts_and_questions_are_code():
    found, asked = counted(
        'COUNTIF(B1:B6,"ok")+B1', "MATCH(B1,B1:B6,0)", "INDEX(B1:B6,MATCH(4,B1:B6,0))&B1", "MIN(B1:B6,5)+MAX(B3:B4)",
        "POWER(B1,2)", "B1^0", "COUNT(B1:B6)*B1",
        'FIND("2",B1&"")', "IF(ISNUMBER(A3),1,MEDIAN(B1,9,2))", "ROUNDUP(B1,0)+N(B2)",
        'COUNTIFS(B1:B6,"ok",A1:A6,2)+B1', "MAX(INDEX(B1:B6,3):INDEX(B1:B6,4))*B1", "B1^B1", "SUM(B1,B3)",
    )  # fmt: skip
    assert found == [5.25, 1.0, "43.25", 7.25, 3.25**2, 1.0, 13.0, 3.0, 3.25, 4.0, 4.25, 13.0, 3.25**3.25, 6.75]
    assert asked == 0


EDGES = [
    "INDEX(A1:A6,0)", "INDEX(A1:A6,7)", "INDEX(A1:A6,B1)", 'COUNTIF(B1:B6,"o*")', 'COUNTIF(B1:B6,">3")', "COUNTIF(B1:B6,3)",
    'COUNTIF(B1:B6,"3")', 'COUNTIF(B1:B6,"TRUE")', 'MATCH("o*",B1:B6,0)', 'MATCH("OK",B1:B6,0)', "SUM(C1)", "SUM(C1,C1)",
    "MIN(C1,C2)", "MAX(C2,C1)", "MIN(C1:C2)", "C1^3", "C1^0.5", "C1^-1", "A6^IF(A1>0,2,1)", "(A6/7)^IF(A1>0,3,2)",
    "XOR(B2,A1)", "XOR(B3,A1)", "ISODD(B2)", "ISODD(D1)", "N(B2)", "ROUNDUP(3.0000000000000004,0)", 'FIND("",B2)', "LEN(D1)",
    "B2&D1&A1",
]  # fmt: skip


def test_edges():
    """With texts, blanks, both zeros, numbers as texts, what is outside and what is a pattern."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [1.0, 2.0, ErrorValue("#N/A"), "ok", "no", 6.0])
    sheet.constants.extend(0, 1, [0.0, "ok", 3.5, "3", True, 3.0])
    sheet.constants.extend(0, 2, [-0.0, 0.0])
    for row, text in enumerate(EDGES):
        sheet.block(row, 5, 1, 1, parse_formula(text))
    plan = compile_book(builder.build())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Segment, "_fast", lambda *_: False)
        patch.setattr(CellCodes, "due", lambda _: False)
        expected = plan.evaluate()
        patch.setattr(CellCodes, "due", lambda _: True)
        same(plan.evaluate(), expected, signs=True)
