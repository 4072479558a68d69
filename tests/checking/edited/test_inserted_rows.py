"""Rows, columns and sheets that were inserted, deleted or renamed: no false alarm, and edits told at their places."""

from dataclasses import replace

import pytest
from edited import audited, edited, laid_out, moved, saved

from livesheet.evaluation import book_of
from livesheet.workbook import Cell
from mechsheet.checking import check
from mechsheet.checking.edited.inserted_rows import NOTHING, Shift, moves_between, undone
from mechsheet.checking.edited.pull import pull


@pytest.fixture(scope="module")
def yoke():
    return laid_out("scotch-yoke")


MOVES = {
    "rows above the dimensions": ("Mechanism", Shift(2, 3), NOTHING, "Mechanism: rows 3 to 5 inserted"),
    "a row above the table": ("Positions", Shift(0, 1), NOTHING, "Positions: row 1 inserted"),
    "a column in the table": ("Positions", NOTHING, Shift(5, 1), "Positions: column F inserted"),
    "rows and columns": ("Positions", Shift(1, 1), Shift(0, 2), "Positions: row 2 inserted"),
    "above the drawing": ("Drawing", Shift(0, 2), NOTHING, "Drawing: rows 1 to 2 inserted"),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", MOVES)
def test_what_a_program_moves_is_no_edit(yoke, tmp_path, what):
    title, rows, cols, remark = MOVES[what]
    workbook = moved(yoke[0], title, rows, cols)
    found = audited(workbook)
    assert found.edits == ()
    assert remark in found.remarks
    if what == "rows and columns":
        report = check(saved(workbook, tmp_path / "moved.xlsx"))
        assert report.agrees
        assert report.remarks == found.remarks


@pytest.mark.slow
def test_a_renamed_sheet(yoke, tmp_path):
    report = check(saved(moved(yoke[0], "Positions", now="My table"), tmp_path / "renamed.ods"))
    assert report.agrees
    assert report.remarks == ('the sheet "Positions" is called "My table" now',)


@pytest.mark.slow
def test_an_edit_is_told_where_it_is_now(yoke, tmp_path):
    workbook, plan = yoke
    workbook = edited(workbook, **{f"Mechanism_B{plan.at.spots['a2'].row + 1}": 42.0})
    workbook = edited(workbook, Positions_C9=5.0)
    shifted_book = moved(moved(workbook, "Positions", Shift(1, 2)), "Mechanism", Shift(2, 3))
    path = saved(shifted_book, tmp_path / "moved.xlsx")
    report = check(path)
    assert [(edit.kind, edit.where) for edit in report.edits] == [("overwritten", "Positions!C11")]
    assert any(remark.startswith("a2 is 42, was") for remark in report.remarks)
    assert any(change.startswith("a2: ") and change.endswith("-> 42") for change in pull(path).changes)


@pytest.mark.slow
def test_a_row_inserted_inside_the_table(yoke, tmp_path):
    """The rows below count themselves anew, and the table lacks a position."""
    report = check(saved(moved(yoke[0], "Positions", Shift(9, 1)), tmp_path / "torn.xlsx"))
    assert [(edit.kind, edit.where) for edit in report.edits] == [("inserted", "Positions row 10")]
    assert not next(item for item in report.comparisons if item.judge == "reference").agrees


def test_a_deleted_column(yoke):
    workbook, plan = yoke
    col = plan.at.spots["s13"].col
    report = audited(moved(workbook, "Positions", cols=Shift(col, -1)))
    assert report.edits[0].kind == "deleted"
    assert any("#REF!" in edit.now for edit in report.edits)


def test_notes_below_a_table_move_nothing(yoke):
    workbook, plan = yoke
    expected = book_of(workbook)
    last = plan.at.last
    cells = {f"Positions_C{last + row}": f"note {row}" for row in (4, 5, 9)} | {
        "Positions_ZA6": "x",
        "Positions_ZA20": 3.0,
    }
    book = book_of(edited(workbook, **cells))
    moves = moves_between(expected, book)
    assert not moves
    assert undone(book, moves) is book


@pytest.mark.parametrize(
    ("shift", "gone"), [(Shift(3, 2), []), (Shift(3, -2), [3, 4]), (Shift(0, 1), []), (NOTHING, [])]
)
def test_there_and_back(shift, gone):
    now = {place: shift.now(place) for place in range(12)}
    assert [place for place, moved in now.items() if moved is None] == gone
    assert all(shift.before(moved) == place for place, moved in now.items() if moved is not None)
    assert [now[place] for place in range(shift.at)] == list(range(shift.at))


def test_a_title_as_a_cell_is_enough(yoke):
    """A row is known by its texts: the same cells with other numbers are the same rows."""
    workbook, _ = yoke
    first = workbook.sheets[0]
    cells = tuple(
        Cell(cell.row, cell.col, cell.content * 2 if isinstance(cell.content, float) else cell.content)
        for cell in first.cells
    )
    book = book_of(replace(workbook, sheets=(replace(first, cells=cells), *workbook.sheets[1:])))
    assert not moves_between(book_of(workbook), book)
