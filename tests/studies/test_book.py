"""What people open: the summary workbook with its commands and its chart, the picture."""

import shlex
from xml.etree import ElementTree

import pytest

from livesheet.formats import read
from mechsheet import open_book
from mechsheet.studies.parts import told_of
from mechsheet.studies.run import studied
from studying import small, study_of

pytest.importorskip("pyarrow")


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return studied(small(6_000), tmp_path_factory.mktemp("book") / "wiper", workers=1, formats=["xlsx", "ods"])


def row_of(book, sheet, row, columns="ABCDEFGHIJKLM"):
    return [book[f"{sheet}!{letter}{row}"] for letter in columns]


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("form", ["xlsx", "ods"])
def test_each_best_design_has_its_row_and_a_command_that_builds_it(found, form):
    book = open_book(found.folder.path / f"study.{form}")
    numbers, remarks = told_of(found.best)
    assert not any(remarks)  # they have a column of their own, which stands here for nothing
    for number, row in enumerate(numbers.to_pylist()):
        cells = row_of(book, "Best designs", number + 7)
        assert cells[0] == number + 1
        assert cells[1] == row["design"]
        assert cells[2 : 2 + len(row) - 1] == pytest.approx(list(row.values())[1:])
        command = next(cell for cell in cells if isinstance(cell, str) and cell.startswith("mechsheet"))
        assert shlex.split(command)[:5] == ["mechsheet", "build", "four-bar.toml", "--design", f"wiper:{row['design']}"]


@pytest.mark.slow
def test_a_folder_that_was_moved_is_typed_once(found):
    book = open_book(found.folder.path / "study.xlsx")
    book["Best designs!C4"] = "elsewhere"
    shown = [value for row in range(7, 17) for value in row_of(book, "Best designs", row)]
    commands = [text for text in shown if isinstance(text, str) and text.startswith("mechsheet")]
    assert len(commands) == 10
    assert all("--design elsewhere:" in text for text in commands)


@pytest.mark.slow
def test_the_counts_are_those_of_the_study(found):
    book = open_book(found.folder.path / "study.xlsx")
    cells = dict(row_of(book, "Study", row, "AB") for row in range(1, 30))
    assert cells["designs tried"] == 6_000
    assert cells["designs that meet all conditions"] == found.result.kept
    assert cells["share"] == found.result.kept / 6_000
    for text, count in found.result.failed:
        assert cells[text] == count


@pytest.mark.slow
def test_the_front_has_its_own_sheet_with_a_chart_of_its_cells(found):
    from mechsheet.studies.book import book_of

    sheet = book_of(found).sheet("Front")
    series = sheet.charts[0].series[0]
    assert series.x.sheet == "Front"
    assert series.x.area.last_row - series.x.area.first_row + 1 == found.front.num_rows
    assert read(found.folder.path / "study.xlsx")


def test_the_picture_is_a_drawing_with_a_line_for_each_best_design(found):
    root = ElementTree.fromstring((found.folder.path / "study.svg").read_bytes())
    lines = root.findall(".//{http://www.w3.org/2000/svg}polyline")
    assert len(lines) == found.best.num_rows
    assert len(root.findall(".//{http://www.w3.org/2000/svg}circle")) >= found.front.num_rows


@pytest.mark.parametrize(
    "objectives", ["", 'minimize = ["swing"]', 'minimize = ["swing", "a2"]\nmaximize = ["mu_min"]']
)
def test_any_number_of_objectives_has_a_workbook_and_a_picture(tmp_path, objectives):
    mechanism = study_of(f'[study]\nvary = {{ a2 = [20, 34, 2] }}\nkeep = ["a2 < 31"]\n{objectives}\n')
    done = studied(mechanism, tmp_path / "study", workers=1)
    assert read(tmp_path / "study" / "study.xlsx")
    ElementTree.fromstring((tmp_path / "study" / "study.svg").read_bytes())
    assert done.best.num_rows == 6


def test_a_study_that_keeps_nothing_has_a_workbook_too(tmp_path):
    done = studied(study_of('[study]\nvary = { a2 = [20, 34, 2] }\nkeep = ["a2 > 50"]'), tmp_path / "study", workers=1)
    assert done.best is None
    assert read(tmp_path / "study" / "study.xlsx")
