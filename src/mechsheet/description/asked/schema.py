"""The keys of what is asked of a mechanism beside its motion: [tolerance], [exercise], [study] and [synthesis]."""

from __future__ import annotations

from dataclasses import replace

from mechsheet.description.grammar import (
    MOST_SERIES,
    Either,
    Integer,
    Items,
    Key,
    Kinds,
    Named,
    Number,
    Table,
    Text,
    YesNo,
)

MOST_SAMPLED = 2**30
"""Points of Sobol's sequence in a study: more tell nothing that these do not."""

TOLERANCES = Table(
    {
        "of": Key(
            Items(Text(names="output, variable, coordinate or summary"), 1, MOST_SERIES),
            "what has bands; default: all outputs and summaries of positions",
        ),
    }
)

EXERCISE = Table(
    {
        "asked": Key(
            Named(Number(0), "variable, coordinate, rate, force, output or summary"),
            "marks for each; default: a mark for every link angle, displacement and output",
        ),
        "vary": Key(
            Named(Items(Number(), 3, 3, "from, to, step"), "dimension"),
            "dimensions that differ from student to student, in their own units",
        ),
        "need": Key(
            Text(longest=1000),
            '"all rows", or a comparison of summaries in their units ("mu_min > 30"); several with "and"',
        ),
        "tolerance": Key(Number(0), "of the mechanism's size, radians for angles; default 1e-4"),
        "follow_through": Key(YesNo(), "false: what is right but for an earlier fault has no marks; default true"),
        "not_live": Key(Number(0), "share of a mark for what does not follow the dimensions; default 0.5"),
    }
)

_RANGE = Table(
    {
        "from": Key(Number(), "its smallest value"),
        "to": Key(Number(), "its largest value"),
        "by": Key(Number(), "the step of a grid"),
        "values": Key(Items(Number(), 1, 10_000), "the values one by one, in place of a range"),
    },
    ways=((("from", "to"), ("values",)),),
)

STUDY = Table(
    {
        "vary": Key(
            Named(Either((Items(Number(), 2, 3, "from, to, step"), _RANGE)), "dimension", 1),
            "dimensions that vary, in their own units: [from, to, step], or as a table; the last one changes first",
            True,
        ),
        "sample": Key(
            Text(("grid", "sobol")), '"grid": all combinations (the default); "sobol": `count` of them, evenly'
        ),
        "count": Key(Integer(1, MOST_SAMPLED), "how many designs a Sobol sample has"),
        "seed": Key(Integer(0, 2**32 - 1), "what scrambles the Sobol sequence; default 0"),
        "keep": Key(
            Items(Text(), 0, 50),
            'conditions that all must hold: "mu_min > 40", "60 < swing < 90", "closes", "crank(LINK)", '
            '"grashof(LOOP)", each also with "not" before it; over dimensions, summaries and min(OUTPUT), max(OUTPUT)',
        ),
        "minimize": Key(Items(Text(), 0, 3), "what is to be small: summaries, or expressions over them"),
        "maximize": Key(Items(Text(), 0, 3), "what is to be large; at most three objectives in all"),
        "best": Key(Integer(1, 1000), "how many of the best designs are listed; default 50"),
    }
)

_KIND = Key(Text(), "kind of the task", True)
_ROUND = Key(Number(), "lengths are rounded to this before they are used; not rounded by default")
_A1 = Key(Number(), "distance A0B0; the dimension a1 by default")
_RATIO = Key(Number(), "time of the slow way over that of the quick one")
_BEST = Key(YesNo(), "true: whatever makes the least transmission angle largest")

MOST_POINTS = 12
"""Precision points; their sums stand in one cell each."""

_PIVOT = Table(
    {
        "moving": Key(Items(Number(), 2, 2, "[x, y]"), "the point of the body, where it is at the first pose"),
        "fixed": Key(Items(Number(), 2, 2, "[x, y]"), "or the fixed pivot"),
        "turns": Key(Items(Number(), 2, 2, "[beta2, beta3]"), "or by how much the crank turns from the first pose"),
    },
    ways=((("moving",), ("fixed",), ("turns",)),),
)

SYNTHESIS = Kinds(
    "kind",
    {
        "function": Table(
            {
                "kind": _KIND,
                "a1": _A1,
                "theta": Key(
                    Items(Number(), 2, MOST_POINTS),
                    "angles of the input from A0B0; of a function `f` the first and the last",
                    True,
                ),
                "psi": Key(Items(Number(), 2, MOST_POINTS), "angles of the output, likewise", True),
                "f": Key(Text(longest=1000), "or a function of x that is to be generated"),
                "x": Key(Items(Number(), 2, 2, "[first, last]"), "its range"),
                "points": Key(Integer(3, MOST_POINTS), "its precision points, Chebyshev's spacing; default 3"),
                "round": _ROUND,
            }
        ),
        "dead-centres": Table(
            {
                "kind": _KIND,
                "a1": _A1,
                "psi": Key(Number(), "swing of the rocker", True),
                "phi": Key(Number(), "turn of the crank on the slow way"),
                "time_ratio": _RATIO,
                "lam": Key(Number(), "coupler over crank, a3/a2"),
                "a2": Key(Number(), "or the crank"),
                "best": _BEST,
                "round": _ROUND,
            },
            ways=((("phi",), ("time_ratio",)), (("lam",), ("a2",), ("best",))),
        ),
        "guidance": Table(
            {
                "kind": _KIND,
                "poses": Key(
                    Items(Items(Number(), 3, 3, "[x, y, angle]"), 3, 3), "three poses of the body: [x, y, angle]", True
                ),
                "A": Key(_PIVOT, "what is given of the first crank", True),
                "B": Key(_PIVOT, "and of the second", True),
                "round": _ROUND,
            }
        ),
        "quick-return-slider": Table(
            {
                "kind": _KIND,
                "stroke": Key(Number(), "of the slider", True),
                "time_ratio": replace(_RATIO, required=True),
                "lam": Key(Number(), "rod over crank, a3/a2"),
                "c": Key(Number(), "or the eccentricity"),
                "a2": Key(Number(), "or the crank"),
                "best": _BEST,
                "round": _ROUND,
            },
            ways=((("lam",), ("c",), ("a2",), ("best",)),),
        ),
        "quick-return-lever": Table(
            {
                "kind": _KIND,
                "stroke": Key(Number(), "of the end of the lever", True),
                "time_ratio": replace(_RATIO, required=True),
                "crank": Key(Number(), "length of the crank; the dimension crank by default"),
                "round": _ROUND,
            }
        ),
    },
)
