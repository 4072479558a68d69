"""The plan of a page: what stands in which row of the top and in which column of the table, before any cell is written."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol, symbols
from livesheet.formula.scalar import evaluate
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_order, dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import FORCES, INNER, RATES, Equations, need_closed_form
from mechsheet.model import Mechanism
from mechsheet.shapes.described import remarkable_points
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.classification import FourBar, classification
from mechsheet.sheet.columns.added import with_averaged
from mechsheet.sheet.findings.finding import Finding
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.page.lowering import PageAssignments, lowered
from mechsheet.sheet.page.paper import CHART_HEIGHT
from mechsheet.sheet.places import Places
from mechsheet.sheet.plan import SHEETS, SPARE, UNIT, VERDICT_ROW, Blocks, Named, Plan, TableColumn
from mechsheet.sheet.shown import kept_names, names_of_dimensions
from mechsheet.words.catalogue import words

FIRST_ROW = 3
"""The row of the first dimension: its value is $B$4, as in the text."""

ROW_HEIGHT = 17
"""Pixels of a row of the page: lower than elsewhere, so that dimensions and table stand on one sheet of paper."""

CHART_ROWS = CHART_HEIGHT // ROW_HEIGHT + 2
"""Rows beside the top that the charts take, with the scroll bar below the drawing."""

STATUS_GROUP = -2
"""The number under which the column stands that says what does not close: it has no heading."""


@dataclass(frozen=True)
class PagePlan(Plan):
    """A plan of one sheet.

    page      the equations of the page
    drawn     False without the drawing
    note_row  where it is said how exact the angles are
    lengths   sides of four-bar loops that are no dimensions, by the keys of their cells
    marks     the column that names the inputs that cannot be, and has the words where all is well: the first to the right
              of table and charts
    """

    page: PageAssignments = field(kw_only=True)
    drawn: bool = field(kw_only=True)
    note_row: int = 0
    marks: int = 0
    lengths: Mapping[str, Node] = field(default_factory=dict)

    @property
    def symbol_row(self) -> int:
        """The row of the symbols over the table."""
        return self.at.first - 2

    @property
    def grouped(self) -> bool:
        """Whether the groups have a row of headings."""
        return len(self.equations.groups) > 1

    @property
    def last_looked_at(self) -> int:
        """The last row that what is said of the table looks at."""
        return self.at.last + SPARE

    def filled(self, spot: Spot) -> RangeRef:
        """The cells of a column of the table, and those below that a person may fill."""
        rows = (self.at.first, self.last_looked_at)
        return RangeRef(*(CellRef(row, spot.col, True, True) for row in rows))

    @cached_property
    def findings(self) -> Sequence[Finding]:
        """What can be said of the rows, in the order in which it stands."""
        return findings_of(self.mechanism, self.found, by_rows=True)

    @property
    def plain(self) -> Mapping[str, Node]:
        """What has no cell of its own: points that are written where they are read."""
        return self.page.plain

    @cached_property
    def unguarded(self) -> frozenset[str]:
        """Columns that say where a group closes, with listed values of the driver, above which no cell asks the inputs."""
        return frozenset(self.page.closes.values()) if self.mechanism.driver.values else frozenset()

    @property
    def ok(self) -> str:
        """The status says something only where a group does not close."""
        return ""


def plan_page(mechanism: Mechanism, equations: Equations) -> PagePlan:
    """The plan of a mechanism's page."""
    need_closed_form(
        equations, say("the layout page cannot hold this"), "workbook.layout", say('layout = "sheets" does')
    )
    _need_short_task(mechanism)
    language, drawn = mechanism.language, mechanism.drawn
    titles = dict.fromkeys(SHEETS, words(language, "sheet.mechanism"))
    titles["description"] = words(language, "sheet.description")
    values = driver_values(mechanism, dimension_values(mechanism))
    traced = traced_points(mechanism) if drawn else ()
    kept = {f"{point}.{axis}" for point in traced for axis in ("x", "y")}
    kept |= {symbol for chart in mechanism.charts for symbol in (chart.x, *chart.y) if symbol}
    kept |= {summary.of for summary in mechanism.summaries}
    # points that velocities and forces are found from have columns: written out, they would make the formulas long
    further = (equation for equation in equations.columns if equation.role in (*RATES, *FORCES))
    kept |= {name for equation in further for name in equation.reads if name.endswith((".x", ".y"))}
    page = with_averaged(mechanism, lowered(mechanism, equations, kept, drawn))
    at = Addresses(titles, 0, 0)
    plan = PagePlan(
        mechanism, page, language, at, len(values), [float(value) for value in values], classification(mechanism, page),
        page=page, drawn=drawn,
    )  # fmt: skip
    return _with_places(_with_columns(_with_rows(plan)))


MOST_STEPS = 12
"""Steps of a synthesis that stand among the dimensions of a page."""


def _need_short_task(mechanism: Mechanism) -> None:
    """Raise MechanismError where the task of a synthesis needs a sheet of its own."""
    task = mechanism.synthesis
    if task is None or (len(task.steps) <= MOST_STEPS and not task.mode):
        return
    message = say(
        "the layout page cannot hold the {steps} steps of a synthesis of kind {kind}",
        steps=len(task.steps),
        kind=task.kind,
    )
    raise MechanismError(Fault(message, key="workbook.layout", hint=say('layout = "sheets" has a sheet for them')))


def traced_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points whose paths are drawn: those that the description asks for, else those whose paths say something."""
    asked = dict.fromkeys(point for chart in mechanism.charts for point in chart.paths)
    return tuple(asked) or remarkable_points(mechanism)


def _named(length: Node, names: Iterable[str], values: Mapping[str, float]) -> Node:
    """The length, or the dimension that the description has for it under one of these names."""
    number = evaluate(length, values)
    found = [name for name in names if name in values and abs(number - values[name]) <= 1e-12 * abs(values[name])]
    return Symbol(found[0]) if found else length


def sides_of(plan: PagePlan, loop: FourBar) -> list[tuple[str, Node]]:
    """Ground, first link, coupler and last link of a four-bar loop as lengths, each with a key of its own."""
    values = dimension_values(plan.mechanism)
    found = []
    for link, one, other in loop.sides(plan.mechanism.ground):
        tree = length_in_cells(link, one, other, plan.equations.poses)
        if values.keys() >= {*symbols(tree)}:
            tree = _named(tree, (f"{one}{other}", f"{other}{one}"), values)
        found.append((f"{one}{other}", tree))
    return found


# --- the top ---------------------------------------------------------------------------------------------------------


def _with_rows(plan: PagePlan) -> PagePlan:
    """The plan with the rows of the top, and of the note below it."""
    mechanism, found, blocks = plan.mechanism, plan.found, Blocks(FIRST_ROW, headed=False)
    blocks.add("dimensions", (dim.symbol for dim in mechanism.dimensions if not dim.derived))
    if mechanism.driver.stepped:
        blocks.add("sweep", ("start", "step"))
    blocks.add("assembly", (group.mode for group in plan.equations.groups if group.mode))
    if plan.drawn:
        blocks.add("position", ("position",))
    order = {symbol: index for index, symbol in enumerate(dimension_order(mechanism))}
    derived = sorted((dim for dim in mechanism.dimensions if dim.derived), key=lambda dim: order[dim.symbol])
    constants = [each.symbol for each in plan.equations.constants]
    sides = (side for loop in found.four_bars for side in sides_of(plan, loop))
    lengths = {key: tree for key, tree in sides if len(set(symbols(tree))) > 1}
    blocks.add("derived", [*(dim.symbol for dim in derived), *(f"length {key}" for key in lengths), *constants])
    blocks.add("verdicts", [key for each in plan.findings for key in (each.key, *each.keys_below(plan))])
    blocks.add("summary", (each.symbol for each in mechanism.motion_numbers))
    blocks.add("variables", ())
    note_row = max(blocks.next_row, FIRST_ROW - 1 + CHART_ROWS) + 1
    first = note_row + 3 + plan.grouped
    at = replace(plan.at, first=first, last=first + plan.rows - 1)
    return replace(plan, at=at, blocks=blocks.of, lengths=lengths, note_row=note_row)


# --- the table -------------------------------------------------------------------------------------------------------


def _with_columns(plan: PagePlan) -> PagePlan:
    """The plan with the columns of the table."""
    driver = plan.mechanism.driver
    outputs = {output.symbol for output in plan.mechanism.outputs}
    columns = [TableColumn(0, driver.symbol, "driver", 0, False)]
    degrees = {driver.symbol: driver.unit.in_degrees}
    for symbol in plan.mechanism.given_by_row:
        columns.append(TableColumn(len(columns), symbol, "time" if driver.law else "listed", 0, False))
        degrees[symbol] = symbol in plan.mechanism.listed_symbols and plan.mechanism.driver_of(symbol).unit.in_degrees
    for col, equation in enumerate(plan.equations.columns, len(columns)):
        inner = equation.role in INNER
        group = -1 if equation.symbol in outputs else equation.group
        columns.append(TableColumn(col, equation.symbol, "equation", group, inner, equation))
        degrees[equation.symbol] = plan.mechanism.shown(equation.unit).in_degrees
    columns.append(TableColumn(len(columns), "", "status", STATUS_GROUP, False))
    spots = {
        column.symbol: Spot(plan.main, plan.at.first, column.col, plan.rows, degrees.get(column.symbol, False))
        for column in columns[:-1]
    }
    return replace(plan, at=plan.at.beside(spots), columns=columns)


# --- places ----------------------------------------------------------------------------------------------------------


def _with_places(plan: PagePlan) -> PagePlan:
    """The plan with a place and a name for everything on top, whether the page's own formulas read names or not."""
    mechanism, rows, spots = plan.mechanism, {key: block.rows for key, block in plan.blocks.items()}, {}
    named = Named(plan)
    called = names_of_dimensions(mechanism, mechanism.dimensions, named.taken, kept_names(mechanism, rows["verdicts"]))
    for dim in mechanism.dimensions:
        row = rows["derived" if dim.derived else "dimensions"][dim.symbol]
        spots[dim.symbol] = named.cell(row, dim.symbol, degrees=dim.unit.in_degrees, own=called[dim.symbol])
    spots |= named.constants(rows["derived"])
    lengths = {key: named.cell(rows["derived"][f"length {key}"], f"length_{key}") for key in plan.lengths}
    spots |= {mode: named.cell(row, mode) for mode, row in rows["assembly"].items()}
    start, step = named.sweep(rows)
    position = named.cell(rows["position"]["position"], plan.text("name.position")) if plan.drawn else None
    lines = {key: named.cell(row, key) for key, row in rows["verdicts"].items()}
    occurs = {each.key: lines[each.key_at] for each in plan.findings if each.key_at in lines}
    summaries = named.summaries(rows["summary"])
    verdict = named.cell(VERDICT_ROW, "verdict", 0)
    status = Spot(plan.main, plan.at.first, plan.columns[-1].col, plan.rows)
    count = Spot(plan.main, rows["verdicts"]["rows_closed"], UNIT)
    places = Places(
        status,
        count,
        verdict,
        lines,
        summaries,
        position=position,
        start=start,
        step=step,
        lengths=lengths,
        occurs=occurs,
    )
    return replace(plan, at=plan.at.beside(spots), names=named.names, placed=places)
