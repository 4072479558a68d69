"""What every spreadsheet program allows, checked before a file is written: XlsxWriter lets bad names pass in silence."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator

from livesheet.diagnostics import Fault, OutputError
from livesheet.formula.names import folded, name_fault
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS
from livesheet.formula.printer import print_formula
from livesheet.formula.references import cell_address
from livesheet.said import say
from livesheet.workbook import Sheet, Workbook

MAX_TEXT = 32767
"""Most characters of a text in a cell (Excel specifications and limits)."""
MAX_CHOICES = 255
"""Most characters of a list of choices, with the commas between them."""
MAX_SERIES = 255
"""Most series of a chart."""
MAX_CONTROL = 30_000
"""Highest number that a scroll bar or spin button of Excel reaches, from 0."""
MAX_FORMULA = 8192
"""Most characters of a formula."""
MAX_TITLE = 31
"""Most characters of a sheet's name."""
_NOT_IN_TITLES = ":\\/?*[]"


def check_workbook(workbook: Workbook) -> None:
    """Raise OutputError with all titles, names, texts and places that a file cannot hold."""
    faults = [*_title_faults(workbook), *_name_faults(workbook)]
    for sheet in workbook.sheets:
        faults += _cell_faults(sheet)
        faults += _rule_faults(sheet)
    if faults:
        raise OutputError(faults)


def _title_faults(workbook: Workbook) -> Iterator[Fault]:
    seen: set[str] = set()
    for sheet in workbook.sheets:
        reason = title_fault(sheet.title)
        if not reason and sheet.title.casefold() in seen:
            reason = say("is the name of two sheets (large and small letters are the same)")
        seen.add(sheet.title.casefold())
        if reason:
            yield Fault(say('the sheet name "{title}" {reason}', title=sheet.title, reason=reason))


def _taken(name: str, seen: dict[str, str]) -> str:
    """Why a name cannot be one beside those `seen`, to which it is added; "" where it can."""
    other = seen.setdefault(folded(name), name)
    alike = say('is the same name as "{other}" to some programs', other=other) if other is not name else ""
    return name_fault(name) or alike


def _name_faults(workbook: Workbook) -> Iterator[Fault]:
    seen: dict[str, str] = {}
    titles = {sheet.title for sheet in workbook.sheets}
    for function in workbook.functions:
        reason = _taken(function.name, seen)
        if not reason and (length := len(print_formula(function.formula))) > MAX_FORMULA:
            reason = say(
                "stands for a formula of {length} characters, {most} are allowed", length=length, most=MAX_FORMULA
            )
        if reason:
            yield Fault(say('the name of a function "{name}" {reason}', name=function.name, reason=reason))
    for name in workbook.names:
        reason = _taken(name.name, seen)
        if not reason and name.sheet not in titles:
            reason = say('stands on a sheet "{sheet}" that does not exist', sheet=name.sheet)
        if reason:
            yield Fault(say('the cell name "{name}" {reason}', name=name.name, reason=reason))


def _cell_faults(sheet: Sheet) -> Iterator[Fault]:
    for cell in sheet.cells:
        text = cell.value
        if isinstance(text, str) and len(text) > MAX_TEXT:
            message = say("a text of {count} characters, a cell holds {most}", count=len(text), most=MAX_TEXT)
            yield Fault(message, key=cell_address(sheet.title, cell.row, cell.col))
    last_row = max([cell.row + 1 for cell in sheet.cells] + [f.row + f.rows for f in sheet.fills], default=0)
    last_col = max([cell.col + 1 for cell in sheet.cells] + [f.col + f.cols for f in sheet.fills], default=0)
    if last_row > MAX_ROWS:
        yield Fault(say("{last_row} rows, a sheet holds {most}", last_row=last_row, most=MAX_ROWS), key=sheet.title)
    if last_col > MAX_COLUMNS:
        yield Fault(
            say("{last_col} columns, a sheet holds {most}", last_col=last_col, most=MAX_COLUMNS), key=sheet.title
        )


def _rule_faults(sheet: Sheet) -> Iterator[Fault]:
    for rule in sheet.validations:
        place = cell_address(sheet.title, rule.area.first_row, rule.area.first_col)
        if any("," in choice or not choice for choice in rule.choices):
            yield Fault(say("a choice may neither be empty nor hold a comma"), key=place)
        elif len(",".join(rule.choices)) > MAX_CHOICES:
            yield Fault(say("the choices have more than {most} characters together", most=MAX_CHOICES), key=place)
    for chart in sheet.charts:
        if not 1 <= len(chart.series) <= MAX_SERIES:
            message = say(
                'the chart "{title}" has {count} series, 1 to {most} are allowed',
                title=chart.title,
                count=len(chart.series),
                most=MAX_SERIES,
            )
            yield Fault(message, key=sheet.title)
    for control in sheet.controls:
        if not 0 <= control.low <= control.high <= MAX_CONTROL:
            message = say(
                'the control "{name}" goes from {low} to {high}, 0 to {most} is allowed',
                name=control.name,
                low=control.low,
                high=control.high,
                most=MAX_CONTROL,
            )
            yield Fault(message, key=sheet.title)


def title_fault(title: str) -> str:
    """Why `title` cannot name a sheet, in words that complete "the sheet name X ..."; "" when it can."""
    if not title.strip():
        return say("is empty")
    if len(title.encode("utf-16-le")) // 2 > MAX_TITLE:
        return say("is longer than {most} characters", most=MAX_TITLE)
    if any(letter in _NOT_IN_TITLES for letter in title):
        return say("holds one of {names}", names=" ".join(_NOT_IN_TITLES))
    if any(unicodedata.category(letter) in ("Cc", "Cs") for letter in title):
        return say("holds a control character")
    if title.startswith("'") or title.endswith("'"):
        return say("begins or ends with an apostrophe")
    if title.casefold() == "history":
        return say("is reserved by Excel")
    return ""
