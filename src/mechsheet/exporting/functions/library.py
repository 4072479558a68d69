"""The basic functions: length, angle, triangle, one per dyad, the four-link mechanisms, with the configuration argument.

They have no mathematics of their own. Each is read from the equations of a small mechanism that the program solves:
DörtÇubuk is the four-bar's theta14, the law of cosines the angle psi of its dyad. So they change when the equations do.
Source of the names and of the order of arguments: Soeylemez, Mechanisms, section 3.8 and Appendix 2.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Number, Symbol
from livesheet.said import Words
from mechsheet.exporting.functions import small_mechanisms as small
from mechsheet.exporting.functions.routines import Parameter, Routine, Source, with_names, with_values
from mechsheet.exporting.lowering import Step
from mechsheet.kinematics.angle_branch import AngleBranch
from mechsheet.kinematics.ledger import CLOSING
from mechsheet.model import Label
from mechsheet.units import LENGTH, NUMBER, RAD, Unit
from mechsheet.words.catalogue import Phrase
from mechsheet.words.equations import NOTHING

Basic: TypeAlias = tuple[Words, Routine]
"""A basic function: what it is called, and its routine."""

# --- the functions --------------------------------------------------------------------------------------------------

CONFIG = "mode_1"

NAMED = ("Area", "crank", "coupler", "output", "ground", "eccentricity", "theta12", CONFIG)
"""Parameters that have a name besides their symbol."""

AREA = Unit("label", "area")

_ANGLES = ("theta12", "delta", "gamma", "delta1", "delta2")

UNITS: dict[str, Unit] = {**dict.fromkeys(_ANGLES, RAD), "Area": AREA, CONFIG: NUMBER}
"""Symbol of a parameter -> its unit; all others are lengths."""


def basics() -> tuple[Basic, ...]:
    """Every basic function, each after those that it calls."""
    return (*_elementary(), _law_of_cosines(), *_linkages())


def name_of(symbol: str) -> Words:
    """What a parameter is called."""
    return Phrase(f"function.name.{symbol}") if symbol in NAMED else Label(symbol)


def _parameters(order: str) -> tuple[Parameter, ...]:
    return tuple(
        Parameter(symbol, Phrase(f"function.part.{symbol}"), UNITS.get(symbol, LENGTH)) for symbol in order.split()
    )


def _basic(key: str, routine: Routine) -> Basic:
    """A basic function by the key of its words."""
    return Phrase(f"function.{key}"), replace(routine, about=Phrase(f"function.{key}.about"))


def _elementary() -> list[Basic]:
    """Length, angle, triangle and leg, as the dyads' equations have them."""
    rrr, rrp = small.rrr().steps, small.rrp().steps
    rows = (
        ("length", "Mag", rrr["s"], "X Y", {"s_x": "X", "s_y": "Y"}, LENGTH),
        ("angle", "Ang", rrr["phi_0"], "X Y", {"s_x": "X", "s_y": "Y"}, RAD),
        (
            "triangle area",
            "TriangleArea",
            rrr["Delta"],
            "A B C Tol",
            {"a": "A", "b": "B", "s": "C", "tol": "Tol"},
            AREA,
        ),
        (
            "triangle angle",
            "TriangleAngle",
            rrr["psi"],
            "A B C Area",
            {"b": "A", "s": "B", "a": "C", "Delta": "Area"},
            RAD,
        ),
        ("leg", "Leg", rrp["w"], "C A Tol", {"a": "C", "n": "A", "tol": "Tol"}, LENGTH),
    )
    found = []
    for key, name, step, order, renamed, unit in rows:
        routine = Routine(key, NOTHING, _parameters(order), (), step.expression, unit, missing=step.missing)
        found.append(_basic(name, with_names(routine, renamed)))
    return found


def _law_of_cosines() -> Basic:
    """AçıCos: the angle between U1 and U2, from the area; what counts as zero is a part of the largest side."""
    u1, u2, u3 = (Symbol(f"U{number}") for number in (1, 2, 3))
    steps = (
        Step("tol", al.mul(Number(CLOSING), al.largest((u1, u2, u3)))),
        Step("Delta", Call("triangle area", (u3, u1, u2, Symbol("tol")))),
    )
    result = Call("triangle angle", (u1, u2, u3, Symbol("Delta")))
    routine = Routine("law of cosines", NOTHING, _parameters("U1 U2 U3"), steps, result, RAD)
    return _basic("AngCos", routine)


def _linkages() -> list[Basic]:
    """The four-link mechanisms and the dyads."""
    four_bar, pins = "crank coupler output ground mode_1 theta12", "xP yP a xQ yQ b mode_1"
    slider, slide = "crank coupler eccentricity mode_1 theta12", "xP yP a xL yL delta mode_1"
    lever, slot = "crank ground eccentricity mode_1 theta12", "xP yP xQ yQ h mode_1"
    lines, yoke = "x1 y1 delta1 x2 y2 delta2", "xP yP xL yL delta gamma"
    rows = (
        ("FourBar", small.four_bar(), "theta14", four_bar),
        ("FourBarCoupler", small.four_bar(), "theta13", four_bar),
        ("SliderCrank", small.slider_crank(), "s", slider),
        ("SliderCrankCoupler", small.slider_crank(), "theta13", slider),
        ("InvertedSliderCrank", small.inverted("eccentricity"), "theta13", lever),
        ("InvertedSliderCrankSlide", small.inverted("eccentricity"), "s", lever),
        ("DyadRRR", small.rrr(), "theta14", pins),
        ("DyadRRRFirst", small.rrr(), "theta13", pins),
        ("DyadRRP", small.rrp(), "s", slide),
        ("DyadRRPFirst", small.rrp(), "theta13", slide),
        ("DyadRPR", small.rpr(), "theta13", slot),
        ("DyadRPRSlide", small.rpr(), "s", slot),
        ("DyadPRP", small.prp(), "s1", lines),
        ("DyadPRPSecond", small.prp(), "s2", lines),
        ("DyadRPP", small.rpp(), "s", yoke),
        ("DyadRPPSlot", small.rpp(), "t", yoke),
    )
    found = [_linkage(*row) for row in rows]
    return [*found[:4], _whole_turn(), *found[4:]]


def _linkage(key: str, source: Source, symbol: str, order: str) -> Basic:
    routine = source.routine(key, symbol, NOTHING, order.split(), windowed=False)
    return _basic(key, replace(routine, parameters=_parameters(order)))


def _whole_turn() -> Basic:
    """KolKızak as the text calls it: no eccentricity, no configuration, from 0 to a turn."""
    source = small.inverted(0.0)
    routine = source.routine("lever", "theta13", NOTHING, ("crank", "ground", "theta12", CONFIG), windowed=False)
    routine = with_values(routine, {CONFIG: al.ONE})
    result = AngleBranch(0, math.pi).taken(routine.result, Symbol("theta12"))
    routine = replace(routine, parameters=_parameters("crank ground theta12"), result=result)
    return _basic("SlottedLever", routine)
