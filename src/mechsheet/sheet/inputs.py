"""The yellow cells: which there are, in the order in which they stand, and what each may hold.

Positions depend on those of `inputs_of`: where one of them cannot be, there are none. Speeds, masses and loads, those of
`further_inputs`, decide rates and forces alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from livesheet.formula.nodes import Binary, Call, CellRef, Node, RangeRef, Symbol
from mechsheet.kinematics.inputs import Asked, asked_of
from mechsheet.model import Dimension
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.as_typed import in_degrees, reads_degrees
from mechsheet.sheet.plan import VALUE, Plan
from mechsheet.sheet.quoted import formula
from mechsheet.words.symbols import plain

Kind = Literal["number", "length", "step", "mode", "choice", "task", "weight"]

CAN_BE: dict[Kind, str] = {
    "number": "ISNUMBER(cell)",
    "length": "(N(cell)>0)",
    "step": "(N(cell)<>0)",
    "mode": "(ABS(N(cell))=1)",
    "task": "(cell=0)",
    "weight": "ISNUMBER(cell)*(N(cell)>=0)",
    "choice": "((ABS(2*N(cell)-most-1)<most)*(MOD(N(cell),1)=0))",
}
"""What holds of a cell of each kind; an empty cell counts as 0 for N, and so does a text."""


@dataclass(frozen=True, slots=True)
class Input:
    """A yellow cell, or one that says whether a task has a solution: what people call it, its row on the first sheet.

    most   choices are 1 to that
    asked  what must hold besides, where it follows from numbers
    """

    spot: Spot
    name: str
    kind: Kind
    row: int
    most: int = 1
    asked: tuple[Asked, ...] = ()

    def can_be(self, cell: Node, plan: Plan, first: bool = False) -> Node:
        """Whether its cell, read on the first sheet, holds what it can; `first`: or another one's is told in its place."""
        can_be = formula(CAN_BE[self.kind], cell=cell, **({"most": self.most} if self.kind == "choice" else {}))
        for each in self.asked:
            holds = _bound(plan, each.holds)
            if first and each.earlier is not None:
                holds = formula("OR(earlier,holds)", earlier=_bound(plan, each.earlier), holds=holds)
            cells = tuple(plan.at.bind(plan.at.spots[symbol].cell, plan.main) for symbol in each.reads)
            # an error is another cell's fault, unless all are numbers from which it follows
            other = formula("counted<all", counted=Call("COUNT", cells), all=len(cells)) if cells else formula("TRUE")
            can_be = formula("can_be*IFERROR(holds,other)", can_be=can_be, holds=holds, other=other)
        return can_be


def _bound(plan: Plan, test: Binary) -> Node:
    """A comparison over the cells of the first sheet; angles in the degrees that people type."""
    bound = plan.at.bind(test, plan.main)
    if isinstance(bound, Binary) and reads_degrees(bound.left):
        return Binary(bound.op, in_degrees(bound.left), in_degrees(bound.right))
    return bound


def inputs_of(plan: Plan) -> list[Input]:
    """Dimensions, gears, start and step (of a motion law start, stop and duration), modes, in the order in which they stand,
    and whether the task of a synthesis has a solution: what positions depend on.

    The driver's listed values are not among them.
    """
    found = []
    asked = _asked_by_symbol(plan)
    for dim in plan.mechanism.dimensions:
        if isinstance(dim.value, float) and decides_positions(plan, dim):
            found.append(_of_dimension(plan, dim, asked.get(dim.symbol, [])))
    driver = plan.mechanism.driver
    start, step = plan.places.start, plan.places.step
    if start is not None and isinstance(driver.start, float):
        found.append(Input(start, plan.text("name.start"), "number", start.row))
    if step is not None and isinstance(driver.step, float):
        found.append(Input(step, plan.text("name.step"), "step", step.row))
    for group in plan.equations.groups:
        if group.mode and group.follows is None:
            kind: Kind = "mode" if group.system is None else "choice"
            spot = plan.at.spots[group.mode]
            found.append(Input(spot, plain(group.mode), kind, spot.row, len(group.assemblies)))
    if plan.places.unsolved is not None:
        title, row = plan.at.titles["synthesis"], plan.blocks["dimensions"].row
        found.append(Input(plan.places.unsolved, title, "task", row))
    return found


def decides_positions(plan: Plan, dim: Dimension) -> bool:
    """Whether positions depend on what is typed into the cell of a dimension; not those of a task, which has a cell."""
    law = plan.mechanism.driver.law
    of_law = law is not None and dim.symbol in (law.start, law.stop, law.duration)
    of_ties = dim.path[:1] in (("joints",), ("drivers",), ("cam",)) or dim.path[1:2] == ("segments",)
    return not dim.path or of_ties or of_law


def further_inputs(plan: Plan) -> list[Input]:
    """What is typed for rates and forces alone: speeds, masses, loads, the fluctuation of a flywheel."""
    asked = _asked_by_symbol(plan)
    found = []
    for dim in plan.mechanism.dimensions:
        told = decides_positions(plan, dim) or dim.path[:1] == ("synthesis",) or dim.symbol not in plan.at.spots
        if isinstance(dim.value, float) and not told:
            known = asked.get(dim.symbol, [])
            kind: Kind = ("weight" if known[0].zero else "length") if known else "number"
            spot = plan.at.spots[dim.symbol]
            found.append(Input(spot, plain(dim.symbol), kind, spot.row))
    return found


def rest_fits(plan: Plan, title: str) -> list[Node]:
    """What must hold beside `inputs_of`, as the sheet called `title` asks it: all that follows from the yellow cells is a
    number, and what is typed for rates and forces can be.
    """
    of_task = {
        dim.symbol for dim in plan.mechanism.dimensions if dim.path[:1] == ("synthesis",)
    }  # its cell says of these
    derived = plan.blocks["derived"].rows if "derived" in plan.blocks else {}
    tests: list[Node] = []
    if rows := [row for symbol, row in derived.items() if symbol not in of_task]:
        tests.append(formula("ISNUMBER(total)", total=Call("SUM", _areas(plan, title, rows))))
    further = further_inputs(plan)
    if further:
        counted = Call("COUNT", _areas(plan, title, [each.row for each in further]))
        tests.append(formula("counted=all", counted=counted, all=len(further)))
    for kind, test in (("weight", "least>=0"), ("length", "least>0")):
        cells = tuple(plan.at.bind(each.spot.cell, title) for each in further if each.kind == kind)
        tests += [formula(test, least=Call("MIN", cells))] if cells else []
    return tests


def _areas(plan: Plan, title: str, rows: Sequence[int]) -> tuple[RangeRef, ...]:
    """The values of the first sheet in such rows, as the sheet called `title` reads them: what stands together as one."""
    sheet, runs = None if title == plan.main else plan.main, list[tuple[int, int]]()
    for row in sorted(rows):
        if runs and runs[-1][1] == row - 1:
            runs[-1] = (runs[-1][0], row)
        else:
            runs.append((row, row))
    return tuple(RangeRef(*(CellRef(row, VALUE, True, True, sheet) for row in (first, last))) for first, last in runs)


def _asked_by_symbol(plan: Plan) -> dict[str, list[Asked]]:
    found: dict[str, list[Asked]] = {}
    for each in asked_of(plan.mechanism):
        found.setdefault(each.symbol, []).append(each)
    return found


def _of_dimension(plan: Plan, dim: Dimension, asked: Sequence[Asked]) -> Input:
    """A dimension as an input; `asked`: what is asked of it beside its kind."""
    kind: Kind = "length" if dim.symbol in plan.equations.positive else "number"
    plain_kinds: dict[Node, Kind] = {Call("ABS", (Symbol(dim.symbol),)): "step", Symbol(dim.symbol): "length"}
    for each in asked:
        if not each.zero:
            kind = plain_kinds.get(each.margin, kind)
    spot = plan.at.spots[dim.symbol]
    rest = tuple({each.holds: each for each in asked if each.zero or each.margin not in plain_kinds}.values())
    return Input(spot, plain(dim.symbol), kind, spot.row, asked=rest)
