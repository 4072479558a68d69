"""The rules of a search, row by row: what a row knows follows from the row above, where it probes from what it knows.

Each rule is said once, as trees over the names of a row's columns: `search_table` prints them into cells, studies evaluate
them over arrays of designs. `x_above` is what the row above has of x.

An extreme: a bracket left < middle < right whose middle has the best value. The probe is at the vertex of the parabola
through the three, as long as steps become shorter, else part of the way to the farther end (Brent, Algorithms for
Minimization without Derivatives, 1973, chapter 5). The better of probe and middle is the next row's middle, the other one
closes the bracket.

A limit: between a newest and another place the margin changes its sign. The probe is where the inverse parabola through
these and the place before them crosses 0, where that is safe, else in the middle (Chandrupatla, A new hybrid quadratic and
bisection algorithm for finding the zero of a nonlinear function without using derivatives, 1997).
"""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula.nodes import Node
from mechsheet.sheet.quoted import formula

PROBES = 5
"""Probes of an extreme: of 2,800 in templates and random mechanisms one in a hundred is off by more than 3e-7 of its range
after five, by more than 9e-7 after four."""

LIMIT_PROBES = 7
"""Probes of a limit: of 212 random ones the median is off by 5e-11 of a row after three; those of a triangle that is thin on
both sides of the limit need more."""

LEAST_STEP = 0.02
"""No probe is nearer to a place of the bracket than this part of it, or a bracket with a far end would not close."""

ASIDE = 0.25
"""Where there is no parabola, at the motion's first or last row, the probe is so far on the way to the farther end."""

SHORTER, GOLDEN = 0.7, 0.38
"""A step that is longer than this part of the one before shows that the parabola does not fit; the probe is then so far on
the way to the farther end. Beside limits (220 four-bars) the worst extreme is off by 3e-5 of its range, by 2e-3 without."""


def _trees(texts: Mapping[str, str], **parts: Node) -> dict[str, Node]:
    return {name: formula(text, **parts) for name, text in texts.items()}


BRACKET = ("left", "f_left", "middle", "f_middle", "right", "f_right")
"""What a row of an extreme knows; `sense` is 1 where the smallest value is sought, -1 where the largest."""

NARROWED = _trees(
    {
        "left": "IF((probe<middle)=better,left,IF(better,middle,probe))",
        "f_left": "IF((probe<middle)=better,f_left,IF(better,f_middle,value))",
        "middle": "IF(better,probe,middle)",
        "f_middle": "IF(better,value,f_middle)",
        "right": "IF((probe>middle)=better,right,IF(better,middle,probe))",
        "f_right": "IF((probe>middle)=better,f_right,IF(better,f_middle,value))",
    },
    better=formula("sense*(value-f_middle)<0"),
)
"""What the next row knows, over what this one does and the `value` that its `probe` has found."""

_FARTHER = formula("IF(left+right>2*middle,right-middle,left-middle)")

VERTEX = formula(
    "IFERROR(middle-((middle-left)^2*(f_middle-f_right)-(middle-right)^2*(f_middle-f_left))"
    "/(2*((middle-left)*(f_middle-f_right)-(middle-right)*(f_middle-f_left))),middle+aside*farther)",
    aside=ASIDE, farther=_FARTHER,
)  # fmt: skip

_WITHIN = (
    "MAX(left+part*(right-left),MIN(right-part*(right-left),"
    "IF(ABS(vertex-middle)<part*(right-left),middle+part*(right-left)*SIGN(farther),step)))"
)

FIRST_PROBE, PROBE = (
    formula(_WITHIN, part=LEAST_STEP, farther=_FARTHER, step=step)
    for step in (
        formula("vertex"),
        formula("IF(ABS(vertex-middle)>shorter*ABS(probe_above-middle_above),middle+golden*farther,vertex)",
                shorter=SHORTER, golden=GOLDEN, farther=_FARTHER),
    )
)  # fmt: skip

ROOTED = formula("IF(side=0,place,side*SQRT(ABS(place-limit)))")
"""The number by which a place is found. Beside a limit a quantity y goes to its value there as a root does, y0 + b w + c w^2
with w^2 = |place - limit|: so places there are counted by w, which grows with them (`side` is 1 after a limit, -1 before
one); elsewhere (0) they are counted by themselves."""

PLACE = formula("IF(side=0,probe,limit+side*probe^2)")
"""The other way round."""

CROSSING = ("newest", "f_newest", "other", "f_other", "oldest", "f_oldest")
"""What a row of a limit knows: two places between which the margin's sign changes, and the one before them."""

CROSSED = _trees(
    {
        "newest": "place",
        "f_newest": "value",
        "other": "IF(same,other,newest)",
        "f_other": "IF(same,f_other,f_newest)",
        "oldest": "IF(same,newest,other)",
        "f_oldest": "IF(same,f_newest,f_other)",
    },
    same=formula("(value<0)=(f_newest<0)"),
)

SHARE = formula(
    "IFERROR(IF(AND(phi^2<xi,(1-phi)^2<1-xi),inverse,0.5),0.5)",
    xi=formula("(newest-other)/(oldest-other)"), phi=formula("(f_newest-f_other)/(f_oldest-f_other)"),
    inverse=formula(
        "f_newest/(f_other-f_newest)*f_oldest/(f_other-f_oldest)"
        "+(oldest-newest)/(other-newest)*f_newest/(f_oldest-f_newest)*f_other/(f_oldest-f_other)"
    ),
)  # fmt: skip
"""On which part of the way from the newest place to the other one the probe is."""

CHORD = formula("f_newest/(f_newest-f_other)")
"""The same on the straight line through the two: of the first row, and where the last one says that the limit is."""
