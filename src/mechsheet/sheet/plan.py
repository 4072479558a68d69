"""The plan of a workbook: every row of the first sheet and every column of the table, before any cell is written.

Everything that is read by a formula gets its address here; the writers of the sheets only fill in.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from livesheet import portable
from livesheet.formula.names import folded, safe_name
from livesheet.formula.nodes import Node
from livesheet.workbook import Name
from mechsheet.kinematics.dimensions import dimension_order, dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import BANDS, FORCES, INNER, JOINT_FORCES, RATES, Equations, Role
from mechsheet.kinematics.lengths import largest_length
from mechsheet.kinematics.newton.system import FIRST_PASSES
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.period import Periods
from mechsheet.kinematics.rates.sensitivity import NO_BANDS, Sensitivities, toleranced
from mechsheet.kinematics.sweep import sweep
from mechsheet.kinematics.terms import only_rounding
from mechsheet.model import ENERGY, Dimension, Mechanism
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.classification import Classification, classification
from mechsheet.sheet.columns.averaged import with_averaged
from mechsheet.sheet.columns.bands import Banded, found_bands, sizes, tolerance_symbol, with_bands
from mechsheet.sheet.columns.flywheel import MEAN, with_energy
from mechsheet.sheet.columns.lowering import Assignment, Assignments, in_pass, lowered
from mechsheet.sheet.columns.start_columns import start_columns
from mechsheet.sheet.naming import kept_names, names_of_dimensions
from mechsheet.sheet.places import Checked, Places, Searched, Starts, there
from mechsheet.sheet.task_rows import Rows, plan_rows
from mechsheet.synthesis.kinds import kind_of
from mechsheet.words.workbook import Language, words

SYMBOL, VALUE, UNIT, TOLERANCE, MEANING, MARGIN, CHARTS = range(7)
"""Columns of the blocks on the first sheet, the narrow one beside them, and the first one of the charts."""

VERDICT_ROW, LEGEND_ROW = 1, 2
"""Rows of the first sheet under its title: what is to be said of the mechanism, and what the colours mean."""

FIRST_BLOCK = 4
"""The row of the first block's heading."""

SHEETS = ("mechanism", "positions", "drawing", "checks", "extremes", "notes", "description")
"""Keys of the sheets that every workbook has; "rates", "forces", "tolerance" stand behind the positions of one that has
them."""

HIDDEN = ("drawing", "checks", "extremes", "iterations")
"""Those that are hidden when the workbook opens: the proof, and what is drawn. They are not printed."""

HEADING_ROWS = 3
"""Rows over the table: group, symbol with unit, formula as text."""

NUMBER, DRIVER, STATUS = range(3)
"""First columns of the table: row number, driver as shown, what it says of the row."""

RATES_DRIVER, RATES_STATUS = range(2)
"""First columns of the sheets of rates and of forces."""

LEAST_PROBED = 4
"""With fewer rows nothing is looked for between them."""

BLOCKS = 100
"""Blocks of passes are counted from so many times the number of their group."""

FOOTER_TITLE = 100
"""Characters of the title in the footer, which holds 255 in all."""


ArrowKind = Literal["velocity", "acceleration", "forces"]
"""What arrows in the drawing show; a cell of the first sheet, `show_velocity`, hides each."""


@dataclass(frozen=True, slots=True)
class Block:
    """A block of the first sheet: its heading's row and the rows of its entries by symbol (or key)."""

    row: int
    rows: dict[str, int]


@dataclass(frozen=True, slots=True)
class TableColumn:
    """One column of the table: the row's number, the driver, what it says of the row, the time of a law, what is listed
    beside the driver's values, or a quantity.

    symbol  of the quantity, "" of the row's number and of what it says
    inner   an intermediate quantity, in quieter ink
    """

    col: int
    symbol: str
    kind: Literal["number", "driver", "status", "time", "listed", "equation"]
    group: int
    inner: bool
    equation: Assignment | None = None


@dataclass
class Plan:
    """Addresses of everything; see `Addresses` for `at`.

    found   what can be said about the mechanism
    rates   the columns of the sheet of rates behind its first two; none without velocities
    iterations  those of the sheet of Newton's method, where a group is solved by it
    forces  those of the sheet of forces, behind the driver's value and what is said of the row
    bands   those of the sheet of tolerances, likewise;  sensitivities: what these say
    window  cells with the middle ("x", "y") and half the side ("half") of the drawing's window, once it is drawn
    places, extremes, checks  what stands where on the first sheet and in the tables, and on those two
    synthesis   rows of the sheet of synthesis; None where no dimension is found from a task
    """

    mechanism: Mechanism
    equations: Assignments
    language: Language
    at: Addresses
    rows: int
    driver: list[float]
    found: Classification
    blocks: dict[str, Block] = field(default_factory=dict)
    columns: list[TableColumn] = field(default_factory=list)
    rates: list[TableColumn] = field(default_factory=list)
    forces: list[TableColumn] = field(default_factory=list)
    iterations: list[TableColumn] = field(default_factory=list)
    bands: list[TableColumn] = field(default_factory=list)
    sensitivities: Sensitivities = NO_BANDS
    names: list[Name] = field(default_factory=list)
    next_row: int = 0
    window: dict[str, Spot] = field(default_factory=dict)
    synthesis: Rows | None = None
    places: Places = field(init=False)
    extremes: Searched | None = None
    checks: Checked | None = None

    @cached_property
    def periods(self) -> Periods:
        """What a turn of the driver changes of each quantity."""
        return Periods(self.equations.columns, self.mechanism.driven_symbols)

    @cached_property
    def size(self) -> float:
        """The largest length, as the description has it; 1 where there is none."""
        return largest_length(self.mechanism, dimension_values(self.mechanism)) or 1.0

    @cached_property
    def pace(self) -> float:
        """How fast the driver goes as described [1/s]: a slide in sizes a second; 1 where it is not one number."""
        speed = abs(dimension_values(self.mechanism).get(self.mechanism.driver_rates[0], 0.0)) or 1.0
        return speed / self.size if self.mechanism.driver.joint and speed != 1.0 else speed

    @cached_property
    def given(self) -> Mapping[str, Array]:
        """Of every row the driver's value and what is given beside it, with the dimensions as described."""
        return given_values(self.mechanism, dimension_values(self.mechanism))

    @cached_property
    def nominal(self) -> dict[str, Array]:
        """Every symbol's values over the rows with the dimensions and modes as described, NaN where there is none."""
        return sweep(self.mechanism, self.equations.equations, self.given)

    @cached_property
    def only_rounding(self) -> dict[str, float]:
        """Quantities that are nothing but rounding with the dimensions as described: how large their terms are."""
        return only_rounding(self.equations.equations, self.nominal)

    @cached_property
    def banded(self) -> dict[str, Banded]:
        """The quantities that have a band, by symbol."""
        return {each.quantity: Banded(each.quantity, tuple(each.by)) for each in self.sensitivities.of}

    @cached_property
    def band_places(self) -> dict[str, int]:
        """By quantity with a band: the decimals of which the last is the band's first digit, in most rows."""
        found = {}
        for name, column in sizes(self.mechanism, self.sensitivities, self.equations, self.nominal).items():
            there = column[np.isfinite(column) & (column > 0)]
            if len(there):
                found[name] = min(10, max(0, math.ceil(-float(portable.log10(np.median(there))) - 1e-9)))
        return found

    @cached_property
    def first_existing(self) -> int:
        """The number of the first row that has a position, with the dimensions as described; 0 where none has."""
        return int(np.argmax(self.equations.equations.closed(self.nominal)))

    @cached_property
    def unguarded(self) -> frozenset[str]:
        """Symbols of groups that always close (lines that cross at one angle): they do not read what counts as zero."""
        always = [group for group in self.equations.groups if not self.equations.equations.of(group.closes).exists]
        return frozenset(symbol for group in always for symbol in (group.closes, *group.unknowns))

    @cached_property
    def newton(self) -> bool:
        """Whether some group is solved by Newton's method: each row from the row above, and nothing between the rows."""
        return any(group.system is not None for group in self.equations.groups)

    @cached_property
    def residuals(self) -> frozenset[str]:
        """Symbols of what is nothing but rounding where Newton's method has arrived."""
        systems = (group.system for group in self.equations.groups if group.system is not None)
        found = {system.residual.partition(" ")[0] for system in systems}
        return frozenset(each.symbol for each in self.equations.columns if each.symbol.partition(" ")[0] in found)

    @cached_property
    def determinants(self) -> frozenset[str]:
        """Symbols of the determinants of groups that Newton's method solves: of any size, for they have any unit."""
        systems = (group.system for group in self.equations.groups if group.system is not None)
        found = {system.determinant.partition(" ")[0] for system in systems}
        return frozenset(each.symbol for each in self.equations.columns if each.symbol.partition(" ")[0] in found)

    @property
    def rows_only(self) -> bool:
        """Whether extremes are those of the rows."""
        return bool(self.mechanism.driver.values) or self.between_unseen

    @property
    def between_unseen(self) -> bool:
        """Whether nobody looks between the rows, although the motion goes on there; where values are listed, it does not."""
        return self.newton or (self.rows < LEAST_PROBED and not self.mechanism.driver.values)

    @property
    def efforts(self) -> tuple[str, ...]:
        """The driver's effort, from the reactions and by virtual work; nothing without forces."""
        return self.equations.equations.efforts

    @property
    def shown_forces(self) -> tuple[str, ...]:
        """What people read of the forces; see `Equations`."""
        return self.equations.equations.shown_forces

    @property
    def moving_points(self) -> tuple[str, ...]:
        """Points that have a velocity and an acceleration."""
        points = {point for link in self.mechanism.links for point in link.points}
        found = (column.symbol.rpartition(".") for column in self.rates)
        return tuple(point for point, _, part in found if part == "v" and point in points)

    @property
    def held_columns(self) -> tuple[str, ...]:
        """The forces of joints, as far as they differ from row to row."""
        columns = {column.symbol for column in self.forces}
        return tuple(name for name in self.equations.equations.forces(*JOINT_FORCES) if name in columns)

    @property
    def arrows(self) -> tuple[ArrowKind, ...]:
        """What arrows there are in the drawing."""
        found: tuple[ArrowKind, ...] = ("velocity", "acceleration") if self.moving_points else ()
        return (*found, "forces") if self.held_columns else found

    @property
    def footer(self) -> str:
        """What stands below every printed page: title, sheet, page; an ampersand is a mark there."""
        title = self.mechanism.title.of(self.language).replace("&", "&&")
        return self.text("footer", title=title[:FOOTER_TITLE], made=self.text("made"))

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook in its language."""
        return words(self.language, key, **parts)

    @property
    def plain(self) -> Mapping[str, Node]:
        """Quantities that have no cell of their own, by symbol."""
        return {}

    @property
    def status_column(self) -> int:
        """The column of the table that says what does not close."""
        return self.places.status.col

    @property
    def ok(self) -> str:
        """What it says where everything closes."""
        return self.text("status.ok")

    @property
    def searched(self) -> Searched:
        """Places on the sheet of extremes, which a page does not have."""
        return there(self.extremes)

    @property
    def checked(self) -> Checked:
        """Places on the sheet of checks, which a page does not have."""
        return there(self.checks)

    @property
    def main(self) -> str:
        """Title of the first sheet."""
        return self.at.titles["mechanism"]

    @property
    def table(self) -> str:
        """Title of the sheet with the positions."""
        return self.at.titles["positions"]


def plan_of(mechanism: Mechanism, equations: Equations) -> Plan:
    """The plan of a mechanism's workbook."""
    language = mechanism.language
    roles = {equation.role for equation in equations.columns}
    further = [
        key for key, own in (("rates", RATES), ("forces", FORCES), ("iterations", ("iteration",))) if roles & {*own}
    ]
    further += ["tolerance"] if mechanism.bands else []
    further += ["synthesis"] if mechanism.synthesis else []
    further += ["alt"] if mechanism.synthesis and kind_of(mechanism.synthesis).alt else []
    titles = {key: words(language, f"sheet.{key}") for key in (*SHEETS, *further)}
    values = given_values(mechanism, dimension_values(mechanism))[mechanism.driver.symbol]
    rows = len(values)
    at = Addresses(titles, HEADING_ROWS, HEADING_ROWS + rows - 1)
    found_of_bands = found_bands(mechanism, equations)
    assignments = with_averaged(
        mechanism, with_bands(mechanism, with_energy(mechanism, lowered(mechanism, equations)), found_of_bands)
    )
    found = classification(mechanism, assignments)
    plan = Plan(mechanism, assignments, language, at, rows, [float(value) for value in values], found)
    plan.sensitivities = found_of_bands
    starts = _plan_columns(plan)
    _plan_names_and_blocks(plan, starts)
    return plan


def _plan_names_and_blocks(plan: Plan, starts: dict[int, Starts]) -> None:
    mechanism = plan.mechanism
    order = {symbol: index for index, symbol in enumerate(dimension_order(mechanism))}
    own = [dim for dim in mechanism.dimensions if not dim.place]
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    inputs = [dim for dim in own if not dim.derived or dim.symbol in found]
    derived = sorted((dim for dim in own if dim not in inputs), key=lambda dim: order[dim.symbol])
    named, singles = Named(plan), mechanism.motion_numbers
    plan.next_row = FIRST_BLOCK
    shown = [f"show_{kind}" for kind in plan.arrows]
    _block(plan, "position", ["position", mechanism.driver.symbol, "status", *shown])
    _block(plan, "dimensions", [dim.symbol for dim in inputs])
    if mechanism.driver.stepped:
        _block(plan, "sweep", ["start", "step", "stop"])
    for key in INPUT_BLOCKS:
        entries = [dim.symbol for dim in mechanism.dimensions if block_of(dim) == key]
        if entries:
            _block(plan, key, entries)
    modes = [group.mode for group in plan.equations.groups if group.mode]
    if modes:
        _block(plan, "assembly", modes)
    variables = [*mechanism.given_by_row]
    variables += [eq.symbol for eq in plan.equations.columns if eq.role in ("variable", "rate", "output")]
    variables += [symbol for symbol in plan.banded if plan.equations.of(symbol).role == "point"]
    variables += [column.symbol for column in plan.forces if column.symbol in plan.shown_forces]
    _block(plan, "variables", [symbol for symbol in variables if symbol != mechanism.driver.symbol])
    if mechanism.summaries:
        _block(plan, "summary", [each.symbol for each in singles])
    if mechanism.bands:
        _block(plan, "bands", [*mechanism.bands.quantities, *mechanism.bands.summaries])
    _block(plan, "verdicts", plan.found.entries)
    _block(plan, "derived", [dim.symbol for dim in derived] + [eq.symbol for eq in plan.equations.constants])
    spots, rows = plan.at.spots, {key: block.rows for key, block in plan.blocks.items()}
    placed = [dim for dim in mechanism.dimensions if block_of(dim) != "synthesis"]
    called = names_of_dimensions(mechanism, placed, named.taken, kept_names(mechanism, [*plan.found.entries, *shown]))
    for dim in placed:
        own_rows = rows[block_of(dim) or ("dimensions" if dim.symbol in rows["dimensions"] else "derived")]
        row, name = own_rows[dim.symbol], called[dim.symbol]
        spots[dim.symbol] = named.cell(row, dim.symbol, degrees=dim.unit.in_degrees, own=name)
    unsolved, line = _place_synthesis(plan, named)
    for equation in plan.equations.constants:
        symbol, degrees = equation.symbol, mechanism.shown(equation.unit).in_degrees
        spots[symbol] = named.cell(rows["derived"][symbol], symbol, degrees=degrees)
    bands = {}
    if mechanism.bands:
        for dim in toleranced(mechanism):
            row = rows["dimensions"][dim.symbol]
            spots[tolerance_symbol(dim.symbol)] = named.cell(row, f"tol_{dim.symbol}", TOLERANCE)
        bands = {symbol: named.cell(row, f"band_{symbol}") for symbol, row in rows["bands"].items()}
    for mode in modes:
        spots[mode] = named.cell(rows["assembly"][mode], mode)
    start, step = named.sweep(rows)
    summaries = {each.symbol: named.cell(rows["summary"][each.symbol], each.symbol, own=each.cell) for each in singles}
    for output in mechanism.outputs:
        if output.cell:
            plan.names.append(Name(output.cell, plan.main, rows["variables"][output.symbol], VALUE))
    position = named.cell(rows["position"]["position"], plan.text("name.position"))
    arrows: dict[str, Spot] = {
        kind: named.cell(rows["position"][key], key) for kind, key in zip(plan.arrows, shown, strict=True)
    }
    verdict = named.cell(VERDICT_ROW, "verdict", SYMBOL)
    lines, occurs = {}, {}
    for key, row in rows["verdicts"].items():
        lines[key] = named.cell(row, key)
        if key in plan.found.placed:
            occurs[key] = named.cell(row, f"{key}_at", TOLERANCE)
    if "mean_torque" in lines:
        spots[MEAN] = lines["mean_torque"]
    first = plan.at.first
    number, status = (Spot(plan.table, first, col, plan.rows) for col in (NUMBER, STATUS))
    rates = Spot(plan.at.titles["rates"], first, RATES_STATUS, plan.rows) if plan.rates else None
    count = Spot(plan.main, rows["verdicts"]["rows_closed"], UNIT)
    plan.places = Places(
        status, count, verdict, lines, summaries, number, rates, position, start, step, unsolved, line, arrows, occurs,
        bands, starts=starts,
    )  # fmt: skip


class Named:
    """Gives names to cells, each its own; those that the description asks for are taken beforehand."""

    def __init__(self, plan: Plan) -> None:
        self.plan, mechanism = plan, plan.mechanism
        named = (*mechanism.dimensions, *mechanism.motion_numbers, *mechanism.outputs)
        self.taken = {folded(each.cell) for each in named if each.cell}

    def cell(
        self, row: int, wish: str, col: int = VALUE, degrees: bool = False, own: str | None = "", sheet: str = ""
    ) -> Spot:
        """A cell of the first sheet where no other is said, under a name that is asked for or one like the wish."""
        title, name = sheet or self.plan.main, own or safe_name(wish, self.taken)
        self.taken.add(folded(name))
        self.plan.names.append(Name(name, title, row, col))
        return Spot(title, row, col, 0, degrees, name, self.plan.mechanism.references == "names")

    def sweep(self, rows: Mapping[str, Mapping[str, int]]) -> tuple[Spot | None, Spot | None]:
        """The driver's start and step, where its values are not listed."""
        if "sweep" not in rows:
            return None, None
        degrees = self.plan.mechanism.driver.unit.in_degrees
        start, step = (
            self.cell(rows["sweep"][key], self.plan.text(f"name.{key}"), degrees=degrees) for key in ("start", "step")
        )
        return start, step


INPUT_BLOCKS = ("motion", "cam", "drivers", "gears", "masses", "loads")
"""Blocks of what the description gives elsewhere than among its dimensions."""


def block_of(dim: Dimension) -> str:
    """The block of the first sheet in which such a dimension stands; "" for one of the description's own; "synthesis" for
    what has a sheet of its own."""
    places = {"driver": "motion", "flywheel": "motion", "links": "masses", "dynamics": "masses", "loads": "loads"}
    places |= {"joints": "gears", "drivers": "drivers", "synthesis": "synthesis", "cam": "cam"}
    if dim.place[1:2] == ("segments",):
        return "cam"
    return places[str(dim.place[0])] if dim.place else ""


def _place_synthesis(plan: Plan, named: Named) -> tuple[Spot | None, Spot | None]:
    """The task's inputs and its steps; whether it has a solution, and the line of what is said of it."""
    task = plan.mechanism.synthesis
    if task is None:
        return None, None

    def place(row: int, col: int, degrees: bool, wish: str) -> Spot:
        return named.cell(row, wish, col, degrees, sheet=plan.at.titles["synthesis"])

    plan.synthesis, spots, line, unsolved = plan_rows(plan.mechanism, task, bool(plan.found.four_bars), place)
    plan.at.spots.update(spots)
    return unsolved, line


def _block(plan: Plan, key: str, entries: list[str]) -> Block:
    """Reserve rows for a block: a heading, its entries, one empty row."""
    first = plan.next_row + 1
    block = Block(plan.next_row, {entry: first + index for index, entry in enumerate(entries)})
    plan.blocks[key] = block
    plan.next_row = first + len(entries) + 1
    return block


def _plan_columns(plan: Plan) -> dict[int, Starts]:
    """One column a quantity: as people read it, and as formulas do."""
    driver = plan.mechanism.driver
    _add_column(plan, "", "number", 0, False)
    _add_column(plan, driver.symbol, "driver", 0, driver.unit.in_degrees)
    _add_column(plan, "", "status", 0, False)
    for symbol in plan.mechanism.given_by_row:
        own = plan.mechanism.given_unit(symbol)
        in_degrees = symbol in plan.mechanism.listed_symbols and own is not None and own.in_degrees
        _add_column(plan, symbol, "time" if driver.law else "listed", 0, in_degrees)
    for equation in plan.equations.columns:
        if equation.role in (*RATES, *FORCES, *BANDS, "iteration"):
            continue
        degrees = equation.role != "intermediate" and plan.mechanism.shown(equation.unit).in_degrees
        group = -1 if equation.role == "output" else equation.group
        _add_column(plan, equation.symbol, "equation", group, degrees, equation)
    starts = _plan_iterations(plan)
    plan.rates += _columns_beside(plan, "rates", RATES)
    plan.forces += _columns_beside(plan, "forces", FORCES)
    plan.bands += _columns_beside(plan, "tolerance", BANDS)
    return starts


def _columns_beside(plan: Plan, key: str, roles: Collection[Role]) -> list[TableColumn]:
    """The columns of a sheet of its own in the rows of the positions: the driver's effort both ways and what holds for the
    whole mechanism first, then group by group as they are solved."""
    first = (*plan.equations.equations.forces("effort", "work", "whole"), ENERGY)
    found = [equation for equation in plan.equations.columns if equation.role in roles]
    found.sort(key=lambda equation: equation.symbol not in first)
    columns = []
    for col, equation in enumerate(found, RATES_STATUS + 1):
        group = 0 if equation.symbol in first else equation.group
        inner = equation.role in INNER
        columns.append(TableColumn(col, equation.symbol, "equation", group, inner, equation))
        degrees = key == "rates" and not inner and plan.mechanism.shown(equation.unit).in_degrees
        plan.at.spots[equation.symbol] = Spot(plan.at.titles[key], plan.at.first, col, plan.rows, degrees)
    return columns


def _plan_iterations(plan: Plan) -> dict[int, Starts]:
    """A block of columns for each pass of each group that Newton's method solves; the last says where it has arrived."""
    found = [equation for equation in plan.equations.columns if equation.role == "iteration"]
    title = plan.at.titles.get("iterations", "")
    for col, equation in enumerate(found, RATES_STATUS + 1):
        number = equation.symbol.rpartition(" ")[2]
        system = plan.equations.groups[equation.group - 1].system
        passes = system.passes if system else 0
        block = BLOCKS * equation.group + (int(number) if number.isdecimal() else passes + 1)
        plan.iterations.append(TableColumn(col, equation.symbol, "equation", block, True, equation))
        plan.at.spots[equation.symbol] = Spot(title, plan.at.first, col, plan.rows)
    return _place_starts(plan, title) if found else {}


def _place_starts(plan: Plan, title: str) -> dict[int, Starts]:
    """Behind the blocks: how many passes each row needs, where each group starts, and the start values."""
    found, first, col = {}, plan.at.first, plan.iterations[-1].col + 1
    for group in plan.equations.groups:
        system = group.system
        if system is None:
            continue
        columns = start_columns(plan.equations, system)
        needed, table, values = col, col + 2, col + 3 + columns.width
        found[group.number] = Starts(
            Spot(title, first, needed, plan.rows),
            Spot(title, first, values - 2, FIRST_PASSES + 1),
            Spot(title, first, table),
            Spot(title, first, values),
        )
        for place, symbol in enumerate(reversed(columns.passes), 3):
            plan.at.spots[in_pass(symbol, 0)] = Spot(title, first + FIRST_PASSES, values - place)
        col = values + len(system.unknowns) + 2
    return found


def _add_column(
    plan: Plan,
    symbol: str,
    kind: Literal["number", "driver", "status", "time", "listed", "equation"],
    group: int,
    degrees: bool,
    equation: Assignment | None = None,
) -> None:
    inner = equation is not None and equation.role in INNER
    col = len(plan.columns)
    plan.columns.append(TableColumn(col, symbol, kind, group, inner, equation))
    if symbol:
        plan.at.spots[symbol] = Spot(plan.table, plan.at.first, col, plan.rows, degrees)
