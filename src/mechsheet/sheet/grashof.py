"""The type of a four-bar loop by its lengths, live: one formula and one threshold for every layout."""

from __future__ import annotations

from collections.abc import Callable

from livesheet.formula.nodes import Node
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.words.equations import link_words
from mechsheet.words.workbook import Language

SAME = 1e-9
"""Shortest + longest and the other two are equal (a change point) up to this part of the longest link of the loop: a
micrometre in a kilometre, and far more than sums of lengths that were computed are off by rounding."""


def excess_of(plan: Plan, shortest: Node, longest: Node, total: Node) -> Node:
    """Shortest + longest - the other two: below 0 some link turns fully (Grashof), 0 at a change point. #N/A where an
    input cannot be.
    """
    return formula(
        "IF(wrong>0,NA(),IF(ABS(2*(shortest+longest)-total)<=same*longest,0,2*(shortest+longest)-total))",
        wrong=plan.places.inputs.cell, shortest=shortest, longest=longest, total=total, same=SAME,
    )  # fmt: skip


def type_of(shortest: Node, excess: Node, which: Node, text: Callable[[str], str]) -> Node:
    """The type in words, by the excess as `excess_of` has it.

    which  what it is called where some link turns fully
    text   the words of `open`, `change`, `none`
    """
    return formula(
        "IF(excess>open_from*shortest,open,IF(excess=0,change,IF(excess>0,none,which)))",
        excess=excess, shortest=shortest, open_from=2 * (1 + SAME), which=which, open=text("open"),
        change=text("change"), none=text("none"),
    )  # fmt: skip


def named(loop: FourBar, plan: Plan) -> str:
    """The loop as its type is said of it; where the mechanism has other links, too, it is said of the loop alone."""
    return loop.name if _is_all(loop, plan) else plan.text("verdict.grashof.alone", loop=loop.name)


def in_summary(loop: FourBar, plan: Plan, words: Node, complete: Node) -> Node:
    """Its type for the line under the title. Of a four-bar that does not close everywhere it says why; of links behind
    the loop it says nothing: then only where all is complete.
    """
    said = formula('"; "&words', words=words)
    return said if _is_all(loop, plan) else formula('IF(complete,said,"")', complete=complete, said=said)


def _is_all(loop: FourBar, plan: Plan) -> bool:
    return len(plan.mechanism.links) == len(loop.sides(plan.mechanism.ground))


def turning_types(loop: FourBar, language: Language, text: Callable[..., str]) -> dict[str, str]:
    """What the loop is called when ground, first link, coupler or last link is the shortest, and some link turns fully."""

    def one(link: str) -> str:
        return text("one", link=link)

    return {
        "both": text("both"),
        "crank": one(link_words(loop.first).of(language)),
        "rockers": text("coupler"),
        "follower": one(link_words(loop.last).of(language)),
    }
