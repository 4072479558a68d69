"""Whether the yellow cells hold what a mechanism can have: no length is empty or below 0, no mode 0.5, no position 99.

Each has a cell of its own in its row, with its name where it cannot be (`marks_of`). One cell, `inputs`, says in which row,
counted from the first input's, the first name stands, and 0 where none does; the words beside it read that name. While it is
not 0 no row has a position: the constant that counts as zero is #N/A.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, CellRef, Node, RangeRef, Symbol, Text
from livesheet.workbook import Area, Conditional
from mechsheet.kinematics.inputs import Asked, asked_of
from mechsheet.model import Dimension
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.as_typed import in_degrees, reads_degrees
from mechsheet.sheet.findings.finding import Finding, Line, bad, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.plan import VALUE, Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.words.symbols import plain

Kind = Literal["number", "length", "step", "mode", "choice", "task"]

CAN_BE: dict[Kind, str] = {
    "number": "ISNUMBER(cell)",
    "length": "(N(cell)>0)",
    "step": "(N(cell)<>0)",
    "mode": "(ABS(N(cell))=1)",
    "task": "(cell=0)",
    "choice": "((ABS(2*N(cell)-most-1)<most)*(MOD(N(cell),1)=0))",
}
"""What holds of a cell of each kind; an empty cell counts as 0 for N, and so does a text."""


class Inputs(Finding):
    """Which yellow cell holds what cannot be; it is red, and so is the line."""

    key, by_rows = "inputs", True

    def line(self, on: Reading) -> Line:
        plan, said = on.plan, on.words(self.key)
        position, known = on.inputs_fit()
        fine = on.text("inputs.fine")
        fits: Node = Text(fine)
        if known is not None:
            fits = formula("IF(known,fine,misfit)", known=known, fine=fine, misfit=on.text("inputs.misfit"))
        nowhere = formula("said=words", said=said, words=no_position(plan)) if plan.places.position else None
        others = on.while_there("extremes", where_it_is(plan, position, fits))
        return Line(
            on.text(self.key), first_wrong(plan, on.marks), words(plan, on.value(self.key), on.marks, others),
            itself=("words",),
            levels=(bad("said<>fine", said=said, fine=fine), good("said=fine", said=said, fine=fine)),
            rules=red_where_wrong(plan, nowhere),
        )  # fmt: skip

    def left(self, on: Reading) -> Node | str:
        return formula('IF(wrong>0,words&"; ","")', wrong=on.value(self.key), words=on.words(self.key))

    def overrules(self, on: Reading, title: Node) -> Node:
        said, (_, known) = on.words(self.key), on.inputs_fit()
        fine = known or formula("said=fine", said=said, fine=on.text("inputs.fine"))
        return formula("IF(fine,title,said)", fine=fine, title=title, said=said)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        return {self.key: Expected([0.0], told=False)}


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
    law = plan.mechanism.driver.law
    of_law = (law.start, law.stop, law.duration) if law else ()
    found = []
    of_cam: dict[str, list[Asked]] = {}
    for each in asked_of(plan.mechanism):
        of_cam.setdefault(each.symbol, []).append(each)
    for dim in plan.mechanism.dimensions:
        of_ties = dim.path[:1] in (("joints",), ("drivers",), ("cam",)) or dim.path[1:2] == ("segments",)
        if isinstance(dim.value, float) and (not dim.path or of_ties or dim.symbol in of_law):
            found.append(_of_dimension(plan, dim, of_cam.get(dim.symbol, [])))
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


def _of_dimension(plan: Plan, dim: Dimension, asked: Sequence[Asked]) -> Input:
    """A dimension as an input; `asked`: what a cam asks of it."""
    kind: Kind = "length" if dim.symbol in plan.equations.positive else "number"
    of_cam = dim.path[:1] == ("cam",)  # a roller of 0 is a knife edge
    if dim.path[-1:] in (("ratio",), ("radius",)) and not of_cam:
        kind = "step"  # not 0
    above = Binary(">", Symbol(dim.symbol), al.ZERO)  # which is what a length is
    if any(each.holds == above for each in asked):
        kind = "length"
    spot = plan.at.spots[dim.symbol]
    rest = tuple({each.holds: each for each in asked if each.holds != above}.values())
    return Input(spot, plain(dim.symbol), kind, spot.row, asked=rest)


def first_wrong(plan: Plan, marks: int) -> Node:
    """In which row, counted from the first input's, the first stands that cannot be, 0 where all can; `marks`: the column
    that says so."""
    if not inputs_of(plan):
        return al.ZERO
    # as the first number of a column is found (`over_rows.ENDS`): so every program does it
    return formula('IFERROR(SUMPRODUCT(MATCH(TRUE,marks<>"",0)),0)', marks=_beside_inputs(plan, marks))


def marks_of(plan: Plan) -> dict[int, Node]:
    """By row of an input a formula with its name where it cannot be: also where its cell holds an error."""
    return {
        each.row: formula('IFERROR(IF(can_be,"",name),name)', name=each.name,
                          can_be=each.can_be(plan.at.bind(each.spot.cell, plan.main), plan))
        for each in inputs_of(plan)
    }  # fmt: skip


def _beside_inputs(plan: Plan, col: int) -> RangeRef:
    """The cells of a column from the first input's row to the last one's."""
    rows = [each.row for each in inputs_of(plan)]
    return RangeRef(CellRef(min(rows), col, True, True), CellRef(max(rows), col, True, True))


def words(plan: Plan, wrong: Node, marks: int, others: Node) -> Node:
    """What is said of the inputs: which one cannot be (`wrong` is the cell with its number), or something else."""
    before, after = plan.text("verdict.inputs.wrong", symbol="#").split("#")
    which: Node = Text("")
    if inputs_of(plan):
        name = formula("INDEX(marks,wrong)", marks=_beside_inputs(plan, marks), wrong=wrong)
        which = joined(before, name, after)
    return formula("IF(wrong>0,which,others)", wrong=wrong, which=which, others=others)


def where_it_is(plan: Plan, position: Node, otherwise: Node) -> Node:
    """What is said where the position that is drawn is one, or that it is none."""
    return formula("IF(position,otherwise,nowhere)", position=position, otherwise=otherwise, nowhere=no_position(plan))


def no_position(plan: Plan) -> str:
    """What is said where there is no such position."""
    return plan.text("verdict.inputs.wrong", symbol=plan.text("name.position"))


def red_where_wrong(plan: Plan, nowhere: Node | None) -> list[Conditional]:
    """The yellow cells that cannot be are red. `nowhere`: whether the position is none, asked of this sheet's cells."""

    def red(row: int, wrong: Node) -> Conditional:
        return Conditional(Area(row, VALUE, row, VALUE), wrong, styles.BAD)

    rules = [
        red(
            each.row, formula("NOT(can_be)", can_be=each.can_be(CellRef(each.row, VALUE, True, True), plan, first=True))
        )
        for each in inputs_of(plan)
        if each.kind != "task"
    ]
    if nowhere is not None:
        rules.append(red(plan.blocks["position"].rows["position"], nowhere))
    return rules
