"""How many summaries a second a session answers: a workbook kept open, one dimension set, one cell of the first sheet read.

    python benchmarks/bench_session.py [--seconds 2] [--check]

Every answer follows from another length, so nothing of it is known before. "a full recalculation" reads, computes and asks
anew. CPU time, the best of all rounds. --check fails where a goal is missed.
"""

from __future__ import annotations

import argparse
import time
from itertools import count
from pathlib import Path

import mechsheet

ROOT = Path(__file__).parent.parent / "generated"
ASKED = {
    "four-bar.xlsx": ("a1", ("mu_min", "swing", "verdict", "Positions!P4:Q28")),
    "slider-crank.xlsx": ("a2", ("verdict", "Positions!A4:H28")),
    "jansen.xlsx": ("j_1", ("step_length", "verdict")),
}
"""Workbook -> the dimension that is set, and what is read."""
ROUND, SETTLED = 50, 20
"""Answers of a round; answers before anything is measured, after which all code is made."""
GOALS = {("four-bar.xlsx", "mu_min"): 500, ("four-bar.xlsx", "swing"): 500}
"""Answers a second on the machine of docs/speed.md."""


def answers_a_second(name: str, dimension: str, asked: str, seconds: float) -> tuple[float, float]:
    """Of a session, and of full recalculations."""
    path = ROOT / name
    book = mechsheet.open_book(path)
    length = book.number(dimension)
    steps = count(1)

    def answer() -> None:
        book[dimension] = length * (1 + 1e-6 * next(steps))
        book[asked]

    for _ in range(SETTLED):
        answer()
    best, until = float("inf"), time.process_time() + seconds
    while time.process_time() < until:
        start = time.process_time()
        for _ in range(ROUND):
            answer()
        best = min(best, (time.process_time() - start) / ROUND)
    start = time.process_time()
    mechsheet.recalc(path, {dimension: length * 1.001})
    return 1 / best, 1 / (time.process_time() - start)


def main() -> None:
    """Print the table; with --check, fail where a goal is missed."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=2.0, help="CPU time for each line")
    parser.add_argument("--check", action="store_true", help="fail where a goal is missed")
    options = parser.parse_args()
    print("| workbook | set | read | answers a second | full recalculations |\n|---|---|---|--:|--:|")
    missed = []
    for name, (dimension, cells) in ASKED.items():
        for asked in cells:
            found, full = answers_a_second(name, dimension, asked, options.seconds)
            print(f"| {name} | {dimension} | {asked} | {found:,.0f} | {full:.0f} |")
            if found < GOALS.get((name, asked), 0):
                missed.append(f"{name} {asked}")
    if options.check and missed:
        raise SystemExit(f"goals missed: {', '.join(missed)}")


if __name__ == "__main__":
    main()
