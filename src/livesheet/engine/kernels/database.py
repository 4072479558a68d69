"""Databases: a range with headings, one of its columns, and a range of criteria (rows are alternatives)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...formula.nodes import Missing, Scalar
from ..interpreter.calling import Args, table_of
from ..interpreter.closures import Evaluation
from ..texts.searching import criterion
from ..values.cells import BLANK, ERROR, NUMBER, VALUE, Cells, Frame, Texts, VaryingSizeError, error
from ..values.coerce import Problem, caught, to_number, to_text
from .fold import count, folded, greatest, least, mean, product, total
from .statistics import SPREADS


def _headings(table: Cells, texts: Texts) -> list[str]:
    return [
        to_text(texts.decode(number, code if code < ERROR else BLANK)).casefold()
        for number, code in zip(table.numbers[0].tolist(), table.codes[0].tolist(), strict=True)
    ]


def _column(field: Scalar, headings: list[str]) -> int:
    """The column that a heading or a number names."""
    if isinstance(field, str):
        if not field or field.casefold() not in headings:
            raise Problem("#VALUE!")
        return headings.index(field.casefold())
    place = math.trunc(to_number(field))
    if not 1 <= place <= len(headings):
        raise Problem("#VALUE!")
    return place - 1


def _chosen(table: Cells, criteria: Cells, headings: list[str], texts: Texts) -> Any:
    """Which rows below the headings fit at least one row of the criteria."""
    rows = Cells(table.numbers[1:], table.codes[1:])
    names = _headings(criteria, texts)
    found = np.zeros(len(rows.numbers), bool)
    for number_row, code_row in zip(criteria.numbers[1:], criteria.codes[1:], strict=True):
        fits = np.ones(len(rows.numbers), bool)
        for name, number, code in zip(names, number_row.tolist(), code_row.tolist(), strict=True):
            if code == BLANK:
                continue
            if name not in headings:
                fits[:] = False
                break
            value = texts.decode(number, code)
            if isinstance(value, str) and value[:1] not in ("=", "<", ">") and texts.settings.beginnings:
                value += "*"
            place = headings.index(name)
            fits &= criterion(value, texts)(Cells(rows.numbers[:, place], rows.codes[:, place]))
        found |= fits
    return found


def _picked(ev: Evaluation, args: Args, frame: Frame) -> tuple[Any, Any]:
    """(numbers, codes) of the field in the rows that fit; without a field, a number for each of them."""
    table, criteria = table_of(ev, args[0], frame), table_of(ev, args[2], frame)
    headings = _headings(table, ev.texts)
    if len(table.numbers) < 2:
        raise Problem("#VALUE!")
    place = None
    if not isinstance(args[1], Missing):
        cells = ev.value(args[1], frame)
        if np.ndim(cells.numbers):
            raise VaryingSizeError
        code = 0 if cells.codes is None else int(cells.codes)
        place = _column(ev.texts.decode(float(cells.numbers), code), headings)
    rows = _chosen(table, criteria, headings, ev.texts)
    if place is None:
        return np.zeros(int(rows.sum())), np.zeros(int(rows.sum()), np.uint8)
    return table.numbers[1:, place][rows], table.codes[1:, place][rows]


def _database(function: Callable[[Any, Any], Cells], counting: bool = False) -> Any:
    """A kernel; only those that count may do without a field."""

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        del spread
        if isinstance(args[1], Missing) and not counting:
            return error(VALUE)
        return function(*_picked(ev, args, frame))

    return caught(kernel)


def _fold(function: Callable[[Any, Any], Any]) -> Any:
    def of(numbers: Any, codes: Any) -> Cells:
        bad = codes[codes >= ERROR]
        if len(bad):
            return error(int(bad[0]))
        return folded(function, np.where(codes == NUMBER, numbers, 0.0), codes == NUMBER, None)

    return _database(of)


def _get(numbers: Any, codes: Any) -> Cells:
    """DGET: the one value; #VALUE! of none, #NUM! of several."""
    if len(numbers) != 1:
        raise Problem("#VALUE!" if not len(numbers) else "#NUM!")
    return Cells(numbers[0], codes[0] if codes[0] else None)


KERNELS: dict[str, Any] = {
    "DSUM": _fold(total), "DAVERAGE": _fold(mean), "DMAX": _fold(greatest), "DMIN": _fold(least),
    "DPRODUCT": _fold(product), "DSTDEV": _fold(SPREADS["STDEV.S"]), "DSTDEVP": _fold(SPREADS["STDEV.P"]),
    "DVAR": _fold(SPREADS["VAR.S"]), "DVARP": _fold(SPREADS["VAR.P"]), "DGET": _database(_get),
    "DCOUNT": _database(lambda numbers, codes: Cells(np.float64(count(numbers, codes == NUMBER))), True),
    "DCOUNTA": _database(lambda numbers, codes: Cells(np.float64(np.count_nonzero(codes != BLANK))), True),
}  # fmt: skip
