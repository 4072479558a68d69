"""Errors of the workbook's variables near dead centres, against the same equations at 50 digits.

Each mechanism is swept towards a dead centre: rows lie at 1, 0.1, ... 1e-9 degrees before it, and as many behind it where it
can be passed. The workbook is computed by the engine from the numbers in its cells; the same numbers are taken as exact in
mpmath, which evaluates the textbook's form (law of cosines with acos, right triangle) at 50 digits. Errors are in parts of
the size: radians, or parts of the largest length; of each row the worst of all variables.

    floor     what the exact result changes by when one input (a length, the driver in radians) is off by half a unit in its
              last place: nothing that computes in such numbers can promise less
    textbook  the error of the textbook's form, with acos, in ordinary numbers
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import mpmath
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve
from mechsheet.sheet.as_typed import typed
from mechsheet.sheet.layout import lay_out

DISTANCES = [10.0**-n for n in range(10)]
HALF_ULP = 2.0**-53

APART = 20.0
"""The first row is so far away [deg] that the sketch can tell the assemblies apart."""


@dataclass(frozen=True)
class Study:
    """One mechanism.

    text      its description, with `{values}` for the driver's values (degrees, or lengths)
    numbers   dimensions by symbol
    centre    the driver's value [degrees, or length] at the dead centre
    inward    +1 where larger values of the driver exist, -1 where smaller ones do, 0 where both do
    exact     (mpmath's or math's functions, numbers, driver in radians or as a length) -> {symbol: value}
    size      largest length
    """

    name: str
    text: str
    numbers: dict[str, float]
    centre: float
    inward: int
    exact: Callable
    size: float


def four_bar(m, n, theta):
    """theta13 and theta14 by the law of cosines; all links' x axes along their arms, mode +1."""
    x, y = n["a2"] * m.cos(theta) - n["a1"], n["a2"] * m.sin(theta)
    s = m.sqrt(x * x + y * y)
    psi = m.acos(_within((n["a4"] ** 2 + s * s - n["a3"] ** 2) / (2 * n["a4"] * s)))
    mu = m.acos(_within((n["a3"] ** 2 + n["a4"] ** 2 - s * s) / (2 * n["a3"] * n["a4"])))
    theta14 = m.atan2(y, x) - psi
    return {"theta14": theta14, "theta13": theta14 - mu, "mu": mu}


def slider_crank(m, n, theta):
    """The displacement, and the rod's angle by its cosine."""
    x, y = n["a2"] * m.cos(theta), n["a2"] * m.sin(theta)
    w = m.sqrt(max(0, n["a3"] ** 2 - y * y))
    angle = m.acos(_within(w / n["a3"]))
    return {"s14": x + w, "theta13": -angle if y > 0 else angle}


def inverted(m, n, theta):
    """The slotted arm: B0 at (a1, 0), the slot misses it by h; the distance of the crank's pin comes down to h."""
    x, y = n["a2"] * m.cos(theta) - n["a1"], n["a2"] * m.sin(theta)
    r = m.sqrt(x * x + y * y)
    w = m.sqrt(max(0, r * r - n["h"] ** 2))
    return {"s34": w, "theta13": m.atan2(y, x) - m.asin(_within(n["h"] / r))}


def _within(cosine):
    return max(-1, min(1, cosine))


HEAD = 'format = 1\n[mechanism]\nname = "study"\n[dimensions]\n'

FOUR_BAR = (
    HEAD
    + """{dimensions}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0] }}
[links.rocker]
points = {{ B0 = [0, 0], B = ["a4", 0] }}
[driver]
link = "crank"
values = {values}
[assembly]
B = [{x}, {y}]
"""
)

SLIDER = (
    HEAD
    + """{dimensions}
[links.ground]
points = {{ A0 = [0, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.rod]
points = {{ A = [0, 0], B = ["a3", 0] }}
[links.slider]
points = {{ B = [0, 0] }}
[[joints]]
type = "prismatic"
link = "slider"
on = "ground"
point = "B"
through = "A0"
symbol = "s14"
[driver]
link = "crank"
values = {values}
[assembly]
s14 = {x}
"""
)

INVERTED = (
    HEAD
    + """{dimensions}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.arm]
points = {{ B0 = [0, 0] }}
[[joints]]
type = "pin-slot"
point = "A"
on = "arm"
through = [0, "h"]
symbol = "s34"
[driver]
link = "crank"
values = {values}
[assembly]
s34 = {x}
"""
)


def studies() -> list[Study]:
    """The mechanisms."""
    found = []
    for name, (a1, a2, a3, a4), reach, inward in (
        ("four-bar, stretched", (100.0, 35.0, 62.3, 56.0), lambda a3, a4: a3 + a4, -1),
        ("four-bar, folded", (100.0, 60.0, 30.0, 80.0), lambda a3, a4: a4 - a3, 1),
        ("four-bar in metres", (0.1, 0.035, 0.0623, 0.056), lambda a3, a4: a3 + a4, -1),
    ):
        numbers = {"a1": a1, "a2": a2, "a3": a3, "a4": a4}
        cosine = (a1**2 + a2**2 - reach(a3, a4) ** 2) / (2 * a1 * a2)
        centre = math.degrees(math.acos(cosine))
        first = four_bar(math, numbers, math.radians(centre + inward * APART))
        x, y = a1 + a4 * math.cos(first["theta14"]), a4 * math.sin(first["theta14"])
        text = FOUR_BAR.replace("{x}", repr(x)).replace("{y}", repr(y))
        found.append(Study(name, text, numbers, centre, inward, four_bar, max(numbers.values())))
    # Grashof's limit: all four links in line at 180 degrees, which can be passed.
    numbers = {"a1": 70.0, "a2": 35.0, "a3": 40.0, "a4": 65.0}
    first = four_bar(math, numbers, math.radians(180.0 + APART))
    x, y = 70 + 65 * math.cos(first["theta14"]), 65 * math.sin(first["theta14"])
    text = FOUR_BAR.replace("{x}", repr(x)).replace("{y}", repr(y))
    found.append(Study("four-bar, change point", text, numbers, 180.0, 0, four_bar, 70.0))
    text = SLIDER.replace("{x}", "60")
    found.append(
        Study(
            "slider-crank, end of the stroke",
            text.replace("60", "250"),
            {"a2": 50.0, "a3": 250.0},
            180.0,
            0,
            slider_crank,
            250.0,
        )
    )
    numbers = {"a2": 50.0, "a3": 30.0}
    centre = math.degrees(math.asin(0.6))
    found.append(Study("slider-crank, short rod", text, numbers, centre, -1, slider_crank, 50.0))
    numbers = {"a1": 60.0, "a2": 45.0, "h": 25.0}
    centre = math.degrees(math.acos((60**2 + 45**2 - 25**2) / (2 * 60 * 45)))
    text = INVERTED.replace("{x}", "30")
    found.append(Study("slotted arm with offset", text, numbers, centre, 1, inverted, 60.0))
    return found


def values_of(study: Study) -> list[float]:
    """The driver's values [deg] as a cell takes them: towards the centre, and away from it where it can be passed."""
    side = study.inward or 1
    values = [study.centre + side * distance for distance in (APART, *DISTANCES)]
    if study.inward == 0:
        values += [study.centre - distance for distance in reversed(DISTANCES)]
    return [typed(value) for value in values]


def measure(study: Study) -> list[tuple[float, float, float, float]]:
    """For each row: (distance from the centre [deg], error, floor, error of the textbook's form), the worst of all."""
    values = values_of(study)
    listed = "[" + ", ".join(repr(value) for value in values) + "]"
    dimensions = "\n".join(f"{symbol} = {number!r}" for symbol, number in study.numbers.items())
    mechanism = loads(study.text.format(values=listed, dimensions=dimensions))
    workbook, plan = lay_out(mechanism, solve(mechanism))
    computed = evaluate(book_of(workbook))
    rows = []
    with mpmath.workdps(50):
        numbers = {symbol: mpmath.mpf(number) for symbol, number in study.numbers.items()}
        for row, value in enumerate(values):
            if row == 0:
                continue
            theta = mpmath.radians(mpmath.mpf(value))
            exact = study.exact(mpmath, numbers, theta)
            floor = _floor(study, numbers, theta, exact)
            textbook = study.exact(math, study.numbers, math.radians(value))
            worst = [0.0, 0.0, 0.0]
            for symbol, right in exact.items():
                spot = plan.at.spots[symbol]
                found = computed.get(spot.sheet, spot.row + row, spot.col)
                if not isinstance(found, float):
                    worst[0] = math.inf
                    continue
                found = math.radians(found) if spot.degrees else found
                angle = symbol.startswith(("theta", "mu"))
                scale = 1.0 if angle else study.size
                for index, number in ((0, found), (2, textbook[symbol])):
                    error = abs(mpmath.mpf(number) - right)
                    if angle:
                        error = abs(error - 2 * mpmath.pi * mpmath.nint(error / (2 * mpmath.pi)))
                    worst[index] = max(worst[index], float(error / scale))
                worst[1] = max(worst[1], float(floor[symbol] / scale))
            rows.append((value - study.centre, *worst))
    return rows


def _floor(study, numbers, theta, exact):
    """What each result changes by, at most, when one input is off by half a unit in its last place."""
    worst = dict.fromkeys(exact, mpmath.mpf(0))
    for symbol in (*numbers, "theta"):
        for sign in (1, -1):
            off = 1 + sign * mpmath.mpf(HALF_ULP)
            changed = dict(numbers)
            angle = theta
            if symbol == "theta":
                angle = theta * off
            else:
                changed[symbol] = numbers[symbol] * off
            for name, value in study.exact(mpmath, changed, angle).items():
                worst[name] = max(worst[name], abs(value - exact[name]))
    return worst


def main() -> None:
    """Print a table for each mechanism."""
    for study in studies():
        print(f"\n### {study.name}\n")
        print("| from the dead centre | error | floor | textbook's acos |")
        print("| ---: | ---: | ---: | ---: |")
        for distance, error, floor, textbook in measure(study):
            print(f"| {distance:.0e}° | {error:.1e} | {floor:.1e} | {textbook:.1e} |")


if __name__ == "__main__":
    np.seterr(all="ignore")
    main()
