"""How a workbook is planned: which rows the first sheet has, which columns the tables have, and what cells are called."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Literal

from livesheet.formula.nodes import RangeRef
from livesheet.workbook import Name
from mechsheet.kinematics.dimensions import dimension_order, dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import BANDS, FORCES, INNER, RATES, Equations, Role
from mechsheet.kinematics.newton.system import FIRST_PASSES
from mechsheet.kinematics.rates.sensitivity import toleranced
from mechsheet.model import ENERGY, Mechanism
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.classification import classification
from mechsheet.sheet.columns.averaged import with_averaged
from mechsheet.sheet.columns.bands import found_bands, tolerance_symbol, with_bands
from mechsheet.sheet.columns.flywheel import MEAN, with_energy
from mechsheet.sheet.columns.lowering import Assignment, in_pass, lowered
from mechsheet.sheet.columns.start_columns import start_columns
from mechsheet.sheet.findings.listing import findings_of
from mechsheet.sheet.naming import kept_names, names_of_dimensions
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
    Named,
    Plan,
    TableColumn,
    block_of,
)
from mechsheet.sheet.table.rates import dead_words
from mechsheet.sheet.table.status import words_looked_up
from mechsheet.sheet.task_rows import plan_rows
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
    plan = Plan(mechanism, assignments, language, at, rows, [float(value) for value in values], found)
    plan.sensitivities = found_of_bands
    starts = _plan_columns(plan)
    _plan_names_and_blocks(plan, starts)
    return plan


def _plan_names_and_blocks(plan: Plan, starts: dict[int, Starts]) -> None:
    mechanism = plan.mechanism
    order = {symbol: index for index, symbol in enumerate(dimension_order(mechanism))}
    own = [dim for dim in mechanism.dimensions if not dim.path]
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    inputs = [dim for dim in own if not dim.derived or dim.symbol in found]
    derived = sorted((dim for dim in own if dim not in inputs), key=lambda dim: order[dim.symbol])
    named, singles = Named(plan), mechanism.motion_numbers
    plan.next_row = FIRST_BLOCK
    shown = [f"show_{kind}" for kind in plan.arrows]
    _block(plan, "position", ["position", mechanism.driver.symbol, "status", *shown])
    _block(plan, "dimensions", [dim.symbol for dim in inputs])
    if mechanism.summaries:  # what one asked for, in sight beside the drawing while one types a dimension
        _block(plan, "summary", [each.symbol for each in singles])
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
    if mechanism.bands:
        _block(plan, "bands", [*mechanism.bands.quantities, *mechanism.bands.summaries])
    findings = findings_of(mechanism, plan.found)
    keys = [finding.key for finding in findings]
    _block(plan, "verdicts", keys)
    _block(plan, "derived", [dim.symbol for dim in derived] + [eq.symbol for eq in plan.equations.constants])
    spots, rows = plan.at.spots, {key: block.rows for key, block in plan.blocks.items()}
    placed = [dim for dim in mechanism.dimensions if block_of(dim) != "synthesis"]
    called = names_of_dimensions(mechanism, placed, named.taken, kept_names(mechanism, [*keys, *shown]))
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
    for finding in findings:
        key, row = finding.key, rows["verdicts"][finding.key]
        lines[key] = named.cell(row, key)
        if finding.placed:
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
    _plan_below(plan)


def _plan_below(plan: Plan) -> None:
    """The last blocks of the first sheet: the words that tables look up, and which other sheets there are."""

    def looked_up(key: str, said: list[str]) -> RangeRef | None:
        if not said:
            return None
        block = _block(plan, key, [f"{key}_{number}" for number in range(len(said))])
        return Spot(plan.main, block.row + 1, MEANING, len(said)).whole()

    reasons, dead = looked_up("reasons", words_looked_up(plan)), looked_up("dead", dead_words(plan))
    block = _block(plan, "sheets", ["left", *(key for key in MAY_GO if key in plan.at.titles)])
    spots = {key: Spot(plan.main, row, VALUE) for key, row in block.rows.items()}
    left = replace(spots.pop("left"), col=MEANING)
    plan.places = replace(plan.places, left=left, reasons=reasons, dead=dead, sheets=spots)


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
