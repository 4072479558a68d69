"""What stands to the right of the table of checks: limit positions, extremes, and the trials by which both are found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mechsheet.formula.nodes import symbols
from mechsheet.sheet.dead_centres import TRIALS, DeadCentres
from mechsheet.sheet.extremes import Extremes, sweep_of
from mechsheet.sheet.findings import findings
from mechsheet.sheet.limits import PARTS, Limits, Slot, slots_of
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.reach import Reach
from mechsheet.sheet.refinement import Tried
from mechsheet.sheet.trials import Corner, Trials
from mechsheet.sheet.workbook import Cell, Column, Fill

MOST_CELLS = 12_000
"""Cells of trials for extremes, about: in mechanisms of very many links only the first extremes are refined."""


@dataclass(frozen=True, slots=True)
class Aside:
    """Cells and formulas, the widths of the columns, and the last of them."""

    cells: tuple[Cell, ...]
    fills: tuple[Fill, ...]
    columns: tuple[Column, ...]
    end: int


def aside(plan: Plan, sheet: str, section: int, head: int, first: int, col: int) -> Aside:
    """All of it. section, head, first: rows of the titles, of the heads, and the first that scrolls; col: first column."""
    said = findings(plan.mechanism, plan.equations)
    reach, extreme = said.reach, said.extremes
    limits_width = 1 + max(slots_of(plan), 1 if reach else 0)
    extremes_at = col + limits_width + 1
    passed_at = extremes_at + (2 + 2 * len(extreme) if extreme else 0)
    refined = _refined(plan, extreme)
    wanted = _wanted(plan, reach, refined)
    if limits_width == 1 and not refined:
        wanted = ()
    trials = Trials(plan, Corner(sheet, section, head, first, passed_at + 2 + len(extreme)), wanted) if wanted else None
    parts: list[Limits | Extremes | DeadCentres | Trials] = []
    tried: dict[tuple[str, str], Tried] = {}
    found = []
    if trials is not None:
        limits = Limits(plan, trials, section, first, col)
        slots, tried, dead = _stages(plan, trials, reach, refined)
        if slots:
            limits.headings()
            passed = limits.passed(passed_at)
            for slot in slots:
                limits.find(slot, passed)
        if reach is not None:
            centres = DeadCentres(plan, trials, reach, first + 1, col)
            centres.write(dead)
            parts.append(centres)
        found = limits.found
        parts += [limits, trials]
    if extreme:
        block = Extremes(plan, trials, sheet, section, first, extremes_at, found)
        block.find_vertices(extreme, first, passed_at + 1)
        block.write(extreme, tried)
        parts.append(block)
    columns = [Column(col, col, 26), Column(col + 1, col + limits_width - 1, 20)] if limits_width > 1 else []
    columns.append(Column(extremes_at - 1, extremes_at - 1, 3))
    if extreme:
        columns += [Column(extremes_at, passed_at - 2, 20), Column(passed_at - 1, passed_at - 1, 3)]
    if trials is not None or extreme:
        last = trials.corner.col + trials.width - 1 if trials is not None else passed_at + len(extreme)
        columns += [Column(passed_at, last, 12, level=1, hidden=True), Column(last + 1, last + 1, 3, collapsed=True)]
    return Aside(
        tuple(cell for part in parts for cell in part.cells),
        tuple(fill for part in parts for fill in part.fills),
        tuple(columns),
        max((column.last for column in columns), default=col),
    )


def _refined(plan: Plan, extreme: Sequence[str]) -> tuple[str, ...]:
    """The symbols whose extremes are refined."""
    if sweep_of(plan) == "list":
        return ()
    room = MOST_CELLS // (16 * max(1, len(plan.equations.columns)))
    return tuple(extreme[: max(room, 1)])


def _wanted(plan: Plan, reach: Reach | None, refined: Sequence[str]) -> tuple[str, ...]:
    """The symbols that trials must find."""
    names = list(refined)
    if slots_of(plan):
        for group in plan.equations.groups:
            names += [group.closes, *(name for side in group.sides for name in symbols(side))]
    elif reach is not None:
        names += [name for side in reach.group.sides for name in symbols(side)]
    return tuple(dict.fromkeys(names))


def _stages(
    plan: Plan, trials: Trials, reach: Reach | None, refined: Sequence[str]
) -> tuple[list[Slot], dict[tuple[str, str], Tried], int]:
    """The rows of the trials, stage after stage: limits, extremes, and the first row of those of the dead centres."""
    count = slots_of(plan)
    numbers = range(1, count + 1)
    names = [plan.text("limits.number", number=number) for number in numbers]
    sides = [(symbol, take) for symbol in refined for take in ("min", "max")]
    labels = [f"{symbol} {plan.text(f'extremes.{take}')}" for symbol, take in sides]
    closed = [(plan.text("dead.title"), TRIALS)] if reach is not None else []
    around = [(label, 3) for label in labels]
    first = trials.stage([*closed, *((name, PARTS - 1) for name in names), *around])
    around = [(label, 5) for label in labels]
    dead = first.pop(0) if closed else 0
    second = trials.stage([*((name, PARTS + 1) for name in names), *around]) if names or around else []
    tried = {
        side: Tried(*rows) for side, rows in zip(sides, zip(first[count:], second[count:], strict=True), strict=True)
    }
    if not count:
        return [], tried, dead
    third = trials.stage([(name, 3) for name in names])
    fourth = trials.stage([(name, 3) for name in names])
    rows = zip(first[:count], second[:count], third, fourth, strict=True)
    slots = [Slot(number, *starts) for number, starts in zip(numbers, rows, strict=True)]
    return slots, tried, dead
