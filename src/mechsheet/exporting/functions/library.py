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
from mechsheet.exporting.functions import small_mechanisms as small
from mechsheet.exporting.functions.routines import Parameter, Routine, Source, with_names, with_values
from mechsheet.exporting.lowering import Step
from mechsheet.kinematics.angle_branch import AngleBranch
from mechsheet.kinematics.ledger import CLOSING
from mechsheet.model import Words
from mechsheet.units import LENGTH, NUMBER, RAD, Unit

Basic: TypeAlias = tuple[Words, Routine]
"""A basic function: what it is called, and its routine."""

# --- the functions --------------------------------------------------------------------------------------------------

CONFIG = "mode_1"

PARAMETERS = {
    "Area": Words("Area", "Alan"),
    "crank": Words("Crank", "Krank"),
    "coupler": Words("Coupler", "Biyel"),
    "output": Words("Output", "Çıkış"),
    "ground": Words("Ground", "Sabit"),
    "eccentricity": Words("Eccentricity", "Eksantriklik"),
    "theta12": Words("Theta", "Theta"),
    CONFIG: Words("Config", "Config"),
}
"""What a parameter is called, where that is not its symbol."""

AREA = Unit("label", "area")

MEANINGS: dict[str, tuple[str, str, Unit]] = {
    "X": ("x part", "x bileşeni", LENGTH),
    "Y": ("y part", "y bileşeni", LENGTH),
    "A": ("first side", "birinci kenar", LENGTH),
    "B": ("second side", "ikinci kenar", LENGTH),
    "C": ("third side", "üçüncü kenar", LENGTH),
    "Tol": ("lengths below this count as zero", "bundan kısa uzunluklar sıfır sayılır", LENGTH),
    "Area": ("area of the triangle", "üçgenin alanı", AREA),
    "U1": ("a side at the angle", "açının bir kenarı", LENGTH),
    "U2": ("the other side at the angle", "açının öbür kenarı", LENGTH),
    "U3": ("the side opposite the angle", "açının karşısındaki kenar", LENGTH),
    "crank": ("crank", "krank", LENGTH),
    "coupler": ("coupler", "biyel", LENGTH),
    "output": ("output link", "çıkış uzvu", LENGTH),
    "ground": ("distance of the fixed pivots, along +x", "sabit mafsallar arasındaki uzaklık, +x boyunca", LENGTH),
    "eccentricity": ("eccentricity of the slide", "kızağın eksantrikliği", LENGTH),
    "theta12": ("crank angle", "krank açısı", RAD),
    CONFIG: ("configuration, +1 or -1", "konfigürasyon, +1 ya da -1", NUMBER),
    "xP": ("pin P, x", "P mafsalı, x", LENGTH),
    "yP": ("pin P, y", "P mafsalı, y", LENGTH),
    "xQ": ("pin Q, x", "Q mafsalı, x", LENGTH),
    "yQ": ("pin Q, y", "Q mafsalı, y", LENGTH),
    "xL": ("a point L of the guide, x", "kızağın bir L noktası, x", LENGTH),
    "yL": ("a point L of the guide, y", "kızağın bir L noktası, y", LENGTH),
    "a": ("link P-R", "P-R uzvu", LENGTH),
    "b": ("link Q-R", "Q-R uzvu", LENGTH),
    "h": ("distance of the slot from P, to its left", "kanalın P'den uzaklığı, soluna doğru", LENGTH),
    "delta": ("direction of the guide", "kızağın doğrultusu", RAD),
    "gamma": ("angle of the slot from the guide", "kanalın kızaktan açısı", RAD),
    "x1": ("a point of line 1, x", "1. doğrunun bir noktası, x", LENGTH),
    "y1": ("a point of line 1, y", "1. doğrunun bir noktası, y", LENGTH),
    "delta1": ("direction of line 1", "1. doğrunun doğrultusu", RAD),
    "x2": ("a point of line 2, x", "2. doğrunun bir noktası, x", LENGTH),
    "y2": ("a point of line 2, y", "2. doğrunun bir noktası, y", LENGTH),
    "delta2": ("direction of line 2", "2. doğrunun doğrultusu", RAD),
}
"""Symbol of a parameter -> what it is (English, Turkish), unit."""


def basics() -> tuple[Basic, ...]:
    """Every basic function, each after those that it calls."""
    return (*_elementary(), _law_of_cosines(), *_linkages())


def _parameters(order: str) -> tuple[Parameter, ...]:
    found = []
    for symbol in order.split():
        english, turkish, unit = MEANINGS[symbol]
        found.append(Parameter(symbol, Words(english, turkish), unit))
    return tuple(found)


def _elementary() -> list[Basic]:
    """Length, angle, triangle and leg, as the dyads' equations have them."""
    rrr, rrp = small.rrr().steps, small.rrp().steps
    rows = (
        ("length", Words("Mag", "Boy"), rrr["s"], "X Y", {"s_x": "X", "s_y": "Y"}, LENGTH,
         Words("Length of the vector (X, Y)", "(X, Y) vektörünün boyu")),
        ("angle", Words("Ang", "Açı"), rrr["phi_0"], "X Y", {"s_x": "X", "s_y": "Y"}, RAD,
         Words("Direction of the vector (X, Y), x first, from -pi to pi",
               "(X, Y) vektörünün doğrultusu, önce x, -pi ile pi arasında")),
        ("triangle area", Words("TriangleArea", "ÜçgenAlanı"), rrr["Delta"], "A B C Tol",
         {"a": "A", "b": "B", "s": "C", "tol": "Tol"}, AREA,
         Words("Area of a triangle from its sides (Heron)", "Kenarlarından bir üçgenin alanı (Heron)")),
        ("triangle angle", Words("TriangleAngle", "ÜçgenAçısı"), rrr["psi"], "A B C Area",
         {"b": "A", "s": "B", "a": "C", "Delta": "Area"}, RAD,
         Words("Angle between the sides A and B of a triangle", "Bir üçgenin A ve B kenarları arasındaki açı")),
        ("leg", Words("Leg", "DikKenar"), rrp["w"], "C A Tol", {"a": "C", "n": "A", "tol": "Tol"}, LENGTH,
         Words("A leg of the right triangle with hypotenuse C and the other leg A",
               "Hipotenüsü C, bir dik kenarı A olan dik üçgenin öbür dik kenarı")),
    )  # fmt: skip
    found = []
    for key, name, step, order, renamed, unit, about in rows:
        routine = Routine(key, about, _parameters(order), (), step.expression, unit, missing=step.missing)
        found.append((name, with_names(routine, renamed)))
    return found


def _law_of_cosines() -> Basic:
    """AçıCos: the angle between U1 and U2, from the area; what counts as zero is a part of the largest side."""
    u1, u2, u3 = (Symbol(f"U{number}") for number in (1, 2, 3))
    steps = (
        Step("tol", al.mul(Number(CLOSING), al.largest((u1, u2, u3)))),
        Step("Delta", Call("triangle area", (u3, u1, u2, Symbol("tol")))),
    )
    about = Words(
        "Interior angle opposite the third side (law of cosines), from 0 to pi",
        "Üçüncü kenarın karşısındaki iç açı (kosinüs teoremi), 0 ile pi arasında",
    )
    result = Call("triangle angle", (u1, u2, u3, Symbol("Delta")))
    routine = Routine("law of cosines", about, _parameters("U1 U2 U3"), steps, result, RAD)
    return Words("AngCos", "AçıCos"), routine


def _linkages() -> list[Basic]:
    """The four-link mechanisms and the dyads."""
    dyad = Words("Dyad", "Diyad")
    four_bar, pins = "crank coupler output ground mode_1 theta12", "xP yP a xQ yQ b mode_1"
    slider, slide = "crank coupler eccentricity mode_1 theta12", "xP yP a xL yL delta mode_1"
    lever, slot = "crank ground eccentricity mode_1 theta12", "xP yP xQ yQ h mode_1"
    lines, yoke = "x1 y1 delta1 x2 y2 delta2", "xP yP xL yL delta gamma"
    rows = (
        (Words("FourBar", "DörtÇubuk"), small.four_bar(), "theta14", four_bar,
         Words("Four-bar: angle of the output link", "Dört-çubuk: çıkış uzvunun açısı")),
        (Words("FourBarCoupler", "DörtÇubukBiyel"), small.four_bar(), "theta13", four_bar,
         Words("Four-bar: angle of the coupler", "Dört-çubuk: biyelin açısı")),
        (Words("SliderCrank", "KrankBiyel"), small.slider_crank(), "s", slider,
         Words("Slider-crank: displacement of the slider from the crank's pivot, along x",
               "Krank-biyel: kızağın krank yatağından ötelenmesi, x boyunca")),
        (Words("SliderCrankCoupler", "KrankBiyelAçısı"), small.slider_crank(), "theta13", slider,
         Words("Slider-crank: angle of the coupler, from crank pin to slider",
               "Krank-biyel: biyelin açısı, krank mafsalından kızağa")),
        (Words("InvertedSliderCrank", "KolKızakE"), small.inverted("eccentricity"), "theta13", lever,
         Words("Inverted slider-crank: direction of the slot, which passes the lever's pivot at a distance",
               "Kol-kızak: kolun yatağından kaçık geçen kanalın doğrultusu")),
        (Words("InvertedSliderCrankSlide", "KolKızakÖtelenmesi"), small.inverted("eccentricity"), "s", lever,
         Words("Inverted slider-crank: displacement of the crank pin along the slot",
               "Kol-kızak: krank mafsalının kanal boyunca ötelenmesi")),
        (Words(f"{dyad.en}RRR", f"{dyad.tr}RRR"), small.rrr(), "theta14", pins,
         Words("Dyad RRR: direction of Q-R; Config +1: R left of P-Q",
               "RRR diyadı: Q-R doğrultusu; Config +1: R, P-Q'nun solunda")),
        (Words(f"{dyad.en}RRRFirst", f"{dyad.tr}RRRBirinci"), small.rrr(), "theta13", pins,
         Words("Dyad RRR: direction of P-R", "RRR diyadı: P-R doğrultusu")),
        (Words(f"{dyad.en}RRP", f"{dyad.tr}RRP"), small.rrp(), "s", slide,
         Words("Dyad RRP: displacement of R from L along the guide; Config +1: the larger of two",
               "RRP diyadı: R'nin L'den kızak boyunca ötelenmesi; Config +1: ikisinden büyüğü")),
        (Words(f"{dyad.en}RRPFirst", f"{dyad.tr}RRPBirinci"), small.rrp(), "theta13", slide,
         Words("Dyad RRP: direction of P-R", "RRP diyadı: P-R doğrultusu")),
        (Words(f"{dyad.en}RPR", f"{dyad.tr}RPR"), small.rpr(), "theta13", slot,
         Words("Dyad RPR: direction of the slot of the link pinned at P, in which Q slides; Config +1: Q ahead of P",
               "RPR diyadı: P'ye mafsallı uzvun Q'nun kaydığı kanalının doğrultusu; Config +1: Q, P'nin ilerisinde")),
        (Words(f"{dyad.en}RPRSlide", f"{dyad.tr}RPRÖtelenme"), small.rpr(), "s", slot,
         Words("Dyad RPR: displacement of Q along the slot", "RPR diyadı: Q'nun kanal boyunca ötelenmesi")),
        (Words(f"{dyad.en}PRP", f"{dyad.tr}PRP"), small.prp(), "s1", lines,
         Words("Dyad PRP: displacement along line 1 to where it meets line 2",
               "PRP diyadı: 2. doğru ile kesiştiği noktaya kadar 1. doğru boyunca ötelenme")),
        (Words(f"{dyad.en}PRPSecond", f"{dyad.tr}PRPİkinci"), small.prp(), "s2", lines,
         Words("Dyad PRP: displacement along line 2", "PRP diyadı: 2. doğru boyunca ötelenme")),
        (Words(f"{dyad.en}RPP", f"{dyad.tr}RPP"), small.rpp(), "s", yoke,
         Words("Dyad RPP: displacement along the guide of a yoke in whose slot P slides",
               "RPP diyadı: kanalında P'nin kaydığı uzvun kızak boyunca ötelenmesi")),
        (Words(f"{dyad.en}RPPSlot", f"{dyad.tr}RPPKanal"), small.rpp(), "t", yoke,
         Words("Dyad RPP: displacement of P along the slot", "RPP diyadı: P'nin kanal boyunca ötelenmesi")),
    )  # fmt: skip
    found = [_linkage(name, source, symbol, order, about) for name, source, symbol, order, about in rows]
    return [*found[:4], _whole_turn(), *found[4:]]


def _linkage(name: Words, source: Source, symbol: str, order: str, about: Words) -> Basic:
    routine = source.routine(name.en, symbol, about, order.split(), windowed=False)
    return name, replace(routine, parameters=_parameters(order))


def _whole_turn() -> Basic:
    """KolKızak as the text calls it: no eccentricity, no configuration, from 0 to a turn."""
    about = Words(
        "Crank and slotted lever: direction of the lever from its pivot to the crank pin, from 0 to 2 pi",
        "Kol-kızak: kolun, yatağından krank mafsalına doğrultusu, 0 ile 2 pi arasında",
    )
    source = small.inverted(0.0)
    routine = source.routine("lever", "theta13", about, ("crank", "ground", "theta12", CONFIG), windowed=False)
    routine = with_values(routine, {CONFIG: al.ONE})
    result = AngleBranch(0, math.pi).taken(routine.result, Symbol("theta12"))
    routine = replace(routine, parameters=_parameters("crank ground theta12"), result=result)
    return Words("SlottedLever", "KolKızak"), routine
