"""What a person has typed into the input cells of a workbook, against the description that it carries."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.formula.book import Book
from livesheet.formula.nodes import Scalar
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet.checking.edited.edits import same
from mechsheet.checking.edited.expected import Expected
from mechsheet.checking.report import text_of
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.plan import TOLERANCE, VALUE

Key = tuple[str | int, ...]
"""Where a value belongs: ("dimensions", "a2"), ("tolerance", "a2"), ("mode", "mode_1"), ("driver", "start"),
("driver", "speed"), ("driver", "speed", 3), ("driver", "motion", "duration"), ("driver", "values", 3),
("tables", 0, "columns", 2), ("tables", 0, "rows", 1), ("links", "crank", "mass"), ("loads", 0, "force", 1)."""


@dataclass(frozen=True, slots=True)
class Change:
    """One input cell whose number is another one; both as the cell has them. `now` None: a tolerance that was emptied."""

    key: Key
    was: float | None
    now: float | None

    @property
    def name(self) -> str:
        """What a person calls it."""
        match self.key:
            case ("tolerance", symbol):
                return say("tolerance of {symbol}", symbol=symbol)
            case ("driver", "values", int(index)):
                return say("driver value {index}", index=index + 1)
            case ("drivers", int(order), "values", int(index)):
                return say("value {index} of driver {order}", index=index + 1, order=order + 2)
            case ("drivers", int(order), str(key)):
                return say("{key} of driver {order}", key=key, order=order + 2)
            case ("joints", int(order), str(key)):
                return say("{key} of joint {order}", key=key, order=order + 1)
            case ("driver", str(key), int(index)):
                return say("{key} {index} of the driver", key=key, index=index + 1)
            case ("tables", int(table), str(heads), int(index)):
                return say(
                    "{key} {index} of table {table}", key=heads.removesuffix("s"), index=index + 1, table=table + 1
                )
            case ("synthesised", symbol):
                return say("{symbol}, taken out of the synthesis", symbol=symbol)
            case ("synthesis", *place):
                named = " ".join(str(part + 1) if isinstance(part, int) else str(part) for part in place)
                return say("the task's {named}", named=named)
            case ("links", str(link), str(key), *part):
                return say("{key} of {link}{axis}", key=key, link=link, axis=_axis(part))
            case ("loads", int(number), str(key), *part):
                return say("{key} of load {number}{axis}", key=key, number=number + 1, axis=_axis(part))
        return str(self.key[1]) if self.key[0] != "driver" else say("{key} of the driver", key=self.key[-1])


def _axis(part: Sequence[object]) -> str:
    """`, x` or `, y` of a coordinate; "" of what has none."""
    return "".join(f", {'xy'[int(str(axis))]}" for axis in part)


def changes_in(book: Book, expected: Expected, shown: str) -> list[Change]:
    """All of them. Raises WorkbookError where an input cell holds something else than a number."""
    found: list[Change] = []
    faults: list[Fault] = []
    for key, (title, row, col) in input_places(expected):
        sheet, original = book.sheet(title), expected.book.sheet(title)
        if sheet is None or original is None:
            faults.append(Fault(say('the sheet "{title}" is missing', title=title), shown))
            break
        was, now = original.constants.get(row, col), sheet.constants.get(row, col)
        cell = cell_address(title, row, col)
        if sheet.formula_at(row, col) is not None:
            faults.append(Fault(say("holds a formula now; only numbers can be taken over"), shown, key=cell))
        elif not same(was, now):
            number = _number(now)
            if number is None and not (now is None and key[0] == "tolerance"):
                what = text_of(now) or say("an empty cell")
                faults.append(Fault(say("must hold a number, not {what}", what=what), shown, key=cell))
                continue
            found.append(Change(key, _number(was), number))
    if faults:
        raise WorkbookError(faults)
    return found + _typed_over(book, expected)


def _typed_over(book: Book, expected: Expected) -> list[Change]:
    """Dimensions of a synthesis in whose place a number stands: they are no results any more."""
    plan, task = expected.plan, expected.plan.mechanism.synthesis
    found = []
    for symbol in task.taken if task else ():
        spot = plan.at.spots[symbol]
        sheet = book.sheet(spot.sheet)
        number = None if sheet is None else _number(sheet.constants.get(spot.row, spot.col))
        if sheet is not None and number is not None and sheet.formula_at(spot.row, spot.col) is None:
            found.append(Change(("synthesised", symbol), None, number))
    return found


def _number(value: Scalar) -> float | None:
    if isinstance(value, bool) or not isinstance(value, float | int) or not math.isfinite(value):
        return None
    return float(value)


def input_places(expected: Expected) -> Iterator[tuple[Key, tuple[str, int, int]]]:
    """Every input that a description keeps, and its cell: not the position shown."""
    plan = expected.plan
    mechanism = plan.mechanism
    keys = {dim.symbol: dim.path for dim in mechanism.dimensions if dim.path and not dim.derived}
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    for symbol, given in keys.items():
        spot = plan.at.spots[symbol]
        yield given, (spot.sheet, spot.row, spot.col)
    for symbol, row in plan.blocks["dimensions"].rows.items():
        if symbol in keys or symbol in found:
            continue
        yield ("dimensions", symbol), (plan.main, row, VALUE)
        if mechanism.layout == "sheets":
            yield ("tolerance", symbol), (plan.main, row, TOLERANCE)
    if "assembly" in plan.blocks:
        for symbol, row in plan.blocks["assembly"].rows.items():
            if mechanism.synthesis is not None and symbol in mechanism.synthesis.mode:
                continue
            yield ("mode", symbol), (plan.main, row, VALUE)
    if "sweep" in plan.blocks:
        for key in ("start", "step"):
            if isinstance(getattr(mechanism.driver, key), float):
                yield ("driver", key), (plan.main, plan.blocks["sweep"].rows[key], VALUE)
    kept = dict(zip(mechanism.driver_rates, ("speed", "acceleration"), strict=True))
    besides = {driver.symbol: driver.order for driver in mechanism.drivers}
    for symbol, listed in mechanism.listed.items():
        for index, value in enumerate(listed):
            if isinstance(value, float):
                own: Key = ("driver", kept.get(symbol, "values"), index)
                other: Key = ("drivers", besides[symbol], "values", index) if symbol in besides else own
                yield other, (plan.table, plan.at.first + index, plan.at.spots[symbol].col)
    yield from _table_places(expected)


def _table_places(expected: Expected) -> Iterator[tuple[Key, tuple[str, int, int]]]:
    """The heads of the two-way tables: the input cells of their sheets, from left to right, then downwards."""
    requests = expected.plan.mechanism.tables
    for table in tables_of(expected.plan):
        index = next(number for number, request in enumerate(requests) if request is table.request)
        for heads, quantities, cells in table.heads():
            for number, (quantity, cell) in enumerate(zip(quantities, cells, strict=True)):
                if isinstance(quantity, float):
                    yield ("tables", index, heads, number), (table.title, *cell)
