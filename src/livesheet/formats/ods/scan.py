"""The tables of an .ods, read in one pass over content.xml."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from datetime import date
from typing import Any, NamedTuple
from xml.parsers import expat

from livesheet.diagnostics import Fault, FormulaError
from livesheet.formula.book import BookSheet, Settings
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, ErrorValue, Scalar
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.said import say

from ..reading.formulas import ArrayText, CellFaults, FormulaRuns, give_arrays
from ..reading.package import MAX_SHEETS, Package
from ..reading.repeated_rows import RepeatedRows
from ..xml_text import NULL_DATE, day_number, finite
from .values import ParagraphText, error_of, error_shown, time_number
from .words import Words, words_of

CONTENT = "content.xml"
MAX_REPEATED = 1 << 23
"""Most cells of a document that are only repetitions of a cell with content: eight columns of a million rows."""


class NameText(NamedTuple):
    """A defined name as it is written. `formula` is an expression, or the address of a range; `sheet` None: the book's.

    fixed  the address means these cells, although it has no `$`
    """

    name: str
    formula: str
    is_range: bool
    base: str
    sheet: str | None
    fixed: bool = False


@dataclass(slots=True)
class Table:
    """A table while it is read."""

    sheet: BookSheet
    faults: CellFaults
    runs: FormulaRuns
    arrays: list[ArrayText] = field(default_factory=list)


_UNSAID = Settings(case_sensitive=True, searching="expressions", beginnings=False)
"""How OpenDocument computes where a document says nothing, as LibreOffice does."""


@dataclass(slots=True)
class ContentScan:
    """What content.xml holds. `kind` is the kind of document, "spreadsheet" for ours.

    current, next_row  the table at hand, and the row that comes next in it
    rows_ended         how many rows have ended
    """

    package: Package
    sheets: list[BookSheet] = field(default_factory=list)
    titles: set[str] = field(default_factory=set)
    names: list[NameText] = field(default_factory=list)
    lists: list[NameText] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    remarks: list[Fault] = field(default_factory=list)
    null_date: date = NULL_DATE
    settings: Settings = _UNSAID
    null_year: str = ""
    kind: str = ""
    repeated: int = 0
    current: Table | None = None
    next_row: int = 0
    rows_ended: int = 0
    words: Words = field(init=False)

    def run(self, rows: RepeatedRows) -> None:
        """Read the part, `rows` apart. Faults of cells are gathered, all else that is wrong raises WorkbookError at once."""
        parser = expat.ParserCreate()
        parser.buffer_text = True
        parser.buffer_size = 1 << 16
        texts: list[str] = []

        def root(tag: str, attributes: dict[str, str]) -> None:
            self.words = words_of(attributes)
            if tag != self.words.root:
                raise self.fault(say("the part is no OpenDocument content"))
            _handlers(self, parser, texts)

        parser.StartElementHandler = root
        self.package.parse(CONTENT, parser, texts, rows)

    def fault(self, message: str) -> Exception:
        """The error that refuses the file."""
        return self.package.fault(message, CONTENT)

    def table(self, title: str) -> Table:
        """Begin a sheet."""
        if title.casefold() in self.titles:
            raise self.fault(say('two sheets are called "{title}"', title=title))
        if len(self.titles) == MAX_SHEETS:
            raise self.fault(say("more than {most} sheets", most=MAX_SHEETS))
        self.titles.add(title.casefold())
        sheet = BookSheet(title)
        self.sheets.append(sheet)
        faults = CellFaults(self.package.name, title, "openformula")
        return Table(sheet, faults, FormulaRuns(faults.formula, "openformula"))

    def end_table(self, table: Table) -> None:
        """Everything of a sheet has been read."""
        table.sheet.blocks.extend(table.runs.blocks())
        table.sheet.keep(table.runs.kept)
        give_arrays(table.sheet, table.arrays, table.faults)
        self.faults += table.faults.found
        self.remarks += table.faults.remarks

    def count(self, text: str | None) -> int:
        """How many times something is repeated; what is beyond every sheet counts as one sheet's worth."""
        if text is None:
            return 1
        if not text.isdecimal() or not text.strip("0"):
            raise self.fault(say('"{text}" is no number of repetitions', text=text[:40]))
        return min(int(text), 2 * MAX_ROWS) if len(text) < 10 else 2 * MAX_ROWS

    def cell(
        self, table: Table, row: int, col: int, rows: int, cols: int, about: Mapping[str, str], text: str | None
    ) -> None:
        """A cell with a type, a formula or a text, which stands `rows` x `cols` times."""
        if row + rows > MAX_ROWS or col + cols > MAX_COLUMNS:
            raise self.fault(say('a cell outside the sheet "{title}"', title=table.sheet.title))
        value = self.value(table, row, col, about, text)
        formula = self.formula(table, row, col, about)
        if formula is not None and text == "" and self.words.value_type not in about:
            value = ""  # LibreOffice's way to write that a formula gives an empty text
        store = table.sheet.constants if formula is None else table.sheet.cached
        if rows == cols == 1:
            if value is not None:
                store.put(row, col, value)
            if formula is not None and self.words.matrix_columns in about and self.words.matrix_rows in about:
                table.arrays.append(self.array(table, row, col, formula, about))
            elif formula is not None:
                table.runs.text(row, col, formula)
            return
        self.repeated += rows * cols - 1
        if self.repeated > MAX_REPEATED:
            raise self.fault(say("cells repeated more than {most} times: this is no workbook", most=MAX_REPEATED))
        for right in range(col, col + cols):
            if value is not None:
                store.extend(row, right, (value,) * rows)
            if formula is not None:
                for down in range(row, row + rows):
                    # The same text, not what fill-down would write: addresses in it mean the same cells everywhere.
                    table.runs.text(down, right, formula)

    def array(self, table: Table, row: int, col: int, formula: str, about: Mapping[str, str]) -> ArrayText:
        """An array formula with the cells that show its array."""
        rows, cols = (self.count(about[word]) for word in (self.words.matrix_rows, self.words.matrix_columns))
        if row + rows > MAX_ROWS or col + cols > MAX_COLUMNS:
            raise self.fault(say('an array formula that leaves the sheet "{title}"', title=table.sheet.title))
        self.repeated += rows * cols
        if self.repeated > MAX_REPEATED:
            raise self.fault(say("array formulas over more than {most} cells: this is no workbook", most=MAX_REPEATED))
        return ArrayText(row, col, rows, cols, formula, False)

    def formula(self, table: Table, row: int, col: int, about: Mapping[str, str]) -> str | None:
        """The formula of a cell as OpenFormula, None for a cell without one."""
        text = about.get(self.words.formula)
        if text is None:
            return None
        if text.startswith(("=", self.words.openformula)):
            return text.partition("=")[2]
        notation, _, rest = text.partition(":=")
        if notation == "oooc":  # OpenOffice before 3.0: the same brackets
            return rest
        if notation != "msoxl":
            table.faults.remark(
                say(
                    'a formula in the notation "{notation}", which is not read: stored values are kept',
                    notation=notation[:20],
                ),
                (row, col, 1, 1),
                say("save the file in LibreOffice"),
            )
            return None
        try:
            return print_formula(parse_formula(rest), "openformula")
        except FormulaError:
            return rest  # and is remarked like any other that cannot be parsed

    def value(self, table: Table, row: int, col: int, about: Mapping[str, str], text: str | None) -> Scalar:
        """What a cell holds, None for nothing."""
        words = self.words
        kind = about.get(words.value_type, "string" if text else "")
        if kind in ("float", "percentage", "currency"):
            given = about.get(words.value)
            error = error_shown(text or "") if given in (None, "0") else None
            if error is not None or given is None:
                return error  # Excel writes its errors so; and a type without a value is an empty cell
            return self.number(table, row, col, given, finite)
        if kind == "string":
            return self.text(about, text)
        if kind == "boolean":
            return about.get(words.boolean_value) == "true"
        if kind == "date":
            read: Callable[[str], float | None] = lambda given: day_number(given, self.null_date)  # noqa: E731
            return self.number(table, row, col, about.get(words.date_value, ""), read)
        if kind == "time":
            return self.number(table, row, col, about.get(words.time_value, ""), time_number)
        if kind not in ("", "void"):
            table.faults.note(say('there is no type of value called "{kind}"', kind=kind[:20]), row, col)
        return None

    def text(self, about: Mapping[str, str], text: str | None) -> str | ErrorValue:
        """A text; or an error, which OpenDocument has no type for: programs write it as a text of a certain kind."""
        words = self.words
        given = about.get(words.string_value)
        shown = text or ""
        special = about.get(words.extended_type)
        if special == "error":
            return error_of(shown) or ErrorValue("#VALUE!")
        if special is None and given is not None and given in ("", shown):
            error = error_of(shown)
            if error is not None:
                return error
        return shown if given is None else given

    def number(self, table: Table, row: int, col: int, text: str, read: Callable[[str], float | None]) -> float | None:
        """A number by one of the spellings."""
        value = read(text)
        if value is None:
            table.faults.note(say('"{text}" is no number, date or time', text=text[:40]), row, col)
        return value

    def calculating(self, said: Mapping[str, str | None]) -> None:
        """What the document sets about computing; what it does not say is as OpenDocument has it (1.3 part 3, 9.4.1)."""
        expressions, wildcards = said["expressions"] != "false", said["wildcards"] == "true"
        self.settings = replace(
            self.settings,
            case_sensitive=said["case"] != "false",
            searching="wildcards" if wildcards else "expressions" if expressions else "plain",
            whole_cells=said["whole"] != "false",
            as_shown=said["shown"] == "true",
        )
        self.null_year = said["year"] or ""

    def calendar(self, text: str) -> None:
        """The day that dates count from."""
        days = day_number(text, NULL_DATE)
        if days is None:
            raise self.fault(say('"{text}" is no date', text=text[:40]))
        self.null_date = date.fromordinal(NULL_DATE.toordinal() + int(days))


def _handlers(scan: ContentScan, parser: expat.XMLParserType, texts: list[str]) -> None:
    """Closures over local state: attributes of an object cost half as much again here, where every cell passes.

    texts  gathers the text at hand
    """
    words = scan.words
    cells, paragraph = words.cells, ParagraphText(words, texts)
    inside = paragraph.tags
    columns_repeated, value_type, formula = words.columns_repeated, words.value_type, words.formula
    table: Table | None = None
    row = col = 0
    rows = 1
    skipping = 0
    about: dict[str, str] | None = None
    depth = 0  # of elements in the paragraph at hand, itself counted
    shown: list[str] = []

    def start(tag: str, attributes: dict[str, Any]) -> None:
        nonlocal about, skipping, depth, row, col, rows, table
        if skipping:
            skipping += 1
        elif tag in cells and table is not None:
            about = attributes
        elif depth:
            if tag in words.not_text:
                skipping = 1
                paragraph.pause()
            else:
                depth += 1
                if tag in inside:
                    paragraph.mark(tag, attributes)
        elif about is not None:
            if tag == words.paragraph:
                depth = 1
                texts.clear()
            else:
                skipping = 1
        elif tag == words.row:
            rows = scan.count(attributes.get(words.rows_repeated))
            col = 0
            shown_as = attributes.get(words.visibility, "visible")
            if shown_as != "visible" and table is not None:
                table.sheet.hide(row, row + rows, shown_as == "filter")
        elif tag == words.table:
            title = attributes.get(words.table_name, "")
            if table is not None or is_cache(title):
                skipping = 1
            else:
                table = scan.current = scan.table(title)
                row = 0
        elif tag in words.passed_over:
            skipping = 1
        else:
            _small(scan, tag, attributes, table)

    def end(tag: str) -> None:
        nonlocal about, skipping, depth, row, col, table
        if skipping:
            skipping -= 1
            if not skipping and depth:
                paragraph.go_on()
        elif depth:
            depth -= 1
            if not depth:
                shown.append(paragraph.text())
        elif about is not None:
            cols = scan.count(about[columns_repeated]) if columns_repeated in about else 1
            if table is not None and (value_type in about or formula in about or shown):
                scan.cell(table, row, col, rows, cols, about, "\n".join(shown) if shown else None)
                shown.clear()
            col += cols
            about = None
            texts.clear()
        elif tag == words.row:
            row += rows
            scan.next_row = row
            scan.rows_ended += 1
            texts.clear()
        elif tag == words.table and table is not None:
            scan.end_table(table)
            table = scan.current = None

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = texts.append


def is_cache(title: str) -> bool:
    """Whether a table is LibreOffice's copy of another file's sheet."""
    return title.startswith("'") and "'#" in title and "/" in title


def _small(scan: ContentScan, tag: str, attributes: Mapping[str, str], table: Table | None) -> None:
    """Names, the calendar, the kind of the document."""
    words = scan.words
    if tag in (words.named_range, words.named_expression):
        is_range = tag == words.named_range
        formula = attributes.get(words.range_address if is_range else words.expression, "")
        base = attributes.get(words.base_cell, "")
        title = None if table is None else table.sheet.title
        scan.names.append(NameText(attributes.get(words.table_name, ""), formula, is_range, base, title))
    elif tag == words.database_range and words.table_name in attributes:
        # A list with filters or a table of Excel: formulas use its name like any other, which comes before it.
        name, area = attributes[words.table_name], attributes.get(words.target_address, "")
        scan.lists.append(NameText(name, area, True, "", None, fixed=True))
    elif tag == words.settings:
        scan.calculating({word: attributes.get(name) for word, name in words.calculating.items()})
    elif tag == words.iteration:
        scan.settings = replace(scan.settings, iterates=attributes.get(words.status) == "enable")
    elif tag == words.null_date:
        scan.calendar(attributes.get(words.date_value_of_null, ""))
    elif tag in words.kinds:
        scan.kind = words.kinds[tag]
