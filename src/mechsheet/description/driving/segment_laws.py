"""The laws of [[driver.segments]]: f, f', f'' and f''' over tau, the part of the segment that has been passed.

A follower is at lift + by f(tau). The modified laws, which are made of pieces, are written for the first half over
w = 4 pi tau; the second half is the first one seen from behind, w = 4 pi (1 - tau) with `half` 1, and `piece` says which
piece it is: from 1/8 of the segment on the second, from 3/8 on the third.
Source: R. L. Norton, Cam Design and Manufacturing Handbook, chapters 2 to 5; H. A. Rothbart, Cam Design Handbook, chapter 2.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.formula.parser import parse_description
from mechsheet.model import HALF, PIECE, SEGMENT_LAWS

_LATER = "tau-0.500000001"
"""Above 0 in the second half; in the middle itself a follower still speeds up, however the rounding fell."""

_TEXTS: dict[str, tuple[str, ...]] = {
    "dwell": ("0", "0", "0", "0"),
    "uniform": ("tau", "1", "0", "0"),
    "parabolic": (
        f"where({_LATER},1-2*(1-tau)^2,2*tau^2)",
        f"where({_LATER},4*(1-tau),4*tau)",
        f"where({_LATER},-4,4)",
        "0",
    ),
    "harmonic": ("(1-cos(pi*tau))/2", "pi/2*sin(pi*tau)", "pi^2/2*cos(pi*tau)", "-pi^3/2*sin(pi*tau)"),
    "cycloidal": (
        "tau-sin(2*pi*tau)/(2*pi)",
        "1-cos(2*pi*tau)",
        "2*pi*sin(2*pi*tau)",
        "4*pi^2*cos(2*pi*tau)",
    ),
    "3-4-5": (
        "tau^3*(10-15*tau+6*tau^2)",
        "30*tau^2*(1-tau)^2",
        "60*tau*(1-tau)*(1-2*tau)",
        "60-360*tau+360*tau^2",
    ),
    "4-5-6-7": (
        "tau^4*(35-84*tau+70*tau^2-20*tau^3)",
        "140*tau^3*(1-tau)^3",
        "420*tau^2*(1-tau)^2*(1-2*tau)",
        "840*tau*(1-tau)*(1-5*tau+5*tau^2)",
    ),
}

_PIECES: dict[str, tuple[tuple[str, tuple[str, ...]], ...]] = {
    "modified trapezoid": (
        ("1/(2*pi*(2+pi))", ("w-sin(w)", "w-1+(w-pi/2)^2/2", "w+pi*(w-pi)+sin(w)")),
        ("2/(2+pi)", ("1-cos(w)", "1+w-pi/2", "1+pi+cos(w)")),
        ("8*pi/(2+pi)", ("sin(w)", "1", "-sin(w)")),
        ("32*pi^2/(2+pi)", ("cos(w)", "0", "-cos(w)")),
    ),
    "modified sine": (
        ("1/(4+pi)", ("(w-sin(w))/4", "2+w/4-9/4*sin((w+pi)/3)")),
        ("pi/(4+pi)", ("1-cos(w)", "1-3*cos((w+pi)/3)")),
        ("4*pi^2/(4+pi)", ("sin(w)", "sin((w+pi)/3)")),
        ("16*pi^3/(4+pi)", ("cos(w)", "cos((w+pi)/3)/3")),
    ),
}
"""Of the first half: a factor, and the pieces."""

assert {*_TEXTS, *_PIECES} == {*SEGMENT_LAWS}


def way_of(law: str) -> tuple[Node, Node, Node, Node]:
    """f, f', f'' and f''' of a law, over tau, or w, half and piece."""
    if law in _TEXTS:
        f, first, second, third = map(parse_description, _TEXTS[law])
        return f, first, second, third
    f, first, second, third = (al.mul(parse_description(factor), _of_piece(pieces)) for factor, pieces in _PIECES[law])
    half: Node = Symbol(HALF)
    turned = al.sub(al.ONE, al.mul(al.TWO, half))
    return al.add(half, al.mul(turned, f)), first, al.mul(turned, second), third


def _of_piece(pieces: tuple[str, ...]) -> Node:
    """The third piece of a law that has two is its second."""
    found = [*pieces, pieces[-1]][:3]
    return Call("CHOOSE", (Symbol(PIECE), *map(parse_description, found)))
