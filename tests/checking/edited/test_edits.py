"""`check edited.xlsx`: what somebody changed, by cell; and no false alarm for what a program only spells differently."""

from dataclasses import replace
from pathlib import Path

import pytest
from edited import audited, edited, laid_out, saved, with_column
from placed import places_of

from chosen import ALL, part
from livesheet.diagnostics import WorkbookError
from livesheet.evaluation import computed
from livesheet.formats import write
from livesheet.formula.nodes import Unary
from livesheet.formula.parser import parse_formula
from livesheet.workbook import Cell
from mechsheet.checking import check
from mechsheet.checking.books_compared import alike
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.description import load
from mechsheet.description.schema import TAKES
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.building import build
from mechsheet.sheet.layout import DESCRIPTION_MARK


@pytest.fixture(scope="module")
def yoke():
    return laid_out("scotch-yoke")


def found_in(workbook, tmp_path, suffix="xlsx"):
    return check(saved(workbook, tmp_path / f"edited.{suffix}"))


def told(report):
    return [(edit.kind, edit.where, edit.was, edit.now) for edit in report.edits]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["xlsx", "ods"])
def test_nothing_was_edited(yoke, tmp_path, suffix):
    report = found_in(yoke[0], tmp_path, suffix)
    assert (report.agrees, report.edits, report.remarks) == (True, (), ())


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("suffix", "references"), [("xlsx", "anchors"), ("ods", "names")])
def test_nothing_was_edited_in_summaries_of_every_kind(tmp_path, suffix, references):
    text = template_text("four-bar")
    head, _, rest = text.partition("[summary]")
    lines = [f'{take}_of_it = {{ of = "mu", take = "{take}" }}' for take in TAKES]
    charts = rest[rest.index("[[charts]]") :].replace('references = "anchors"', f'references = "{references}"')
    source = tmp_path / "all.toml"
    source.write_text("\n".join([head + "[summary]", *lines, "", charts]), encoding="utf-8")
    report = check(build(load(source), tmp_path, [suffix])[0])
    assert (report.agrees, report.edits) == (True, ())


def column(plan, symbol):
    """(sheet, column as letters, first row as people count)"""
    spot = plan.at.spots[symbol]
    from livesheet.formula.references import column_letters

    return column_letters(spot.col), spot.row + 1


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["xlsx", "ods"])
def test_a_formula_overwritten_by_a_number(yoke, tmp_path, suffix):
    workbook, plan = yoke
    letters, first = column(plan, "A.x")
    report = found_in(edited(workbook, **{f"Positions_{letters}{first + 5}": 12.5}), tmp_path, suffix)
    ((kind, where, was, now),) = told(report)
    assert (kind, where, now) == ("overwritten", f"Positions!{letters}{first + 5}", "12.5")
    assert was.startswith("=")
    assert str(first + 5) in was
    assert not report.agrees
    reference = next(item for item in report.comparisons if item.judge == "reference")
    assert not reference.agrees


def test_neighbours_are_one_range(yoke):
    workbook, plan = yoke
    letters, first = column(plan, "A.x")
    cells = {f"Positions_{letters}{first + row}": 1.0 * row for row in (3, 4, 5, 6, 9)}
    assert [edit.where for edit in audited(edited(workbook, **cells)).edits] == [
        f"Positions!{letters}{first + 3}:{letters}{first + 6}",
        f"Positions!{letters}{first + 9}",
    ]


def test_a_cell_broken_out_of_its_column(yoke):
    workbook, plan = yoke
    letters, first = column(plan, "A.x")
    (edit,) = audited(edited(workbook, **{f"Positions_{letters}{first + 5}": "=1+1"})).edits
    assert (edit.kind, edit.now) == ("out of its run", "=1+1")
    assert f"{letters}{first}:{letters}{first + plan.rows - 1}" in edit.note


def test_a_whole_column(yoke):
    workbook, plan = yoke
    letters, first = column(plan, "A.x")
    spot = plan.at.spots["A.x"]
    report = audited(with_column(workbook, "Positions", spot.col, lambda node: Unary("-", node)))
    (edit,) = report.edits
    assert (edit.kind, edit.where) == ("changed", f"Positions!{letters}{first}:{letters}{first + plan.rows - 1}")
    assert edit.now == "=-(" + edit.was[1:] + ")"


@pytest.mark.slow
def test_a_formula_of_the_same_value_is_an_edit_that_does_no_harm(yoke, tmp_path):
    workbook, plan = yoke
    report = found_in(
        with_column(workbook, "Positions", plan.at.spots["A.x"].col, lambda node: Unary("+", node)), tmp_path
    )
    assert [edit.kind for edit in report.edits] == ["changed"]
    assert all(item.agrees for item in report.comparisons)
    assert not report.agrees


def test_emptied(yoke):
    workbook, plan = yoke
    letters, first = column(plan, "A.x")
    (edit,) = audited(edited(workbook, **{f"Positions_{letters}{first}": None})).edits
    assert (edit.kind, edit.now) == ("emptied", "")


def test_inputs_are_there_to_be_changed(yoke):
    workbook, plan = yoke
    row = {symbol: spot.row + 1 for symbol, spot in places_of(plan).items()}
    cells = {
        f"Mechanism_B{row['a2']}": 30.0,
        f"Mechanism_D{row['a2']}": 0.05,
        f"Mechanism_B{row['step']}": 10.0,
        f"Mechanism_B{row['position']}": 7.0,
    }
    report = audited(edited(workbook, **cells))
    assert report.edits == ()
    assert set(report.remarks) == {
        "a2 is 30, was 50",
        "step is 10, was 5",
        "the tolerance of a2 is 0.05, was not given",
    }


def test_a_formula_in_place_of_an_input(yoke):
    workbook, plan = yoke
    row = plan.at.spots["a2"].row + 1
    report = audited(edited(workbook, **{f"Mechanism_B{row}": "=7*5"}))
    assert told(report) == [("formula", f"Mechanism!B{row}", "50.0", "=7*5")]


def test_cells_of_ones_own_and_other_words_are_no_faults(yoke):
    workbook, _ = yoke
    report = audited(edited(workbook, Mechanism_A1="My yoke", Positions_ZZ9="note", Positions_ZZ10="=1+2"))
    assert report.edits == ()
    assert report.remarks == (
        "Mechanism: texts changed in A1",
        "Positions: cells of your own in ZZ9, ZZ10",
    )


def test_a_name_that_means_another_cell(yoke):
    workbook, _ = yoke
    first = workbook.names[0]
    names = (replace(first, row=first.row + 1), *workbook.names[2:])
    edits = audited(replace(workbook, names=names)).edits
    assert [(edit.kind, edit.where) for edit in edits] == [("name", first.name), ("name", workbook.names[1].name)]
    assert edits[1].now == "missing"


def test_another_layout_is_not_called_an_edit_only(yoke):
    """A file of another version of the program: so many formulas differ that one remark says what is likely."""
    workbook, plan = yoke
    for col in range(4, len(plan.columns)):
        workbook = with_column(workbook, "Positions", col, lambda node: Unary("+", node))
    for sheet in ("Drawing", "Checks"):
        width = max(fill.col for part in workbook.sheets if part.title == sheet for fill in part.fills)
        for col in range(width + 1):
            if any(
                fill.col == col and fill.rows > 1
                for part in workbook.sheets
                if part.title == sheet
                for fill in part.fills
            ):
                workbook = with_column(workbook, sheet, col, lambda node: Unary("+", node))
    assert any("another version" in remark for remark in audited(workbook).remarks)


# --- files that are not what they should be ------------------------------------------------------------------------


def with_description(workbook, change):
    """With other lines in the hidden sheet."""
    hidden = workbook.sheets[-1]
    cells = tuple(cell for cell in (change(cell) for cell in hidden.cells) if cell is not None)
    return replace(workbook, sheets=(*workbook.sheets[:-1], replace(hidden, cells=cells)))


@pytest.mark.slow
def test_without_a_description(yoke, tmp_path):
    report = found_in(replace(yoke[0], sheets=yoke[0].sheets[:-1]), tmp_path)
    assert report.agrees
    assert "no description inside" in report.remarks[0]


@pytest.mark.slow
def test_a_description_of_which_the_mark_is_gone(yoke, tmp_path):
    workbook = with_description(yoke[0], lambda cell: None if cell.content == DESCRIPTION_MARK else cell)
    assert "no description inside" in found_in(workbook, tmp_path).remarks[0]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "message"),
    [("[dimensions", "is not closed"), ('wrong = "key"', "unknown"), ("a1 = 3", "")],
    ids=["broken", "unknown key", "key twice"],
)
def test_a_damaged_description(yoke, tmp_path, line, message):
    workbook = with_description(
        yoke[0], lambda cell: replace(cell, content=line) if cell.content == "[dimensions]" else cell
    )
    with pytest.raises(MechsheetError, match=r"description inside") as caught:
        found_in(workbook, tmp_path)
    assert message in str(caught.value)


@pytest.mark.slow
def test_an_input_that_is_no_number(yoke, tmp_path):
    workbook, plan = yoke
    with pytest.raises(WorkbookError, match="a2 must be a number, not thirty"):
        found_in(edited(workbook, **{f"Mechanism_B{plan.at.spots['a2'].row + 1}": "thirty"}), tmp_path)
    step = f"Mechanism_B{plan.places.step.row + 1}"
    with pytest.raises(WorkbookError, match="step must not be 0"):  # as the line of the sheet says
        found_in(edited(workbook, **{step: 0.0}), tmp_path)
    with pytest.raises(WorkbookError, match="step must be a number, not an empty cell"):
        found_in(edited(workbook, **{step: None}), tmp_path)


# --- what a program only spells differently ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "equal"),
    [
        ("5.7295779513082324E-08", "5.729577951308E-08", True),
        ("1E-9*A1", "0.000000001*A1", True),
        ("A1+1", "A1+1.0000001", False),
        ("SUM(A1:A3)", "SUM(A1:A4)", False),
        ("-A1", "+A1", False),
        ("SIN(A1)", "COS(A1)", False),
        ("MAX(A1,2)", "MAX(A1,2,3)", False),
        ("A1&\"x\"", "A1&\"y\"", False),
    ],
)  # fmt: skip
def test_trees_that_are_alike(one, other, equal):
    assert alike(parse_formula(one), parse_formula(other)) is equal


def round_trip(folder: Path, names, source, target):
    """Workbooks of templates, saved again by LibreOffice."""
    files = [saved(laid_out(name)[0], folder / f"{name}.{source}") for name in names]
    (folder / "back").mkdir()
    return convert_with_libreoffice(files, target, folder / "back")


@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.parametrize(
    ("source", "target"), part([("xlsx", "ods"), ("xlsx", "xlsx"), ("ods", "xlsx"), ("ods", "ods")], 8)
)
def test_a_file_saved_by_libreoffice_raises_no_false_alarm(tmp_path, source, target):
    """The four-bar: anchors, coupler point. The pump: names, a two-way table, Turkish.

    On `make full` the dwell: derived angles; and the engine: a force that is 0 but for rounding, of which an .ods keeps
    twenty decimals.
    """
    names = ("four-bar", "adjustable-pump", "six-link-dwell", "engine")
    if not ALL:  # both ways of converting, and both programs' own
        names = names[:1] if source == target else names[1:2]
    for path in round_trip(tmp_path, names, source, target):
        report = check(path)
        assert report.edits == (), path.name
        assert report.remarks == ()
        assert report.agrees


@pytest.mark.slow
def test_a_description_changed_by_hand(tmp_path):
    """The hidden sheet says a step of 10 degrees: 37 rows; the workbook has 73."""
    text = template_text("scotch-yoke")
    workbook, _ = laid_out("scotch-yoke")
    hidden = workbook.sheets[-1]
    other = text.replace("step = 5", "step = 10").split("\n")
    cells = (hidden.cells[0], *(Cell(row, 0, line) for row, line in enumerate(other, 1) if line))
    workbook = replace(workbook, sheets=(*workbook.sheets[:-1], replace(hidden, cells=cells)))
    write(computed(workbook), tmp_path / "other.xlsx")
    report = check(tmp_path / "other.xlsx")
    assert not report.agrees
    assert any(edit.kind == "changed" for edit in report.edits)


def test_a_sheet_of_ones_own(yoke):
    workbook, _ = yoke
    extra = replace(workbook.sheets[0], title="Mine", charts=(), controls=())
    found = audited(replace(workbook, sheets=(*workbook.sheets, extra)))
    assert found.edits == ()
    assert found.remarks == ('the sheet "Mine" is your own',)


def test_sheets_that_are_gone(yoke):
    """The drawing and the notes may be deleted; positions may not."""
    workbook, plan = yoke
    gone = ("Drawing", "Notes", plan.table)
    found = audited(replace(workbook, sheets=tuple(sheet for sheet in workbook.sheets if sheet.title not in gone)))
    assert ("sheet", plan.table) in [(edit.kind, edit.where) for edit in found.edits]
    assert {'the sheet "Drawing" is missing', 'the sheet "Notes" is missing'} <= {*found.remarks}
    kept = audited(replace(workbook, sheets=tuple(sheet for sheet in workbook.sheets if sheet.title not in gone[:2])))
    assert kept.edits == ()
