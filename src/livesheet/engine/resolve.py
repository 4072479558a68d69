"""Formulas made ready for evaluation: names replaced by what they stand for, every reference with its sheet.

What is not known is remarked with its cells and becomes the error that spreadsheet programs show: nothing stops the rest.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from ..diagnostics import Fault, FormulaError, near_miss
from ..formula.book import Block, Book, DefinedName
from ..formula.dialects import MAX_NESTING
from ..formula.functions import FUNCTIONS, MANY
from ..formula.names import folded
from ..formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    UNKNOWN_FUNCTION,
    Apply,
    Arrayed,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Foreign,
    FunctionRef,
    Missing,
    NameRef,
    Node,
    Number,
    Previous,
    RangeRef,
    SheetsRef,
    Symbol,
    TableRef,
    Text,
    Unary,
    anchored,
    shifted,
    transform,
    walk,
)
from ..formula.parser import parse_formula
from ..formula.printer import quote_sheet
from ..formula.references import area_name, parse_r1c1
from ..formula.tables import cells_of_table
from ..said import Said, say, say_count
from .graph import ANYWHERE, reads_anywhere
from .interpreter.environment import deeply
from .interpreter.regions import gives_region
from .interpreter.rewriting import intersected, is_function, with_locals
from .kernels.table import lacks_scipy

_MOST_SHEETS = 1024
_ZEROS = re.compile(r"(?<![\w.])0+(?=[1-9])|(?<=[A-Za-z$])(?<![A-Za-z]{4})0+(?=[1-9][0-9]*(?![\w.]))")
_MOST_READ = 20_000
"""Texts of INDIRECT whose meaning is remembered."""
_STEADY = frozenset(("OFFSET", "INDIRECT", "CELL", "INFO"))
"""Volatile functions that give the same value as long as the workbook stays as it is."""

FOREIGN = "another workbook"
UNSTEADY = "another value at every recalculation"
"""Why a workbook alone does not say what a formula gives."""

ELSEWHERE = frozenset(
    ("CUBEKPIMEMBER", "CUBEMEMBER", "CUBEMEMBERPROPERTY", "CUBERANKEDMEMBER", "CUBESET", "CUBESETCOUNT", "CUBEVALUE", "CALL",
     "COPILOT", "DDE", "DETECTLANGUAGE", "EUROCONVERT", "IMAGE", "PY", "REGISTER.ID", "RTD", "SQL.REQUEST", "STOCKHISTORY",
     "TRANSLATE", "WEBSERVICE")
)  # fmt: skip
"""Excel's and LibreOffice's own functions that ask the world outside: no macro of the file defines them."""


def _with_kept(fault: Fault) -> Fault:
    """What is remarked of a function when its cells keep their stored values."""
    if fault.about != "function":
        return fault
    return replace(fault, message=say("{message}: stored values are kept", message=fault.message))


def _arguments(least: int, most: int) -> Said:
    """How many arguments a function takes."""
    if most == MANY:
        return say_count("at least 1 argument", "at least {count} arguments", least)
    if least == most:
        return say_count("1 argument", "{count} arguments", least)
    return say("{least} to {most} arguments", least=least, most=most)


def _is_unsteady(name: str) -> bool:
    return name not in _STEADY and name in FUNCTIONS and FUNCTIONS[name].volatile


def _rows(block: Block) -> range:
    return range(block.row, block.row + block.rows)


def _cols(block: Block) -> range:
    return range(block.col, block.col + block.cols)


@dataclass(slots=True)
class Resolved:
    """What is known of the formulas of a book that have been asked for.

    functions  what the names that stand for functions mean
    remarks    what is not as it is meant, with its cells
    kept       blocks that keep the values stored in the file -> the error of cells without one
    unsteady   blocks with functions that give another value at every recalculation
    moving     blocks that read what is known only when they are computed
    """

    functions: dict[FunctionRef, Node] = field(default_factory=dict)
    remarks: list[Fault] = field(default_factory=list)
    kept: dict[int, str] = field(default_factory=dict)
    unsteady: set[int] = field(default_factory=set)
    moving: set[int] = field(default_factory=set)


def _same_size(call: Call) -> Call:
    """SUMIF and AVERAGEIF take as many cells from the first of their last argument on as the first argument has."""
    if call.name not in ("SUMIF", "AVERAGEIF") or len(call.args) < 3:
        return call
    asked, criterion, summed = call.args
    first, last = (asked.start, asked.end) if isinstance(asked, RangeRef) else (asked, asked)
    start, end = (summed.start, summed.end) if isinstance(summed, RangeRef) else (summed, summed)
    if not all(isinstance(corner, CellRef) for corner in (first, last, start, end)):
        return call
    assert isinstance(first, CellRef) and isinstance(last, CellRef)
    assert isinstance(start, CellRef) and isinstance(end, CellRef)
    down, right = last.row - first.row, last.col - first.col
    if (end.row - start.row, end.col - start.col) == (down, right):
        return call
    corner = replace(start, row=min(start.row + down, MAX_ROWS - 1), col=min(start.col + right, MAX_COLUMNS - 1))
    if first.row_abs and not last.row_abs:  # a range that grows with fill-down
        corner = replace(corner, row_abs=False)
    return Call(call.name, (asked, criterion, RangeRef(start, corner)))


def _typed(text: str) -> Node | None:
    """A reference as a person types it: "05:05" is a row, and a sheet's name needs no quotation marks."""
    before, mark, area = text.strip().rpartition("!")
    spellings = [_ZEROS.sub("", text)]
    if mark and not before.startswith("'"):
        spellings.append(f"{quote_sheet(before)}!{_ZEROS.sub('', area)}")
    for spelling in spellings:
        try:
            return parse_formula(spelling)
        except FormulaError:
            continue
    return None


def _on_sheet(area: Node, title: str) -> Node:
    return transform(area, lambda ref: replace(ref, sheet=title) if isinstance(ref, CellRef) else ref)


_RESOLVED = frozenset((Number, Text, Boolean, Missing, ErrorValue, Unary, Binary, RangeRef))
"""What most of a formula is made of, and means the same in every workbook."""


class Resolver:
    """Resolves the formulas of one book.

    Unknown names are #NAME?, a wrong number of arguments #VALUE!, a sheet that does not exist #REF!; a block that reads
    another workbook, or calls an unknown function, keeps its stored values (without any, an unknown function is #NAME?). All
    of these but #REF! are remarked, volatile functions too.

    steady  blocks with volatile functions keep their stored values, where each of their cells has one
    """

    def __init__(self, book: Book, steady: bool = False) -> None:
        self.book = book
        self.steady = steady
        self.titles = {sheet.title.casefold(): sheet.title for sheet in book.sheets}
        self.names = {(d.name.casefold(), d.sheet and d.sheet.casefold()): d for d in reversed(book.names)}
        self.alike = {folded(d.name): d for d in reversed(book.names) if d.sheet is None}
        self.tables = {table.name.casefold() for table in book.tables}
        self.found = Resolved()
        self._stored = {sheet.title: sheet.cached for sheet in book.sheets}
        self._read: dict[tuple[str, bool, str, int, int], Node | None] = {}

    def reference(self, text: str, in_a1: bool, sheet: str, row: int, col: int) -> Node | None:
        """The reference that a text says in (row, col) of `sheet`, None when it says none; not in A1 form, it is in R1C1."""
        key = text, in_a1, sheet, row, col
        if key not in self._read:
            if len(self._read) >= _MOST_READ:
                self._read.clear()
            self._read[key] = self._reference(*key)
        return self._read[key]

    def _reference(self, text: str, in_a1: bool, sheet: str, row: int, col: int) -> Node | None:
        node = _typed(text) if in_a1 else parse_r1c1(text, row, col)
        before = len(self.found.remarks)
        block = Block(row, col, 1, 1, node or ErrorValue("#REF!"))
        found = self.named(block.formula, block, sheet, "", ())
        del self.found.remarks[before:]  # #REF! says enough
        return None if isinstance(found, ErrorValue) else transform(found, anchored)

    def formula(self, number: int, block: Block, sheet: str) -> Node:
        """The formula of the block of this number, ready for evaluation. Remarks are made with its cells."""
        return deeply(lambda: self._formula(number, block, sheet))

    def _formula(self, number: int, block: Block, sheet: str) -> Node:
        place = f"{sheet}!{area_name(block.row, block.col, block.rows, block.cols)}"
        before = len(self.found.remarks)
        node = self.named(with_locals(block.formula), block, sheet, place, ())
        parts = list(walk(node))
        kinds = set(map(type, parts))
        names = dict.fromkeys(part.name for part in parts if isinstance(part, Call)) if Call in kinds else {}
        for name in names:
            if _is_unsteady(name):
                self.remark(
                    place, say("{name} gives another value at every recalculation", name=name), about="volatile"
                )
        if any(map(_is_unsteady, names)) or not kinds.isdisjoint((Foreign, FunctionRef)):
            self._note_strangers(number, node, block, sheet)
        if self.book.settings.as_shown:
            self.found.kept[number] = "#VALUE!"
        said = dict.fromkeys(self.found.remarks[before:])
        self.found.remarks[before:] = [_with_kept(fault) if number in self.found.kept else fault for fault in said]
        may_move = FunctionRef in kinds or not ANYWHERE.isdisjoint(names)
        may_move = may_move or any(isinstance(part, Binary) and part.op == ":" for part in parts)
        if may_move and number not in self.found.kept and reads_anywhere(node, self.found.functions):
            self.found.moving.add(number)
        return intersected(node) if block.kind == "fill" and names and RangeRef in kinds else node

    def named(self, node: Node, block: Block, sheet: str, place: str, inside: tuple[str, ...]) -> Node:
        """The tree with its names replaced and its references given their sheet."""

        def change(part: Node) -> Node:
            if type(part) in _RESOLVED:
                return part
            match part:
                case CellRef():
                    return self.cell(part, sheet)
                case NameRef():
                    return self.name(part, block, sheet, place, inside)
                case Call():
                    return self.call(part, block, sheet, place)
                case TableRef():
                    found = cells_of_table(part, self.book.tables, sheet, block.row, block.col)
                    return transform(found, change) if isinstance(found, CellRef | RangeRef) else found
                case SheetsRef(first, last, area):
                    return self.through_sheets(first, last, area)
                case FunctionRef(name, "") if name not in FUNCTIONS or lacks_scipy(name):
                    return self.unknown_function(place, name)
                case Foreign(text, why) if why != UNKNOWN_FUNCTION:
                    self.remark(place, say("{why}, {text}: stored values are kept", why=why, text=text))
                    return part
                case Symbol() | Previous():
                    raise TypeError(f"{place}: {part} is not bound to a cell")
                case _:
                    return part

        return transform(node, change)

    def cell(self, part: CellRef, sheet: str) -> CellRef | ErrorValue:
        """A reference with its sheet; on `sheet` where it names none."""
        title = self.titles.get((part.sheet or sheet).casefold())
        if title is None:
            return ErrorValue("#REF!")
        return part if part.sheet == title else CellRef(part.row, part.col, part.row_abs, part.col_abs, title)

    # names

    def name(self, part: NameRef, block: Block, sheet: str, place: str, inside: tuple[str, ...]) -> Node:
        """What a name stands for."""
        defined = self.find(part, sheet)
        if defined is None and part.sheet is None and part.name.casefold() in self.tables:
            return cells_of_table(TableRef(part.name), self.book.tables, sheet, block.row, block.col)
        if defined is None:
            known = [each.name for each in self.book.names]
            return self.unknown(place, say("unknown name {name}", name=part.name), near_miss(part.name, known))
        home = defined.sheet or sheet
        match defined.formula:
            case CellRef(_, _, True, True):  # what most names are: one cell, wherever they are used
                return self.cell(defined.formula, home)
        formula = with_locals(defined.formula)
        if is_function(formula):
            return self.function_name(defined, formula, block, sheet, place)
        if defined.name in inside:
            circle = " -> ".join((*inside, defined.name))
            return self.unknown(
                place, say("the name {name} stands for itself: {circle}", name=defined.name, circle=circle)
            )
        if len(inside) >= MAX_NESTING:
            return self.unknown(place, say("names that stand for one another, more than {most} deep", most=MAX_NESTING))
        moved = shifted(formula, block.row, block.col, wrap=True)
        found = self.named(moved, block, home, place, (*inside, defined.name))
        if gives_region(found) or not any(isinstance(each, RangeRef | ArrayLiteral) for each in walk(found)):
            return found
        return Arrayed(found)

    def find(self, reference: NameRef, sheet: str) -> DefinedName | None:
        """The sheet's own name before the book's."""
        name = reference.name.casefold()
        return self.names.get((name, (reference.sheet or sheet).casefold())) or self.names.get((name, None))

    def function_name(self, defined: DefinedName, formula: Node, block: Block, sheet: str, place: str) -> FunctionRef:
        """A name that stands for a function; what it says is resolved once, so that it may call itself."""
        refs = [part for part in walk(formula) if isinstance(part, CellRef)]
        moves = any(not (ref.row_abs and ref.col_abs) for ref in refs)
        key = FunctionRef(defined.name, defined.sheet or sheet, *((block.row, block.col) if moves else (0, 0)))
        if key not in self.found.functions:
            self.found.functions[key] = formula
            moved = shifted(formula, block.row, block.col, wrap=True) if moves else formula
            self.found.functions[key] = self.named(moved, block, key.sheet, place, ())
        return key

    # functions and references

    def call(self, part: Call, block: Block, sheet: str, place: str) -> Node:
        """A function's call, if there is such a function and it takes as many arguments."""
        row = FUNCTIONS.get(part.name)
        if row is None:
            # the capitals in which calls are read are those of two letters: Açı and Açi
            defined = self.find(NameRef(part.name), sheet) or self.alike.get(folded(part.name))
            if defined is not None:
                function = self.function_name(defined, with_locals(defined.formula), block, sheet, place)
                return Apply(function, part.args)
        if row is None or lacks_scipy(part.name):
            return self.unknown_function(place, part.name)
        if row.least <= len(part.args) <= row.most:
            return _same_size(part)
        takes = _arguments(row.least, row.most)
        self.remark(
            place, say("{text} takes {takes}, found {count}", text=part.name, takes=takes, count=len(part.args))
        )
        return ErrorValue("#VALUE!")

    def through_sheets(self, first: str, last: str, area: Node) -> Node:
        """The same cells of several sheets, as a union."""
        titles = list(self.titles)
        if first.casefold() not in titles or last.casefold() not in titles:
            return ErrorValue("#REF!")
        start, end = sorted((titles.index(first.casefold()), titles.index(last.casefold())))
        union: Node | None = None
        for title in [sheet.title for sheet in self.book.sheets][start : end + 1][:_MOST_SHEETS]:
            there = _on_sheet(area, title)
            union = there if union is None else Binary(",", union, there)
        return union or ErrorValue("#REF!")

    def _note_strangers(self, number: int, formula: Node, block: Block, sheet: str) -> None:
        """Whether a block keeps its stored values: for what it cannot know, itself or by the functions that it calls."""
        kinds = set(self._strangers(formula))
        if UNSTEADY in kinds:
            self.found.unsteady.add(number)
        if not kinds:
            return
        stored = self._stored[sheet]
        have = [stored.get(row, col) is not None for col in _cols(block) for row in _rows(block)]
        if FOREIGN in kinds or (UNSTEADY in kinds and self.steady and all(have)):
            self.found.kept[number] = "#REF!"
        elif UNKNOWN_FUNCTION in kinds and any(have):
            self.found.kept[number] = "#NAME?"

    def _strangers(self, formula: Node) -> Iterator[str]:
        """What a formula has that the workbook does not say, also by the functions that names stand for."""
        seen: set[FunctionRef] = set()
        waiting = [formula]
        while waiting:
            for part in walk(waiting.pop()):
                if isinstance(part, Foreign):
                    yield UNKNOWN_FUNCTION if part.why == UNKNOWN_FUNCTION else FOREIGN
                elif isinstance(part, Call) and _is_unsteady(part.name):
                    yield UNSTEADY
                elif isinstance(part, FunctionRef) and part not in seen and part in self.found.functions:
                    seen.add(part)
                    waiting.append(self.found.functions[part])

    # remarks

    def unknown(self, place: str, message: str, hint: str = "") -> ErrorValue:
        """Remark something that is not known."""
        self.remark(place, message, hint)
        return ErrorValue("#NAME?")

    def unknown_function(self, place: str, name: str) -> Foreign:
        """Remark a function that is not known, or not without SciPy. Its cells keep what is stored; else they are #NAME?."""
        if name in FUNCTIONS:
            message, hint = say("{name} needs scipy, which is not installed", name=name), "pip install scipy"
        elif self.book.macros and name not in ELSEWHERE:
            message, hint = say("{name} is defined in this file's {macros}", name=name, macros=self.book.macros), ""
        else:
            message, hint = say("unknown function {name}", name=name), near_miss(name, FUNCTIONS)
        self.remark(place, message, hint, "function")
        return Foreign(name, UNKNOWN_FUNCTION)

    def remark(self, place: str, message: str, hint: str = "", about: str = "") -> None:
        """Note what is not as it is meant in the cells of `place`."""
        self.found.remarks.append(Fault(message, file=self.book.source, key=place, hint=hint, about=about))
