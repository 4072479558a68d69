"""How fast the equations are evaluated over a sweep of the four-bar, beside the same columns written by hand in numpy.

    python benchmarks/bench_sweep.py [--rows 361,3601,36001,361000] [--seconds 3] [--check]

"functions" is what no numpy program can do without: the sines, cosines, arc tangents and roots alone. All three run in
turn in one process; CPU time, the best of all runs. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import sys
import time

import numpy as np

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep

MECHANISM = loads(template_text("four-bar"), "four-bar.toml")
EQUATIONS = solve(MECHANISM)
GOAL, GOAL_ROWS = 10e-3, 36_001
"""Seconds for so many rows."""
RATIO = 2.6
"""To what is written by hand, from so many rows on; below that the steps in Python count. By hand the functions are numpy's,
which use the processor's own; here they give the same bits on every machine."""


def driver(rows: int) -> np.ndarray:
    """One turn over all rows."""
    return np.linspace(0.0, 2 * np.pi, rows)


def ours(theta12: np.ndarray) -> dict[str, np.ndarray]:
    return sweep(MECHANISM, EQUATIONS, theta12)


def by_hand(theta12: np.ndarray) -> dict[str, np.ndarray]:
    """The same columns as one would write them, with the same care: limits, no acos, no jumps."""
    inputs = dimension_values(MECHANISM)
    a1, a2, a3, a4, b3, gamma3 = (inputs[name] for name in ("a1", "a2", "a3", "a4", "b3", "gamma3"))
    mode = EQUATIONS.groups[0].mode_value
    x_a, y_a = a2 * np.cos(theta12), a2 * np.sin(theta12)
    x = x_a - a1
    s = np.sqrt(x * x + y_a * y_a)
    phi = np.arctan2(y_a, x)
    turns = np.zeros(len(phi))
    np.cumsum(np.round((phi[:-1] - phi[1:]) / (2 * np.pi)), out=turns[1:])
    phi = phi + 2 * np.pi * turns
    product = (a3 + a4 + s) * (a3 + a4 - s) * (s + a3 - a4) * (s - a3 + a4)
    tol = 1e-12 * max(a1, a2, a3, a4)
    apart = (s < tol) | (np.minimum(a3 + a4 - s, s - abs(a3 - a4)) < -tol)
    area = np.where(apart, np.nan, np.sqrt(np.maximum(0.0, product)))
    psi = np.arctan2(area, a4 * a4 + s * s - a3 * a3)
    mu_1 = np.arctan2(area, a3 * a3 + a4 * a4 - s * s)
    theta14 = phi - mode * psi
    theta13 = theta14 - mode * mu_1
    return {
        "A.x": x_a, "A.y": y_a, "s_x": x, "s": s, "phi": phi, "psi": psi, "mu_1": mu_1, "theta14": theta14,
        "B.x": a1 + a4 * np.cos(theta14), "B.y": a4 * np.sin(theta14), "theta13": theta13,
        "C.x": x_a + b3 * np.cos(theta13 + gamma3), "C.y": y_a + b3 * np.sin(theta13 + gamma3), "mu": theta14 - theta13,
    }  # fmt: skip


def functions(theta12: np.ndarray) -> None:
    for _ in range(3):
        y, x = np.sin(theta12), np.cos(theta12)
        np.arctan2(y, x)
    for _ in range(2):
        np.sqrt(theta12)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--rows", default="361,3601,36001,361000")
    parser.add_argument("--seconds", type=float, default=3.0)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    missed = False
    print(f"{'rows':>8} {'functions ms':>13} {'numpy ms':>9} {'sweep ms':>9} {'ratio':>6}  worst difference")
    for rows in map(int, options.rows.split(",")):
        theta12 = driver(rows)
        found, expected = ours(theta12), by_hand(theta12)
        worst = max(float(np.max(np.abs(found[name] - column))) for name, column in expected.items())
        best = [float("inf")] * 3
        end = time.perf_counter() + options.seconds
        while time.perf_counter() < end:
            for index, side in enumerate((functions, by_hand, ours)):
                start = time.process_time()
                side(theta12)
                best[index] = min(best[index], time.process_time() - start)
        least, hand, swept = best
        missed |= worst > 1e-9 or (rows == GOAL_ROWS and swept > GOAL) or (rows >= GOAL_ROWS and swept > RATIO * hand)
        print(
            f"{rows:>8} {least * 1e3:>13.3f} {hand * 1e3:>9.3f} {swept * 1e3:>9.3f} {swept / hand:>6.2f}  {worst:.1e}"
        )
    return int(options.check and missed)


if __name__ == "__main__":
    sys.exit(main())
