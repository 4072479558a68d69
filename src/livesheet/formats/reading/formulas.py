"""Formulas of a sheet while it is read: cell by cell, gathered into blocks, and what is wrong with them.

One parse does for a run, however long. A file that repeats the full text in every row costs a comparison of texts a cell:
the text that fill-down would have written in the next row is predicted from the first one. Columns with the same formula
side by side become one block. An array formula is one formula, and
cells that show its array, which files store as values.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import NamedTuple

from livesheet.diagnostics import Fault, FormulaError
from livesheet.formula.book import Block, BookSheet, CellStore, Kind
from livesheet.formula.lexer import tokenise
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, Call, Node, shifted
from livesheet.formula.parser import parse_formula
from livesheet.formula.references import CELL, ROW, area_name, parse_area
from livesheet.said import say

MAX_FAULTS = 100
"""Most faults that one sheet reports: a file of another kind would have one for each cell."""
MAX_FORMULA = 1 << 16
"""Most characters of a formula: Excel takes 8,192, the files spell some of them longer."""
_SHOWN = 60

Area = tuple[int, int, int, int]
"""Row, column, rows, columns."""


class CellFaults:
    """The faults and remarks of one sheet, each with its cells; formulas are parsed here, where most remarks come from.

    dialect  the spelling of the formulas, as `parse_formula` names it
    found    what refuses the file;  remarks  what is read in another way than it is meant
    """

    def __init__(self, file: str, title: str, dialect: str) -> None:
        self.file, self.title, self.dialect = file, title, dialect
        self.found: list[Fault] = []
        self.remarks: list[Fault] = []

    def note(self, message: str, row: int, col: int, hint: str = "") -> None:
        """Note what is wrong with a cell."""
        if len(self.found) < MAX_FAULTS:
            self.found.append(self._fault(message, (row, col, 1, 1), hint))

    def remark(self, message: str, area: Area, hint: str = "") -> None:
        """Note what is not as it is meant in the cells of `area`."""
        if len(self.remarks) < MAX_FAULTS:
            self.remarks.append(self._fault(message, area, hint))

    def _fault(self, message: str, area: Area, hint: str) -> Fault:
        return Fault(message, file=self.file, key=f"{self.title}!{area_name(*area)}", hint=hint)

    def formula(self, text: str, area: Area) -> Node | None:
        """The tree of a formula. None when it cannot be parsed, which is remarked: its cells keep their stored values."""
        if len(text) > MAX_FORMULA:
            self.remark(
                say("a formula of {count} characters, which is not read: stored values are kept", count=len(text)), area
            )
            return None
        try:
            return parse_formula(text, self.dialect)
        except FormulaError as problem:
            fault = problem.faults[0]
            text = text.removeprefix("=")
            shown = text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."
            self.remark(
                say("{message} of ={shown}: stored values are kept", message=fault.message, shown=shown),
                area,
                fault.hint,
            )
            return None


class Template:
    """A formula's text as pieces between the relative row numbers, and how far those rows are from the formula's own."""

    __slots__ = ("level", "offsets", "pieces")

    def __init__(self, text: str, row: int, dialect: str) -> None:
        self.pieces: list[str] = []
        self.offsets: list[int] = []
        done = 0
        for start, end in _relative_rows(text, dialect):
            self.pieces.append(text[done:start])
            self.offsets.append(int(text[start:end]) - 1 - row)
            done = end
        self.pieces.append(text[done:])
        self.level = not any(self.offsets)

    def text(self, row: int) -> str:
        """What fill-down writes in `row`."""
        if self.level:
            return str(row + 1).join(self.pieces)
        parts = [self.pieces[0]]
        for offset, piece in zip(self.offsets, self.pieces[1:], strict=True):
            parts.append(str(row + 1 + offset))
            parts.append(piece)
        return "".join(parts)

    def places(self, row: int) -> Iterator[tuple[int, int, int]]:
        """(start, stop, offset) of the row numbers in the text of `row`."""
        at = 0
        for offset, piece in zip(self.offsets, self.pieces, strict=False):
            start = at + len(piece)
            at = start + len(str(row + 1 + offset))
            yield start, at, offset


_BRACKETED_ROW = re.compile(r"'(?:[^']|'')+'|\.\$?[A-Za-z]{0,3}(?P<anchor>\$?)(?P<row>[1-9][0-9]{0,6})")
"""A row number inside OpenFormula's `[$'Sheet 1'.A$1:.B2]`; a quoted sheet name is passed over."""


def _relative_rows(text: str, dialect: str) -> list[tuple[int, int]]:
    """Where in a formula the row numbers without `$` stand."""
    found: list[tuple[int, int]] = []
    try:
        tokens = tokenise(text, dialect)
    except FormulaError:
        return found
    for token in tokens:
        start = token.column - 1
        if token.kind == "reference":
            for part in _BRACKETED_ROW.finditer(token.text):
                if part["row"] and not part["anchor"] and int(part["row"]) <= MAX_ROWS:
                    found.append((start + part.start("row"), start + part.end("row")))
        elif token.kind == "cell":
            match = CELL.fullmatch(token.text)
            if match and not match[3] and int(match[4]) <= MAX_ROWS:
                found.append((start + match.start(4), start + match.end(4)))
        elif token.kind == "rows":
            for row in (ROW.match(token.text), ROW.match(token.text, token.text.index(":") + 1)):
                if row and not row[1]:
                    found.append((start + row.start(2), start + row.end(2)))
    return found


_DIGITS = re.compile(r"[0-9]+")
"""Texts that differ in more than these are no formula filled down: most neighbours are told apart without their tokens."""

Key = tuple[str, int]
"""A shared formula: its number in the file, and which of the texts that the file gives for that number."""


class Run:
    """Cells of one column that hold the same formula as far as read. `shared` is the key of a shared formula, or None."""

    __slots__ = ("end", "first", "shared", "template", "text")

    def __init__(self, first: int, text: str, shared: Key | None) -> None:
        self.first = first
        self.end = first + 1
        self.text = text
        self.shared = shared
        self.template: Template | None = None


class FormulaRuns:
    """The formulas of one sheet while it is read, and the blocks they make.

    parse    (text, cells) -> the tree, None when it cannot be read;  dialect  the spelling of the texts
    unknown  (number, cells): told of members of a shared formula that has no text anywhere
    kept     after `blocks`: cells whose formulas could not be read
    """

    def __init__(
        self,
        parse: Callable[[str, Area], Node | None],
        dialect: str = "excel",
        unknown: Callable[[str, Area], None] = lambda key, area: None,
    ) -> None:
        self._parse = parse
        self._dialect = dialect
        self._unknown = unknown
        self._open: dict[int, Run] = {}
        self._closed: list[tuple[int, Run]] = []
        self._masters: dict[str, list[tuple[int, int, str]]] = {}
        self.kept: list[Area] = []

    def text(self, row: int, col: int, text: str) -> None:
        """A cell with its own text."""
        run = self._open.get(col)
        if run is not None and run.end == row and run.shared is None:
            template = run.template
            if template is None and _DIGITS.sub("", run.text) == _DIGITS.sub("", text):
                template = run.template = Template(run.text, run.first, self._dialect)
            if template is not None and template.text(row) == text:
                run.end += 1
                return
        self._start(col, Run(row, text, None))

    def master(self, row: int, col: int, key: str, text: str) -> None:
        """The cell that holds the text of a shared formula; a second text for a number is for the cells after it."""
        masters = self._masters.setdefault(key, [])
        masters.append((row, col, text))
        self._start(col, Run(row, text, (key, len(masters) - 1)))

    def member(self, row: int, col: int, key: str) -> None:
        """A cell of a shared formula without a text, which may come before the cell with the text."""
        shared = self._latest(key)
        run = self._open.get(col)
        if run is not None and run.end == row and run.shared == shared:
            run.end += 1
        else:
            self._start(col, Run(row, "", shared))

    def _latest(self, number: str) -> Key:
        """The key that a member of a shared formula has now."""
        masters = self._masters.get(number)
        return number, len(masters) - 1 if masters else 0

    def filled_to(self, col: int, row: int, least: int) -> Run | None:
        """The run of at least so many cells whose last one is in `row`, None when there is none that can go on."""
        run = self._open.get(col)
        return run if run is not None and run.end - run.first >= least and self.goes_on(col, run, row + 1) else None

    def goes_on(self, col: int, run: Run, row: int) -> bool:
        """Whether the same formula in `row` would be a part of the run: nothing has come between."""
        if self._open.get(col) is not run or run.end != row:
            return False
        return run.shared is None or run.shared == self._latest(run.shared[0])

    def all_go_on(self, runs: Mapping[int, Run], row: int) -> bool:
        """The same of several runs, by column."""
        return all(self.goes_on(col, run, row) for col, run in runs.items())

    def _start(self, col: int, run: Run) -> None:
        old = self._open.get(col)
        if old is not None:
            self._closed.append((col, old))
        self._open[col] = run

    def blocks(self) -> list[Block]:
        """All formulas as blocks, in the order of rows and columns; equal columns side by side are one."""
        runs = sorted([*self._closed, *self._open.items()], key=lambda item: (item[1].first, item[0]))
        masters: dict[Key, Node | None] = {}
        found: list[Block] = []
        for col, run in runs:
            area = run.first, col, run.end - run.first, 1
            formula = self._formula(run, area, masters)
            if formula is None:
                self.kept.append(area)
                continue
            block = Block(*area, formula)
            if found and _continues(found[-1], block):
                last = found[-1]
                found[-1] = Block(last.row, last.col, last.rows, last.cols + 1, last.formula)
            else:
                found.append(block)
        return found

    def _formula(self, run: Run, area: Area, masters: dict[Key, Node | None]) -> Node | None:
        if run.shared is None:
            return self._parse(run.text, area)
        number, which = run.shared
        if number not in self._masters:
            self._unknown(number, area)
            return None
        row, col, text = self._masters[number][which]
        if run.shared not in masters:
            masters[run.shared] = self._parse(text, (row, col, 1, 1))
        master = masters[run.shared]
        return None if master is None else shifted(master, area[0] - row, area[1] - col)


def _continues(last: Block, block: Block) -> bool:
    """Whether `block` is the next column of `last`: the same rows, and what fill-right would write there."""
    if (last.row, last.rows, last.col + last.cols) != (block.row, block.rows, block.col):
        return False
    before, formula = last.formula, block.formula
    if isinstance(before, Call) and not (isinstance(formula, Call) and before.name == formula.name):
        return False  # which is seen without shifting anything
    return shifted(before, 0, last.cols) == formula


MOST_CELLS = 1 << 24
"""Cells of all array formulas of a sheet: more of them are a mistake, or meant to fill the memory."""


class ArrayText(NamedTuple):
    """An array formula as it is read; a dynamic one grows and shrinks with its array."""

    row: int
    col: int
    rows: int
    cols: int
    text: str
    dynamic: bool


def array_text(row: int, col: int, ref: str, text: str, dynamic: bool) -> ArrayText | None:
    """An array formula in (row, col) with the area `ref` ("B2:B9"); None when that does not begin there or is too large."""
    area = parse_area(ref)
    if area is None or area[:2] != (row, col):
        return None
    rows, cols = area[2] - row + 1, area[3] - col + 1
    if rows < 1 or cols < 1 or rows * cols > MOST_CELLS:
        return None
    return ArrayText(row, col, rows, cols, text, dynamic)


def give_arrays(sheet: BookSheet, arrays: Iterable[ArrayText], faults: CellFaults) -> None:
    """Put array formulas into a sheet that has been read. The values in their areas are results, not constants."""
    taken: list[Block] = []
    cells = 0
    for array in arrays:
        cells += array.rows * array.cols
        if cells > MOST_CELLS:
            faults.note(
                say("array formulas over more than {most} cells: this is no workbook", most=MOST_CELLS),
                array.row,
                array.col,
            )
            break
        area = array.row, array.col, array.rows, array.cols
        formula = faults.formula(array.text, area)
        if formula is None:
            sheet.keep([(array.row, array.col, 1, 1)])
            continue
        if array.row + array.rows > MAX_ROWS or array.col + array.cols > MAX_COLUMNS:
            faults.note(say("an array formula that leaves the sheet"), array.row, array.col)
            continue
        kind: Kind = "spill" if array.dynamic else "array"
        taken.append(Block(*area, formula, kind))
    sheet.blocks.extend(taken)
    wide = [block for block in taken if block.rows * block.cols > 1]
    if wide:
        move_values(sheet, wide)


def move_values(sheet: BookSheet, blocks: list[Block]) -> None:
    """What stands as a constant inside the areas is a stored result."""
    areas: dict[int, list[tuple[int, int]]] = {}
    for block in sorted(blocks, key=lambda block: block.row):
        for col in range(block.col, block.col + block.cols):
            areas.setdefault(col, []).append((block.row, block.row + block.rows))
    constants = CellStore()
    for row, col, value in sheet.constants.items():
        here = areas.get(col, ())
        # Areas that overlap are refused later; the last that begins above is the one to look at in all others.
        index = bisect_right(here, (row, MAX_ROWS + 1)) - 1
        inside = index >= 0 and row < here[index][1]
        (sheet.cached if inside else constants).put(row, col, value)
    sheet.constants = constants
