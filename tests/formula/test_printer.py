import tomllib
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given

from formula_trees import description_trees, sheet_trees
from livesheet.diagnostics import FormulaError
from livesheet.formula.functions import FUNCTIONS, canonical_name, spelling
from livesheet.formula.nodes import Apply, Binary, Call, CellRef, Local, Number, Previous, RangeRef, Symbol, Unary
from livesheet.formula.parser import parse_description, parse_formula
from livesheet.formula.printer import number_text, print_formula, quote_sheet

CASES = Path(__file__).parent.parent / "cases" / "formula"
TEXTS = tomllib.loads((CASES / "text.toml").read_text(encoding="utf-8"))


@pytest.mark.slow
@given(sheet_trees)
def test_what_is_printed_reads_back(tree):
    for dialect in ("excel", "openformula"):
        assert parse_formula(print_formula(tree, dialect), dialect) == tree


@pytest.mark.slow
@given(description_trees)
def test_what_is_printed_for_a_description_reads_back(tree):
    assert parse_description(print_formula(tree, "description")) == tree


@pytest.mark.slow
@given(sheet_trees)
def test_no_pair_of_parentheses_can_be_left_out(tree):
    """Each pair either holds arguments, or its absence changes or breaks the formula."""
    text = print_formula(tree, "excel")
    for start, end in _pairs(text):
        without = text[:start] + " " + text[start + 1 : end] + " " + text[end + 1 :]
        with suppress(FormulaError):
            assert parse_formula(without) != tree, (text, without)


def _pairs(text):
    """Places of grouping parentheses, outside of texts and quoted sheets."""
    stack, quote = [], ""
    for place, character in enumerate(text):
        if quote:
            quote = "" if character == quote else quote
        elif character in "\"'":
            quote = character
        elif character == "(":
            stack.append(place)
        elif character == ")":
            start = stack.pop()
            if start == 0 or not (text[start - 1].isalnum() or text[start - 1] in "._"):
                yield start, place


@pytest.mark.parametrize("formula", TEXTS)
def test_texts_for_people(formula):
    assert print_formula(parse_formula(formula), "text") == TEXTS[formula]


def test_symbols_are_for_people_and_descriptions_only():
    node = Binary("+", Symbol("theta13"), Symbol("C.x"))
    assert print_formula(node, "text") == print_formula(node, "description") == "theta13 + C.x"
    assert print_formula(Previous("n"), "text") == "previous(n)"
    for dialect in ("excel", "openformula"):
        with pytest.raises(ValueError, match="cannot be written"):
            print_formula(node, dialect)
    for part in (CellRef(0, 0), RangeRef(CellRef(0, 0), CellRef(1, 1)), Call("INDEX", (Number(1),)), Previous("n")):
        with pytest.raises(ValueError, match="cannot be written in a description"):
            print_formula(part, "description")


def test_a_negative_number_is_a_sign_and_a_number():
    square = Binary("^", Number(-2), Number(2))
    assert print_formula(square, "excel") == "-2^2"
    assert print_formula(square, "description") == "(-2)^2"
    assert print_formula(Unary("-", Number(-2)), "excel") == "--2"
    assert print_formula(Binary("-", Number(1), Number(-2)), "description") == "1 - -2"


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (5.0, "5"),
        (0.1, "0.1"),
        (1e22, "1E+22"),
        (1e-7, "1E-07"),
        (123456789012.5, "123456789012.5"),
        (1 / 3, "0.3333333333333333"),
    ],
)
def test_numbers(value, text):
    assert number_text(value) == text
    assert float(text) == value


def test_numbers_that_no_formula_holds():
    for value in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match="no number of a formula"):
            number_text(value)


@pytest.mark.parametrize(
    ("sheet", "quoted"),
    [
        ("Positions", "Positions"),
        ("Two words", "'Two words'"),
        ("A1", "'A1'"),
        ("RC", "'RC'"),
        ("R1", "'R1'"),
        ("It's", "'It''s'"),
        ("2nd", "'2nd'"),
        ("Çizim", "Çizim"),
        ("Hızlar", "Hızlar"),
        ("Şekil", "'Şekil'"),
        ("TRUE", "'TRUE'"),
    ],
)
def test_quoting(sheet, quoted):
    assert quote_sheet(sheet) == quoted


@pytest.mark.parametrize(
    "around",
    [
        lambda node: Call("SIN", (node,)),
        lambda node: Apply(Local("f"), (node,)),
        lambda node: Unary("-", node),
        lambda node: Binary(",", CellRef(0, 0), node),
    ],
    ids=["a function", "a function of a name", "a sign", "areas within areas"],
)
def test_sixty_four_levels_are_written_and_no_more(around):
    node = CellRef(0, 0)
    for _ in range(64):
        node = around(node)
    assert "A1" in print_formula(node)
    with pytest.raises(FormulaError, match="nested deeper than 64 levels"):
        print_formula(around(node))


def test_many_areas_side_by_side_are_one_level():
    text = f"SUM(({','.join(f'A{row}' for row in range(1, 200))}))"
    assert print_formula(parse_formula(text)) == text


def test_every_function_is_found_by_both_spellings():
    for name in FUNCTIONS:
        for dialect in ("excel", "openformula"):
            assert canonical_name(spelling(name, dialect), dialect) == name
            assert canonical_name(spelling(name, dialect).lower(), dialect) == name
    assert canonical_name("_xlfn._xlws.SORT") == "SORT"


@pytest.mark.parametrize("text", ["A:B", "$C:C", "3:4", "$5:$5", "Data!A:B", "A1:B1048576", "A1:XFD2", "A$2:B$1048576"])
def test_whole_columns_and_rows_are_written_as_such(text):
    assert print_formula(parse_formula(text)) == text
