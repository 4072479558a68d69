"""The type of a four-bar loop by its lengths, live: one formula and one threshold for every layout."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, Symbol, Text, symbols
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.geometry import length_in_cells
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.words.equations import link_words
from mechsheet.words.symbols import plain

SAME = 1e-9
"""Shortest + longest and the other two are equal (a change point) up to this part of the longest link of the loop: a
micrometre in a kilometre, and far more than sums of lengths that were computed are off by rounding."""


OPEN = 2 * (1 + SAME)
"""A loop cannot be closed where the excess is more than so many times its shortest link: then the longest is longer than all
others together."""


WORTH = 0.1
"""A first link that would have to be shorter than this part of what it is to turn fully is no advice."""


def excess_of(plan: Plan, shortest: Node, longest: Node, total: Node) -> Node:
    """Shortest + longest - the other two: below 0 some link turns fully (Grashof), 0 at a change point. #N/A where an
    input cannot be.
    """
    return formula(
        "IF(wrong>0,NA(),IF(ABS(2*(shortest+longest)-total)<=same*longest,0,2*(shortest+longest)-total))",
        wrong=plan.places.inputs.cell, shortest=shortest, longest=longest, total=total, same=SAME,
    )  # fmt: skip


def bound_of(sides: Sides, shortest: Node, excess: Node) -> Node:
    """What would mend it, in words: up to which length of its longest link a loop closes that cannot be closed, or of its
    first link this one turns fully, where no link does. Nothing where it would have to be next to nothing.
    """
    longest, total = Call("MAX", sides.all), Call("SUM", sides.all)
    closes = joined(sides.first("MAX", sides.names), AT_MOST, _at_most(al.sub(total, longest), sides.places))
    return formula(
        'IF(excess>open_from*shortest,closes,IF(AND(excess>0,turns>worth*first),said,""))', excess=excess,
        shortest=shortest, open_from=OPEN, closes=closes, turns=sides.turns, worth=WORTH, first=sides.lengths[1],
        said=joined(sides.names[1] + AT_MOST, _at_most(sides.turns, sides.places)),
    )  # fmt: skip


def turns_up_to(lengths: Sequence[Node]) -> Node:
    """The length up to which a loop's first link turns fully, as long as no other link turns: of ground, first link,
    coupler and last link; below 0 where there is none."""
    ground, _, coupler, last = lengths
    return formula("others-2*most", others=al.total([ground, coupler, last]), most=Call("MAX", (ground, coupler, last)))


AT_MOST = " ≤ "

BEGINS = "LEFT(said,LEN(begin))=begin"
"""Whether words begin so: what would mend it follows."""


def type_of(
    shortest: Node, excess: Node, which: Node, text: Callable[[str], str], bound: Node | None = None
) -> Node:  # fmt: skip
    """The type in words, by the excess as `excess_of` has it.

    which  what it is called where some link turns fully
    text   the words of `open`, `change`, `none`
    bound  what would mend it, as `bound_of` says: a cell, without a text where nothing is to be mended
    """
    words = formula(
        "IF(excess>open_from*shortest,opened,IF(excess=0,change,IF(excess>0,none,which)))",
        excess=excess, shortest=shortest, open_from=OPEN, which=which, opened=text("open"), change=text("change"),
        none=text("none"),
    )  # fmt: skip
    if bound is None:
        return words
    return joined(words, formula('IF(bound="","",enough&bound)', bound=bound, enough=text("enough")))


def _at_most(bound: Node, places: int) -> Node:
    """A bound as words say it: rounded to what is still allowed, but for what is rounding already."""
    return formula("ROUND(bound-half,digits)", bound=bound, half=0.499999 * 10.0**-places, digits=places)


@dataclass(frozen=True, slots=True)
class Sides:
    """Ground, first link, coupler and last link of a loop in cells.

    lengths  each;  all: the arguments of a function of all four, one range where they stand side by side
    names    what they are called: dimensions, or their pins;  places: decimals of a length
    turns    up to which length the first link turns fully (`turns_up_to`)
    shortest the length of the shortest;  which: its number, where a cell has it
    """

    lengths: Sequence[Node]
    all: tuple[Node, ...]
    names: Sequence[str]
    places: int
    turns: Node
    shortest: Node
    which: Node | None = None

    def first(self, function: Literal["MIN", "MAX"], words: Sequence[str]) -> Node:
        """The words of the first side that is as short, or as long, as any."""
        if len(self.all) == 1:
            place: Node = Call("MATCH", (Call(function, self.all), *self.all, Number(0.0)))
            if function == "MIN" and self.which is not None:
                place = self.which
            return Call("CHOOSE", (place, *map(Text, words)))
        found: Node = Text(words[-1])
        for index, said in reversed([*enumerate(words[:-1], 1)]):  # each is compared with those behind it
            side, *others = self.lengths[index - 1 :]
            other = others[0] if len(others) == 1 else Call(function, tuple(others))
            test = Binary("<=" if function == "MIN" else ">=", side, other)
            found = formula("IF(test,said,found)", test=test, said=said, found=found)
        return found


def names_of_sides(loop: FourBar, plan: Plan) -> list[str]:
    """What the lengths of a loop's sides are called: the dimension that a side is, else its two pins."""
    found = []
    for link, one, other in loop.sides(plan.mechanism.ground):
        match length_in_cells(link, one, other, plan.equations.poses):
            case Symbol(name) | Call("ABS", (Symbol(name),)):
                found.append(plain(name))
            case _:
                found.append(one + other)
    return found


def why_nowhere(plan: Plan, words: int) -> Node:
    """What the line under the title says where no position closes: of a four-bar its type, too.

    words  the column of the words of its type
    """
    nowhere = plan.text("verdict.line.nowhere")
    loop = next((loop for loop in plan.found.four_bars[:1] if is_all(loop, plan)), None)
    if loop is None:
        return Text(nowhere)
    return joined(f"{nowhere}; ", CellRef(plan.blocks["verdicts"].rows[f"grashof_{loop.group}"], words, True, True))


def named(loop: FourBar, plan: Plan) -> str:
    """The loop as its type is said of it; where the mechanism has other links, too, it is said of the loop alone."""
    return loop.name if is_all(loop, plan) else plan.text("verdict.grashof.alone", loop=loop.name)


def in_summary(loop: FourBar, plan: Plan, words: Node, complete: Node) -> Node:
    """Its type for the line under the title. Of a four-bar that does not close everywhere it says why; of links behind
    the loop it says nothing: then only where all is complete.
    """
    said = formula('"; "&words', words=words)
    return said if is_all(loop, plan) else formula('IF(complete,said,"")', complete=complete, said=said)


def is_all(loop: FourBar, plan: Plan) -> bool:
    """Whether the mechanism has no links but those of the loop."""
    return len(plan.mechanism.links) == len(loop.sides(plan.mechanism.ground))


def has_advice(loop: FourBar, plan: Plan) -> bool:
    """Whether another length of one side would mend the loop: the mechanism has no other links, and no dimension decides two
    of its sides, as that of both arms of a steering linkage."""
    if not is_all(loop, plan):
        return False
    return not any(one & other for one, other in itertools.combinations(_decided_by(loop, plan), 2))


def _decided_by(loop: FourBar, plan: Plan) -> list[set[str]]:
    """The dimensions that each side of a loop follows from."""
    formulas = {dim.symbol: dim.value for dim in plan.mechanism.dimensions if not isinstance(dim.value, float)}

    def behind(tree: Node) -> set[str]:
        read = set(symbols(tree))
        return read.union(*(behind(formulas[name]) for name in read if name in formulas))

    sides = loop.sides(plan.mechanism.ground)
    return [behind(length_in_cells(link, one, other, plan.equations.poses)) for link, one, other in sides]


def turning_types(loop: FourBar, plan: Plan, text: Callable[..., str]) -> list[str]:
    """What the loop is called when ground, first link, coupler or last link is the shortest, and some link turns fully.

    A link that is called rocker is named by its pins: "crank-rocker, rocker can turn fully" sounds like a contradiction.
    """

    def turning(side: int) -> str:
        link, *pins = loop.sides(plan.mechanism.ground)[side]
        word = link_words(link).of(plan.language)
        return text("one", link="".join(pins) if text("rocker") in word.split() else word)

    return [text("both"), turning(1), text("coupler"), turning(3)]
