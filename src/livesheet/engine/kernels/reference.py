"""Functions of references: what they mean, where they are, what kind of cells stand there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ...diagnostics import FormulaError
from ...formula.nodes import Call, CellRef, Node, RangeRef, shifted
from ...formula.printer import print_formula, quote_sheet
from ...formula.references import column_letters
from ...said import reason, say
from ..interpreter.calling import Args
from ..interpreter.closures import Evaluation
from ..interpreter.regions import gives_region, regions
from ..layout import Area
from ..values.cells import (
    BLANK,
    NA,
    REF,
    TEXT,
    VALUE,
    Cells,
    Frame,
    Span,
    UnsupportedError,
    VaryingSizeError,
    boolean,
    codes_of,
    error,
)
from ..values.coerce import text_of


def _cell_by_cell(kernel: Callable[[Evaluation, Args, Frame], Cells]) -> Any:
    """A kernel that computes one cell at a time."""

    def each(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        if frame.rows > 1 or frame.cols > 1:
            raise VaryingSizeError
        return kernel(ev, args, frame)

    return each


def _region(name: str) -> Any:
    """A function that gives a reference, as a value."""

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        return ev.region(Call(name, args), frame, spread)

    return kernel


def single(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """`@`: of a reference the cell beside the formula, of an array its first cell."""
    del spread
    if isinstance(args[0], RangeRef | CellRef) or gives_region(args[0]):
        found = ev.value(args[0], frame)
    else:
        found = ev.value(args[0], frame, spread=True)
    if np.ndim(found.numbers) <= 2:
        return found
    shape = found.shape
    numbers, codes = np.broadcast_to(found.numbers, shape)[0, 0], np.broadcast_to(codes_of(found), shape)[0, 0]
    if shape[2] == 1:
        numbers, codes = numbers[0], codes[0]
        if shape[3] == 1:
            numbers, codes = numbers[0], codes[0]
    return Cells(numbers, codes if np.count_nonzero(codes) else None)


def areas(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """AREAS: how many rectangles a reference has."""
    found = regions(ev, args[0], frame)
    if isinstance(found, Cells):
        return found
    return error(VALUE) if found is None else Cells(np.float64(len(found)))


def isref(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """ISREF: whether the argument is a reference."""
    return boolean(np.bool_(isinstance(regions(ev, args[0], frame), list)))


def _first(ev: Evaluation, node: Node, frame: Frame) -> Span | Cells:
    """The first cell of a reference."""
    found = regions(ev, node, frame)
    if isinstance(found, list):
        return found[0]
    return error(VALUE) if found is None else found


def _formula_at(ev: Evaluation, span: Span) -> tuple[Node, bool] | None:
    """The formula of a cell as it stands there, and whether it is an array formula; None where there is none."""
    sheet = ev.around.book.sheets[span.sheet]
    block = sheet.formula_at(span.row, span.col)
    if block is None:
        return None
    if block.kind != "fill":
        own = block.kind == "array" or (span.row, span.col) == (block.row, block.col)
        return (block.formula, block.kind == "array") if own else None
    return shifted(block.formula, span.row - block.row, span.col - block.col), False


def isformula(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """ISFORMULA: whether a cell holds a formula; where arrays are taken, of each cell of a range."""
    if frame.rows > 1 or frame.cols > 1:
        raise VaryingSizeError
    span = _first(ev, args[0], frame)
    if not isinstance(span, Span):
        return span
    if not spread or span.height * span.width == 1:
        return boolean(np.bool_(_formula_at(ev, span) is not None))
    found = np.zeros((span.height, span.width), dtype=np.bool_)
    for block in ev.around.book.sheets[span.sheet].blocks:
        whole = block.kind in ("fill", "array")  # of others the first cell alone holds the formula
        rows, cols = (block.rows, block.cols) if whole else (1, 1)
        top, left = block.row - span.row, block.col - span.col
        found[max(0, top) : max(0, top + rows), max(0, left) : max(0, left + cols)] = True
    return boolean(found[:, :, np.newaxis, np.newaxis])


def formulatext(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """FORMULATEXT: the formula of a cell as text, #N/A where there is none."""
    span = _first(ev, args[0], frame)
    if not isinstance(span, Span):
        return span
    found = _formula_at(ev, span)
    if found is None:
        return error(NA)
    try:
        text = "=" + print_formula(found[0]).replace("_xlfn.", "").replace("_xlws.", "").replace("_xlpm.", "")
    except (FormulaError, ValueError) as problem:
        raise UnsupportedError(
            say("FORMULATEXT of a formula that cannot be written: {problem}", problem=reason(problem))
        ) from problem
    return ev.texts.constant(f"{{{text}}}" if found[1] else text)


def sheet(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """SHEET: the number of a sheet, by a reference or a title; without an argument the formula's own."""
    if not args:
        return Cells(np.float64(frame.sheet + 1))
    found = regions(ev, args[0], frame)
    if isinstance(found, list):
        return Cells(np.float64(found[0].sheet + 1))
    title = text_of(ev.value(args[0], frame), ev.texts) if found is None else found
    if isinstance(title, Cells):
        return title
    titles = [known.casefold() for known in ev.layout.titles]
    return Cells(np.float64(titles.index(title.casefold()) + 1)) if title.casefold() in titles else error(NA)


def sheets(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """SHEETS: how many sheets a reference has cells of; without an argument how many there are."""
    if not args:
        return Cells(np.float64(len(ev.layout.titles)))
    found = regions(ev, args[0], frame)
    if isinstance(found, list):
        return Cells(np.float64(len({span.sheet for span in found})))
    return error(REF) if found is None else found


def cell(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """CELL: address, row, col, contents or type of a reference's first cell, or "filename": [book.xlsx]Sheet, without the
    folder. Other information is not known here."""
    what = text_of(ev.value(args[0], frame), ev.texts)
    if isinstance(what, Cells):
        return what
    what = what.strip().lower()
    if what == "filename":
        span = _first(ev, args[1], frame) if len(args) > 1 else Span(frame.sheet, 0, 0, 1, 1, False, False)
        if not isinstance(span, Span):
            return span
        name = ev.around.book.source.replace("\\", "/").rpartition("/")[2]
        return ev.texts.constant(f"[{name}]{ev.layout.titles[span.sheet]}" if name else "")
    if what not in ("address", "row", "col", "contents", "type"):
        raise UnsupportedError(say('CELL("{what}") is not supported', what=what[:40]))
    if len(args) < 2:
        raise UnsupportedError(say('CELL("{what}") without a reference is not supported', what=what))
    span = _first(ev, args[1], frame)
    if not isinstance(span, Span):
        return span
    if what == "row":
        return Cells(np.float64(span.row + 1))
    if what == "col":
        return Cells(np.float64(span.col + 1))
    if what == "address":
        there = "" if span.sheet == frame.sheet else f"{quote_sheet(ev.layout.titles[span.sheet])}!"
        return ev.texts.constant(f"{there}${column_letters(span.col)}${span.row + 1}")
    ev.around.need(Area(span.sheet, span.row, span.col, 1, 1))
    found = ev.at(span.sheet, span.row, span.col)
    code = int(codes_of(found))
    if what == "contents":
        return Cells(np.float64(0)) if code == BLANK else found
    return ev.texts.constant("b" if code == BLANK else "l" if code == TEXT else "v")


_INFORMATION = {"recalc": "Automatic", "origin": "$A:$A$1"}


def info(ev: Evaluation, args: Args, frame: Frame) -> Cells:
    """INFO: "recalc", "origin", "numfile"; what is said of the machine is not known here."""
    what = text_of(ev.value(args[0], frame), ev.texts)
    if isinstance(what, Cells):
        return what
    what = what.strip().lower()
    if what == "numfile":
        return Cells(np.float64(len(ev.layout.titles)))
    if what not in _INFORMATION:
        raise UnsupportedError(say('INFO("{what}") is not supported', what=what[:40]))
    return ev.texts.constant(_INFORMATION[what])


KERNELS: dict[str, Any] = {
    "OFFSET": _region("OFFSET"), "INDIRECT": _region("INDIRECT"), "ANCHORARRAY": _region("ANCHORARRAY"),
    "SINGLE": single, "AREAS": _cell_by_cell(areas), "ISREF": _cell_by_cell(isref),
    "ISFORMULA": isformula, "FORMULATEXT": _cell_by_cell(formulatext), "SHEET": _cell_by_cell(sheet),
    "SHEETS": _cell_by_cell(sheets), "CELL": _cell_by_cell(cell), "INFO": _cell_by_cell(info),
}  # fmt: skip
