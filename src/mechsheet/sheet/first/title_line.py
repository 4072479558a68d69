"""The line under the title, which says all in one, and the marks beside what is red or amber."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef, Node, RangeRef, Text
from livesheet.workbook import Area, Conditional
from mechsheet.sheet import styles
from mechsheet.sheet.first import task
from mechsheet.sheet.first.other_sheets import FIRST_OF_ALL, are_there, missing_words
from mechsheet.sheet.first.verdict_lines import MARKS, VerdictLines
from mechsheet.sheet.grashof import (
    in_summary,
    why_nowhere,
)
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import LEGEND_ROW, MEANING, SYMBOL, VALUE, VERDICT_ROW, Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.start_table import assemblies_lost
from mechsheet.sheet.transmission import some_poor
from mechsheet.units import behind_number


def write_marks(block: VerdictLines) -> None:
    """Beside each line that is red or amber a mark; under the line under the title which the first of them is, and
    where: it may be far below."""
    writer, names = block.writer, list(block.rows.values())
    for key, levels in block.levels.items():
        mark: Node = Text("")
        for test, level in reversed(levels):
            mark = formula("IF(test,level,mark)", test=test, level=level, mark=mark)
        writer.formula(block.rows[key], MEANING + 1, formula('IFERROR(mark,"")', mark=mark), styles.MARK)
    column, symbols = (
        RangeRef(CellRef(names[0], col, True, True), CellRef(names[-1], col, True, True))
        for col in (MEANING + 1, SYMBOL)
    )
    missing = block.plan.text("legend.missing")
    said: Node = Text(missing)
    for sign in reversed(MARKS.values()):
        place = formula("MATCH(sign,column,0)", sign=sign, column=column)
        words = joined(f"{sign} ", formula("INDEX(symbols,place)", symbols=symbols, place=place), ": E",
                       formula("ROW(first)+place-1", first=column.start, place=place), f" · {missing}")  # fmt: skip
        said = formula("IFERROR(words,said)", words=words, said=said)
    writer.formula(LEGEND_ROW, MEANING, said, styles.LEGEND)
    area, cell = Area(LEGEND_ROW, MEANING, LEGEND_ROW, MEANING), CellRef(LEGEND_ROW, MEANING, True, True)
    writer.conditionals += [
        Conditional(area, formula("LEFT(cell,1)=mark", cell=cell, mark=mark), style) for style, mark in MARKS.items()
    ]


def write_title_line(block: VerdictLines) -> None:
    """All in one line: whether it closes, what it is, how well it transmits force; or what is wrong, and where."""
    plan = block.plan
    count, rows = block.value("rows_closed"), block.of_rows
    parts: list[Node | str] = [closes_in(plan, count, rows)]
    if plan.found.limits:
        parts.append(formula('IF(passes>0,"; "&dips,"")', passes=block.value("passes"), dips=block.words("passes")))
    for loop in plan.found.four_bars[:1]:
        complete = formula("count=rows", count=count, rows=rows)
        parts.append(in_summary(loop, plan, block.words(f"grashof_{loop.group}"), complete))
    if plan.found.transmission:
        parts.append(_worst_transmission(block))
    gap = block.words("largest_gap")
    good = joined(*parts)
    if plan.found.task is not None:
        good = task.with_task(good, block.value("task"), block.words("task"))
    lost: Node | None = None
    nowhere = why_nowhere(plan, MEANING)
    if plan.found.newton:
        nowhere = formula("IF(ends>0,ended,nowhere)", ends=assemblies_lost(plan), ended=block.text("line.ended"),
                          nowhere=nowhere)  # fmt: skip
        lost = block.words("same_assembly")
        good = formula("IF(lost=kept,good,lost)", lost=lost, kept=block.text("same_assembly.kept"), good=good)
    words = formula(
        "IF(fine,IF(count=0,nowhere,IF(gap=closed,good,gap)),inputs)",
        fine=block.found.fine.cell, count=count, nowhere=nowhere, gap=gap,
        closed=block.text("gap.closed"),
        good=good, inputs=block.words("inputs"),
    )  # fmt: skip
    missing = there(plan.places.missing).cell
    words = formula("IF(missing>0,left,words)", missing=missing, left=_without_sheets(block), words=words)
    block.writer.formula(VERDICT_ROW, SYMBOL, words, styles.LINE)
    area = Area(VERDICT_ROW, SYMBOL, VERDICT_ROW, MEANING)
    said = CellRef(VERDICT_ROW, SYMBOL, True, True)
    # rules read this sheet only: other programs refuse another's cells
    bad = formula("OR(n=0,said=inputs,said=gap)", said=said, gap=gap, n=count, inputs=block.words("inputs"))
    if plan.found.task is not None:
        bad = formula("OR(bad,wrong>0)", bad=bad, wrong=block.value("task"))
    if lost is not None:
        bad = formula("OR(bad,count=0,leapt>0)", bad=bad, count=count, leapt=block.value("same_assembly"))
    doubts = formula("OR(count<rows,missing>0)", count=count, rows=rows, missing=missing)
    if plan.found.limits:
        doubts = formula("OR(doubts,passes>0)", doubts=doubts, passes=block.value("passes"))
    if plan.found.transmission:
        doubts = formula("OR(doubts,poor)", doubts=doubts, poor=some_poor(plan.mechanism, _transmissions(block, VALUE)))
    if plan.found.task is not None:
        doubts = formula("OR(doubts,doubt)", doubts=doubts, doubt=task.doubtful(plan, block.words("task")))
    if plan.found.four_bars and plan.mechanism.bands is not None:
        doubts = formula("OR(doubts,ISNUMBER(FIND(reach,said)))", doubts=doubts, said=said,
                         reach=block.text("grashof.reach"))  # fmt: skip
    if lost is not None:
        doubts = formula("OR(doubts,lost=begun)", doubts=doubts, lost=lost, begun=block.text("same_assembly.begun"))
    block.writer.colour(area, bad, styles.BAD)
    block.writer.colour(area, doubts, styles.WARN)
    block.writer.colour(area, formula("count=rows", count=count, rows=rows), styles.GOOD)


def _transmissions(block: VerdictLines, col: int) -> RangeRef:
    """The cells of a column in the lines of all angles of transmission."""
    rows = [block.rows[f"transmission_{group.number}"] for group in block.plan.found.transmission]
    return RangeRef(CellRef(rows[0], col, True, True), CellRef(rows[-1], col, True, True))


def _worst_transmission(block: VerdictLines) -> Node:
    """The words of the group with the least angle of transmission; of several with its symbol."""
    keys = [f"transmission_{group.number}" for group in block.plan.found.transmission]
    what = f"; {block.text('line.transmission')} "
    if len(keys) == 1:
        return formula('IF(ISNUMBER(value),what&words,"")', value=block.value(keys[0]), what=what,
                       words=block.words(keys[0]))  # fmt: skip
    symbols, said = _transmissions(block, SYMBOL), _transmissions(block, MEANING)
    return formula(
        'IFERROR(what&INDEX(symbols,worst)&" "&INDEX(said,worst),"")', what=what, symbols=symbols, said=said,
        worst=there(block.found.worst_group).cell,
    )  # fmt: skip


def _without_sheets(block: VerdictLines) -> Node:
    """What can be said without a sheet that was deleted, and which that is."""
    plan = block.plan
    parts: list[Node | str] = [formula('IF(wrong>0,inputs,closes)', wrong=plan.places.inputs.cell,
                                       inputs=block.words("inputs"), closes=block.words("rows_closed")), "; "]  # fmt: skip
    if plan.found.transmission:
        angles, unit = _transmissions(block, VALUE), behind_number(plan.mechanism.angle_unit.text)
        least = formula(
            "ROUND(MIN(angles),digits)", angles=angles, digits=1 if plan.mechanism.angle_unit.in_degrees else 2
        )
        said = joined(f"{block.text('line.transmission')} ", least, f"{unit}; ")
        parts.append(formula('IF(COUNT(angles)>0,said,"")', angles=angles, said=said))
    left, missing = joined(*parts, missing_words(plan)), missing_words(plan)
    present = are_there(plan, FIRST_OF_ALL)
    return left if present is None else formula("IF(present,left,missing)", present=present, left=left, missing=missing)


def closes_in_some(plan: Plan, count: Node, rows: Node) -> Node:
    """In how many of how many positions, where these are not all."""
    return joined(
        plan.text("verdict.line.closes"), " ", count, " / ", rows, f" {plan.text('verdict.line.positions')}".rstrip()
    )


def closes_in(plan: Plan, count: Node, rows: Node) -> Node:
    """In how many of how many positions; of all what `closes_in_all` says, of the rows that there are."""
    text = plan.text
    some, end = joined(text("verdict.line.closes"), " ", count, " / ", rows), f" {text('verdict.line.positions')}"
    before, after = text("verdict.line.all", rows="#").split("#")
    everywhere = joined(before, rows)
    if plan.rows == 1:
        everywhere = formula("IF(rows=1,one,many)", rows=rows, one=closes_in_all(plan), many=joined(everywhere, after))
        after = ""
    if after != end:  # else it is said once
        everywhere, some, end = joined(everywhere, after), joined(some, end), ""
    return joined(
        formula("IF(count=rows,everywhere,some)", count=count, rows=rows, everywhere=everywhere, some=some), end
    )


def closes_in_all(plan: Plan) -> str:
    """What the line says first of a mechanism that closes in all positions, of so many rows as were built."""
    return plan.text("verdict.line.one") if plan.rows == 1 else plan.text("verdict.line.all", rows=plan.rows)
