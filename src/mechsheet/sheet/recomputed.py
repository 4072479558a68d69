"""A hidden sheet that computes a second time what the geometry of a row cannot prove, and marks each cell that differs.

The first sheet, the drawing, two-way tables, outputs, and what is sought between rows have no ruler and protractor to be
held against: a cell typed over or a formula changed would only look right. Here each such cell has a copy with the same
formula, which reads what the cell reads (not other copies): 0 where both agree, 1 where they do not.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text, transform
from mechsheet.formula.printer import print_formula
from mechsheet.formula.references import column_letters
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.workbook import Area, Cell, Column, Conditional, Fill, PrintSetup, Sheet

TITLE_ROW, ABOUT_ROW, DIFFER_ROW, WHERE_ROW, ANY_ROW, HEAD_ROW, FIRST = range(7)
"""Rows: what holds for the whole sheet; over each column whether one of its cells differs, and the column it stands for;
then the copies, each FIRST rows below the row of its cell."""

LABEL, VALUE, COPIES = range(3)
"""First columns; the copies stand from the third on."""

LONGEST = 8000
"""Characters of a formula that has a copy; Excel takes 8,192, and the copy stands inside a comparison."""

SHORT = 100
"""Parts of a tree up to which its text is never that long: it need not be printed to see that."""

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
                repeats += [] if again is None else [_Repeat(sheet.title, fill, again)]
    heads = _columns(repeats, [sheet.title for sheet in sheets])
    apart = _columns([repeat for repeat in repeats if repeat.apart], [sheet.title for sheet in sheets])
    place = {key: COPIES + index for index, key in enumerate(heads)}
    aside = {key: COPIES + len(heads) + 1 + index for index, key in enumerate(apart)}
    marks = tuple(repeat.marks(place, aside) for repeat in repeats)
    values = tuple(repeat.values(aside) for repeat in repeats if repeat.apart)
    return _Page(plan, marks, values, tuple(heads), tuple(apart)).sheet()


def _columns(repeats: Sequence[_Repeat], titles: Sequence[str]) -> list[tuple[str, int]]:
    """The columns that stand in them, sheet after sheet, from left to right: those of one fill beside each other."""
    return sorted(
        {key for repeat in repeats for key in repeat.columns()}, key=lambda key: (titles.index(key[0]), key[1])
    )


_STYLE = styles.decimals(styles.INNER, 0)


def _again(fill: Fill, title: str, clear: Spot) -> Node | None:
    """A fill's formula as this sheet has it; None for one that depends on this sheet's result, or that is too long."""
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
    too_long = parts > SHORT and len(print_formula(again, "excel")) > LONGEST
    return None if circular or too_long else again


@dataclass(frozen=True, slots=True)
class _Repeat:
    """A fill of the sheet `title`, and its formula as this sheet has it."""

    title: str
    fill: Fill
    again: Node

    @property
    def apart(self) -> bool:
        """Whether the copy must stand in a cell of its own: programs take a sum or difference that is a formula's last step
        for 0 when it is rounding, and do not when it stands inside another formula."""
        return isinstance(self.again, Binary) and self.again.op in ("+", "-")

    def columns(self) -> list[tuple[str, int]]:
        """(sheet, column) of its cells."""
        return [(self.title, self.fill.col + index) for index in range(self.fill.cols)]

    def marks(self, place: Mapping[tuple[str, int], int], aside: Mapping[tuple[str, int], int]) -> Fill:
        """0 where the cell and its copy agree, else 1."""
        fill, key = self.fill, (self.title, self.fill.col)
        own = CellRef(fill.row, fill.col, sheet=self.title)
        again = CellRef(fill.row + FIRST, aside[key]) if self.apart else self.again
        alike = Binary("=", Call("IFERROR", (again, WRONG)), Call("IFERROR", (own, WRONG)))
        mark = Call("IF", (alike, al.ZERO, al.ONE))
        return replace(fill, row=fill.row + FIRST, col=place[key], formula=mark, style=_STYLE)

    def values(self, aside: Mapping[tuple[str, int], int]) -> Fill:
        """The copy in cells of its own."""
        col = aside[self.title, self.fill.col]
        return replace(self.fill, row=self.fill.row + FIRST, col=col, formula=self.again, style=styles.INNER)


@dataclass(frozen=True, slots=True)
class _Page:
    """The sheet's cells around the copies."""

    plan: Plan
    marks: tuple[Fill, ...]
    values: tuple[Fill, ...]
    heads: tuple[tuple[str, int], ...]
    apart: tuple[tuple[str, int], ...]

    def sheet(self) -> Sheet:
        """The finished sheet."""
        text = self.plan.text
        last = COPIES + len(self.heads) - 1
        labels = ((DIFFER_ROW, "differ"), (WHERE_ROW, "where"), (ANY_ROW, "any"))
        names = [f"{title}!{column_letters(col)}" for title, col in self.heads]
        values = [text("recomputed.value", column=f"{title}!{column_letters(col)}") for title, col in self.apart]
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
