"""The hidden sheet that computes a second time: what it covers, what it says, and that it does not cry wolf."""

from dataclasses import replace

import pytest
from laid import Laid, template_text

from mechsheet.compiled import Compiled
from mechsheet.compiled.evaluation import book_of
from mechsheet.engine import evaluate
from mechsheet.exporting.workbooks import functions_workbook
from mechsheet.formula.nodes import Binary, Call, CellRef, Number, transform, walk
from mechsheet.formula.printer import print_formula
from mechsheet.formula.spellings import longest_spelling
from mechsheet.sheet.recomputed import COPIES, DIFFER_ROW, FIRST, HEAD_ROW, VALUE, WHERE_ROW

NAMES = ("four-bar", "adjustable-pump")


@pytest.fixture(scope="module", params=NAMES)
def laid(request):
    return Laid(template_text(request.param), copies=True)


def recomputed(laid, workbook=None):
    return (workbook or laid.workbook).sheet(laid.plan.at.titles["recomputed"])


def marks(laid):
    """The fills that compare, by (sheet, row, column) of the first cell that they stand for."""
    found = {}
    for fill in recomputed(laid).fills:
        if fill.row >= FIRST and isinstance(fill.formula, Call):
            match fill.formula:
                case Call("IF", (Binary("=", Call("IFERROR", _), Call("IFERROR", (CellRef() as own, _))), _, _)):
                    found[own.sheet, own.row, own.col] = fill
    return found


def typed_over(laid, sheet, row, col):
    """The values when one formula has become a number."""
    book = book_of(laid.workbook)
    sheets = []
    for own in laid.workbook.sheets:
        if own.title == sheet:
            pieces = []
            for fill in own.fills:
                inside = fill.row <= row < fill.row + fill.rows and fill.col <= col < fill.col + fill.cols
                pieces += (
                    [replace(fill, rows=1, cols=1, row=row, col=col, formula=Number(12345.678))] if inside else [fill]
                )
            own = replace(own, fills=tuple(pieces))
        sheets.append(own)
    book = book_of(replace(laid.workbook, sheets=tuple(sheets)))
    return evaluate(book)


def test_it_is_hidden_and_nothing_differs(laid):
    sheet = recomputed(laid)
    assert sheet.hidden
    assert laid.spot("#differ") == 0
    assert laid.values.get(sheet.title, WHERE_ROW, VALUE) == laid.plan.text("recomputed.none")


def test_every_formula_is_proven_or_copied_or_reads_the_verdict(laid):
    plan, copied = laid.plan, marks(laid)
    clear = plan.at.spots["#clear"]
    left = []
    for sheet in laid.workbook.sheets:
        if sheet.title == plan.at.titles["recomputed"]:
            continue
        proven = plan.proven.get(sheet.title, set())
        for fill in sheet.fills:
            if (sheet.title, fill.row, fill.col) not in copied and (fill.row, fill.col) not in proven:
                left.append((sheet.title, fill))
    inside_checks = [fill for title, fill in left if title == clear.sheet]
    assert all(
        fill.row < plan.at.first + 6 and fill.col < 16 for fill in inside_checks
    )  # the verdict on the copies itself
    for title, fill in left:
        cells = [part for part in walk(fill.formula) if isinstance(part, CellRef)]
        reads_verdict = any((cell.sheet, cell.row, cell.col) == (clear.sheet, clear.row, clear.col) for cell in cells)
        assert reads_verdict or title == clear.sheet
    assert 1 <= len([title for title, _ in left if title == plan.main]) <= 2


def test_a_copy_reads_what_the_cell_reads_and_never_another_copy(laid):
    title = laid.plan.at.titles["recomputed"]
    aside = {(fill.row, fill.col): fill.formula for fill in recomputed(laid).fills}
    for fill in marks(laid).values():
        del aside[fill.row, fill.col]

    def whole(formula):
        """With what stands in cells of its own: sums, and the steps of a long formula."""

        def put(part):
            if isinstance(part, CellRef) and part.sheet is None:
                assert part.row == fill.row
                return whole(aside[part.row, part.col])
            return part

        return transform(formula, put)

    originals = {(s.title, f.row, f.col): f.formula for s in laid.workbook.sheets for f in s.fills}
    for (sheet, row, col), fill in marks(laid).items():
        assert fill.row == row + FIRST
        again = fill.formula.args[0].left.args[0]
        assert not isinstance(again, CellRef) or again.sheet or isinstance(aside[again.row, again.col], Binary)
        again = whole(again)
        cells = [part for part in walk(again) if isinstance(part, CellRef)]
        assert all(part.sheet not in (None, title) for part in cells), (sheet, row, col)
        # The same formula, but for the sheets that it names.
        here = transform(again, lambda part: replace(part, sheet=None) if isinstance(part, CellRef) else part)
        there = transform(
            originals[sheet, row, col], lambda part: replace(part, sheet=None) if isinstance(part, CellRef) else part
        )
        if Call("ROW") not in walk(there):
            assert here == there, (sheet, row, col)


def test_long_copies_are_computed_in_steps(laid):
    assert all(longest_spelling(fill.formula) <= 8192 for fill in recomputed(laid).fills)
    if laid.plan.mechanism.name == "adjustable-pump":
        assert any(row >= FIRST and sheet.startswith("Tablo") for sheet, row, _ in marks(laid))


def test_a_cell_typed_over_is_named(laid):
    """One formula of each sheet, in the middle of its fill."""
    plan = laid.plan
    seen = set()
    for sheet, row, col in marks(laid):
        if sheet in seen or sheet == plan.at.titles["checks"]:
            continue
        seen.add(sheet)
        values = typed_over(laid, sheet, row, col)
        spot = plan.at.spots["#differ"]
        assert values.get(spot.sheet, DIFFER_ROW, VALUE) >= 1
        named = values.get(spot.sheet, WHERE_ROW, VALUE)
        assert named == f"{sheet}!{print_formula(CellRef(row, col))}"
        clear = plan.at.spots["#clear"]
        assert values.get(clear.sheet, clear.row, clear.col) == plan.text("checks.not_clear")
    assert seen >= {plan.main, plan.table, plan.at.titles["drawing"]}


def test_columns_say_what_they_stand_for(laid):
    sheet = recomputed(laid)
    heads = {cell.col: cell.content for cell in sheet.cells if cell.row == HEAD_ROW}
    for (title, _, col), fill in marks(laid).items():
        letters = print_formula(CellRef(0, col)).rstrip("1")
        assert heads[fill.col] == f"{title}!{letters}"
    assert min(heads) == COPIES


@pytest.mark.parametrize("name", ["pantograph", "peaucellier", "scissor-lift"])
def test_rounding_of_a_last_difference_is_no_damage(name):
    """Programs take a difference that is rounding for 0 only where it is a formula's last step."""
    laid = Laid(template_text(name), copies=True)
    assert laid.spot("#differ") == 0
    assert any(isinstance(fill.formula, Binary) for fill in recomputed(laid).fills if fill.row >= FIRST)


@pytest.mark.parametrize("form", ["lambda", "basic"])
def test_workbooks_with_functions_are_covered_too(form):
    laid = Laid(template_text("adjustable-pump"), copies=True)
    compiled = Compiled(laid.mechanism)
    workbook, plan = functions_workbook(compiled, form), compiled.plan
    values = evaluate(book_of(workbook))
    spot = plan.at.spots["#differ"]
    assert values.get(spot.sheet, spot.row, spot.col) == 0
    names = {function.name for function in workbook.functions}
    calls = [
        part.name for fill in recomputed(laid, workbook).fills for part in walk(fill.formula) if isinstance(part, Call)
    ]
    assert names & set(calls)
