"""The marks as a workbook, as CSV, and as a page for each student."""

from __future__ import annotations

import html
from collections.abc import Sequence
from dataclasses import replace
from pathlib import PurePath

from livesheet.evaluation import computed
from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef
from livesheet.workbook import Cell, Column, Fill, PrintSetup, Properties, Sheet, Style, Workbook
from mechsheet.homework.audit import fault_line, kind_words
from mechsheet.homework.classroom.exercise import csv_text, no_formula, safe
from mechsheet.homework.classroom.marks import Marked, Marks, lines_of, words_of
from mechsheet.homework.drawn_by_numbers import pictures
from mechsheet.sheet.cells import wrapped_lines
from mechsheet.sheet.styles import BAD_FILL, DERIVED_FILL, HEAD, HEAD_LEFT, INPUT, SUBTITLE, SYMBOL, TITLE, WARN_FILL
from mechsheet.words.catalogue import marks_of, said

CELL = replace(SYMBOL, name="", valign="top", wrap=True)
MARK = replace(CELL, align="center")
TOTAL = replace(MARK, bold=True, fill=DERIVED_FILL)
OVERRULED = replace(INPUT, name="", align="center", valign="top")
HEAD_ROW, FIRST = 3, 4
"""Rows of the headings and of the first student, from 0."""
WIDTHS = (11.0, 18.0, 16.0)
"""Of id, name and file."""
WIDE = 70.0
"""Width of the remarks, which are broken into lines: the sheet fits a screen, and a page can be read."""
TITLE_HEIGHT, HEAD_HEIGHT, LINE = 26.0, 38.0, 17.0
"""Heights of rows, and of a line in them."""
MOST_LINES = 30
"""In a row: Excel has none higher than 409 points."""
LONGEST_FOOTER = 60
"""Characters of the title below a page: it stays one line."""


def marks_workbook(marks: Marks) -> Workbook:
    """Sheets *Class* and *Faults*; totals are formulas, and a number in the yellow column stands in their place."""
    sheets = (_class(marks), _faults(marks))
    found = Workbook(sheets, properties=Properties(title=marks.title, language=marks.language, author="mechsheet"))
    return computed(found)


def _class(marks: Marks) -> Sheet:
    language = marks.language
    symbols = list(marks.asked)
    heads = [said(language, "marks.id"), said(language, "marks.name"), said(language, "marks.file")]
    heads += [f"{symbol} ({marks.asked[symbol]:g})" for symbol in symbols]
    tail = ["marks.total", "marks.overrule", "marks.mark", "marks.count", "marks.words"]
    heads += [said(language, key, of=f"{marks.of:g}") for key in tail]
    cells = [Cell(0, 0, marks.title, TITLE), Cell(1, 0, said(language, "marks.hint"), SUBTITLE)]
    cells += [Cell(HEAD_ROW, col, head, HEAD) for col, head in enumerate(heads)]
    total = 3 + len(symbols)
    files = _short_names([one.file for one in marks.students])
    for row, one in enumerate(marks.students, FIRST):
        cells += [Cell(row, col, text or None, CELL) for col, text in enumerate((one.id, one.name, files[one.file]))]
        for col, symbol in enumerate(symbols, 3):
            cells.append(Cell(row, col, *_earned(one, symbol)))
        cells.append(Cell(row, total + 1, None, OVERRULED))
        cells.append(Cell(row, total + 3, float(len(one.audit.faults)) if one.audit else None, MARK))
        cells.append(Cell(row, total + 4, "\n".join([*one.private, *lines_of(one)]) or None, CELL))
    count = len(marks.students)
    summed = Call("SUM", (RangeRef(CellRef(FIRST, 3), CellRef(FIRST, total - 1)),)) if symbols else Number(0.0)
    typed = CellRef(FIRST, total + 1)
    overruled = Call("IF", (Call("ISNUMBER", (typed,)), typed, CellRef(FIRST, total)))
    fills = (Fill(FIRST, total, summed, TOTAL, count, 1), Fill(FIRST, total + 2, overruled, TOTAL, count, 1))
    columns = _columns(total)
    heights = ((0, TITLE_HEIGHT), (HEAD_ROW, HEAD_HEIGHT), *_heights(cells, FIRST, columns))
    return Sheet(
        said(language, "marks.class"), tuple(cells), fills if count else (), columns, heights,
        freeze=(FIRST, 2), selected=(FIRST, 0), gridlines=False,
        print_setup=PrintSetup(repeat_rows=(HEAD_ROW, HEAD_ROW), footer=_footer(marks)),
    )  # fmt: skip


def _columns(total: int) -> tuple[Column, ...]:
    """Of *Class*, whose total stands in column `total`."""
    return (
        *(Column(col, col, width) for col, width in enumerate(WIDTHS)),
        Column(3, total, 9.0),
        Column(total + 1, total + 1, 11.0),
        Column(total + 2, total + 3, 8.0),
        Column(total + 4, total + 4, WIDE),
    )


def _heights(cells: Sequence[Cell], first: int, columns: Sequence[Column]) -> tuple[tuple[int, float], ...]:
    """Of the rows from `first` on, each as high as its longest text wants."""
    widths = {col: column.width for column in columns for col in range(column.first, column.last + 1)}
    lines: dict[int, int] = {}
    for cell in cells:
        if cell.row >= first:
            lines[cell.row] = max(lines.get(cell.row, 1), wrapped_lines(cell.content, widths[cell.col]))
    return tuple((row, LINE * min(count, MOST_LINES) + 3) for row, count in sorted(lines.items()))


def _earned(one: Marked, symbol: str) -> tuple[float | None, Style]:
    """The marks of one quantity and their look: amber is not right as it stands, red has no marks."""
    if one.audit is None or symbol not in one.audit.asked:
        return None, MARK
    earned = one.audit.earned.get(symbol, 0.0)
    if one.audit.asked[symbol].verdict == "right":
        return earned, MARK
    return earned, replace(MARK, fill=WARN_FILL if earned else BAD_FILL)


def _short_names(files: Sequence[str]) -> dict[str, str]:
    """Files without the folders that all of them have."""
    folders = [PurePath(file).parent.parts for file in files if file]
    same = 0
    while folders and all(len(parts) > same and parts[same] == folders[0][same] for parts in folders):
        same += 1
    return {file: "/".join(PurePath(file).parts[same:]) for file in files}


def _footer(marks: Marks) -> str:
    """Below each printed page; an ampersand is a mark there."""
    return f"&L{marks.title[:LONGEST_FOOTER].replace('&', '&&')}&R&A, &P / &N"


def _faults(marks: Marks) -> Sheet:
    """Every fault, and how often each kind occurred: what to explain next week."""
    language = marks.language
    listed = [(one, fault) for one in marks.students if one.audit is not None for fault in one.audit.faults]
    kinds: dict[str, int] = {}
    for _, fault in listed:
        kinds[fault.kind] = kinds.get(fault.kind, 0) + 1
    ordered = sorted(kinds, key=lambda kind: (-kinds[kind], kind))
    heads = [said(language, key) for key in ("marks.kind", "marks.often")]
    cells = [Cell(0, col, head, HEAD_LEFT) for col, head in enumerate(heads)]
    cells += [Cell(row, 0, kind_words(kind, language), CELL) for row, kind in enumerate(ordered, 1)]
    top = len(ordered) + 3
    keys = ["marks.kind", "marks.student", "marks.cells", "marks.formula", "marks.mend"]
    cells += [Cell(top, col, said(language, key), HEAD_LEFT) for col, key in enumerate(keys)]
    for row, (one, fault) in enumerate(listed, top + 1):
        texts = (kind_words(fault.kind, language), one.id, fault.cells, fault.formula, fault.mend)
        cells += [Cell(row, col, text or None, CELL) for col, text in enumerate(texts)]
    fills: tuple[Fill, ...] = ()
    if listed:
        places = RangeRef(CellRef(top + 1, 0, True, True), CellRef(top + len(listed), 0, True, True))
        often: Node = Call("SUMPRODUCT", (Binary("*", Binary("=", places, CellRef(1, 0)), Number(1.0)),))
        fills = (Fill(1, 1, often, MARK, len(ordered), 1),)
    columns = (Column(0, 0, 34.0), Column(1, 1, 14.0), Column(2, 2, 20.0), Column(3, 4, 46.0))
    return Sheet(
        said(language, "marks.faults"), tuple(cells), fills, columns, row_heights=_heights(cells, 0, columns),
        gridlines=False, print_setup=PrintSetup(footer=_footer(marks)),
    )  # fmt: skip


def marks_csv(marks: Marks) -> str:
    """id, mark, words: what spreadsheet programs and most learning platforms import."""
    heads = [said("en", key) for key in ("marks.id", "marks.mark", "marks.words")]
    rows = [[no_formula(one.id), f"{one.mark:g}", no_formula(words_of(one))] for one in marks.students]
    return csv_text([heads, *rows])


def moodle_csv(marks: Marks) -> str:
    """What Moodle's grade import reads: the ID number, a grade item called as the mechanism, its feedback. Whose workbook is
    missing or cannot be judged has no grade yet, which Moodle writes as a dash."""
    rows = [[one.id, f"{one.mark:g}" if one.audit else "-", words_of(one)] for one in marks.students]
    return csv_text([["ID number", marks.title, f"Feedback: {marks.title}"], *rows])


def pages(marks: Marks) -> dict[str, str]:
    """File name -> the page of one student, without a word of any other."""
    found: dict[str, str] = {}
    taken: set[str] = set()
    for one in marks.students:
        name = safe(one.id)
        while name.casefold() in taken:
            name += "_"
        taken.add(name.casefold())
        found[f"{name}.html"] = page(marks, one)
    return found


def page(marks: Marks, one: Marked) -> str:
    """One student's page."""
    language = marks.language
    heads = [said(language, key) for key in ("page.asked", "page.cells", "page.verdict", "page.marks")]
    rows: list[Sequence[str]] = []
    lines: list[str] = []
    if one.audit is not None:
        for symbol, result in one.audit.asked.items():
            got = f"{one.audit.earned.get(symbol, 0.0):g} / {marks.asked.get(symbol, 0.0):g}"
            rows.append((symbol, result.cells, said(language, result.verdict), got))
        lines = [fault_line(fault, language) for fault in one.audit.faults]
    own = [text for text in one.remarks if text != said(language, "marks.unknown")]
    lines += [one.why] if one.why else []
    remarks = [*own, *(one.audit.remarks if one.audit is not None else ())]
    mark = marks_of(language, one.mark, marks.of)
    table = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>\n" for row in rows)
    head = "<tr>" + "".join(f"<th>{html.escape(text)}</th>" for text in heads) + "</tr>\n"
    listed = "".join(f"<li>{html.escape(text)}</li>\n" for text in (*lines, *remarks))
    drawn = pictures(one.audit.picture, language) if one.audit is not None and one.audit.picture is not None else ""
    title = html.escape(f"{marks.title}: {one.id} {one.name}".strip())
    return (
        f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n<meta charset="utf-8">\n<title>{title}</title>\n'
        "<style>body{font:16px/1.4 sans-serif;max-width:50em;margin:2em auto;padding:0 1em}"
        ".both{display:flex;flex-wrap:wrap;gap:1em}figure{margin:0;border:1px solid #bbb;text-align:center}"
        "td,th{border:1px solid #bbb;padding:.3em .6em;text-align:left}table{border-collapse:collapse}</style>\n"
        f"</head>\n<body>\n<h1>{title}</h1>\n<p><strong>{html.escape(mark)}</strong></p>\n"
        f"<table>\n{head}{table}</table>\n<ul>\n{listed}</ul>\n{drawn}</body>\n</html>\n"
    )
