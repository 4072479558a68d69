"""What velocities and forces cost: a four-bar with three masses and a load on its coupler.

    python benchmarks/bench_forces.py [--rows 361,36001] [--seconds 4] [--check]

recalculated  the tables of positions, velocities and forces of the built workbook, by the engine, over the same columns
              written by hand in numpy
solved        the equations in numpy with velocities over the positions alone; and with forces, too
built         CPU of `mechsheet build` with velocities and forces over that of building without (25 rows)
again         the same within a process that has built before, where loading Python and the package no longer counts

In turn, the best of all runs. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from livesheet.engine import compile_book
from livesheet.formula.book import Book, BookBuilder
from livesheet.formula.nodes import CellRef
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.sweep import sweep
from mechsheet.library.building import build
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.plan import Plan

GOALS = {"recalculated": 1.3, "velocities": 4.0, "built": 1.3}
GOAL_ROWS = 36_001
TABLES = ("positions", "rates", "forces")
MASSES = {
    "crank": "mass = 0.8\ncenter = [17.5, 2]\ninertia = 2e-4",
    "coupler": "mass = 1.5\ncenter = [31, 8]\ninertia = 9e-4",
    "rocker": "mass = 1.2\ncenter = [28, 1]\ninertia = 6e-4",
}
LOAD = '[dynamics]\ngravity = 9.81\n[[loads]]\nname = "P"\nlink = "coupler"\npoint = "C"\nforce = [4, -20]\n'


def four_bar(kind: str, rows: int) -> str:
    """The template with "positions" alone, with "rates" too, or with "forces" too."""
    text = re.sub(r"(?m)^(speed|acceleration) *=.*$", "", template_text("four-bar").partition("[[charts]]")[0])
    text = re.sub(r"(?m)^step *=.*$", f"step = {360 / (rows - 1)!r}", text)
    if kind != "positions":
        text = text.replace("[driver]", "[driver]\nspeed = 30\nacceleration = 5")
    if kind == "forces":
        for link, keys in MASSES.items():
            text = text.replace(f"[links.{link}]", f"[links.{link}]\n{keys}")
        text += LOAD
    return text


def tables_of(rows: int) -> tuple[Book, Plan]:
    """The tables of the built workbook and the cells that they read, without what is said of them."""
    mechanism = loads(four_bar("forces", rows))
    workbook, plan = lay_out(mechanism, solve(mechanism))
    builder = BookBuilder()
    first = builder.sheet(plan.main)
    spots = (*plan.at.spots.values(), plan.places.start, plan.places.step)
    known = {spot for spot in spots if spot is not None and spot.sheet == plan.main}
    cells = {(spot.row, spot.col) for spot in known}
    sheet = workbook.sheet(plan.main)
    for cell in sheet.cells:
        if (cell.row, cell.col) in cells and isinstance(cell.content, float):
            first.constant(cell.row, cell.col, cell.content)
    derived = plan.blocks["derived"].rows.values()
    for fill in sheet.fills:
        if fill.row in derived and fill.col == 1:
            first.block(fill.row, fill.col, 1, 1, fill.formula)
    wrong = plan.places.inputs
    first.constant(wrong.row, wrong.col, 0.0)
    for name in workbook.names:
        if (name.row, name.col) in cells | {(wrong.row, wrong.col)} and name.sheet == plan.main:
            builder.name(name.name, CellRef(name.row, name.col, True, True, name.sheet))
    for key, columns in zip(TABLES, (plan.columns, plan.rates, plan.forces), strict=True):
        table = builder.sheet(plan.at.titles[key])
        wanted = {column.col for column in columns if column.kind != "status"}
        sheet = workbook.sheet(plan.at.titles[key])
        for cell in sheet.cells:  # the headings that the first row reads
            if cell.row == plan.at.first - 1 and cell.col in wanted and cell.content is not None:
                table.constant(cell.row, cell.col, cell.value)
        for fill in sheet.fills:
            if fill.row >= plan.at.first and fill.col in wanted:
                table.block(fill.row, fill.col, fill.rows, fill.cols, fill.formula)
    return builder.build(), plan


def inputs() -> dict[str, float]:
    """The dimensions, masses and the load."""
    return dimension_values(loads(four_bar("forces", 25)))


def by_hand(rows: int, given: Mapping[str, float]) -> dict[str, np.ndarray]:
    """The same columns as one would write them, with the same care: limits, no acos, no jumps, dead centres."""
    a1, a2, a3, a4, b3, gamma3 = (given[name] for name in ("a1", "a2", "a3", "a4", "b3", "gamma3"))
    w, e, g, metre = given["omega12"], given["alpha12"], given["g"], 0.001
    theta12 = np.radians(np.arange(float(rows)) * (360 / (rows - 1)))
    ax, ay = a2 * np.cos(theta12), a2 * np.sin(theta12)
    sx = ax - a1
    s = np.sqrt(sx * sx + ay * ay)
    phi = np.arctan2(ay, sx)
    turns = np.zeros(rows)
    np.cumsum(np.round((phi[:-1] - phi[1:]) / (2 * np.pi)), out=turns[1:])
    phi = phi + 2 * np.pi * turns
    open_ = (s < 1e-10) | (np.minimum(a3 + a4 - s, s - abs(a3 - a4)) < -1e-10)
    product = (a3 + a4 + s) * (a3 + a4 - s) * (s + a3 - a4) * (s - a3 + a4)
    area = np.where(open_, np.nan, np.sqrt(np.maximum(0.0, product)))
    theta14 = phi - np.arctan2(area, a4 * a4 + s * s - a3 * a3)
    theta13 = theta14 - np.arctan2(area, a3 * a3 + a4 * a4 - s * s)
    bx, by = a1 + a4 * np.cos(theta14), a4 * np.sin(theta14)
    cx, cy = ax + b3 * np.cos(theta13 + gamma3), ay + b3 * np.sin(theta13 + gamma3)
    # influence coefficients
    px, py, qx, qy = bx - ax, by - ay, bx - a1, by
    d = px * qy - py * qx
    d = np.where(np.abs(d) < 1e-5 * a3 * a4, np.nan, d)
    t3, t4 = (ay * qx - ax * qy) / d, (ay * px - ax * py) / d
    kx, ky = ax + t3 * t3 * px - t4 * t4 * qx, ay + t3 * t3 * py - t4 * t4 * qy
    tt3, tt4 = (kx * qx + ky * qy) / d, (kx * px + ky * py) / d
    w3, e3, w4, e4 = t3 * w, tt3 * w * w + t3 * e, t4 * w, tt4 * w * w + t4 * e
    cx1, cy1 = -ay - t3 * (cy - ay), ax + t3 * (cx - ax)
    cx2 = -ax - tt3 * (cy - ay) - t3 * t3 * (cx - ax)
    cy2 = -ay + tt3 * (cx - ax) - t3 * t3 * (cy - ay)
    v = abs(w) * np.sqrt(cx1 * cx1 + cy1 * cy1)
    acx, acy = w * w * cx2 + e * cx1, w * w * cy2 + e * cy1
    a = np.sqrt(acx * acx + acy * acy)
    # what acts on each link
    found: dict[str, np.ndarray] = {}
    aax, aay = -e * ay - w * w * ax, e * ax - w * w * ay
    for n, x, y, theta, turning, rate, from_x, from_y in (
        (3, ax, ay, theta13, w3, e3, aax, aay), (4, a1, 0.0, theta14, w4, e4, 0.0, 0.0),
        (2, 0.0, 0.0, theta12, w, e, 0.0, 0.0),
    ):  # fmt: skip
        u, h, m = given[f"x_G{n}"], given[f"y_G{n}"], given[f"m_{n}"]
        c, i = np.cos(theta), np.sin(theta)
        gx, gy = x + u * c - h * i, y + u * i + h * c
        rx, ry = gx - x, gy - y
        gax, gay = from_x - rate * ry - turning * turning * rx, from_y + rate * rx - turning * turning * ry
        fx, fy = -m * metre * gax, -m * (g + metre * gay)
        found |= {f"G{n}.x": gx, f"G{n}.y": gy, f"G{n}.ax": gax, f"G{n}.ay": gay, f"I{n}x": fx, f"I{n}y": fy}
        found[f"I{n}m"] = metre * (rx * fy - ry * fx) - given[f"J_{n}"] * rate
    lx, ly = given["P_x"], given["P_y"]
    s3x, s3y = found["I3x"] + lx, found["I3y"] + ly
    m3, m4 = found["I3m"] + metre * ((cx - ax) * ly - (cy - ay) * lx), found["I4m"]
    fx, fy = (m3 * qx + m4 * px) / (d * metre), (m3 * qy + m4 * py) / (d * metre)
    f23x, f23y = fx - s3x, fy - s3y
    f14x, f14y = -fx - found["I4x"], -fy - found["I4y"]
    f12x, f12y = f23x - found["I2x"], f23y - found["I2y"]
    torque = -found["I2m"] + metre * (ax * f23y - ay * f23x)
    work = lx * cx1 + ly * cy1
    for n, turning, base_x, base_y in ((3, t3, ax, ay), (4, t4, a1, 0.0), (2, 1.0, 0.0, 0.0)):
        moved_x, moved_y = (-ay, ax) if n == 3 else (0.0, 0.0)
        moved_x, moved_y = (
            moved_x - turning * (found[f"G{n}.y"] - base_y),
            moved_y + turning * (found[f"G{n}.x"] - base_x),
        )
        work = work + found[f"I{n}x"] * moved_x + found[f"I{n}y"] * moved_y
    couples = given["J_2"] * e + given["J_3"] * e3 * t3 + given["J_4"] * e4 * t4
    return found | {
        "theta13": theta13, "theta14": theta14, "B.x": bx, "B.y": by, "D": d, "theta13.d": t3, "theta14.d": t4, "k_x": kx,
        "k_y": ky, "theta13.dd": tt3, "theta14.dd": tt4, "omega13": w3, "alpha13": e3, "omega14": w4, "alpha14": e4,
        "C.x.d": cx1, "C.y.d": cy1, "C.x.dd": cx2, "C.y.dd": cy2, "C.v": v, "C.a": a, "F34.x": fx, "F34.y": fy,
        "F34": np.sqrt(fx * fx + fy * fy), "F23.x": f23x, "F23.y": f23y, "F23": np.sqrt(f23x * f23x + f23y * f23y),
        "F14.x": f14x, "F14.y": f14y, "F14": np.sqrt(f14x * f14x + f14y * f14y), "F12.x": f12x, "F12.y": f12y,
        "F12": np.sqrt(f12x * f12x + f12y * f12y), "T12": torque, "T12.work": couples - metre * work,
    }  # fmt: skip


def worst_of(rows: int, values: object, plan: Plan) -> float:
    """The largest difference of the engine's columns from those by hand, as a part of the column's largest number."""
    worst = 0.0
    for symbol, column in by_hand(rows, inputs()).items():
        if symbol in plan.at.spots:
            spot = plan.at.spots[symbol]
            cells = values.arrays(spot.sheet, spot.col, plan.at.first, plan.at.last)[0]  # type: ignore[attr-defined]
            ours = np.radians(cells) if spot.degrees else cells
            worst = max(worst, float(np.max(np.abs(ours - column)) / max(1e-9, np.max(np.abs(column)))))
    return worst


def swept(kind: str, rows: int) -> Callable[[], object]:
    """The equations evaluated over one turn."""
    mechanism = loads(four_bar(kind, rows))
    equations, driver = solve(mechanism), np.linspace(0.0, 2 * np.pi, rows)
    return lambda: sweep(mechanism, equations, driver)


def building(kind: str, folder: str) -> Callable[[], object]:
    """The workbook built from its text."""
    text = four_bar(kind, 25)
    return lambda: build(loads(text), f"{folder}/{kind}.xlsx", force=True)


def commanded(kind: str, folder: str) -> Callable[[], object]:
    """The workbook built from its file by the command, in a process of its own."""
    source = Path(folder) / f"{kind}.toml"
    source.write_text(four_bar(kind, 25), encoding="utf-8")
    command = [sys.executable, "-m", "mechsheet", "build", str(source), "-o", f"{folder}/{kind}.xlsx", "--force"]
    return lambda: subprocess.run(command, check=True, capture_output=True)


def of_children() -> float:
    """CPU time of all processes started here that have ended [s]."""
    used = os.times()
    return used.children_user + used.children_system


def best_cpu(
    sides: list[Callable[[], object]], seconds: float, clock: Callable[[], float] = time.process_time
) -> list[float]:
    """The least CPU time of each, taken in turn until the time is up."""
    best = [float("inf")] * len(sides)
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        for index, side in enumerate(sides):
            start = clock()
            side()
            best[index] = min(best[index], clock() - start)
    return best


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", default="361,36001")
    parser.add_argument("--seconds", type=float, default=4.0)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    missed = []
    for rows in map(int, options.rows.split(",")):
        book, plan = tables_of(rows)
        compiled = compile_book(book)
        compiled.evaluate()
        worst = worst_of(rows, compiled.evaluate(), plan)
        given = inputs()
        hand, ours = best_cpu([lambda rows=rows, given=given: by_hand(rows, given), compiled.evaluate], options.seconds)
        places, rates, forces = best_cpu([swept(kind, rows) for kind in TABLES], options.seconds)
        print(f"{rows} rows")
        print(
            f"  recalculated  {ours / hand:5.2f} of numpy by hand ({hand * 1e3:.2f} ms), worst difference {worst:.1e}"
        )
        print(f"  solved        {rates / places:5.2f} of the positions' {places * 1e3:.2f} ms with velocities")
        print(f"                {forces / places:5.2f} with velocities and forces")
        if rows >= GOAL_ROWS:
            missed += ["recalculated"] * (ours > GOALS["recalculated"] * hand or worst > 1e-9)
            missed += ["velocities"] * (rates > GOALS["velocities"] * places)
    kinds = ("positions", "forces")
    with tempfile.TemporaryDirectory() as folder:
        without, within = best_cpu([commanded(kind, folder) for kind in kinds], 4 * options.seconds, of_children)
        sides = [building(kind, folder) for kind in kinds]
        for side in sides:
            side()  # modules are loaded by the first
        first, second = best_cpu(sides, 4 * options.seconds)
    print(f"built           {within / without:5.2f} of the CPU without velocities and forces ({without * 1e3:.0f} ms)")
    print(f"again           {second / first:5.2f} ({first * 1e3:.0f} ms)")
    missed += ["built"] * (within > GOALS["built"] * without)
    print("goals missed: " + (", ".join(missed) or "none"))
    return int(options.check and bool(missed))


if __name__ == "__main__":
    sys.exit(main())
