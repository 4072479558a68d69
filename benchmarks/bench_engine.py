"""How fast the engine recalculates a four-bar's sheet, as multiples of the same thing written by hand in numpy.

    python benchmarks/bench_engine.py [--rows 361,3601,36001,361000] [--check]

The book has the columns of a built workbook: the driver by start + n*step, the diagonal, its direction made continuous
by a column that counts turns, the area of the triangle with #N/A where it does not close, the angles, the coupler point,
degrees. Then a two-way table: one long formula, an adjustable pump's lever over the crank's angle (down)
and the stroke setting (across). Both sides run in turn, in one process; the figure is the ratio of the best times. "a_2
changed" is a session in which one dimension is set and the last column read. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from itertools import count

import numpy as np

from livesheet.engine import compile_book
from livesheet.formula.book import Book, BookBuilder
from livesheet.formula.parser import parse_formula
from mechsheet.library.session import Session

DIMENSIONS = {
    "a_1": 70.0,
    "a_2": 35.0,
    "a_3": 62.3,
    "a_4": 56.0,
    "b_3": 126.6,
    "gamma_3": 0.62,
    "mode": 1.0,
    "tol": 1e-10,
}
GOALS = {361: 5.0}
GOAL = 7.0
"""Most of the time goes into the column of turns, a loop over the rows where the code by hand has `cumsum`."""
TWO_WAY = 1.2
FIRST = 3  # the table's first row, counted from 0: row 4 of the sheet

COLUMNS = (
    "start+A4*step",  # B   driver [deg]
    "RADIANS(B4)",  # C
    "a_2*COS(C4)",  # D   x of A
    "a_2*SIN(C4)",  # E   y of A
    "D4-a_1",  # F
    "SQRT(F4^2+E4^2)",  # G   s
    "ATAN2(F4,E4)",  # H   direction, one turn
    "",  # I   turns
    "H4+2*PI()*I4",  # J   phi
    "IF(OR(G4<tol,MIN(a_3+a_4-G4,G4-ABS(a_3-a_4))<-tol),NA(),"
    "SQRT(MAX(0,(a_3+a_4+G4)*(a_3+a_4-G4)*(G4+a_3-a_4)*(G4-a_3+a_4)))/4)",  # K   area
    "ATAN2(a_4^2+G4^2-a_3^2,4*K4)",  # L   psi
    "ATAN2(a_3^2+a_4^2-G4^2,4*K4)",  # M   mu
    "J4-mode*L4",  # N   theta14
    "N4-mode*M4",  # O   theta13
    "D4+b_3*COS(O4+gamma_3)",  # P   x of C
    "E4+b_3*SIN(O4+gamma_3)",  # Q   y of C
    "DEGREES(N4)",  # R
    "DEGREES(O4)",  # S
)


def four_bar(rows: int) -> Book:
    """The book."""
    builder = BookBuilder()
    mechanism = builder.sheet("Mechanism")
    for row, (name, value) in enumerate({**DIMENSIONS, "start": 0.0, "step": 360.0 / (rows - 1)}.items()):
        mechanism.constant(row, 0, name)
        mechanism.constant(row, 1, value)
        builder.name(name, parse_formula(f"Mechanism!$B${row + 1}"))
    positions = builder.sheet("Positions")
    positions.constants.extend(FIRST, 0, [float(n) for n in range(rows)])
    for col, text in enumerate(COLUMNS, 1):
        if text:
            positions.block(FIRST, col, rows, 1, parse_formula(text))
    positions.constant(FIRST, 8, 0.0)
    positions.block(FIRST + 1, 8, rows - 1, 1, parse_formula("I4+ROUND((H4-H5)/(2*PI()),0)"))
    return builder.build()


def by_hand(rows: int, a_2: float = DIMENSIONS["a_2"]) -> tuple[np.ndarray, ...]:
    """The same columns as one would write them."""
    a_1, a_3, a_4, b_3, gamma_3, mode, tol = (
        DIMENSIONS[k] for k in ("a_1", "a_3", "a_4", "b_3", "gamma_3", "mode", "tol")
    )
    driver = 0.0 + np.arange(float(rows)) * (360.0 / (rows - 1))
    theta12 = np.radians(driver)
    x_a, y_a = a_2 * np.cos(theta12), a_2 * np.sin(theta12)
    x = x_a - a_1
    s = np.sqrt(x**2 + y_a**2)
    raw = np.arctan2(y_a, x)
    turns = np.zeros(rows)
    np.cumsum(np.round((raw[:-1] - raw[1:]) / (2 * np.pi)), out=turns[1:])
    phi = raw + 2 * np.pi * turns
    open_ = (s < tol) | (np.minimum(a_3 + a_4 - s, s - abs(a_3 - a_4)) < -tol)
    product = (a_3 + a_4 + s) * (a_3 + a_4 - s) * (s + a_3 - a_4) * (s - a_3 + a_4)
    area = np.where(open_, np.nan, np.sqrt(np.maximum(0, product)) / 4)
    psi = np.arctan2(4 * area, a_4**2 + s**2 - a_3**2)
    mu = np.arctan2(4 * area, a_3**2 + a_4**2 - s**2)
    theta14 = phi - mode * psi
    theta13 = theta14 - mode * mu
    x_c, y_c = x_a + b_3 * np.cos(theta13 + gamma_3), y_a + b_3 * np.sin(theta13 + gamma_3)
    return (driver, theta12, x_a, y_a, x, s, raw, turns, phi, area, psi, mu, theta14, theta13, x_c, y_c,
            np.degrees(theta14), np.degrees(theta13))  # fmt: skip


CRANK, LEVER, ROD, BASE, OUT = 20.0, 45.0, 70.0, 60.0, 25.0
ACROSS = (5.0, 8.0, 11.0, 14.0, 17.0, 20.0)


def pump_formula() -> str:
    """Row 8, column B: the angle stands in column A, the setting in row 7."""
    x, y = "Crank*COS(RADIANS($A8))+Base", "Crank*SIN(RADIANS($A8))-B$7"
    square = f"(({x})^2+({y})^2)"
    s = f"SQRT{square}"
    sides = f"(Rod+Lever+{s})*(Rod+Lever-{s})*({s}+Rod-Lever)*({s}-Rod+Lever)"
    area = f"IF(MIN(Rod+Lever-{s},{s}-ABS(Rod-Lever))<-tol,NA(),SQRT(MAX(0,{sides}))/4)"
    return f"Out*COS(ATAN2({x},{y})-mode*ATAN2(Lever^2+{square}-Rod^2,4*{area})+3*PI()/2)-Base"


def pump(rows: int) -> Book:
    """The book with the two-way table."""
    builder = BookBuilder()
    sheet = builder.sheet("Table")
    names = {"Crank": CRANK, "Lever": LEVER, "Rod": ROD, "Base": BASE, "Out": OUT, "mode": 1.0, "tol": 1e-10}
    for col, (name, value) in enumerate(names.items()):
        sheet.constant(0, col, value)
        builder.name(name, parse_formula(f"Table!${chr(65 + col)}$1"))
    sheet.constants.extend(7, 0, [360.0 * n / (rows - 1) for n in range(rows)])
    for col, setting in enumerate(ACROSS, 1):
        sheet.constant(6, col, setting)
    sheet.block(7, 1, rows, len(ACROSS), parse_formula(pump_formula()))
    return builder.build()


def pump_by_hand(rows: int) -> np.ndarray:
    """The same, each angle's sine and cosine once, as one would write it."""
    theta = np.radians(360.0 * np.arange(float(rows)) / (rows - 1))[:, None]
    x, y = CRANK * np.cos(theta) + BASE, CRANK * np.sin(theta) - np.array(ACROSS)
    square = x**2 + y**2
    s = np.sqrt(square)
    product = (ROD + LEVER + s) * (ROD + LEVER - s) * (s + ROD - LEVER) * (s - ROD + LEVER)
    open_ = np.minimum(ROD + LEVER - s, s - abs(ROD - LEVER)) < -1e-10
    area = np.where(open_, np.nan, np.sqrt(np.maximum(0, product)) / 4)
    angle = np.arctan2(y, x) - np.arctan2(4 * area, LEVER**2 + square - ROD**2)
    found: np.ndarray = OUT * np.cos(angle + 3 * np.pi / 2) - BASE
    return found


def two_way(rows: int, seconds: float) -> bool:
    """Prints the line of the two-way table; whether its goal is met."""
    plan = compile_book(pump(rows))
    plan.evaluate()
    values, expected = plan.evaluate(), pump_by_hand(rows)
    worst = max(
        float(np.max(np.abs(values.arrays("Table", col, 7, rows + 6)[0] - expected[:, col - 1])))
        for col in range(1, len(ACROSS) + 1)
    )
    hand, ours = best_of([lambda: pump_by_hand(rows), plan.evaluate], seconds)
    times = f"{rows:>6}x{len(ACROSS)} {hand * 1e6:>9.1f} {ours * 1e6:>10.1f} {ours / hand:>6.2f}"
    print(f"{times} {TWO_WAY:>5.1f}{'':>15}  {worst:.1e}")
    return ours / hand <= TWO_WAY and worst < 1e-9


def best_of(sides: list[Callable[[], object]], seconds: float) -> list[float]:
    """The best CPU time of each, taken in turn until the time is up."""
    best = [float("inf")] * len(sides)
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        for index, side in enumerate(sides):
            start = time.process_time()
            side()
            best[index] = min(best[index], time.process_time() - start)
    return best


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", default="361,3601,36001,361000")
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    missed = False
    print(
        f"{'rows':>8} {'numpy us':>10} {'engine us':>10} {'ratio':>6} {'goal':>5}  {'a_2 changed':>11}  worst difference"
    )
    for rows in map(int, options.rows.split(",")):
        plan = compile_book(four_bar(rows))
        plan.evaluate()
        values, expected = plan.evaluate(), by_hand(rows)
        worst = max(
            float(np.max(np.abs(values.arrays("Positions", col, FIRST, FIRST + rows - 1)[0] - column)))
            for col, column in enumerate(expected, 1)
        )
        session = Session(four_bar(rows))
        session["a_2"] = 33.0
        session.array(f"Positions!S{FIRST + 1}")
        turn = count()

        def change(session=session, turn=turn) -> None:
            session["a_2"] = 34.0 + 0.01 * (next(turn) % 9)
            session.array(f"Positions!S{FIRST + 1}")

        hand, ours, changed = best_of([lambda rows=rows: by_hand(rows), plan.evaluate, change], options.seconds)
        ratio, goal = ours / hand, GOALS.get(rows, GOAL)
        missed |= ratio > goal or worst > 1e-9
        times = f"{rows:>8} {hand * 1e6:>10.1f} {ours * 1e6:>10.1f}"
        print(f"{times} {ratio:>6.2f} {goal:>5.1f} {changed * 1e6:>9.1f} us  {worst:.1e}")
    missed |= not two_way(3_601, options.seconds)
    return int(options.check and missed)


if __name__ == "__main__":
    sys.exit(main())
