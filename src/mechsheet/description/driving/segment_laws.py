"""The laws of [[driver.segments]]: f, f', f'' and f''' over tau, the part of the segment that has been passed.

A follower is at lift + by f(tau). The modified laws, which are made of pieces, are written for the first half over
u = min(tau, 1 - tau): the second half is the first one seen from behind.
Source: R. L. Norton, Cam Design and Manufacturing Handbook, chapters 2 to 5; H. A. Rothbart, Cam Design Handbook, chapter 2.
"""

from __future__ import annotations

from mechsheet.formula.nodes import Node, with_symbols
from mechsheet.formula.parser import parse_description
from mechsheet.model import SEGMENT_LAWS

_LATER = "tau-0.500000001"
"""Above 0 in the second half; in the middle itself a follower still speeds up, however the rounding fell."""

_FROM_NEARER_END = {"u": parse_description("min(tau,1-tau)")}
_MIRRORED = (f"where({_LATER},1,0)+where({_LATER},-1,1)*", "", f"where({_LATER},-1,1)*", "")
"""What makes f and its derivatives of the first half those of both."""


def _pieces(factors: tuple[str, str, str, str], *pieces: tuple[str, tuple[str, str, str, str]]) -> tuple[str, ...]:
    """A law that is even about its middle: each piece with the u at which it ends ("" for the last)."""
    found = []
    for order, (factor, mirrored) in enumerate(zip(factors, _MIRRORED, strict=True)):
        text = ""
        for end, ways in reversed(pieces):
            text = f"where(u-{end}-1e-9,{text},{ways[order]})" if end else ways[order]
        found.append(f"{mirrored}{factor}*{text}")
    return tuple(found)


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
    "modified trapezoid": _pieces(
        ("2/(2+pi)", "2/(2+pi)", "8*pi/(2+pi)", "32*pi^2/(2+pi)"),
        ("0.125", ("(u-sin(4*pi*u)/(4*pi))", "(1-cos(4*pi*u))", "sin(4*pi*u)", "cos(4*pi*u)")),
        ("0.375", ("(u-1/(4*pi)+2*pi*(u-0.125)^2)", "(1+4*pi*(u-0.125))", "1", "0")),
        (
            "",
            (
                "(u+pi*(u-0.25)-cos(4*pi*(u-0.375))/(4*pi))",
                "(1+pi+sin(4*pi*(u-0.375)))",
                "cos(4*pi*(u-0.375))",
                "(-sin(4*pi*(u-0.375)))",
            ),
        ),
    ),
    "modified sine": _pieces(
        ("1/(4+pi)", "pi/(4+pi)", "4*pi^2/(4+pi)", "16*pi^3/(4+pi)"),
        ("0.125", ("(pi*u-sin(4*pi*u)/4)", "(1-cos(4*pi*u))", "sin(4*pi*u)", "cos(4*pi*u)")),
        (
            "",
            (
                "(2+pi*u-9/4*sin((4*pi*u+pi)/3))",
                "(1-3*cos((4*pi*u+pi)/3))",
                "sin((4*pi*u+pi)/3)",
                "cos((4*pi*u+pi)/3)/3",
            ),
        ),
    ),
}

assert tuple(_TEXTS) == SEGMENT_LAWS


def way_of(law: str) -> tuple[Node, Node, Node, Node]:
    """f, f', f'' and f''' of a law, over tau."""
    f, first, second, third = (with_symbols(parse_description(text), _FROM_NEARER_END) for text in _TEXTS[law])
    return f, first, second, third
