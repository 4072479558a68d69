"""Random trees of formulas that give numbers, over three columns of data: what the ways to compute them are held against."""

import numpy as np
from hypothesis import strategies as st

from livesheet.engine.values.cells import TEXT
from livesheet.formula.nodes import Binary, Call, CellRef, ErrorValue, Number, RangeRef, Text, Unary

FIRST, ROWS = 3, 7

plain = st.sampled_from([0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -3.0, 360.0, 0.1, 0.2, 0.3]) | st.floats(-1e3, 1e3)
values = (
    plain | plain | plain | st.sampled_from([1e308, -1e200, 1e-300, 1e15, ErrorValue("#N/A"), "abc", "3", True, None])
)
columns = st.lists(plain, min_size=ROWS + 2, max_size=ROWS + 2) | st.lists(values, min_size=ROWS + 2, max_size=ROWS + 2)

# Columns A..C hold data from the row above the table; D, E, F are formulas; H1, H2 single cells.
small = st.integers(0, 9).map(lambda n: Number(float(n)))
lines = st.sampled_from(
    [(FIRST, 0, FIRST + ROWS - 1, 0), (FIRST - 1, 1, FIRST + ROWS - 1, 1), (FIRST, 0, FIRST, 2)]
).map(lambda c: RangeRef(CellRef(c[0], c[1], True, True), CellRef(c[2], c[3], True, True)))
data_refs = (
    st.builds(lambda col: CellRef(FIRST, col), st.integers(0, 2))
    | st.builds(lambda col: CellRef(FIRST - 1, col), st.integers(0, 2))
    | st.builds(lambda row: CellRef(row, 7, True, True), st.integers(0, 1))
)
refs = data_refs | st.just(CellRef(FIRST, 3))
numbers = st.sampled_from([0.0, 1.0, 2.0, 3.0, 0.5, 1e-12, 1e308, 90.0]).map(Number)
ONE = [
    *("SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SINH", "COSH", "TANH", "ASINH", "ACOSH", "ATANH", "RADIANS"),
    *("DEGREES", "SQRT", "ABS", "SIGN", "EXP", "LN", "LOG10", "INT"),
]


def numeric(below, cells):
    return (
        st.builds(Binary, st.sampled_from(list("+-*/+-*")), below, below)
        | st.builds(lambda a, n: Binary("^", a, Number(n)), below, st.sampled_from([2.0, 3.0, 0.5, -1.0, 0.0]))
        | st.builds(Unary, st.sampled_from(["-", "%", "+"]), below)
        | st.builds(lambda name, arg: Call(name, (arg,)), st.sampled_from(ONE), below)
        | st.builds(lambda a, b: Call("ATAN2", (a, b)), below, below)
        | st.builds(lambda a, b: Call("MOD", (a, b)), below, below)
        | st.builds(lambda a, digits: Call("ROUND", (a, digits)), below, st.sampled_from([0.0, 0.0, 2.0]).map(Number))
        | st.builds(lambda r, a: Call("INDEX", (r, a)), lines, below | small)
        | st.builds(lambda a, r, k: Call("MATCH", (a, r, k)), below, lines, st.sampled_from([0.0, 1.0]).map(Number))
        | st.builds(lambda name, r: Call(name, (r,)), st.sampled_from(["SUM", "MIN", "MAX", "COUNT"]), lines)
        | st.builds(lambda a, b: Call("IFERROR", (a, b)), below, below)
        | st.builds(lambda a, b: Binary("^", a, b), below, below)
        | st.builds(
            lambda name, args: Call(name, tuple(args)),
            st.sampled_from(["MIN", "MAX", "SUM", "SUMSQ"]),
            st.lists(below, min_size=1, max_size=3),
        )
        | st.builds(lambda c, a, b: Call("IF", (c, a, b)), conditions(below), below | st.just(Call("NA")), below)
        | st.builds(lambda r, a: Call("IF", (Call("ISNUMBER", (r,)), a, Text("no"))), cells, below)
    )


def conditions(below):
    single = st.builds(Binary, st.sampled_from(["=", "<>", "<", "<=", ">", ">="]), below, below)
    return (
        single
        | st.builds(
            lambda name, parts: Call(name, tuple(parts)),
            st.sampled_from(["AND", "OR"]),
            st.lists(single, min_size=1, max_size=2),
        )
        | single.map(lambda c: Call("NOT", (c,)))
        | st.builds(Binary, st.sampled_from(["=", "<>"]), single, single)
    )


def same(found, expected, signs=False):
    """Values of two evaluations are equal to the last bit, with `signs` those of zeros too; texts by what they say."""
    codes = expected._codes
    assert np.array_equal(found._codes, codes)
    exact = (codes < 16) & (codes != TEXT)
    numbers, wanted = found._numbers[exact], expected._numbers[exact]
    assert np.array_equal(numbers, wanted)
    assert not signs or np.array_equal(np.signbit(numbers), np.signbit(wanted))
    texts = [[one.texts.text(number) for number in one._numbers[codes == TEXT]] for one in (found, expected)]
    assert texts[0] == texts[1]
