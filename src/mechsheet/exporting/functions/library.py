"""The basic functions: length, angle, triangle, one per dyad, the four-link mechanisms, with the configuration argument.

They have no mathematics of their own. Each is read from the equations of a small mechanism, solved as every mechanism is:
DörtÇubuk is the four-bar's theta14, the law of cosines the angle psi of its dyad. So they change when the equations do.
Sizes of the small mechanisms are such that each closes. Where a dimension may be negative, its size here is: the equations
then take its magnitude.

Source of the names and of the order of arguments: Soeylemez, Mechanisms, section 3.8 and Appendix 2.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Number, Symbol
from livesheet.said import Words
from mechsheet.compiled import Compiled
from mechsheet.exporting.functions.routines import Parameter, Routine, Source, with_names, with_values
from mechsheet.exporting.lowering import Step
from mechsheet.kinematics.angle_branch import AngleBranch
from mechsheet.kinematics.ledger import CLOSING
from mechsheet.model import Cartesian, Dimension, Driver, Joint, Label, Link, Mechanism, Quantity
from mechsheet.units import LENGTH, NUMBER, RAD, Unit, unit_of
from mechsheet.words.catalogue import Phrase
from mechsheet.words.equations import NOTHING

MILLIMETRE = unit_of("mm", "mm")

Named: TypeAlias = float | str
"""A size, or the name of a dimension."""


def _source(
    lengths: dict[str, float],
    links: dict[str, dict[str, tuple[Named, Named]]],
    joints: Sequence[Joint] = (),
    slides: str = "",
    angles: dict[str, float] | None = None,
    value: float = 1.0,
) -> Source:
    """A mechanism from its dimensions (with sizes at which it closes), links and joints; `slides`: the joint that is driven.

    The driver is the second link, or the sliding joint. The first link is the ground.
    """
    dimensions = [Dimension(symbol, size, MILLIMETRE) for symbol, size in lengths.items()]
    dimensions += [Dimension(symbol, size, RAD) for symbol, size in (angles or {}).items()]
    bodies = tuple(
        Link(name, number, {point: Cartesian(_size(x), _size(y)) for point, (x, y) in points.items()})
        for number, (name, points) in enumerate(links.items(), 1)
    )
    driven = next((joint.symbol for joint in joints if joint.name == slides), "theta12")
    driver = Driver(driven, MILLIMETRE if slides else RAD, "" if slides else bodies[1].name, bodies[0].name, slides)
    nothing = Label("")
    mechanism = Mechanism(
        "basic",
        nothing,
        nothing,
        "mm",
        RAD,
        tuple(dimensions),
        bodies,
        tuple(joints),
        replace(driver, values=(value,)),
    )
    return Source(Compiled(mechanism), judged=False)


def _size(named: Named) -> Quantity:
    return Symbol(named) if isinstance(named, str) else named


def _guide(name: str, link: str, point: str, through: tuple[Named, Named], angle: Named, symbol: str) -> Joint:
    x, y = through
    return Joint(name, "prismatic", link, "ground", point, (_size(x), _size(y)), _size(angle), 0.0, symbol)


def _slot(link: str, on: str, point: str, height: Named, angle: Named, symbol: str) -> Joint:
    return Joint("slot", "pin-slot", link, on, point, (0.0, _size(height)), _size(angle), 0.0, symbol)


def _pin(height: Named, symbol: str, point: str = "P") -> Joint:
    """The driven slide that brings a pin anywhere: along x at the height given, from x = 0."""
    return _guide("place", "carrier", point, (0.0, height), 0.0, symbol)


@lru_cache(maxsize=1)
def four_bar() -> Source:
    """Crank, coupler, output, ground along +x."""
    return _source(
        {"crank": 35.0, "coupler": 62.3, "output": 56.0, "ground": 70.0},
        {
            "ground": {"A0": (0.0, 0.0), "B0": ("ground", 0.0)},
            "crank": {"A0": (0.0, 0.0), "A": ("crank", 0.0)},
            "coupler": {"A": (0.0, 0.0), "B": ("coupler", 0.0)},
            "output": {"B0": (0.0, 0.0), "B": ("output", 0.0)},
        },
    )


@lru_cache(maxsize=1)
def slider_crank() -> Source:
    """A slide along x at the height `eccentricity` over the crank's pivot."""
    return _source(
        {"crank": 50.0, "coupler": 250.0, "eccentricity": -20.0},
        {
            "ground": {"A0": (0.0, 0.0)},
            "crank": {"A0": (0.0, 0.0), "A": ("crank", 0.0)},
            "coupler": {"A": (0.0, 0.0), "B": ("coupler", 0.0)},
            "slider": {"B": (0.0, 0.0)},
        },
        (_guide("guide", "slider", "B", (0.0, "eccentricity"), 0.0, "s"),),
    )


@lru_cache(maxsize=2)
def inverted(eccentricity: Named) -> Source:
    """A crank pin in the slot of a lever; the slot passes the lever's pivot at a distance."""
    lengths = {"crank": 51.0, "ground": 127.0}
    if isinstance(eccentricity, str):
        lengths[eccentricity] = -5.0
    return _source(
        lengths,
        {
            "ground": {"A0": (0.0, 0.0), "B0": ("ground", 0.0)},
            "crank": {"A0": (0.0, 0.0), "A": ("crank", 0.0)},
            "lever": {"B0": (0.0, 0.0)},
        },
        (_slot("crank", "lever", "A", eccentricity, 0.0, "s"),),
    )


@lru_cache(maxsize=1)
def rrr() -> Source:
    """Pin P anywhere (driven), pin Q fixed, links a and b."""
    return _source(
        {"yP": -10.0, "a": 60.0, "xQ": -70.0, "yQ": -30.0, "b": 50.0},
        {
            "ground": {"Q": ("xQ", "yQ")},
            "carrier": {"P": (0.0, 0.0)},
            "first": {"P": (0.0, 0.0), "R": ("a", 0.0)},
            "second": {"Q": (0.0, 0.0), "R": ("b", 0.0)},
        },
        (_pin("yP", "xP"),),
        slides="place",
        value=-140.0,
    )


@lru_cache(maxsize=1)
def rrp() -> Source:
    """Pin P anywhere (driven), a guide through L in the direction delta."""
    return _source(
        {"yP": -30.0, "a": 60.0, "xL": -5.0, "yL": -10.0},
        {
            "ground": {},
            "carrier": {"P": (0.0, 0.0)},
            "first": {"P": (0.0, 0.0), "R": ("a", 0.0)},
            "second": {"R": (0.0, 0.0)},
        },
        (_pin("yP", "xP"), _guide("guide", "second", "R", ("xL", "yL"), "delta", "s")),
        slides="place",
        angles={"delta": 0.3},
    )


@lru_cache(maxsize=1)
def rpr() -> Source:
    """Pin P fixed, pin Q anywhere (driven), a slot at the distance h from P."""
    return _source(
        {"xP": -5.0, "yP": -10.0, "yQ": -30.0, "h": -4.0},
        {"ground": {"P": ("xP", "yP")}, "carrier": {"Q": (0.0, 0.0)}, "lever": {"P": (0.0, 0.0)}},
        (
            _pin("yQ", "xQ", "Q"),
            _slot("carrier", "lever", "Q", "h", 0.0, "s"),
        ),
        slides="place",
        value=60.0,
    )


@lru_cache(maxsize=1)
def prp() -> Source:
    """Two fixed lines (the crank only drives)."""
    return _source(
        {"x1": 5.0, "y1": 10.0, "x2": 50.0, "y2": 30.0},
        {
            "ground": {"O": (0.0, 0.0)},
            "crank": {"O": (0.0, 0.0)},
            "first": {"R": (0.0, 0.0)},
            "second": {"R": (0.0, 0.0)},
        },
        (
            _guide("line1", "first", "R", ("x1", "y1"), "delta1", "s1"),
            _guide("line2", "second", "R", ("x2", "y2"), "delta2", "s2"),
        ),
        angles={"delta1": 0.3, "delta2": 1.3},
    )


@lru_cache(maxsize=1)
def rpp() -> Source:
    """Pin P anywhere (driven) in the slot of a yoke that slides along a guide."""
    return _source(
        {"yP": 30.0, "xL": 5.0, "yL": 10.0},
        {"ground": {}, "carrier": {"P": (0.0, 0.0)}, "yoke": {"Y": (0.0, 0.0)}},
        (
            _pin("yP", "xP"),
            _guide("guide", "yoke", "Y", ("xL", "yL"), "delta", "s"),
            _slot("carrier", "yoke", "P", 0.0, "gamma", "t"),
        ),
        slides="place",
        angles={"delta": 0.3, "gamma": 1.4},
    )


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
    pins, slide = rrr().steps, rrp().steps
    rows = (
        ("length", "Mag", pins["s"], "X Y", {"s_x": "X", "s_y": "Y"}, LENGTH),
        ("angle", "Ang", pins["phi_0"], "X Y", {"s_x": "X", "s_y": "Y"}, RAD),
        (
            "triangle area",
            "TriangleArea",
            pins["Delta"],
            "A B C Tol",
            {"a": "A", "b": "B", "s": "C", "tol": "Tol"},
            AREA,
        ),
        (
            "triangle angle",
            "TriangleAngle",
            pins["psi"],
            "A B C Area",
            {"b": "A", "s": "B", "a": "C", "Delta": "Area"},
            RAD,
        ),
        ("leg", "Leg", slide["w"], "C A Tol", {"a": "C", "n": "A", "tol": "Tol"}, LENGTH),
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
    bars, pins = "crank coupler output ground mode_1 theta12", "xP yP a xQ yQ b mode_1"
    slider, slide = "crank coupler eccentricity mode_1 theta12", "xP yP a xL yL delta mode_1"
    lever, slot = "crank ground eccentricity mode_1 theta12", "xP yP xQ yQ h mode_1"
    lines, yoke = "x1 y1 delta1 x2 y2 delta2", "xP yP xL yL delta gamma"
    rows = (
        ("FourBar", four_bar(), "theta14", bars),
        ("FourBarCoupler", four_bar(), "theta13", bars),
        ("SliderCrank", slider_crank(), "s", slider),
        ("SliderCrankCoupler", slider_crank(), "theta13", slider),
        ("InvertedSliderCrank", inverted("eccentricity"), "theta13", lever),
        ("InvertedSliderCrankSlide", inverted("eccentricity"), "s", lever),
        ("DyadRRR", rrr(), "theta14", pins),
        ("DyadRRRFirst", rrr(), "theta13", pins),
        ("DyadRRP", rrp(), "s", slide),
        ("DyadRRPFirst", rrp(), "theta13", slide),
        ("DyadRPR", rpr(), "theta13", slot),
        ("DyadRPRSlide", rpr(), "s", slot),
        ("DyadPRP", prp(), "s1", lines),
        ("DyadPRPSecond", prp(), "s2", lines),
        ("DyadRPP", rpp(), "s", yoke),
        ("DyadRPPSlot", rpp(), "t", yoke),
    )
    found = [_linkage(*row) for row in rows]
    return [*found[:4], _whole_turn(), *found[4:]]


def _linkage(key: str, source: Source, symbol: str, order: str) -> Basic:
    routine = source.routine(key, symbol, NOTHING, order.split(), windowed=False)
    return _basic(key, replace(routine, parameters=_parameters(order)))


def _whole_turn() -> Basic:
    """KolKızak as the text calls it: no eccentricity, no configuration, from 0 to a turn."""
    source = inverted(0.0)
    routine = source.routine("lever", "theta13", NOTHING, ("crank", "ground", "theta12", CONFIG), windowed=False)
    routine = with_values(routine, {CONFIG: al.ONE})
    result = AngleBranch(0, math.pi).taken(routine.result, Symbol("theta12"))
    routine = replace(routine, parameters=_parameters("crank ground theta12"), result=result)
    return _basic("SlottedLever", routine)
