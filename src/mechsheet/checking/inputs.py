"""What a mechanism's workbook carries in itself: its description, the workbook that this would build, and what a person has
typed into the input cells.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault, MissingSheetError, WorkbookError, readable_name
from livesheet.evaluation import book_of
from livesheet.formula.book import Book
from livesheet.formula.nodes import Call
from livesheet.formula.references import cell_address
from livesheet.formula.scalar import evaluate
from livesheet.said import reason, say
from livesheet.workbook import Workbook
from mechsheet.checking.comparison import Array, text_of
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.report import located
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_order, dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.inputs import refused_of
from mechsheet.kinematics.points_in_link import number as place_number
from mechsheet.library.building import build
from mechsheet.library.changed import load
from mechsheet.model import Mechanism
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.lowering import Assignments
from mechsheet.sheet.layout import DESCRIPTION_MARK, DESCRIPTION_SHEET
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import TOLERANCE, Plan


def description_in(book: Book) -> str | None:
    """The description that a workbook carries, or None."""

    for sheet in book.sheets:
        if sheet.constants.get(0, 0) != DESCRIPTION_MARK:
            continue
        runs = sheet.constants.columns.get(0, ())
        last = max((run.end for run in runs), default=1)
        lines = [sheet.constants.get(row, 0) for row in range(1, last)]
        return "\n".join("" if line is None else str(line) for line in lines)
    return None


def description_or_fault(book: Book, shown: str) -> str:
    """The description that a book carries. Raises WorkbookError when there is none."""
    text = description_in(book)
    if text is None:
        raise WorkbookError(
            Fault(say("carries no description: it was not built by mechsheet, or its sheet is gone"), shown)
        )
    return text


@contextmanager
def workbook_of(path: Path) -> Iterator[Path]:
    """The workbook itself, or the one that a description builds, aside; what is wrong with that is told at its lines."""
    if path.suffix.lower() != ".toml":
        yield path
        return
    mechanism = load(path)
    try:
        with tempfile.TemporaryDirectory(prefix="mechsheet-") as folder:
            (built,) = build(mechanism, folder)
            yield built
    except MechanismError as error:
        raise located(error, mechanism.listing, readable_name(path)) from error


def plan_inside(text: str, shown: str) -> Plan:
    """Where everything stands in the workbook that carries the description `text` (`shown`: the file, for messages)."""
    return Compiled(loads(text, file=inside(shown))).plan


InputCells = dict[tuple[str, int, int], str]
"""(sheet, row, column) of each input cell -> what it holds."""


@dataclass(frozen=True, slots=True)
class Expected:
    """The workbook as data, the same as a book of constants and formulas, and where everything stands in it."""

    workbook: Workbook
    book: Book
    compiled: Compiled

    @property
    def plan(self) -> Plan:
        """Where everything is in it."""
        return self.compiled.plan

    @property
    def description_sheet(self) -> str:
        """Title of the hidden sheet that carries the description."""
        return self.plan.at.titles[DESCRIPTION_SHEET]

    def inputs(self) -> InputCells:
        """The cells that are there to be changed, and what each holds: dimensions, modes, the driver, tolerances …"""
        named = {"start": self.plan.places.start, "step": self.plan.places.step, **self.plan.at.spots}
        by_cell = {(spot.sheet, spot.row, spot.col): symbol for symbol, spot in named.items() if spot is not None}
        found = {}
        for sheet in self.workbook.sheets:
            for cell in sheet.cells:
                if not cell.style.locked and not isinstance(cell.content, str):
                    place = (sheet.title, cell.row, cell.col)
                    found[place] = by_cell.get(place, "")
        tolerated = self.plan.blocks["dimensions"].rows if self.plan.mechanism.layout == "sheets" else {}
        for symbol, row in tolerated.items():
            found[self.plan.main, row, TOLERANCE] = f"the tolerance of {symbol}"
        return found


def expected_for(text: str, file: str, functions: str = "") -> Expected:
    """What the description `text` builds; `file` is what messages call it. Raises MechsheetError.

    functions  "lambda" for the workbook whose tables call functions (`functions_in` tells)
    """
    loads(text, file=file)  # its faults name the file
    try:
        return _built(text, functions)
    except MechanismError as error:
        raise located(error, text, file) from error


@lru_cache(maxsize=1)
def _built(text: str, functions: str) -> Expected:
    """The last is kept: the .xlsx and the .ods of one description are judged one after the other."""
    compiled = Compiled(loads(text))
    if functions:
        from mechsheet.exporting.functions.workbooks import functions_workbook, in_sheets

        compiled = in_sheets(compiled)
        workbook = functions_workbook(compiled, functions)
    else:
        workbook = compiled.layout
    return Expected(workbook, book_of(workbook), compiled)


def functions_in(book: Book) -> str:
    """The form of a workbook whose names stand for functions: "lambda"; else nothing."""
    has = any(isinstance(name.formula, Call) and name.formula.name == "LAMBDA" for name in book.names)
    return "lambda" if has else ""


def inside(shown: str) -> str:
    """What messages call the description in a workbook's file."""
    return f"{shown} (description inside)"


@dataclass(frozen=True, slots=True)
class Inputs:
    """What a person has typed into a workbook: dimensions and modes by symbol, and what is given row by row, as of
    `given_values` (internal units)."""

    dimensions: Mapping[str, float]
    modes: Mapping[str, int]
    given: Mapping[str, Array]
    remarks: tuple[str, ...] = field(default=())

    def same_as(self, other: Inputs) -> bool:
        """Whether the other has the same numbers in its cells."""
        return (
            self.dimensions == other.dimensions
            and self.modes == other.modes
            and self.given.keys() == other.given.keys()
            and all(np.array_equal(column, other.given[name], equal_nan=True) for name, column in self.given.items())
        )


Found = TypeVar("Found")


def numbers_in(values: Any, sheet: str, col: int, first: int, last: int, degrees: bool = False) -> Array:
    """The numbers in rows of a column, NaN where there is none; those of `degrees` in radians."""
    cells = values.column(sheet, col, first, last)
    found = np.array([cell if isinstance(cell, float) else math.nan for cell in cells], dtype=float)
    return np.radians(found) if degrees else found


class OfTheLast(Generic[Found]):
    """What was found for the plan and the inputs that were asked of last.

    For what reads nothing else of a workbook: the .xlsx and the .ods of one description are judged one after the other, with
    the same plan (`expected_for` keeps the last).
    """

    def __init__(self) -> None:
        self._last: tuple[Plan, Inputs, Found] | None = None

    def of(self, plan: Plan, inputs: Inputs, find: Callable[[], Found]) -> Found:
        """What `find` gives; asked again only for another plan or other inputs."""
        last = self._last
        if last is None or last[0] is not plan or not last[1].same_as(inputs):
            last = self._last = (plan, inputs, find())
        return last[2]


def inputs_in(book: Book, values: Any, plan: Plan, shown: str) -> Inputs:
    """Read a workbook's input cells.

    Raises WorkbookError where one holds no number, a length between joints is not above 0, a cam cannot be, a mode is
    neither 1 nor -1, or a sheet is missing.
    """
    titles = {sheet.title.casefold() for sheet in book.sheets}
    lost = [title for title in (plan.main, plan.table) if title.casefold() not in titles]
    if lost:
        raise MissingSheetError(lost[0], shown)
    faults: list[Fault] = []
    remarks: list[str] = []

    def number(symbol: str) -> float:
        spot = plan.at.spots[symbol]
        value = _typed_number(values, spot, symbol, shown, faults)
        return math.radians(value) if spot.degrees else value

    def wrong(symbol: str, message: str) -> None:
        spot = plan.at.spots[symbol]
        cell = cell_address(spot.sheet, spot.row, spot.col)
        value = text_of(values.get(spot.sheet, spot.row, spot.col))
        faults.append(Fault(say("{message}, not {value}", message=message, value=value), shown, key=cell))

    dimensions = {dim.symbol: number(dim.symbol) for dim in plan.mechanism.dimensions if not dim.derived}
    law = plan.mechanism.driver.law
    for symbol in plan.equations.positive:
        if dimensions.get(symbol, 1.0) <= 0:
            task = plan.mechanism.synthesis
            if task is not None and symbol in task.positive:
                wrong(symbol, say("{symbol} of the task must be greater than 0", symbol=symbol))
                continue
            message = say("{symbol} is the distance of two joints and must be greater than 0", symbol=symbol)
            if law and symbol == law.duration:
                message = say("{symbol} is the time of the motion and must be greater than 0", symbol=symbol)
            wrong(symbol, message)
    if not faults:
        for asked, why in refused_of(plan.mechanism, dimensions):
            spot = plan.at.spots[asked.symbol]
            faults.append(Fault(why, shown, key=cell_address(spot.sheet, spot.row, spot.col)))
    modes: dict[str, int] = {}
    for group in plan.equations.groups:
        if group.follows is not None:  # a formula: where it is damaged, that is told of the cell
            spot = plan.at.spots[group.mode]
            found = values.get(spot.sheet, spot.row, spot.col)
            modes[group.mode] = group.value_of(found) if isinstance(found, float) else group.mode_value
        elif group.mode:
            typed = number(group.mode)
            if math.isfinite(typed) and typed not in group.mode_values:
                message = say("{symbol} must be 1 or -1", symbol=group.mode)
                if group.system is not None:
                    message = say("{symbol} must be 1 to {count}", symbol=group.mode, count=len(group.assemblies))
                wrong(group.mode, message)
            modes[group.mode] = group.value_of(typed)
            if modes[group.mode] != group.mode_value:
                remarks.append(
                    say(
                        "{mode} is {now:+d}; the description's sketch means {meant:+d}",
                        mode=group.mode,
                        now=modes[group.mode],
                        meant=group.mode_value,
                    )
                )
    given = {} if faults else _given(plan, values, dimensions, faults, shown)
    if faults:
        raise WorkbookError(faults)
    return Inputs(dimensions, modes, given, tuple(remarks))


def _typed_number(values: Any, spot: Spot, called: str, shown: str, faults: list[Fault]) -> float:
    """The number in an input cell; where none is, NaN and a fault that names the cell."""
    value = values.get(spot.sheet, spot.row, spot.col)
    if isinstance(value, float | int) and not isinstance(value, bool):
        return float(value)
    message = say("{symbol} must be a number, not {what}", symbol=called, what=text_of(value) or say("an empty cell"))
    faults.append(Fault(message, shown, key=cell_address(spot.sheet, spot.row, spot.col)))
    return math.nan


def _faults_of_sweep(plan: Plan, values: Any, shown: str) -> list[Fault]:
    """What is wrong with start and step where a person types them."""
    faults: list[Fault] = []
    start, step, driver = plan.places.start, plan.places.step, plan.mechanism.driver
    if start is not None and isinstance(driver.start, float):
        _typed_number(values, start, "start", shown, faults)
    if step is not None and isinstance(driver.step, float) and _typed_number(values, step, "step", shown, faults) == 0:
        message = say("step must not be 0: all rows would be one position")
        faults.append(Fault(message, shown, key=cell_address(step.sheet, step.row, step.col)))
    return faults


def _of_sweep(plan: Plan, values: Any, key: Literal["start", "step"], dimensions: Mapping[str, float]) -> Any:
    """Start or step as its cell has it. Where that follows from dimensions and shows no number, what it should be, NaN
    where these have none: what is shown instead is told elsewhere.
    """
    spot = there(plan.places.start if key == "start" else plan.places.step)
    found = values.get(spot.sheet, spot.row, spot.col)
    quantity = getattr(plan.mechanism.driver, key)
    if isinstance(found, float) or isinstance(quantity, float):
        return found
    try:
        computed = place_number(quantity, dimension_values(with_numbers(plan.mechanism, dimensions)))
    except (ArithmeticError, ValueError):
        return math.nan
    return plan.mechanism.driver.unit.to_shown(computed)


def _empty_rows(plan: Plan, values: Any) -> NDArray[np.bool_]:
    """Rows that are none: somebody inserted them and left them empty, or emptied them, which is told as an edit."""
    spot = plan.at.spots[plan.mechanism.driver.symbol]
    return np.array([cell is None for cell in values.column(spot.sheet, spot.col, plan.at.first, plan.at.last)])


def _given(
    plan: Plan, values: Any, dimensions: Mapping[str, float], faults: list[Fault], shown: str
) -> dict[str, Array]:
    """What is given row by row: from start and step as cells have them, from the listed cells, or by the motion law."""
    mechanism, driver = plan.mechanism, plan.mechanism.driver
    if driver.law is not None:
        return given_values(mechanism, dimension_values(with_numbers(mechanism, dimensions)))
    if driver.values:
        found = {}
        for symbol in (driver.symbol, *mechanism.given_by_row):
            spot = plan.at.spots[symbol]
            found[symbol] = numbers_in(values, spot.sheet, spot.col, plan.at.first, plan.at.last)
    else:
        if wrong := _faults_of_sweep(plan, values, shown):
            faults += wrong
            return {}
        start = _of_sweep(plan, values, "start", dimensions)
        step = _of_sweep(plan, values, "step", dimensions)
        numbers = isinstance(start, float) and isinstance(step, float)
        found = {driver.symbol: start + np.arange(plan.rows) * step if numbers else np.array([math.nan])}
        if numbers:
            found[driver.symbol][_empty_rows(plan, values)] = math.nan
    for symbol, column in found.items():
        # NaN where they follow from a task without a solution, as everything does that they decide
        missing = ~np.isfinite(column)
        if driver.stepped and len(column) == plan.rows:
            missing &= ~_empty_rows(plan, values)
        if missing.any() and (mechanism.synthesis is None or len(column) != plan.rows):
            message = say("the values of {symbol} are not all numbers", symbol=symbol)
            if symbol == driver.symbol:
                message = say("the driver's values are not all numbers")
            faults.append(Fault(message, shown, key=plan.table))
    for each in plan.mechanism.all_drivers:
        if each.symbol in found:
            found[each.symbol] = each.unit.to_internal(found[each.symbol])
    return found


# --- the mechanism with what has been typed --------------------------------------------------------------------------


def missing_dimensions(mechanism: Mechanism, inputs: Mapping[str, float]) -> dict[str, str]:
    """Derived dimensions that have no value for these inputs (arccos 1.05), and those that read them: symbol -> why not.

    Nothing may be shown from them.
    """
    by_symbol = {dim.symbol: dim for dim in mechanism.dimensions}
    values = dict(inputs)
    missing: dict[str, str] = {}
    for symbol in dimension_order(mechanism):
        value = by_symbol[symbol].value
        if isinstance(value, float):
            continue
        try:
            values[symbol] = evaluate(value, values)
        except KeyError as error:
            missing[symbol] = say("{name} has no value", name=error.args[0])
        except (ArithmeticError, ValueError) as error:
            missing[symbol] = reason(error)
    return missing


def readers(equations: Assignments, symbols: Collection[str]) -> set[str]:
    """Symbols of all equations that read one of `symbols`, straight or through others."""
    found = set(symbols)
    for equation in equations.all:  # each is solved before it is read
        if found & {*equation.reads, *equation.reads_previous}:
            found.add(equation.symbol)
    return found - set(symbols)


def with_numbers(mechanism: Mechanism, numbers: Mapping[str, float]) -> Mechanism:
    """The mechanism with other values of the dimensions that do not follow from others."""
    dimensions = tuple(dim if dim.derived else replace(dim, value=numbers[dim.symbol]) for dim in mechanism.dimensions)
    return replace(mechanism, dimensions=dimensions)


def typed(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """With the values of further drivers as they are typed, row by row."""
    drivers = tuple(
        replace(driver, values=tuple(float(value) for value in inputs.given[driver.symbol]))
        if driver.values
        else driver
        for driver in mechanism.drivers
    )
    return replace(mechanism, drivers=drivers) if drivers else mechanism


def changed(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """The mechanism with what has been typed into the cells."""
    values = tuple(inputs.given[mechanism.driver.symbol].tolist())
    listed = replace(mechanism, driver=replace(mechanism.driver, values=values))
    driver = mechanism.driver if mechanism.driver.law is not None else with_listed_rates(listed, inputs).driver
    return replace(with_numbers(typed(mechanism, inputs), inputs.dimensions), driver=driver)


def equations_as_typed(plan: Plan, inputs: Inputs) -> Equations:
    """The plan's own equations with the assemblies of the cells: their start values are those of the workbook."""
    equations = plan.equations.equations
    groups = (
        replace(group, assembly=group.assembly_of(inputs.modes[group.mode])) if group.mode in inputs.modes else group
        for group in equations.groups
    )
    return replace(equations, groups=tuple(groups))


def with_listed_rates(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """The mechanism with the speeds and accelerations that stand in the cells."""
    speeds, accelerations = (tuple(inputs.given[name].tolist()) if name in inputs.given else ()
                             for name in mechanism.driver_rates)  # fmt: skip
    return replace(mechanism, driver=replace(mechanism.driver, speeds=speeds, accelerations=accelerations))
