"""Do engine, stored values, reference and other programs agree? The only place where they meet."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.diagnostics import Fault, WorkbookError, readable_name
from mechsheet.formula.book import Book, cells_of
from mechsheet.formula.nodes import ErrorValue, Scalar
from mechsheet.formula.references import cell_address
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import VALUE, Plan

Array = NDArray[np.float64]

TOLERANCE = 1e-9
"""Largest difference that counts as agreement: of lengths as a part of the mechanism's size, of angles in radians."""

DEAD_CENTRE = 1e-6
"""At a dead centre a position is as uncertain as the square root of rounding: two answers that both close the loops to
CLOSED agree when they are this near."""

CLOSED = 1e-11
"""A closure residual, as a part of the size, that is nothing but rounding."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One judge's answers against the engine's.

    judge   "stored values", "reference", or the name of a program
    cells   how many values were compared
    worst   largest difference (lengths as a part of the size, angles in radians, other numbers relative), 0 if none
    where   cell and quantity of the worst difference;  ours, theirs  the two values there
    agrees  nothing differs by more than the tolerance, and errors stand in the same cells
    """

    judge: str
    cells: int
    worst: float = 0.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True


@dataclass(frozen=True, slots=True)
class Report:
    """What `check` found in one file; `remarks` say what a person should know (a mode that was flipped …)."""

    file: str
    comparisons: tuple[Comparison, ...]
    remarks: tuple[str, ...] = ()

    @property
    def agrees(self) -> bool:
        """True when all judges agree."""
        return all(comparison.agrees for comparison in self.comparisons)

    def as_dict(self) -> dict[str, Any]:
        """The report as JSON data."""
        return {
            "file": self.file,
            "agrees": self.agrees,
            "remarks": list(self.remarks),
            "comparisons": [
                {
                    "judge": item.judge,
                    "cells": item.cells,
                    "worst": item.worst,
                    "where": item.where,
                    "ours": item.ours,
                    "theirs": item.theirs,
                    "agrees": item.agrees,
                }
                for item in self.comparisons
            ],
        }


@dataclass
class Tally:
    """The running worst of a comparison."""

    judge: str
    cells: int = 0
    worst: float = -1.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True

    def note(self, difference: float, where: str, ours: Scalar, theirs: Scalar, tolerance: float = TOLERANCE) -> None:
        """Count one pair; NaN or infinity is a difference in kind (a number against an error)."""
        self.cells += 1
        if not math.isfinite(difference):
            difference = math.inf
        if difference > tolerance:
            self.agrees = False
        if difference > self.worst:
            self.worst, self.where = difference, where
            self.ours, self.theirs = _text(ours), _text(theirs)

    def result(self) -> Comparison:
        """The finished comparison."""
        return Comparison(self.judge, self.cells, max(self.worst, 0.0), self.where, self.ours, self.theirs, self.agrees)


def _text(value: Scalar) -> str:
    return "" if value is None else (repr(value) if isinstance(value, float) else str(value))


def difference(ours: Scalar, theirs: Scalar) -> float:
    """How far two cell values are apart: numbers relative (absolute below 1), anything else 0 if equal, else infinity.

    Any error equals any error: programs name the same fault differently (#NUM! and #VALUE!).
    """
    if isinstance(ours, ErrorValue) or isinstance(theirs, ErrorValue):
        return 0.0 if isinstance(ours, ErrorValue) and isinstance(theirs, ErrorValue) else math.inf
    if isinstance(ours, bool) or isinstance(theirs, bool):
        return 0.0 if ours == theirs else math.inf
    if isinstance(ours, float | int) and isinstance(theirs, float | int):
        return abs(ours - theirs) / max(1.0, abs(ours), abs(theirs))
    return 0.0 if (ours or "") == (theirs or "") else math.inf


# --- the judges --------------------------------------------------------------------------------------------------


def check(path: str | Path, programs: Sequence[str] = (), progress: Callable[[str], None] | None = None) -> Report:
    """Judge a description (.toml) or a workbook: engine against stored values, reference, and the named programs.

    Raises MechsheetError when the file cannot be read, MissingProgramError when a program is not installed.
    """
    path = Path(path)
    say = progress or (lambda _: None)
    if path.suffix.lower() == ".toml":
        return _check_description(path, programs, say)
    say("reading")
    from mechsheet.formats import read

    return _check_book(read(path), path, readable_name(path), programs, say)


def _check_description(path: Path, programs: Sequence[str], say: Callable[[str], None]) -> Report:
    """Build the workbook aside and judge that file."""
    import tempfile

    from mechsheet.building import build
    from mechsheet.description import load
    from mechsheet.formats import read

    mechanism = load(path)
    with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
        say("building")
        (built,) = build(mechanism, folder)
        return _check_book(read(built), built, readable_name(path), programs, say)


def _check_book(book: Book, path: Path, shown: str, programs: Sequence[str], say: Callable[[str], None]) -> Report:
    from mechsheet.engine import evaluate

    say("recalculating")
    values = evaluate(book)
    comparisons = [_against_stored(book, values)]
    remarks: list[str] = []
    text = description_in(book)
    if text is None:
        remarks.append("no description inside: only recalculated, not compared with the reference")
    else:
        say("solving")
        comparison, remarks = _against_reference(book, values, text, shown)
        comparisons.append(comparison)
    for program in programs:
        say(program)
        comparisons.append(_against_program(book, values, path, program))
    return Report(shown, tuple(comparisons), tuple(remarks))


def _against_stored(book: Book, values: Any) -> Comparison:
    tally = Tally("stored values")
    for sheet in book.sheets:
        for block in sheet.blocks:
            for col in range(block.col, block.col + block.cols):
                ours = values.column(sheet.title, col, block.row, block.row + block.rows - 1)
                for offset, value in enumerate(ours):
                    row = block.row + offset
                    stored = sheet.cached.get(row, col)
                    apart = difference(value, stored)
                    if apart > tally.worst or apart > TOLERANCE:
                        tally.note(apart, cell_address(sheet.title, row, col), value, stored)
                    else:
                        tally.cells += 1
    return tally.result()


def _against_program(book: Book, values: Any, path: Path, program: str) -> Comparison:
    from mechsheet.programs import answers

    theirs = answers(program, path)
    tally = Tally(program)
    for title, row, col in cells_of(book):
        value = values.get(title, row, col)
        other = theirs.get(title, row, col)
        tally.note(difference(value, other), cell_address(title, row, col), value, other)
    return tally.result()


# --- a mechanism's workbook --------------------------------------------------------------------------------------


def description_in(book: Book) -> str | None:
    """The description that a workbook carries, or None."""
    from mechsheet.sheet.layout import DESCRIPTION_MARK

    for sheet in book.sheets:
        if sheet.constants.get(0, 0) != DESCRIPTION_MARK:
            continue
        runs = sheet.constants.columns.get(0, ())
        last = max((run.end for run in runs), default=1)
        lines = [sheet.constants.get(row, 0) for row in range(1, last)]
        return "\n".join("" if line is None else str(line) for line in lines)
    return None


@dataclass(frozen=True, slots=True)
class Inputs:
    """What a person has typed into a workbook: input dimensions and modes by symbol, and the driver's values (internal units)."""

    dimensions: Mapping[str, float]
    modes: Mapping[str, int]
    driver: Array
    remarks: tuple[str, ...] = field(default=())


def inputs_in(book: Book, values: Any, plan: Plan, shown: str) -> Inputs:
    """Read a workbook's input cells. Raises WorkbookError where one holds no number, or a sheet is missing."""
    titles = {sheet.title.casefold() for sheet in book.sheets}
    lost = [title for title in (plan.main, plan.table) if title.casefold() not in titles]
    if lost:
        raise WorkbookError(Fault(f'the sheet "{lost[0]}" of the mechanism\'s workbook is missing', shown))
    faults: list[Fault] = []
    remarks: list[str] = []

    def number(symbol: str) -> float:
        spot = plan.at.spots[symbol]
        value = values.get(spot.sheet, spot.row, spot.col)
        if isinstance(value, bool) or not isinstance(value, float | int):
            cell = cell_address(spot.sheet, spot.row, spot.col)
            faults.append(Fault(f"{symbol} must be a number, not {_text(value) or 'an empty cell'}", shown, key=cell))
            return math.nan
        return math.radians(value) if spot.degrees else float(value)

    dimensions = {dim.symbol: number(dim.symbol) for dim in plan.mechanism.dimensions if not dim.derived}
    modes: dict[str, int] = {}
    for group in plan.equations.groups:
        if group.mode:
            modes[group.mode] = 1 if number(group.mode) > 0 else -1
            if modes[group.mode] != group.mode_value:
                remarks.append(
                    f"{group.mode} is {modes[group.mode]:+d}; the description's sketch means {group.mode_value:+d}"
                )
    for dim in plan.mechanism.dimensions:
        if (
            not dim.derived
            and isinstance(dim.value, float)
            and not math.isclose(dimensions[dim.symbol], dim.value, rel_tol=1e-14, abs_tol=1e-300)
        ):
            remarks.append(f"{dim.symbol} differs from the description's")
    driver = _driver_column(plan, values, faults, shown)
    if faults:
        raise WorkbookError(faults)
    return Inputs(dimensions, modes, driver, tuple(remarks))


def _driver_column(plan: Plan, values: Any, faults: list[Fault], shown: str) -> Array:
    """The driver's values from start and step, as cells have them (or from the listed cells)."""
    driver = plan.mechanism.driver
    if driver.values:
        from mechsheet.sheet.plan import DRIVER

        cells = values.column(plan.table, DRIVER, plan.at.first, plan.at.last)
    else:
        start, step = (values.get(plan.main, plan.at.spots[key].row, VALUE) for key in ("#start", "#step"))
        numbers = isinstance(start, float) and isinstance(step, float)
        cells = [start + n * step for n in range(plan.rows)] if numbers else [None]
    if not all(isinstance(cell, float) for cell in cells):
        faults.append(Fault("the driver's values are not all numbers", shown, key=plan.table))
        return np.zeros(0)
    found = np.array(cells, dtype=float)
    return np.radians(found) if driver.unit == "deg" else found


def _against_reference(book: Book, values: Any, text: str, shown: str) -> tuple[Comparison, list[str]]:
    from mechsheet import reference
    from mechsheet.description import loads
    from mechsheet.kinematics.solve import solve
    from mechsheet.sheet.plan import plan_of

    mechanism = loads(text, file=f"{shown} (description inside)")
    plan = plan_of(mechanism, solve(mechanism))
    inputs = inputs_in(book, values, plan, shown)
    start = _start(mechanism, inputs)
    if start is None:
        return _nowhere(plan, values), [*inputs.remarks, NOWHERE]
    solution = reference.solve(mechanism, inputs.dimensions, start=start, values=inputs.driver)
    theirs = reference.variables(solution)
    tally = Tally("reference")
    ours = {symbol: _column(plan, values, symbol) for symbol in _judged(plan) if symbol in theirs}
    closed = _closed_rows(mechanism, solution, ours)
    for symbol, column in ours.items():
        _compare_column(plan, tally, symbol, column, np.asarray(theirs[symbol], float), solution.size, closed)
    return tally.result(), list(inputs.remarks)


NOWHERE = "with these dimensions and modes no row exists: there is no position to compare, only that none is shown"


def _nowhere(plan: Plan, values: Any) -> Comparison:
    """Nothing assembles: every result must say so."""
    tally = Tally("reference")
    for equation in plan.equations.columns:
        if equation.kind in ("variable", "point", "output"):
            spot = plan.at.shown[equation.symbol]
            for row, value in enumerate(_column(plan, values, equation.symbol)):
                where = f"{cell_address(spot.sheet, plan.at.first + row, spot.col)} ({equation.symbol}, row {row})"
                tally.note(0.0 if math.isnan(value) else math.inf, where, float(value), None)
    return tally.result()


def _judged(plan: Plan) -> list[str]:
    kinds = ("variable", "point", "output")
    fixed = [f"{point}.{axis}" for point in plan.mechanism.ground.points for axis in "xy"]
    columns = [equation.symbol for equation in plan.equations.columns if equation.kind in kinds]
    return list(dict.fromkeys([plan.mechanism.driver.symbol, *fixed, *columns]))


def _column(plan: Plan, values: Any, symbol: str) -> Array:
    """A column of the table in internal units, NaN where it holds no number."""
    spot = plan.at.shown[symbol]
    if not spot.column:
        cell = values.get(spot.sheet, spot.row, spot.col)
        return np.full(plan.rows, cell if isinstance(cell, float) else math.nan)
    cells = values.column(spot.sheet, spot.col, plan.at.first, plan.at.last)
    found = np.array([cell if isinstance(cell, float) else math.nan for cell in cells], dtype=float)
    return np.radians(found) if spot.degrees else found


def _closed_rows(mechanism: Mechanism, solution: Any, ours: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Rows in which our positions close every loop to rounding: there a larger difference is a dead centre's uncertainty."""
    from mechsheet import reference

    worst, _ = reference.worst(reference.residuals(mechanism, solution.dimensions, ours))
    return np.nan_to_num(worst, nan=math.inf) < CLOSED * max(solution.size, 1e-300)


def _compare_column(
    plan: Plan, tally: Tally, symbol: str, ours: Array, theirs: Array, size: float, closed: NDArray[np.bool_]
) -> None:
    spot = plan.at.shown[symbol]
    output = next((out for out in plan.mechanism.outputs if out.symbol == symbol), None)
    unit = plan.equations.of(symbol).unit if symbol != plan.mechanism.driver.symbol else ""
    is_angle = unit == "angle" or (unit == "" and plan.mechanism.driver.unit in ("deg", "rad"))
    gap = ours - theirs
    if is_angle:
        gap = np.remainder(gap + math.pi, math.tau) - math.pi
    else:
        scale = size if output is None or unit == "length" else np.maximum(1.0, np.abs(theirs))
        gap = gap / scale
    apart = np.abs(gap)
    both_missing = np.isnan(theirs) if not spot.column else np.isnan(ours) & np.isnan(theirs)
    apart = np.where(both_missing, 0.0, np.where(np.isnan(apart), math.inf, apart))
    excused = closed & (apart <= DEAD_CENTRE)
    apart = np.where(excused, np.minimum(apart, TOLERANCE), apart)
    tally.cells += len(apart) - 1
    row = int(np.argmax(apart))
    where = (
        f"{cell_address(spot.sheet, plan.at.first + row if spot.column else spot.row, spot.col)} ({symbol}, row {row})"
    )
    tally.note(float(apart[row]), where, float(ours[row]), float(theirs[row]))


def _start(mechanism: Mechanism, inputs: Inputs) -> dict[str, tuple[float, float, float]] | None:
    """A completed sketch for the reference: link poses in the first row that exists, by fresh equations, roughly.

    The reference needs to know which assembly is meant, also where the sketch leaves it open or a person has flipped a
    mode. The poses are rounded to three digits: Newton's method finds the position itself.
    """
    from mechsheet.diagnostics import MechanismError
    from mechsheet.kinematics.rough import rough_poses

    changed = replace(
        mechanism,
        dimensions=tuple(
            dim if dim.derived else replace(dim, value=inputs.dimensions[dim.symbol]) for dim in mechanism.dimensions
        ),
        driver=replace(mechanism.driver, values=tuple(float(value) for value in inputs.driver)),
    )
    try:
        return rough_poses(changed, inputs.modes)
    except MechanismError:
        return None  # it assembles nowhere: the reference will find that by itself


def worst_of(comparisons: Iterable[Comparison]) -> float:
    """The largest difference of several comparisons."""
    return max((comparison.worst for comparison in comparisons), default=0.0)
