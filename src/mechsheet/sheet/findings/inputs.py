"""Whether the yellow cells hold what a mechanism can have: no length is empty or below 0, no mode 0.5, no position 99.

One cell, `inputs`, is the number of the first input that cannot be, in the order in which they stand, and 0 where all can;
the words beside it name that input. While it is not 0 no row has a position: the constant that counts as zero is #N/A.
Speeds, masses and loads decide no position: where one of them cannot be, the words only say that something does not fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, CellRef, Node, RangeRef, Text
from livesheet.workbook import Area, Conditional
from mechsheet.sheet import styles
from mechsheet.sheet.findings.finding import Finding, Line, bad, good
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.inputs import further_inputs, inputs_of
from mechsheet.sheet.plan import SYMBOL, VALUE, Plan
from mechsheet.sheet.quoted import formula, joined

CHOICES = 29
"""So many LibreOffice's CHOOSE takes beside the number; Excel takes more."""


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
            on.text(self.key), first_wrong(plan), words(plan, on.value(self.key), others), itself=("words",),
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


def first_wrong(plan: Plan) -> Node:
    """The number of the first input that cannot be, 0 where all can: where the first 0 is in 111...10, a digit an input."""
    found = inputs_of(plan)
    each_can = (each.can_be(plan.at.bind(each.spot.cell, plan.main), plan) for each in found)
    digits = joined(*(_digit(can_be) for can_be in each_can), "0")
    return formula('MOD(FIND("0",digits),beyond)', digits=digits, beyond=len(found) + 1)


def _digit(holds: Node) -> Node:
    """1 where it holds, else 0; a product is a number as it is."""
    return holds if isinstance(holds, Binary) and holds.op == "*" else formula("holds*1", holds=holds)


def words(plan: Plan, wrong: Node, others: Node) -> Node:
    """What is said of the inputs: which one cannot be (`wrong` is the cell with its number), or something else."""
    before, after = plan.text("verdict.inputs.wrong", symbol="#").split("#")
    which = joined(before, _named(plan, wrong), after) if inputs_of(plan) else Text("")
    return formula("IF(wrong>0,which,others)", wrong=wrong, which=which, others=others)


def where_it_is(plan: Plan, position: Node, otherwise: Node) -> Node:
    """What is said where the position that is drawn is one, or that it is none."""
    return formula("IF(position,otherwise,nowhere)", position=position, otherwise=otherwise, nowhere=no_position(plan))


def _named(plan: Plan, wrong: Node) -> Node:
    """What the input of that number is called: the symbol beside it where the inputs stand one below another."""
    found = inputs_of(plan)
    first, last = found[0].row, found[-1].row
    if [each.row for each in found] == [*range(first, last + 1)] and found[-1].kind != "task":
        symbols = RangeRef(CellRef(first, SYMBOL, True, True), CellRef(last, SYMBOL, True, True))
        return formula("INDEX(symbols,wrong)", symbols=symbols, wrong=wrong)
    return _choice(wrong, [Text(each.name) for each in found])


def _choice(number: Node, texts: Sequence[Text]) -> Node:
    """The text of that number, from 1."""
    near = Call("CHOOSE", (number, *texts[:CHOICES]))
    if len(texts) <= CHOICES:
        return near
    far = _choice(al.sub(number, al.number(CHOICES)), texts[CHOICES:])
    return formula("IF(number>most,far,near)", number=number, most=CHOICES, far=far, near=near)


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
