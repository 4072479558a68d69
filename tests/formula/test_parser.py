import tomllib
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from formula_trees import spelt_out
from livesheet.diagnostics import FormulaError
from livesheet.formula.nodes import Apply, Binary, Call, CellRef, Local, NameRef, Number, TableRef, shifted, walk
from livesheet.formula.parser import parse_description, parse_formula
from livesheet.formula.printer import print_formula

CASES = Path(__file__).parent.parent / "cases" / "formula"


def load(name):
    return tomllib.loads((CASES / f"{name}.toml").read_text(encoding="utf-8"))


DESCRIPTION = load("description")["case"]
SHEET = load("sheet")["case"]
FAULTS = load("faults")


@pytest.mark.parametrize("case", DESCRIPTION, ids=lambda case: case["text"])
def test_description(case):
    node = parse_description(case["text"])
    assert spelt_out(node) == case["tree"]
    if "excel" in case:
        assert print_formula(node, "excel") == case["excel"]
    assert parse_description(print_formula(node, "description")) == node


@pytest.mark.parametrize("case", SHEET, ids=lambda case: case["excel"])
def test_sheet(case):
    node = parse_formula(case["excel"])
    assert spelt_out(node) == case["tree"]
    assert print_formula(node, "excel") == case["excel"]
    assert print_formula(node, "openformula") == case["openformula"]
    assert parse_formula(case["openformula"], "openformula") == node
    assert parse_formula("=" + case["excel"]) == node
    assert parse_formula("of:=" + case["openformula"], "openformula") == node


def test_where_takes_its_second_where_the_first_is_above_0():
    assert spelt_out(parse_description("where(x - 1, 2, 3)")) == "IF(((x-1)>0),2,3)"


@pytest.mark.parametrize(("typed", "stored"), [("A1#", "_xlfn.ANCHORARRAY(A1)"), ("@A1:A3", "_xlfn.SINGLE(A1:A3)")])
def test_a_spilled_area_and_one_of_its_cells_are_read_as_typed_and_as_stored(typed, stored):
    assert parse_formula(f"SUM({typed})") == parse_formula(f"SUM({stored})") != parse_formula("SUM(A1)")


@pytest.mark.parametrize("dialect", FAULTS)
def test_faults(dialect):
    for text, messages in FAULTS[dialect].items():
        with pytest.raises(FormulaError) as caught:
            parse_description(text) if dialect == "description" else parse_formula(text, dialect)
        assert [fault.message for fault in caught.value.faults] == messages, text
        assert all(fault.source == text.removeprefix("=") for fault in caught.value.faults)


COMPARED = "expressions have no comparisons; where(x, a, b) is a where x is greater than 0, otherwise b"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("a**2", 'write "^" for a power'),
        ("2a", 'a product is written with "*"'),
        ("2,5", 'the decimal sign is "."; "," stands between arguments only'),
        ("sinn(2)", 'did you mean "sin"?'),
        (
            "frob(2)",
            "functions: sin cos tan asin acos atan atan2 sqrt abs sign min max exp ln radians degrees hypot where",
        ),
        ("pi()", 'pi is a number: write it without parentheses, "2*pi"'),
        ("theta14 + 90 deg", "write radians(90) for 90 degrees"),
        ("30°", "write radians(30) for 30 degrees"),
        ("a1 + 22.5 °", "write radians(22.5) for 22.5 degrees"),
        ("a1°", 'angles are in radians here; write "radians(30)" for 30 degrees'),
        ("where(s.v < 0, P, 0)", f'{COMPARED}: for "u < v" write where(v - u, a, b)'),
        ("P*(s.v >= 0)", f'{COMPARED}: for "u > v" write where(u - v, a, b)'),
        ("where(x = 1, a, b)", f'{COMPARED}: for "u = v" there is where(d - abs(u - v), a, b), with a small d'),
        ("if(s.v, 0, P)", COMPARED),
    ],
)
def test_hints(text, hint):
    with pytest.raises(FormulaError) as caught:
        parse_description(text)
    assert caught.value.faults[0].hint == hint


def test_cells_end_where_the_sheet_ends():
    assert parse_formula("XFD1048576") == CellRef(1_048_575, 16_383)
    assert parse_formula("A1048577") == NameRef("A1048577")
    assert parse_formula("XFE1") == NameRef("XFE1")


def test_an_at_sign_asks_for_one_value_of_a_range():
    assert parse_formula("@A1:A3*2") == parse_formula("_xlfn.SINGLE(A1:A3)*2")


def test_a_name_of_a_lambda_may_be_called():
    called = parse_formula("_xlpm.f(A1)")
    assert called == Apply(Local("f"), (CellRef(0, 0),))
    assert print_formula(called) == "_xlpm.f(A1)"


def test_columns_of_tables_stand_in_formulas():
    assert parse_formula("SUM(Sales[Qty])") == Call("SUM", (TableRef("Sales", frozenset(), "Qty", "Qty"),))


@pytest.mark.parametrize(
    ("excel", "openformula"),
    [
        ("_xlfn.LAMBDA(_xlpm.x,_xlop.y,_xlpm.x+1)(2)", "LAMBDA(x;y;x+1)(2)"),
        ("_xlfn.MAP(A1:A3,_xleta.ABS)", "MAP([.A1:.A3];ABS)"),
    ],
)
def test_names_of_functions_are_marked_in_excel_s_files_only(excel, openformula):
    assert print_formula(parse_formula(excel), "excel") == excel
    assert print_formula(parse_formula(excel), "openformula") == openformula


def test_lower_case_and_spaces_do_not_matter_in_a_sheet():
    assert parse_formula("= sum( a1 : $b$2 , 3 )") == parse_formula("SUM(A1:$B$2,3)")


@pytest.mark.parametrize("opening", ["(", "-", "SIN(", "IF(1,", "2^"])
def test_nesting_is_limited_without_a_traceback(opening):
    depth = 5000
    with pytest.raises(FormulaError, match="nested deeper than 64 levels"):
        parse_description(opening.lower() * depth)
    if opening != "2^":  # in a sheet ^ leans left: a run of it is no nesting
        with pytest.raises(FormulaError, match="nested deeper than 64 levels"):
            parse_formula(opening * depth)


def test_sixty_levels_are_read():
    text = "SIN(1+2*3^" * 60 + "A1" + ")" * 60
    assert print_formula(parse_formula(text)) == text


def test_long_sums_are_no_nesting():
    text = "+".join(["A1"] * 4000)
    node = parse_formula(text)
    assert print_formula(node) == text
    assert print_formula(shifted(node, 1)) == text.replace("A1", "A2")
    assert sum(isinstance(part, Binary) for part in walk(node)) == 3999


@given(st.text(max_size=30) | st.text("()+-*/^%,;:{}[]'\"!#$&<>= .A1aé9E\\_|~", max_size=30))
def test_any_text_is_parsed_or_refused(text):
    for parse in (parse_description, parse_formula, lambda t: parse_formula(t, "openformula")):
        try:
            parse(text)
        except FormulaError as problem:
            assert problem.faults


def test_numbers_keep_their_value():
    assert parse_formula("0.1") == Number(0.1)
    assert parse_formula("1.7976931348623157E+308") == Number(1.7976931348623157e308)
    with pytest.raises(FormulaError, match="too large"):
        parse_formula("1E309")
