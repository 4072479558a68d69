"""The plan of a workbook: every row of the first sheet and every column of the table, before any cell is written.

Everything that is read by a formula has its address here; the writers of the sheets only fill in. A plan is not changed: it
is made in steps (`planning`, `page.plan`), each of which makes one that knows more.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from livesheet import portable
from livesheet.formula.names import folded, safe_name
from livesheet.formula.nodes import Node
from livesheet.workbook import Name
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.kinematics.numeric import Array, only_rounding
from mechsheet.kinematics.rates.sensitivity import NO_BANDS, Sensitivities
from mechsheet.kinematics.sweep import sweep
from mechsheet.kinematics.whole_turns import Periods
from mechsheet.model import Dimension, Mechanism
from mechsheet.shapes.loads import first_shown
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.classification import Classification
from mechsheet.sheet.columns.bands import Banded, sizes
from mechsheet.sheet.columns.lowering import Assignment, Assignments
from mechsheet.sheet.places import Checked, Places, Searched, there
from mechsheet.sheet.task_rows import Rows
from mechsheet.units import Unit
from mechsheet.words.catalogue import Language, words

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

MAY_GO = ("synthesis", "iterations", "rates", "forces", "tolerance", "checks", "extremes")
"""Those that the first sheet reads beside the positions, and that a person may delete all the same."""

HEADING_ROWS = 3
"""Rows over the table: group, symbol with unit, formula as text."""

NUMBER, DRIVER, STATUS = range(3)
"""First columns of the table: row number, driver as shown, what it says of the row."""

RATES_DRIVER, RATES_STATUS = range(2)
"""First columns of the sheets of rates and of forces."""

SPARE = 400
"""So many rows below the table are looked at too: a person may fill it further down."""

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


Kind = Literal["number", "driver", "status", "time", "listed", "equation"]
"""What a column of the table holds."""


@dataclass(frozen=True, slots=True)
class TableColumn:
    """One column of the table: the row's number, the driver, what it says of the row, the time of a law, what is listed
    beside the driver's values, or a quantity.

    symbol  of the quantity, "" of the row's number and of what it says
    inner   an intermediate quantity, in quieter ink
    """

    col: int
    symbol: str
    kind: Kind
    group: int
    inner: bool
    equation: Assignment | None = None


@dataclass(frozen=True)
class Plan:
    """Addresses of everything; see `Addresses` for `at`.

    found   what can be said about the mechanism
    rates   the columns of the sheet of rates behind its first two; none without velocities
    iterations  those of the sheet of Newton's method, where a group is solved by it
    forces  those of the sheet of forces, behind the driver's value and what is said of the row
    bands   those of the sheet of tolerances, likewise;  sensitivities: what these say
    placed, extremes, checks  what stands where on the first sheet and in the tables, and on those two
    synthesis   rows of the sheet of synthesis; None where no dimension is found from a task
    """

    mechanism: Mechanism
    equations: Assignments
    language: Language
    at: Addresses
    rows: int
    driver: Sequence[float]
    found: Classification
    sensitivities: Sensitivities = NO_BANDS
    columns: Sequence[TableColumn] = ()
    rates: Sequence[TableColumn] = ()
    forces: Sequence[TableColumn] = ()
    iterations: Sequence[TableColumn] = ()
    bands: Sequence[TableColumn] = ()
    blocks: Mapping[str, Block] = field(default_factory=dict)
    names: Sequence[Name] = ()
    synthesis: Rows | None = None
    placed: Places | None = None
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
    def band_decimals(self) -> dict[str, int]:
        """By quantity with a band: the decimals of which the last is the band's first digit, in most rows."""
        found = {}
        for name, column in sizes(self.mechanism, self.sensitivities, self.equations, self.nominal).items():
            there = column[np.isfinite(column) & (column > 0)]
            if len(there):
                found[name] = min(10, max(0, math.ceil(-float(portable.log10(np.median(there))) - 1e-9)))
        return found

    @cached_property
    def first_shown(self) -> int:
        """The number of the row that is shown first, with the dimensions as described."""
        return first_shown(self.mechanism, self.equations.equations.closed(self.nominal), self.nominal)

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

    def unit_of(self, symbol: str) -> Unit:
        """The unit of what a column holds: as it is given row by row, or of its equation."""
        return self.mechanism.given_unit(symbol) or self.equations.of(symbol).unit

    @property
    def status_column(self) -> int:
        """The column of the table that says what does not close."""
        return self.places.status.col

    @property
    def ok(self) -> str:
        """What it says where everything closes."""
        return self.text("status.ok")

    @property
    def places(self) -> Places:
        """Places on the first sheet and in the tables."""
        return there(self.placed)

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


class Blocks:
    """Hands out the rows of blocks, from above.

    headed  whether a block has a heading above its entries and an empty row below them
    """

    def __init__(self, row: int, headed: bool) -> None:
        self.next_row, self.headed, self.of = row, headed, dict[str, Block]()

    def add(self, key: str, entries: Iterable[str]) -> Block:
        """The next block."""
        names, first = list(entries), self.next_row + self.headed
        block = self.of[key] = Block(first - 1, {entry: first + index for index, entry in enumerate(names)})
        self.next_row = first + len(names) + self.headed
        return block


class Named:
    """Gives names to cells, each its own; those that the description asks for are taken beforehand."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.names, mechanism = plan, [*plan.names], plan.mechanism
        named = (*mechanism.dimensions, *mechanism.motion_numbers, *mechanism.outputs)
        self.taken = {folded(each.cell) for each in named if each.cell} | {folded(each.name) for each in plan.names}

    def cell(
        self, row: int, wish: str, col: int = VALUE, degrees: bool = False, own: str | None = "", sheet: str = ""
    ) -> Spot:
        """A cell of the first sheet where no other is said, under a name that is asked for or one like the wish."""
        title, name = sheet or self.plan.main, own or safe_name(wish, self.taken)
        self.taken.add(folded(name))
        self.names.append(Name(name, title, row, col))
        return Spot(title, row, col, 0, degrees, name, self.plan.mechanism.references == "names")

    def constants(self, rows: Mapping[str, int]) -> dict[str, Spot]:
        """What the equations have once, by symbol."""
        found = self.plan.equations.constants
        units = {each.symbol: self.plan.mechanism.shown(each.unit) for each in found}
        return {symbol: self.cell(rows[symbol], symbol, degrees=unit.in_degrees) for symbol, unit in units.items()}

    def summaries(self, rows: Mapping[str, int]) -> dict[str, Spot]:
        """The numbers of the whole motion, by symbol."""
        numbers = self.plan.mechanism.motion_numbers
        return {each.symbol: self.cell(rows[each.symbol], each.symbol, own=each.cell) for each in numbers}

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
    if dim.path[1:2] == ("segments",):
        return "cam"
    return places[str(dim.path[0])] if dim.path else ""
