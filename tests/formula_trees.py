"""Random trees that a parser can give back, and a plain way to write a tree with all its parentheses."""

from hypothesis import strategies as st

from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    NameRef,
    Number,
    RangeRef,
    Symbol,
    Text,
    Unary,
)
from livesheet.formula.parser import DESCRIPTION_FUNCTIONS
from livesheet.formula.printer import print_formula

numbers = st.floats(min_value=0, allow_nan=False, allow_infinity=False).map(lambda x: Number(abs(x)))
symbols = st.sampled_from(["a", "a_1", "theta12", "C.x", "β₂", "açı"]).map(Symbol)
sheets = st.sampled_from([None, None, "Sheet1", "My sheet", "It's", "A1", "Größe", "R1C1", "x.y", "1st"])
texts = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=5).map(Text)
errors = st.sampled_from(["#N/A", "#DIV/0!", "#NUM!", "#VALUE!", "#REF!", "#NAME?", "#NULL!"]).map(ErrorValue)


@st.composite
def cells(draw, sheet=None):
    row = draw(st.integers(0, 99) | st.integers(0, MAX_ROWS - 1))
    col = draw(st.integers(0, 30) | st.integers(0, MAX_COLUMNS - 1))
    return CellRef(row, col, draw(st.booleans()), draw(st.booleans()), sheet or draw(sheets))


@st.composite
def ranges(draw):
    sheet = draw(sheets)
    start, end = draw(cells()), draw(cells())
    corners = [CellRef(ref.row, ref.col, ref.row_abs, ref.col_abs, sheet) for ref in (start, end)]
    shape = draw(st.sampled_from(["cells", "cells", "columns", "rows"]))
    if shape == "columns":
        rows = (0, MAX_ROWS - 1)
        corners = [CellRef(row, ref.col, True, ref.col_abs, sheet) for row, ref in zip(rows, corners, strict=True)]
    elif shape == "rows":
        cols = (0, MAX_COLUMNS - 1)
        corners = [CellRef(ref.row, col, ref.row_abs, True, sheet) for col, ref in zip(cols, corners, strict=True)]
    return RangeRef(*corners)


names = st.builds(NameRef, st.sampled_from(["a_1", "Krank", "rate", "β", "x.y"]), sheets.filter(lambda s: s != "x.y"))
constants = numbers | texts | errors | st.booleans().map(Boolean)
signed = numbers | st.builds(lambda n: Number(-n.value), numbers.filter(lambda n: n.value))
arrays = st.builds(
    lambda rows: ArrayLiteral(tuple(tuple(row) for row in rows)),
    st.integers(1, 3).flatmap(
        lambda width: st.lists(
            st.lists(signed | texts | errors, min_size=width, max_size=width), min_size=1, max_size=3
        )
    ),
)

_FUNCTIONS = sorted(FUNCTIONS)
functions = st.integers(0, len(_FUNCTIONS) - 1).map(lambda place: _FUNCTIONS[place])


def _sheet_level(below):
    arguments = st.lists(below | st.just(Missing()), max_size=4).map(lambda args: [] if args == [Missing()] else args)
    return (
        st.builds(
            Binary, st.sampled_from(["+", "-", "*", "/", "^", "&", "=", "<>", "<", "<=", ">", ">="]), below, below
        )
        | st.builds(Unary, st.sampled_from(["-", "+", "%"]), below)
        | st.builds(lambda name, args: Call(name, tuple(args)), functions, arguments)
        | st.builds(Binary, st.just(","), cells() | ranges(), cells() | ranges())
        | st.builds(Binary, st.just(" "), cells() | ranges(), cells() | ranges())
    )


sheet_trees = st.recursive(constants | cells() | ranges() | names | arrays, _sheet_level, max_leaves=20)

_one = sorted(set(DESCRIPTION_FUNCTIONS.values()) - {"ATAN2", "MIN", "MAX"})


def _description_level(below):
    return (
        st.builds(Binary, st.sampled_from(list("+-*/^")), below, below)
        | st.builds(Unary, st.sampled_from(["-", "+"]), below)
        | st.builds(lambda name, arg: Call(name, (arg,)), st.sampled_from(_one), below)
        | st.builds(lambda a, b: Call("ATAN2", (a, b)), below, below)
        | st.builds(lambda a, b: Call("SQRT", (Call("SUMSQ", (a, b)),)), below, below)
        | st.builds(
            lambda name, args: Call(name, tuple(args)),
            st.sampled_from(["MIN", "MAX"]),
            st.lists(below, min_size=1, max_size=3),
        )
    )


description_trees = st.recursive(numbers | symbols | st.just(Call("PI")), _description_level, max_leaves=25)


def spelt_out(node):
    """The tree with all its parentheses: binary and unary operators in (), everything else as Excel writes it."""
    match node:
        case Binary(",", left, right):
            return f"({spelt_out(left)},{spelt_out(right)})"
        case Binary(op, left, right):
            return f"({spelt_out(left)}{op}{spelt_out(right)})"
        case Unary("%", operand):
            return f"({spelt_out(operand)}%)"
        case Unary(op, operand):
            return f"({op}{spelt_out(operand)})"
        case Call(name, args):
            return f"{name}({','.join(map(spelt_out, args))})"
        case Symbol(name):
            return name
        case _:
            return print_formula(node, "excel")
