"""Whether the yellow cells hold what a mechanism can have: no length is empty or below 0, no mode 0.5, no position 99.

Each has a cell of its own in its row, with its name where it cannot be (`marks_of`). One cell, `inputs`, says in which row,
counted from the first input's, the first name stands, and 0 where none does; the words beside it read that name. While it is
not 0 no row has a position: the constant that counts as zero is #N/A.
Speeds, masses and loads decide no position: where one of them cannot be, the words only say that something does not fit.
"""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef, Text
from livesheet.workbook import Area, Conditional
from mechsheet.sheet import styles
from mechsheet.sheet.findings.finding import Finding, Line, bad, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.inputs import further_inputs, inputs_of
from mechsheet.sheet.plan import VALUE, Plan
from mechsheet.sheet.quoted import formula, joined


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
        fine = formula("said=fine", said=said, fine=on.text("inputs.fine"))
        if isinstance(known, CellRef):
            fine = known
        return formula("IF(fine,title,said)", fine=fine, title=title, said=said)

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        return {self.key: Expected([0.0], told=False)}


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
        for each in [*inputs_of(plan), *further_inputs(plan)]
        if each.kind != "task"
    ]
    if nowhere is not None:
        rules.append(red(plan.blocks["position"].rows["position"], nowhere))
    return rules
