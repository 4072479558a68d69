"""The pages of a lecturer's week: their files and their commands, as they stand there, from beginning to end."""

from __future__ import annotations

import csv
import itertools
import json
import re
import shlex
from pathlib import Path

import openpyxl
import pytest

import mechsheet
from chosen import ALL
from command_line import printed
from homework.handmade import FOUR_BAR, Table, four_bar
from homework.plain_export import plain_book
from mechsheet.checking.programs import convert_with_libreoffice

pytestmark = pytest.mark.slow

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"```(\w+)\n(.*?)```", re.DOTALL)


def blocks(page, kind):
    return [text for found, text in BLOCK.findall((DOCS / page).read_text(encoding="utf-8")) if found == kind]


def commands(page):
    return [line for text in blocks(page, "text") for line in text.splitlines() if line.startswith("mechsheet ")]


def run(line, code=0):
    return printed(*shlex.split(line)[1:], code=code)


def plain_pump(path):
    """A pump's table by hand: formulas of the plain export, typed with openpyxl."""
    from livesheet.formula.nodes import shifted
    from livesheet.formula.printer import print_formula

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


C_POINT = [
    ("xC", "xC", "{xA}+{b3}*COS({t13}+{gamma})"),
    ("yC", "yC", "{yA}+{b3}*SIN({t13}+{gamma})"),
]
KNOWN = {
    "right": ({}, 7, ""),
    "an angle turned": ({"b": "ATAN2(-{yA},{a1}-{xA})"}, 7, "ATAN2($B$2-C"),
    "its own angle turned": ({"t14": "ATAN2({yB},{xB}-{a1})"}, 5, "ATAN2(I"),
    "typed numbers": ({"xA": "OWN*COS({fi})", "yA": "OWN*SIN({fi})"}, 3.5, "a2"),
    "no C.y": ({"yC": None}, 6, "C.y: "),
    "another length": ({"a1": 71.0}, 7, "71"),
    "another's lengths": ({"copied": True}, 7, "OTHER"),
    "unreadable": (None, 0, ""),
    "not handed in": (None, 0, ""),
}
"""What a student did: changes of the table, the marks of 7, and what stands in the lecturer's words."""


def handed_in(path, own, copied, kind):
    """A student's own workbook, .xlsx; nothing where nothing was handed in."""
    changes = KNOWN[kind][0]
    if kind == "unreadable":
        path.write_bytes(b"PK\x03\x04 a lost file")
    if changes is None:
        return
    lengths = dict(copied if "copied" in changes else own)
    lengths |= {name: value for name, value in changes.items() if name in lengths}
    given = [(name, name, lengths[name]) for name in ("a1", "a2", "a3", "a4", "b3", "c3")]
    given.append(("gamma3", "gamma", "ACOS(({a3}^2+{b3}^2-{c3}^2)/(2*{a3}*{b3}))"))
    slips = {name: text.replace("OWN", repr(own["a2"])) for name, text in changes.items() if isinstance(text, str)}
    columns = four_bar(**slips) + [column for column in C_POINT if changes.get(column[1], "") is not None]
    table = Table(given, columns)
    table.cells = {"A50": "swing", "B50": "=MAX(K12:K36)-MIN(K12:K36)"}
    table.save(path)


def in_three_formats(folder):
    """Every third file as it is, as .ods and as .xls, where LibreOffice can write them."""
    for number, suffix in ((1, "ods"), (2, "xls")):
        files = [path for path in sorted(folder.glob("*.xlsx"))[number::3] if path.stat().st_size > 100]
        convert_with_libreoffice(files, suffix, folder)
        for path in files:
            path.unlink()


def appeal(path, identifier):
    """5 of 7, and the lecturer overrules: the mark follows, the formula's own total stays beside it."""
    marks = mechsheet.open_book(path)
    sheet = openpyxl.load_workbook(path).worksheets[0]
    row = next(row for row in range(1, sheet.max_row + 1) if sheet.cell(row, 1).value == identifier)
    assert [marks[f"{sheet.title}!{col}{row}"] for col in ("I", "K")] == [5.0, 5.0]
    marks.set(f"{sheet.title}!J{row}", 6.5, force=True)
    assert [marks[f"{sheet.title}!{col}{row}"] for col in ("I", "K")] == [5.0, 6.5]


@pytest.mark.full
@pytest.mark.ci
@pytest.mark.libreoffice
@pytest.mark.parametrize(
    ("page", "count", "week", "handed", "pump", "old"),
    [
        ("week.md", 60 if ALL else 20, "week3", "handed-in", "old-pump.xlsx", "old.xlsx"),
        ("week.tr.md", 12, "hafta3", "gelenler", "eski-pompa.xlsx", "eski.xlsx"),
    ],
)
def test_the_week_from_beginning_to_end(tmp_path, monkeypatch, page, count, week, handed, pump, old):
    """The page's own files and commands, for a class of `count` of whom it is known what each did."""
    monkeypatch.chdir(tmp_path)
    for name in ("four-bar", "adjustable-pump"):
        Path(f"{name}.toml").write_text(mechsheet.template(name).text, encoding="utf-8")
    (exercise,) = blocks(page, "toml")
    Path("four-bar.toml").write_text(f"{mechsheet.template('four-bar').text}\n{exercise}", encoding="utf-8")
    (people,) = [text for text in blocks(page, "text") if text.startswith("id,")]
    people += "".join(f"{number},Öğrenci {number}\n" for number in range(1003, 1001 + count))
    Path("class.csv").write_text(people, encoding="utf-8")
    given, marked, audited, recognised = commands(page)

    run(given)
    assert len(list(Path(week, "student").iterdir())) == len(list(Path(week, "solution").iterdir())) == count
    students = json.loads(Path(week, "key.json").read_text(encoding="utf-8"))["students"]
    assert len({tuple(one["dimensions"].items()) for one in students}) == count
    kinds = dict(zip((one["id"] for one in students), itertools.cycle(KNOWN), strict=False))
    Path(handed).mkdir()
    for one, other in zip(students, students[1:] + students[:1], strict=True):
        handed_in(Path(handed, f"{one['id']}.xlsx"), one["dimensions"], other["dimensions"], kinds[one["id"]])
    in_three_formats(Path(handed))
    assert {path.suffix for path in Path(handed).iterdir()} == {".xlsx", ".ods", ".xls"}

    run(marked)
    (file,) = [path for path in Path().glob("*.csv") if path.name != "class.csv"]
    lines = list(csv.reader(file.read_text(encoding="utf-8-sig").splitlines()))[1:]
    assert [(line[0], float(line[1])) for line in lines] == [(id_, KNOWN[kind][1]) for id_, kind in kinds.items()]
    for identifier, _, words in lines:
        text = KNOWN[kinds[identifier]][2]
        assert text == "OTHER" or text in words
    pages = {path.stem: path.read_text(encoding="utf-8") for path in Path().glob("*/1*.html")}
    assert sorted(pages) == sorted(kinds)
    for identifier, text in pages.items():  # nobody's page says anything of another
        assert [other["id"] for other in students if other["id"] in text] == [identifier]
        assert not [other["name"] for other in students if other["name"] in text and other["id"] != identifier]

    (book,) = Path().glob("*.xlsx")
    appeal(book, next(id_ for id_, kind in kinds.items() if kind == "its own angle turned"))

    plain_pump(pump)
    run(audited)
    Table(FOUR_BAR, four_bar()).save(Path(old))
    assert "four-bar" in run(recognised)
    assert mechsheet.load(Path(old).with_suffix(".toml"))
