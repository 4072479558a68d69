"""The marks as a workbook, as CSV, and as a page for each student."""

from __future__ import annotations

import csv
import html
import io
from collections.abc import Sequence

from mechsheet.compiled.evaluation import computed
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef
from mechsheet.homework.exercise import safe
from mechsheet.homework.marks import Marked, Marks, words_of
from mechsheet.homework.words_of import fault_line, kind_words
from mechsheet.sheet.workbook import Cell, Column, Fill, Properties, Sheet, Style, Workbook
from mechsheet.words.homework import said

TITLE = Style(bold=True, size=14.0)
HEAD = Style(bold=True, fill="DDE6F0", border="thin", wrap=True, valign="top")
PLAIN = Style(border="thin", valign="top")
INPUT = Style(border="thin", fill="FFF7D6", locked=False, valign="top")
TOTAL = Style(border="thin", bold=True, valign="top")
FIRST = 4
"""Row of the first student, from 0."""


def marks_workbook(marks: Marks) -> Workbook:
    """Sheets *Class* and *Faults*; totals are formulas, and a number in the yellow column stands in their place."""
    sheets = (_class(marks), _faults(marks))
    found = Workbook(sheets, properties=Properties(title=marks.title, language=marks.language))
    return computed(found)


def _class(marks: Marks) -> Sheet:
    language = marks.language
    symbols = list(marks.asked)
    heads = [said(language, "marks.id"), said(language, "marks.name"), said(language, "marks.file")]
    heads += [f"{symbol} ({marks.asked[symbol]:g})" for symbol in symbols]
    tail = ["marks.total", "marks.overrule", "marks.mark", "marks.count", "marks.words"]
    heads += [said(language, key) for key in tail]
    cells = [Cell(0, 0, marks.title, TITLE), Cell(1, 0, said(language, "marks.hint"))]
    cells.append(Cell(2, 0, said(language, "marks.of", of=f"{marks.of:g}")))
    cells += [Cell(FIRST - 1, col, head, HEAD) for col, head in enumerate(heads)]
    total = 3 + len(symbols)
    for row, one in enumerate(marks.students, FIRST):
        cells += [Cell(row, col, text or None, PLAIN) for col, text in enumerate((one.id, one.name, one.file))]
        for col, symbol in enumerate(symbols, 3):
            got = None if one.audit is None else one.audit.earned.get(symbol, 0.0)
            cells.append(Cell(row, col, got, PLAIN))
        cells.append(Cell(row, total + 1, None, INPUT))
        cells.append(Cell(row, total + 3, float(len(one.audit.faults)) if one.audit else None, PLAIN))
        cells.append(Cell(row, total + 4, "; ".join(filter(None, [*one.private, words_of(one)])) or None, PLAIN))
    count = len(marks.students)
    summed = Call("SUM", (RangeRef(CellRef(FIRST, 3), CellRef(FIRST, total - 1)),)) if symbols else Number(0.0)
    typed = CellRef(FIRST, total + 1)
    overruled = Call("IF", (Call("ISNUMBER", (typed,)), typed, CellRef(FIRST, total)))
    fills = (
        Fill(FIRST, total, summed, TOTAL, count, 1),
        Fill(FIRST, total + 2, overruled, TOTAL, count, 1),
    )
    columns = (Column(0, 0, 12.0), Column(1, 2, 22.0), Column(3, total + 3, 11.0), Column(total + 4, total + 4, 90.0))
    return Sheet(said(language, "marks.class"), tuple(cells), fills if count else (), columns, freeze=(FIRST, 1))


def _faults(marks: Marks) -> Sheet:
    """Every fault, and how often each kind occurred: what to explain next week."""
    language = marks.language
    listed = [(one, fault) for one in marks.students if one.audit is not None for fault in one.audit.faults]
    kinds: dict[str, int] = {}
    for _, fault in listed:
        kinds[fault.kind] = kinds.get(fault.kind, 0) + 1
    ordered = sorted(kinds, key=lambda kind: (-kinds[kind], kind))
    cells = [Cell(0, 0, said(language, "marks.kind"), HEAD), Cell(0, 1, said(language, "marks.often"), HEAD)]
    cells += [Cell(row, 0, kind_words(kind, language), PLAIN) for row, kind in enumerate(ordered, 1)]
    top = len(ordered) + 3
    heads = ["marks.student", "marks.cells", "marks.formula", "marks.mend", "marks.kind"]
    cells += [Cell(top, col, said(language, key), HEAD) for col, key in enumerate(heads)]
    for row, (one, fault) in enumerate(listed, top + 1):
        texts = (one.id, fault.cells, fault.formula, fault.mend, kind_words(fault.kind, language))
        cells += [Cell(row, col, text or None, PLAIN) for col, text in enumerate(texts)]
    fills: tuple[Fill, ...] = ()
    if listed:
        places = RangeRef(CellRef(top + 1, 4, True, True), CellRef(top + len(listed), 4, True, True))
        often: Node = Call("SUMPRODUCT", (Binary("*", Binary("=", places, CellRef(1, 0)), Number(1.0)),))
        fills = (Fill(1, 1, often, PLAIN, len(ordered), 1),)
    columns = (Column(0, 0, 30.0), Column(1, 1, 20.0), Column(2, 3, 45.0), Column(4, 4, 30.0))
    return Sheet(said(language, "marks.faults"), tuple(cells), fills, columns)


def marks_csv(marks: Marks) -> str:
    """id, mark, words: what learning platforms import."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([said("en", key) for key in ("marks.id", "marks.mark", "marks.words")])
    writer.writerows([_no_formula(one.id), f"{one.mark:g}", _no_formula(words_of(one))] for one in marks.students)
    return text.getvalue()


def _no_formula(text: str) -> str:
    """A text that no spreadsheet program takes for a formula."""
    return f"'{text}" if text[:1] in ("=", "+", "-", "@", "\t") else text


def pages(marks: Marks) -> dict[str, str]:
    """File name -> the page of one student, without a word of any other."""
    found: dict[str, str] = {}
    for one in marks.students:
        name = safe(one.id)
        while f"{name}.html" in found:
            name += "_"
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
    mark = said(language, "marks", marks=f"{one.mark:g}", of=f"{marks.of:g}")
    table = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>\n" for row in rows)
    head = "<tr>" + "".join(f"<th>{html.escape(text)}</th>" for text in heads) + "</tr>\n"
    listed = "".join(f"<li>{html.escape(text)}</li>\n" for text in (*lines, *remarks))
    title = html.escape(f"{marks.title}: {one.id} {one.name}".strip())
    return (
        f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n<meta charset="utf-8">\n<title>{title}</title>\n'
        "<style>body{font:16px/1.4 sans-serif;max-width:50em;margin:2em auto;padding:0 1em}"
        "td,th{border:1px solid #bbb;padding:.3em .6em;text-align:left}table{border-collapse:collapse}</style>\n"
        f"</head>\n<body>\n<h1>{title}</h1>\n<p><strong>{html.escape(mark)}</strong></p>\n"
        f"<table>\n{head}{table}</table>\n<ul>\n{listed}</ul>\n</body>\n</html>\n"
    )
