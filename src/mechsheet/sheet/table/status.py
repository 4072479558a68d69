"""What column C says of a row: "ok", or which group is open, or which one closes but leaves its links free to turn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.numeric import value
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.words.equations import body_words

NEAR = 0.2
"""Pins that come nearer than this part of the size, or lines whose directions' sine does, may coincide: it is asked for."""


def status(plan: Plan) -> Node:
    """ "ok", or the first group that cannot be joined, or is undetermined."""
    tests, reasons = _all_tests(plan), plan.places.reasons
    if not tests:
        return formula(
            "IF(wrong=0,ok,inputs)",
            wrong=plan.places.inputs.cell,
            ok=plan.text("status.ok"),
            inputs=plan.text("status.inputs"),
        )
    if reasons is None:
        return formula("IF(closes,ok,reason)", closes=tests[0], ok=plan.text("status.ok"), reason=status_words(plan)[0])
    return formula("INDEX(reasons,first_open)", reasons=reasons, first_open=first_open(tests))


def words_looked_up(plan: Plan) -> list[str]:
    """The words that it looks up in cells, that of a row that closes last; none where the formula says them itself."""
    tests = len(_all_tests(plan))
    if not tests or (tests == 1 and not plan.newton):  # whose words are long
        return []
    return [*status_words(plan), plan.text("status.ok")]


def while_inputs_can_be(plan: Plan, value: Node) -> Node:
    """A value that asks nothing of the inputs by itself; #N/A where one of them cannot be."""
    return formula("IF(wrong>0,NA(),value)", wrong=plan.places.inputs.cell, value=value)


def first_open(closing: Sequence[Node]) -> Node:
    """The number of the first group that is open, from 1; one more than there are where all close.

    1 + c1 (1 + c2 (1 + ...)), each c TRUE or FALSE.
    """
    count: Node = al.ONE
    for closes in reversed(closing):
        count = formula("1+closes*count", closes=closes, count=count)
    return count


def links_of(plan: Plan, group: Group) -> str:
    """The links of a group in words."""
    return ", ".join(body_words(plan.mechanism, name).of(plan.language) for name in group.links)


def status_words(plan: Plan) -> list[str]:
    """What the table says where a test fails, in order of solution: of one group first that it is undetermined."""
    found = []
    for group in plan.equations.groups:
        links = links_of(plan, group)
        if undetermined(plan, group) is not None:
            found.append(plan.text("status.undetermined", links=links))
        found.append(plan.text(group.status, links=links))
    return found


def _all_tests(plan: Plan) -> list[Node]:
    return [test for group in plan.equations.groups for test in _tests(plan, group)]


def _tests(plan: Plan, group: Group) -> list[Node]:
    """What holds where a group closes: where it can close and leave its links free, that it does not; then, that it does."""
    free = undetermined(plan, group)
    closes = formula("ISNUMBER(value)", value=Symbol(group.closes))
    # after a group that is open nothing is known of it
    return [closes] if free is None else [formula("IFERROR(NOT(free),TRUE)", free=free), closes]


def undetermined(plan: Plan, group: Group) -> Node | None:
    """TRUE where the group's links can be joined and still move; None where, as described, they are never near to that.

    Two links of different lengths never lie on each other: where their outer pins coincide they do not meet.
    """
    if group.degenerate is None or group.only_undetermined:
        return None
    return group.degenerate if _alike(plan, group) and _comes_near(plan, group) else None


def _alike(plan: Plan, group: Group) -> bool:
    """Whether the lengths let links lie on each other: both arms are equal, or one is nothing. Lines may always."""
    if not group.sides:
        return True
    with np.errstate(all="ignore"):
        first, second = (float(np.ravel(value(side, plan.nominal))[0]) for side in group.sides[:2])
    least = float(np.ravel(plan.nominal[plan.equations.tolerance])[0])
    if len(group.sides) == 3:
        return abs(first - second) <= least or min(first, second) < least
    return abs(second) < least  # a slot that misses both pins by nothing


def _comes_near(plan: Plan, group: Group) -> bool:
    """Whether pins come near to each other in some row, or lines to being parallel."""
    closes = plan.equations.equations.of(group.closes)
    near = NEAR * (1.0 if closes.unit.kind == "number" else plan.size)
    with np.errstate(all="ignore"):
        margins = [np.ravel(value(each.margin, plan.nominal)) for each in closes.exists if not each.reach]
    return any(float(np.min(margin[np.isfinite(margin)], initial=np.inf)) < near for margin in margins)
