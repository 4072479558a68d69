"""How a workbook is planned: which rows the first sheet has, which columns the tables have, and what cells are called."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from livesheet.workbook import Name
from mechsheet.kinematics.dimensions import dimension_order, dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import BANDS, FORCES, INNER, RATES, Equations, Role
from mechsheet.kinematics.newton.system import FIRST_PASSES
from mechsheet.kinematics.rates.sensitivity import toleranced
from mechsheet.model import ENERGY, Mechanism, Synthesis
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import Extremes
from mechsheet.sheet.classification import classification
from mechsheet.sheet.columns.added import MEAN, start_columns, with_averaged, with_energy
from mechsheet.sheet.columns.bands import found_bands, tolerance_symbol, with_bands
from mechsheet.sheet.columns.lowering import Assignment, in_pass, lowered
from mechsheet.sheet.findings.finding import Finding
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.places import Places, Starts
from mechsheet.sheet.plan import (
    BLOCKS,
    FIRST_BLOCK,
    HEADING_ROWS,
    INPUT_BLOCKS,
    MAY_GO,
    MEANING,
    NUMBER,
    RATES_STATUS,
    SHEETS,
    STATUS,
    SYMBOL,
    TOLERANCE,
    UNIT,
    VALUE,
    VERDICT_ROW,
    Block,
    Blocks,
    Kind,
    Named,
    Plan,
    TableColumn,
    block_of,
)
from mechsheet.sheet.shown import kept_names, names_of_dimensions
from mechsheet.sheet.table.rates import dead_words
from mechsheet.sheet.table.status import words_looked_up
from mechsheet.sheet.task_rows import Rows, plan_rows
from mechsheet.synthesis.kinds import kind_of
from mechsheet.words.catalogue import words


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
    mechanism, found_of_bands = found_bands(mechanism, equations)
    assignments = with_averaged(
        mechanism, with_bands(mechanism, with_energy(mechanism, lowered(mechanism, equations)), found_of_bands)
    )
    found = classification(mechanism, assignments)
    driver = [float(value) for value in values]
    plan = Plan(mechanism, assignments, language, at, rows, driver, found, found_of_bands)
    plan, starts = _with_columns(plan)
    plan = _with_rows(plan, starts)
    return _with_proof(plan)


# --- the first sheet -------------------------------------------------------------------------------------------------


def _with_rows(plan: Plan, starts: Mapping[int, Starts]) -> Plan:
    """The plan with the rows of the first sheet, and with the places and names of its cells."""
    mechanism = plan.mechanism
    findings = findings_of(mechanism, plan.found)
    shown = {kind: f"show_{kind}" for kind in plan.arrows}
    blocks, named = _blocks(plan, findings, list(shown.values())), Named(plan)
    rows = {key: block.rows for key, block in blocks.items()}
    spots = {}
    placed = [dim for dim in mechanism.dimensions if block_of(dim) != "synthesis"]
    kept = kept_names(mechanism, [*rows["verdicts"], *shown.values()])
    called = names_of_dimensions(mechanism, placed, named.taken, kept)
    for dim in placed:
        own_rows = rows[block_of(dim) or ("dimensions" if dim.symbol in rows["dimensions"] else "derived")]
        row, name = own_rows[dim.symbol], called[dim.symbol]
        spots[dim.symbol] = named.cell(row, dim.symbol, degrees=dim.unit.in_degrees, own=name)
    unsolved = line = task_rows = None
    if mechanism.synthesis is not None:
        task_rows, of_task, line, unsolved = _place_synthesis(plan, mechanism.synthesis, named)
        spots |= of_task
    spots |= named.constants(rows["derived"])
    bands = {}
    if mechanism.bands:
        for dim in toleranced(mechanism):
            row = rows["dimensions"][dim.symbol]
            spots[tolerance_symbol(dim.symbol)] = named.cell(row, f"tol_{dim.symbol}", TOLERANCE)
        bands = {symbol: named.cell(row, f"band_{symbol}") for symbol, row in rows["bands"].items()}
    spots |= {mode: named.cell(row, mode) for mode, row in rows.get("assembly", {}).items()}
    start, step = named.sweep(rows)
    summaries = named.summaries(rows.get("summary", {}))
    for output in mechanism.outputs:
        if output.cell:
            named.names.append(Name(output.cell, plan.main, rows["variables"][output.symbol], VALUE))
    position = named.cell(rows["position"]["position"], plan.text("name.position"))
    arrows: dict[str, Spot] = {kind: named.cell(rows["position"][key], key) for kind, key in shown.items()}
    verdict = named.cell(VERDICT_ROW, "verdict", SYMBOL)
    lines, occurs = {}, {}
    for finding in findings:
        key, row = finding.key, rows["verdicts"][finding.key]
        lines[key] = named.cell(row, key)
        if finding.placed:
            occurs[key] = named.cell(row, finding.key_at, TOLERANCE)
    if "mean_torque" in lines:
        spots[MEAN] = lines["mean_torque"]
    first = plan.at.first
    number, status = (Spot(plan.table, first, col, plan.rows) for col in (NUMBER, STATUS))
    rates = Spot(plan.at.titles["rates"], first, RATES_STATUS, plan.rows) if plan.rates else None
    count = Spot(plan.main, rows["verdicts"]["rows_closed"], UNIT)
    reasons, dead = (
        Spot(plan.main, blocks[key].row + 1, MEANING, len(rows[key])).whole() if key in blocks else None
        for key in ("reasons", "dead")
    )
    sheets = {key: Spot(plan.main, row, VALUE) for key, row in rows["sheets"].items()}
    left, well = (replace(sheets.pop(key), col=MEANING) for key in (LEFT, WELL))
    places = Places(
        status, count, verdict, lines, summaries, number, rates, position, start, step, unsolved, line, arrows, occurs,
        bands, starts=starts, reasons=reasons, dead=dead, sheets=sheets, left=left, well=well,
    )  # fmt: skip
    return replace(plan, at=plan.at.beside(spots), blocks=blocks, names=named.names, synthesis=task_rows, placed=places)


LEFT, WELL = "left", "well"
"""The entries of what can be said where sheets were deleted, and where nothing is wrong, before those that say whether
sheets are there."""


def _blocks(plan: Plan, findings: Iterable[Finding], shown: Sequence[str]) -> Mapping[str, Block]:
    """The blocks of the first sheet, from above."""
    mechanism, blocks = plan.mechanism, Blocks(FIRST_BLOCK, headed=True)
    order = {symbol: index for index, symbol in enumerate(dimension_order(mechanism))}
    own = [dim for dim in mechanism.dimensions if not dim.path]
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    inputs = [dim for dim in own if not dim.derived or dim.symbol in found]
    derived = sorted((dim for dim in own if dim not in inputs), key=lambda dim: order[dim.symbol])
    blocks.add("position", ["position", mechanism.driver.symbol, "status", *shown])
    blocks.add("dimensions", [dim.symbol for dim in inputs])
    if mechanism.summaries:  # what one asked for, in sight beside the drawing while one types a dimension
        blocks.add("summary", [each.symbol for each in mechanism.motion_numbers])
    if mechanism.driver.stepped:
        blocks.add("sweep", ["start", "step", "stop"])
    for key in INPUT_BLOCKS:
        entries = [dim.symbol for dim in mechanism.dimensions if block_of(dim) == key]
        if entries:
            blocks.add(key, entries)
    modes = [group.mode for group in plan.equations.groups if group.mode]
    if modes:
        blocks.add("assembly", modes)
    variables = [*mechanism.given_by_row]
    variables += [eq.symbol for eq in plan.equations.columns if eq.role in ("variable", "rate", "output")]
    variables += [symbol for symbol in plan.banded if plan.equations.of(symbol).role == "point"]
    variables += [column.symbol for column in plan.forces if column.symbol in plan.shown_forces]
    blocks.add("variables", [symbol for symbol in variables if symbol != mechanism.driver.symbol])
    if mechanism.bands:
        blocks.add("bands", [*mechanism.bands.quantities, *mechanism.bands.summaries])
    blocks.add("verdicts", [finding.key for finding in findings])
    blocks.add("derived", [dim.symbol for dim in derived] + [eq.symbol for eq in plan.equations.constants])
    for key, said in (("reasons", words_looked_up(plan)), ("dead", dead_words(plan))):
        if said:  # the words that tables look up
            blocks.add(key, [f"{key}_{number}" for number in range(len(said))])
    blocks.add("sheets", [WELL, LEFT, *(key for key in MAY_GO if key in plan.at.titles)])
    return blocks.of


def _place_synthesis(plan: Plan, task: Synthesis, named: Named) -> tuple[Rows, dict[str, Spot], Spot, Spot]:
    """See `plan_rows`: what it places has names."""

    def place(row: int, col: int, degrees: bool, wish: str) -> Spot:
        return named.cell(row, wish, col, degrees, sheet=plan.at.titles["synthesis"])

    return plan_rows(plan.mechanism, task, bool(plan.found.four_bars), place)


def _with_proof(plan: Plan) -> Plan:
    """The plan with the sheets of extremes and of checks; the driver's value at a limit has a name, the same in all
    languages."""
    searched, named = Extremes(plan).places, Named(plan)
    limits = [
        named.cell(spot.row, f"limit_{number}", spot.col, sheet=spot.sheet)
        for number, spot in enumerate(searched.limits, 1)
    ]
    plan = replace(plan, names=named.names, extremes=replace(searched, limits=limits))
    return replace(plan, checks=Checks(plan).places)


# --- the tables ------------------------------------------------------------------------------------------------------


def _with_columns(plan: Plan) -> tuple[Plan, Mapping[int, Starts]]:
    """The plan with one column a quantity: as people read it, and as formulas do; and where Newton's method begins."""
    driver = plan.mechanism.driver
    columns, spots = list[TableColumn](), dict[str, Spot]()

    def add(symbol: str, kind: Kind, group: int = 0, degrees: bool = False, equation: Assignment | None = None) -> None:
        col, inner = len(columns), equation is not None and equation.role in INNER
        columns.append(TableColumn(col, symbol, kind, group, inner, equation))
        if symbol:
            spots[symbol] = Spot(plan.table, plan.at.first, col, plan.rows, degrees)

    add("", "number")
    add(driver.symbol, "driver", degrees=driver.unit.in_degrees)
    add("", "status")
    for symbol in plan.mechanism.given_by_row:
        own = plan.mechanism.given_unit(symbol)
        in_degrees = symbol in plan.mechanism.listed_symbols and own is not None and own.in_degrees
        add(symbol, "time" if driver.law else "listed", degrees=in_degrees)
    for equation in plan.equations.columns:
        if equation.role in (*RATES, *FORCES, *BANDS, "iteration"):
            continue
        degrees = equation.role != "intermediate" and plan.mechanism.shown(equation.unit).in_degrees
        group = -1 if equation.role == "output" else equation.group
        add(equation.symbol, "equation", group, degrees, equation)
    iterations, starts, of_iterations = _iterations(plan)
    rates, forces, bands = (_columns_beside(plan, roles) for roles in (RATES, FORCES, BANDS))
    spots |= of_iterations
    for key, beside in (("rates", rates), ("forces", forces), ("tolerance", bands)):
        for column in beside:
            equation = plan.equations.of(column.symbol)
            degrees = key == "rates" and not column.inner and plan.mechanism.shown(equation.unit).in_degrees
            spots[column.symbol] = Spot(plan.at.titles[key], plan.at.first, column.col, plan.rows, degrees)
    plan = replace(
        plan, at=plan.at.beside(spots), columns=columns, rates=rates, forces=forces, iterations=iterations, bands=bands
    )
    return plan, starts


def _columns_beside(plan: Plan, roles: Collection[Role]) -> list[TableColumn]:
    """The columns of a sheet of its own in the rows of the positions: the driver's effort both ways and what holds for the
    whole mechanism first, then group by group as they are solved."""
    first = (*plan.equations.equations.forces("effort", "work", "whole"), ENERGY)
    found = [equation for equation in plan.equations.columns if equation.role in roles]
    found.sort(key=lambda equation: equation.symbol not in first)
    return [
        TableColumn(
            col, each.symbol, "equation", 0 if each.symbol in first else each.group, each.role in INNER, each
        )
        for col, each in enumerate(found, RATES_STATUS + 1)
    ]  # fmt: skip


def _iterations(plan: Plan) -> tuple[list[TableColumn], Mapping[int, Starts], dict[str, Spot]]:
    """A block of columns for each pass of each group that Newton's method solves; the last says where it has arrived. Where
    each group starts, and where all of these quantities stand."""
    found = [equation for equation in plan.equations.columns if equation.role == "iteration"]
    if not found:
        return [], {}, {}
    title, columns, spots = plan.at.titles["iterations"], [], {}
    for col, equation in enumerate(found, RATES_STATUS + 1):
        number = equation.symbol.rpartition(" ")[2]
        system = plan.equations.groups[equation.group - 1].system
        passes = system.passes if system else 0
        block = BLOCKS * equation.group + (int(number) if number.isdecimal() else passes + 1)
        columns.append(TableColumn(col, equation.symbol, "equation", block, True, equation))
        spots[equation.symbol] = Spot(title, plan.at.first, col, plan.rows)
    starts, of_starts = _starts(plan, title, columns[-1].col + 1)
    return columns, starts, spots | of_starts


def _starts(plan: Plan, title: str, col: int) -> tuple[Mapping[int, Starts], dict[str, Spot]]:
    """Behind the blocks: how many passes each row needs, where each group starts, and the start values."""
    found, spots, first = {}, {}, plan.at.first
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
            spots[in_pass(symbol, 0)] = Spot(title, first + FIRST_PASSES, values - place)
        col = values + len(system.unknowns) + 2
    return found, spots
