"""A hidden sheet that computes a second time what the geometry of a row cannot prove, and marks each cell that differs.

The first sheet, the drawing, two-way tables, outputs, and what is sought between rows have no ruler and protractor to be
held against: a cell typed over or a formula changed would only look right. Here each such cell has a copy with the same
formula, which reads what the cell reads (not other copies): 0 where both agree, 1 where they do not.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, NameRef, Node, Number, RangeRef, Text, transform, walk
from mechsheet.formula.references import column_letters
from mechsheet.formula.spellings import longest_spelling
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.workbook import Area, Cell, Column, Conditional, Fill, PrintSetup, Sheet

TITLE_ROW, ABOUT_ROW, DIFFER_ROW, WHERE_ROW, ANY_ROW, HEAD_ROW, FIRST = range(7)
"""Rows: what holds for the whole sheet; over each column whether one of its cells differs, and the column it stands for;
then the copies, each FIRST rows below the row of its cell."""

LABEL, VALUE, COPIES = range(3)
"""First columns; the copies stand from the third on."""

LONGEST = 7_500
"""Characters of a copy, in the language where it has most; Excel takes 8,192, and the copy stands inside a comparison."""

SHORT = 100
"""Parts of a tree up to which its text is never that long: it need not be printed to see that."""

STEP = "#{number}"
"""What stands for a step in the formula that reads it."""

SHORTEST_STEP = 40
"""A call of so few characters is no step."""

Key = tuple[str, int, int]
"""A column beside the marks: sheet, 0 for a copy or the number of a step, column of the cell on that sheet."""

WRONG = Text("#")
"""Stands for an error: two errors are alike."""


def place_recomputed(plan: Plan) -> None:
    """Where the number of cells that differ will stand: the sheet of checks reads it before this sheet is laid out."""
    plan.at.spots["#differ"] = plan.at.shown["#differ"] = Spot(plan.at.titles["recomputed"], DIFFER_ROW, VALUE)


def recomputed_sheet(plan: Plan, sheets: Sequence[Sheet]) -> Sheet:
    """The sheet, with copies of the formulas of `sheets` (but for its own) that are not `plan.proven`."""
    title = plan.at.titles["recomputed"]
    clear = plan.at.spots["#clear"]
    repeats: list[_Repeat] = []
    for sheet in sheets:
        proven = plan.proven.get(sheet.title, set())
        for fill in sheet.fills if sheet.title != title else ():
            if (fill.row, fill.col) not in proven:
                again = _again(fill, sheet.title, clear)
                repeats += [] if again is None else [_Repeat(sheet.title, fill, *again)]
    titles = [sheet.title for sheet in sheets]
    heads = _sorted({key for repeat in repeats for key in repeat.columns()}, titles)
    apart = _sorted({key for repeat in repeats for key in repeat.apart()}, titles)
    place = {key: COPIES + index for index, key in enumerate(heads)}
    aside = {key: COPIES + len(heads) + 1 + index for index, key in enumerate(apart)}
    marks = tuple(repeat.marks(place, aside) for repeat in repeats)
    values = tuple(value for repeat in repeats for value in repeat.values(aside))
    return _Page(plan, marks, values, tuple(heads), tuple(apart)).sheet()


AnyKey = TypeVar("AnyKey", tuple[str, int], Key)


def _sorted(keys: Collection[AnyKey], titles: Sequence[str]) -> list[AnyKey]:
    """Sheet after sheet, from left to right: the columns of one fill beside each other."""
    return sorted(keys, key=lambda key: (titles.index(key[0]), *key[1:]))


_STYLE = styles.decimals(styles.INNER, 0)


def _again(fill: Fill, title: str, clear: Spot) -> tuple[Node, tuple[Node, ...]] | None:
    """A fill's formula as this sheet has it, and its steps; None for one that reads this sheet's result, or is too long."""
    circular = False
    parts = 0

    def change(part: Node) -> Node:
        nonlocal circular, parts
        parts += 1
        if isinstance(part, CellRef):
            there = part if part.sheet is not None else replace(part, sheet=title)
            circular = circular or (there.sheet, part.row, part.col) == (clear.sheet, clear.row, clear.col)
            return there
        return Call("ROW", (CellRef(fill.row, fill.col, sheet=title),)) if part == Call("ROW") else part

    again = transform(fill.formula, change)
    if circular:
        return None
    return _in_steps(again) if parts > SHORT else (again, ())


def _in_steps(formula: Node) -> tuple[Node, tuple[Node, ...]] | None:
    """A formula that is too long as one that reads steps, each in a cell of its own; None where it cannot be cut.

    A step is the call that takes most characters, however often it is repeated. None reads a range, which can be an array
    there, and none is a sum: programs take a sum that is a formula's last step for 0 when it is rounding.
    """
    steps: list[Node] = []
    while longest_spelling(formula) > LONGEST:
        calls = Counter(part for part in walk(formula) if isinstance(part, Call))
        lengths = {call: longest_spelling(call) for call in calls}
        fit = [call for call in calls if SHORTEST_STEP < lengths[call] <= LONGEST and not _reads_range(call)]
        if not fit:
            return None
        step = max(fit, key=lambda call: calls[call] * lengths[call])
        steps.append(step)
        formula = _put(formula, step, NameRef(STEP.format(number=len(steps))))
    return formula, tuple(steps)


def _put(formula: Node, step: Node, cell: Node) -> Node:
    """The formula with `cell` in place of a step."""
    return transform(formula, lambda part: cell if part == step else part)


def _reads_range(node: Node) -> bool:
    return any(isinstance(part, RangeRef) for part in walk(node))


@dataclass(frozen=True, slots=True)
class _Repeat:
    """A fill of the sheet `title`, its formula as this sheet has it, and the steps which that reads by names."""

    title: str
    fill: Fill
    again: Node
    steps: tuple[Node, ...] = ()

    @property
    def is_apart(self) -> bool:
        """Whether the copy must stand in a cell of its own: programs take a sum or difference that is a formula's last step
        for 0 when it is rounding, and do not when it stands inside another formula."""
        return isinstance(self.again, Binary) and self.again.op in ("+", "-")

    def columns(self) -> list[tuple[str, int]]:
        """(sheet, column) of its cells."""
        return [(self.title, self.fill.col + index) for index in range(self.fill.cols)]

    def apart(self) -> list[Key]:
        """The columns that it needs beside the marks, the copy's own as number 0."""
        numbers = [*([0] if self.is_apart else []), *range(1, 1 + len(self.steps))]
        # A step's columns lie beside each other, as its formula wants it.
        return [(self.title, number, col) for number in numbers for _, col in self.columns()]

    def marks(self, place: Mapping[tuple[str, int], int], aside: Mapping[Key, int]) -> Fill:
        """0 where the cell and its copy agree, else 1."""
        fill = self.fill
        own = CellRef(fill.row, fill.col, sheet=self.title)
        again = self._cell(0, aside) if self.is_apart else self._bound(self.again, aside)
        alike = Binary("=", Call("IFERROR", (again, WRONG)), Call("IFERROR", (own, WRONG)))
        mark = Call("IF", (alike, al.ZERO, al.ONE))
        return replace(fill, row=fill.row + FIRST, col=place[self.title, fill.col], formula=mark, style=_STYLE)

    def values(self, aside: Mapping[Key, int]) -> list[Fill]:
        """The copy in cells of its own, and the steps."""
        formulas = [*([(0, self.again)] if self.is_apart else []), *enumerate(self.steps, 1)]
        return [
            replace(
                self.fill,
                row=self.fill.row + FIRST,
                col=aside[self.title, number, self.fill.col],
                formula=self._bound(formula, aside),
                style=styles.INNER,
            )
            for number, formula in formulas
        ]

    def _cell(self, number: int, aside: Mapping[Key, int]) -> CellRef:
        return CellRef(self.fill.row + FIRST, aside[self.title, number, self.fill.col])

    def _bound(self, formula: Node, aside: Mapping[Key, int]) -> Node:
        """The formula with the cells of its steps."""
        cells = {STEP.format(number=number): self._cell(number, aside) for number in range(1, 1 + len(self.steps))}
        return (
            transform(
                formula, lambda part: cells[part.name] if isinstance(part, NameRef) and part.name in cells else part
            )
            if cells
            else formula
        )


@dataclass(frozen=True, slots=True)
class _Page:
    """The sheet's cells around the copies."""

    plan: Plan
    marks: tuple[Fill, ...]
    values: tuple[Fill, ...]
    heads: tuple[tuple[str, int], ...]
    apart: tuple[Key, ...]

    def sheet(self) -> Sheet:
        """The finished sheet."""
        text = self.plan.text
        last = COPIES + len(self.heads) - 1
        labels = ((DIFFER_ROW, "differ"), (WHERE_ROW, "where"), (ANY_ROW, "any"))
        names = [f"{title}!{column_letters(col)}" for title, col in self.heads]
        values = [text("recomputed.value", column=f"{title}!{column_letters(col)}") for title, _, col in self.apart]
        cells = [
            Cell(TITLE_ROW, LABEL, text("recomputed.title"), styles.TITLE),
            Cell(ABOUT_ROW, LABEL, text("recomputed.about"), styles.SUBTITLE),
            *(Cell(row, LABEL, text(f"recomputed.{key}"), styles.LABEL) for row, key in labels),
            *(Cell(HEAD_ROW, COPIES + index, name, styles.HEAD) for index, name in enumerate(names)),
            *(Cell(HEAD_ROW, last + 2 + index, name, styles.HEAD) for index, name in enumerate(values)),
        ]
        bottom = max(fill.row + fill.rows - 1 for fill in self.marks)
        return Sheet(
            self.plan.at.titles["recomputed"],
            tuple(cells),
            (*self._results(bottom, last), *self.marks, *self.values),
            columns=(Column(LABEL, LABEL, 26), Column(VALUE, VALUE, 14), Column(COPIES, last + 1 + len(values), 12)),
            row_heights=((TITLE_ROW, 26.0),),
            conditionals=tuple(
                Conditional(area, Binary("=", CellRef(area.first_row, COPIES), al.ONE), styles.BAD)
                for area in (Area(ANY_ROW, COPIES, ANY_ROW, last), Area(FIRST, COPIES, bottom, last))
            ),
            freeze=(FIRST, COPIES),
            selected=(DIFFER_ROW, VALUE),
            hidden=True,
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(fit_width=0, repeat_rows=(HEAD_ROW, HEAD_ROW), footer=self.plan.footer),
        )

    def _results(self, bottom: int, last: int) -> tuple[Fill, ...]:
        """How many cells differ (a copy typed over with a text is one more), the first of them, and a mark over columns."""
        column = RangeRef(CellRef(FIRST, COPIES, True, False), CellRef(bottom, COPIES, True, False))
        everything = RangeRef(CellRef(FIRST, COPIES, True, True), CellRef(bottom, last, True, True))
        count = sum(fill.rows * fill.cols for fill in self.marks)
        lost = Call("ABS", (al.sub(Call("COUNT", (everything,)), Number(float(count))),))
        differ = al.add(Call("SUM", (everything,)), lost)
        some = Call("IF", (Binary("=", Call("SUM", (column,)), al.ZERO), al.ZERO, al.ONE))
        marks = RangeRef(CellRef(ANY_ROW, COPIES, True, True), CellRef(ANY_ROW, last, True, True))
        heads = RangeRef(CellRef(HEAD_ROW, COPIES, True, True), CellRef(HEAD_ROW, last, True, True))
        number = Call("MATCH", (al.ONE, marks, al.ZERO))
        row = Call("MATCH", (al.ONE, Call("INDEX", (everything, al.ZERO, number)), al.ZERO))
        cell = Binary("&", Call("INDEX", (heads, number)), row)
        where = Call("IFERROR", (cell, Text(self.plan.text("recomputed.none"))))
        return (
            Fill(DIFFER_ROW, VALUE, differ, styles.decimals(styles.RESULT, 0)),
            Fill(WHERE_ROW, VALUE, where, styles.RESULT),
            Fill(ANY_ROW, COPIES, some, _STYLE, cols=len(self.heads)),
        )
