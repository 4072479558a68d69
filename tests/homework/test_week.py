"""The pages of a lecturer's week: their files and their commands, as they stand there, from beginning to end."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

import mechsheet
from homework.handmade import FOUR_BAR, Table, four_bar
from homework.plain_export import plain_book
from mechsheet.cli import main

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"```(\w+)\n(.*?)```", re.DOTALL)


def blocks(page, kind):
    return [text for found, text in BLOCK.findall((DOCS / page).read_text(encoding="utf-8")) if found == kind]


def commands(page):
    return [line for text in blocks(page, "text") for line in text.splitlines() if line.startswith("mechsheet ")]


def run(line, code=0):
    result = CliRunner().invoke(main, shlex.split(line)[1:])
    assert result.exit_code == code, f"{line}\n{result.output}"
    return result.output


def plain_pump(path):
    """A pump's table by hand: formulas of the plain export, typed with openpyxl."""
    import openpyxl

    from mechsheet.formula.nodes import shifted
    from mechsheet.formula.printer import print_formula

    (sheet,) = plain_book(mechsheet.template("adjustable-pump")).sheets
    book = openpyxl.Workbook()
    for row, col, value in sheet.constants.items():
        book.active.cell(row + 1, col + 1, value)
    for block in sheet.blocks:
        for row in range(block.rows):
            text = print_formula(shifted(block.formula, row, 0))
            book.active.cell(block.row + row + 1, block.col + 1, f"={text}")
    book.active.title = sheet.title
    book.save(path)


@pytest.mark.ci
@pytest.mark.parametrize(
    ("page", "week", "handed", "pump", "old"),
    [
        ("week.md", "week3", "handed-in", "old-pump.xlsx", "old.xlsx"),
        ("week.tr.md", "hafta3", "gelenler", "eski-pompa.xlsx", "eski.xlsx"),
    ],
)
def test_the_commands_of_the_page(tmp_path, monkeypatch, page, week, handed, pump, old):
    monkeypatch.chdir(tmp_path)
    for name in ("four-bar", "adjustable-pump"):
        Path(f"{name}.toml").write_text(mechsheet.template(name).text, encoding="utf-8")
    (exercise,) = blocks(page, "toml")
    Path("four-bar.toml").write_text(f"{mechsheet.template('four-bar').text}\n{exercise}", encoding="utf-8")
    (people,) = [text for text in blocks(page, "text") if text.startswith("id,")]
    Path("class.csv").write_text(people, encoding="utf-8")
    given, marked, audited, recognised = commands(page)

    run(given)
    assert sorted(path.name for path in Path(week, "student").iterdir()) == ["1001.xlsx", "1002.xlsx"]
    students = json.loads(Path(week, "key.json").read_text(encoding="utf-8"))["students"]
    Path(handed).mkdir()
    for student, slip in zip(students, ({}, {"b": "ATAN2(-{yA},{a1}-{xA})"}), strict=True):
        cells = [(name, name, student["dimensions"][name]) for name in ("a1", "a2", "a3", "a4")]
        Table(cells, four_bar(**slip)).save(Path(handed) / f"{student['id']}.xlsx")

    run(marked)
    assert [path.stem for path in Path().glob("*.xlsx")] in (["marks"], ["notlar"])
    marks = next(path for path in Path().glob("*.csv") if path.name != "class.csv").read_text(encoding="utf-8-sig")
    lines = marks.splitlines()
    assert [line.split(",")[0] for line in lines] == ["id", "1001", "1002"]
    assert "ATAN2" in lines[2]
    assert "ATAN2" not in lines[1]
    assert len(list(Path().glob("*/1002.html"))) == 1

    plain_pump(pump)
    run(audited)
    Table(FOUR_BAR, four_bar()).save(Path(old))
    assert "four-bar" in run(recognised)
    assert mechsheet.load(Path(old).with_suffix(".toml"))
