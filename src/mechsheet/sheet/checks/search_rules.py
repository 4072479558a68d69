"""The rules of a search: where it begins, row by row where it probes, and what is said of what it has found.

Each rule is said once, as trees over names: the sheet of extremes prints them into cells, studies evaluate them over arrays
of designs. Rows of the table count from 1, and places between them; of rows the first and the last stretch's are `first` and
`last`, and the stretch goes from `low` to `high`. Of a row of a search `x_above` is what the row above has of x.

An extreme: a bracket left < middle < right whose middle has the best value. The probe is at the vertex of the parabola
through the three, as long as steps become shorter, else part of the way to the farther end (Brent, Algorithms for
Minimization without Derivatives, 1973, chapter 5). The better of probe and middle is the next row's middle, the other one
closes the bracket.

A limit: between a newest and another place the margin changes its sign. The probe is where the inverse parabola through
these and the place before them crosses 0, where that is safe, else in the middle (Chandrupatla, A new hybrid quadratic and
bisection algorithm for finding the zero of a nonlinear function without using derivatives, 1997).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from livesheet.formula.nodes import Call, Node, Symbol, with_symbols
from mechsheet.sheet.quoted import formula

STRETCHES = 3
"""Stretches that are looked at; of more there are no extremes."""

LEAST_INNER = 7
"""Rows, at least, where an extreme is also looked for between those that are no neighbours of the best."""

NEAR_END = 0.15
"""So far inside [rows] a vertex counts as outside: a search from the row at the end would find little more than it has."""

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

INWARDS = 1e-9
"""How far inside the limit its value is given, in parts of a row: there the mechanism still closes."""

DOUBTED = 1e-4
"""By so much of what the last step would change it is given further inside."""

SETTLED_LIMIT = 1e-5
"""What the best probe lacks to the limit, in parts of the margin in the row beside it; more, and it is said to be
known to a step."""

SETTLED = 1e-4
"""The last probe may be worse than the best, or better than all others, by this part of the range; more, and the value is
said to be about right."""

SURE, ABOUT, BEYOND, ROWS = 1, 2, 3, 4
"""What is said of an extreme: that it is right, about right, that it may be elsewhere, beyond what is given, or that it is
of rows only."""

NEARER = 0.5
"""An angle of transmission that is less than this part of the rows' least one between them makes such a spike: velocities
and forces go with one over its sine, so they are twice as large there."""


def _trees(texts: Mapping[str, str], **parts: Node) -> dict[str, Node]:
    return {name: formula(text, **parts) for name, text in texts.items()}


# --- extremes: where a search begins --------------------------------------------------------------------------------------

WRAPS = formula("IFERROR(IF(AND(whole>0,first=1,last=rows,meet),whole,0),0)")
"""1, 2 where the ends of the rows are neighbours for a quantity (one row twice, or not): as the rows cover whole turns; 0
where a row is missing, or the quantity does not `meet` itself again (`over_rows.ends_meet`)."""

ROW_AT = formula("IF(wraps>0,1+MOD(place-1,turned),place)", turned=formula("IF(wraps=1,rows-1,rows)"))
"""The place in the table: places go on beyond its ends where these are neighbours."""

INNER = formula(
    "AND(sense*(of_end*end+of_third*third-of_next*next)<=0,sense*(other-next)<0)",
    of_end=3 - 2 * NEAR_END, of_third=1 - 2 * NEAR_END, of_next=4 - 4 * NEAR_END,
)  # fmt: skip
"""Whether a search does not begin from the row at the end of the motion that is the best one, but from the best `other` row
that is no neighbour of it: the parabola through the three rows there has its vertex outside or nearly (`end`, `next` and
`third` are values at 0, 1 and 2), and the other row is better than the next. The row at the end has a probe of its own."""

START = formula(
    "IF(wraps>0,here,IF(AND(low<first,sense*(at_low-value)<0),IF(sense*(at_high-at_low)<0,high,low),"
    "IF(AND(high>last,sense*(at_high-value)<0),high,here)))"
)
"""The place from which a search begins: the row `here`, with its value, or a limit where the stretch begins or ends."""

LOWER = formula("IF(wraps>0,start-1,MAX(low,ROUNDUP(start,0)-1))")
UPPER = formula("IF(wraps>0,start+1,MIN(high,ROUNDDOWN(start,0)+1))")
"""The places beside it: rows, or where the stretch begins or ends."""

ROOTED = formula("IF(side=0,place,side*SQRT(ABS(place-limit)))")
"""The number by which a place is found. Beside a limit a quantity y goes to its value there as a root does, y0 + b w + c w^2
with w^2 = |place - limit|: so places there are counted by w, which grows with them (`side` is 1 after a limit, -1 before
one); elsewhere (0) they are counted by themselves."""

PLACE = formula("IF(side=0,probe,limit+side*probe^2)")
"""The other way round."""

BEGUN = _trees(
    {
        "near": "MAX(first,MIN(last,ROUND(start,0)))",
        "side": "IF(wraps>0,0,IF(AND(lower=low,low<first),1,IF(AND(upper=high,high>last),-1,0)))",
        "limit": "IF(side<0,high,low)",
        "f_left": "IF(AND(wraps=0,lower=low),at_low,of_lower)",
        "f_middle": "IF(start=here,value,IF(start=low,at_low,at_high))",
        "f_right": "IF(AND(wraps=0,upper=high),at_high,of_upper)",
    }
) | {
    name: with_symbols(ROOTED, {"place": Symbol(place)})
    for name, place in (("left", "lower"), ("middle", "start"), ("right", "upper"))
}
"""What the first row of a search knows; `of_lower`, `of_upper`: what the rows beside have. Angles are taken near a row."""

# --- extremes: corners ----------------------------------------------------------------------------------------------------
# Where pieces of a motion meet a quantity may be extreme without turning back there, and a segment may be narrower than a
# row: so these places, and those where its law is fastest, are asked beforehand, and a search may begin from the best.

CORNER_PLACE = formula(
    "IF(whole>0,place,MEDIAN(1,place,rows))", place=formula("1+MOD((angle-start)*SIGN(step),turn)/ABS(step)")
)
"""The place of a corner, at an angle of the driver that goes from `start` by `step`: of rows that do not cover the turn the
nearest that they have."""

SAME_CORNER = 1e-9
"""A corner and a row whose values differ by no more than this part of the range are one place."""

BESIDE_HERE = tuple(
    formula(f"1+MOD(here{sign}1-1,IF(wraps>0,turned,2*rows))", turned=formula("IF(wraps=1,rows-1,rows)"))
    for sign in "-+"
)
"""The rows beside the one from which a search would begin, `earlier` and `later`; beyond the table where there is none."""

OFFER = formula("1.5*own-(before+after)/4")
"""What a row promises: its value and a quarter of the second difference."""

CORNERED = formula(
    "IFERROR(AND(sense*(at_corner-of_rows)<-least,IFERROR(OR(ABS(corner-here)<1,sense*(at_corner-promise)<=0),TRUE)),FALSE)",
    least=formula("same*ABS(of_rows-other)", same=SAME_CORNER),
    promise=with_symbols(OFFER, {"own": Symbol("value"), "before": Symbol("earlier"), "after": Symbol("later")}),
)
"""Whether the best corner is better than the best row, and beside it, or better than what that row promises beside it
(`OFFER`): if not, the search begins at the row, and the corner stands beside what it finds."""

OF_ROWS_AND_CORNERS = formula("IFERROR(IF(sense*(at_corner-of_rows)<0,at_corner,of_rows),of_rows)")
"""The best of both."""

UNLESS_CORNER = formula(
    "IFERROR(IF(AND(cornered,ABS(extreme-at_corner)<=same*ABS(of_rows-other)),extreme,probed),probed)", same=SAME_CORNER
)
"""What the last probe has found, for `DOUBT`: that it is worse than the corner from which the search began says nothing."""


def begun(corners: bool, limits: bool = True) -> dict[str, Node]:
    """`START`, `LOWER`, `UPPER` and `BEGUN`: where corners may be better than rows, and where there are no limits."""
    start: Node = START if limits else Symbol("here")
    middle: Node = BEGUN["f_middle"] if limits else Symbol("value")
    lower, upper = LOWER, UPPER
    if corners:  # one lies between two rows
        start = formula("IF(cornered,corner,start)", start=start)
        middle = formula("IF(cornered,at_corner,middle)", middle=middle)
        lower, upper = (
            with_symbols(tree, {"start": formula(f"{rounded}(start,0)")})
            for tree, rounded in ((LOWER, "ROUNDUP"), (UPPER, "ROUNDDOWN"))
        )
    return {"start": start, "lower": lower, "upper": upper, **BEGUN, "f_middle": middle}


# --- extremes: the probes -------------------------------------------------------------------------------------------------

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

PARABOLA = formula(
    "middle-((middle-left)^2*(f_middle-f_right)-(middle-right)^2*(f_middle-f_left))"
    "/(2*((middle-left)*(f_middle-f_right)-(middle-right)*(f_middle-f_left)))"
)
"""Where the parabola through three points has its vertex."""

VERTEX = formula("IFERROR(vertex,middle+aside*farther)", vertex=PARABOLA, aside=ASIDE, farther=_FARTHER)

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

# --- extremes: what is found ----------------------------------------------------------------------------------------------

EXTREME = formula("IF(rows_only,of_rows,IFERROR(IF(sense*(of_rows-found)<0,of_rows,found),of_rows))")
"""The value: the best of the rows, or what the probes have found. Each of several stretches would need a search of its own,
and where one ends must be known."""

PLACED = formula("IF(rows_only,best,IF(extreme=found,place,best))")
"""Its place: the best row, or where the probes have found it."""

EXTREME_OF_CORNERS = formula(
    "IF(rows_only,of_rows,IFERROR(IF(sense*(best_known-found)<0,best_known,found),best_known))"
)
PLACED_OF_CORNERS = formula("IF(OR(rows_only,extreme=of_rows),best,IF(extreme=found,place,corner))")
"""The same where there are corners; `best_known`: the best of rows and corners."""

DOUBT = formula(
    f"IF(rows_only,{ROWS},IFERROR(IF(elsewhere,{BEYOND},IF(AND(wraps=0,OR(place=low,place=high)),{SURE},"
    f"IF(MAX(ABS(extreme-last_probe),ABS(extreme-before))>settled*ABS(extreme-other),{ABOUT},{SURE}))),{SURE}))",
    settled=SETTLED,
)
"""What is said of it: where the last probe is worse than the best, the quantity is no parabola there; at an end of the
motion that is as it should be. `before` is the best before the last probe, `other` the other extreme of the rows."""

SPIKES = formula("found<nearer*of_rows", nearer=NEARER)
"""Whether an angle of transmission between 0 and 90 degrees is so much less between the rows than in them."""

DIP = formula("IF(AND(before>here,after>here),here-(after-before)^2/(8*(before-2*here+after)),here)")
"""A row of three, or the least of the parabola through them where that lies between."""

# --- limits ---------------------------------------------------------------------------------------------------------------

ONLY_ROWS = formula("OR(stretches>1,unsettled,AND(stretches=1,first=last))")
"""Whether nothing is known between rows: of several stretches, of one whose ends are unsettled, of a single row."""

CROSSING = ("newest", "f_newest", "other", "f_other", "oldest", "f_oldest")
"""What a row of a limit knows: two places between which the margin's sign changes, and the one before them."""

CROSSED = _trees(
    {
        "newest": "probe",
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

FIRST_SHARE = formula("IF(f_newest<0,chord,NA())", chord=CHORD)
"""The first probe's: the newest place is the row that does not close, the other one the row that does."""

SHARED = formula("newest+share*(other-newest)")
"""The place of the probe."""

_LIMIT = formula("newest+chord*(other-newest)", chord=CHORD)

FOUND = formula(
    "IF(ISNUMBER(outside),IFERROR(MEDIAN(inside,outside,limit+(inside-outside)*(least*part+inwards)),inside),NA())",
    limit=_LIMIT, least=formula("MIN(ABS(limit-newest),ABS(other-limit))", limit=_LIMIT), part=DOUBTED, inwards=INWARDS,
)  # fmt: skip
"""The limit by the last row, a little inside: by a part of what one more probe would change. Where there is no margin
outside, it is the row inside: a group is not apart there but undetermined."""

REST = formula("IF(ISNUMBER(outside),IFERROR(MIN(ABS(f_newest),ABS(f_other))/margin,1),0)")
"""What it lacks, in parts of the margin in the row inside."""


def least_margin(margins: Sequence[Node]) -> Node:
    """The least margin: of groups after one that is open nothing is known."""
    least = Call("MIN", tuple(margins)) if len(margins) > 1 else margins[0]
    for count in range(len(margins) - 1, 0, -1):
        fewer = Call("MIN", tuple(margins[:count])) if count > 1 else margins[0]
        least = formula("IFERROR(least,fewer)", least=least, fewer=fewer)
    return least
