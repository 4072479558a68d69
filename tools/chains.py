"""Links that must be solved all at once, held against what ought to be: the figures of docs/proof.md.

python tools/chains.py leaps [FIRST LAST]    dimensions changed at random in workbooks: does one leap to another assembly?
python tools/chains.py rates [FIRST LAST]    velocities, accelerations and joint forces against the reference
python tools/chains.py drawn [FIRST LAST]    positions of linkages that another generator draws, over a turn
python tools/chains.py engine [FIRST LAST]   the same in built workbooks, recalculated by the engine

FIRST and LAST are seeds. Prints a line for each linkage, and the sums.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parent.parent
TESTS = (".", "sheet", "sheet/table", "dynamics", "reference")
sys.path[:0] = [str(ROOT / "src"), *(str(ROOT / "tests" / name) for name in TESTS)]

from test_chains import mechanism_of, worst_of  # noqa: E402
from test_start_table import judged, text_of  # noqa: E402

from chains_compared import Compared, compared  # noqa: E402
from drawn_chains import Drawn  # noqa: E402
from judging import judged as judged_by_engine  # noqa: E402
from mechsheet.description import loads  # noqa: E402
from mechsheet.diagnostics import MechsheetError  # noqa: E402

CHANGES, STEP, MOST_ROWS, TRIES = 150, 5.0, 481, 4


def leaps(first: int, last: int) -> Iterator[str]:
    """So many random changes of each of some workbooks."""
    total, amiss = np.zeros(4, int), []
    for seed in range(first, last):
        counts, silent = judged(text_of(seed), seed, CHANGES)
        total += counts
        amiss += silent
        yield f"{seed}: {counts.tolist()}, {len(silent)} silent"
    fine, ended, nowhere, alarms = total
    yield (
        f"{fine + ended + nowhere} changes: {fine} begin in the assembly described ({alarms} of them told to be doubtful), "
        f"{ended} in another and told, {nowhere} nowhere; silent leaps: {amiss or 0}"
    )


def rates(first: int, last: int) -> Iterator[str]:
    """Rates and forces of some linkages of class III and IV."""
    count = rows = 0
    largest = np.zeros(2)
    for seed in range(first, last):
        try:
            worst, compared_rows = worst_of(mechanism_of(seed))
        except MechsheetError as error:
            yield f"{seed}: {error.faults[0].message}"
            continue
        count, rows, largest = count + 1, rows + compared_rows, np.maximum(largest, worst)
        yield f"{seed}: {worst}, {compared_rows} rows"
    yield f"{count} linkages, {rows} rows: rates at most {largest[0]:.0e}, forces {largest[1]:.0e}"


def drawn(first: int, last: int) -> Iterator[str]:
    """Columns of positions of drawn linkages against the reference."""
    count = rows = ends = told = refused = 0
    worst = gap = 0.0
    for seed in range(first, last):
        linkage = Drawn(seed)
        try:
            found, step = over_a_turn(linkage)
        except MechsheetError as error:
            refused += 1
            yield f"{seed}: {linkage.shape}: {error.faults[0].message}"
            continue
        count, rows, ends, told = count + 1, rows + found.rows, ends + found.ends, told + found.told
        worst, gap = max(worst, found.worst), max(gap, found.gap)
        amiss = "".join(f", {words}" for words in found.amiss)
        yield f"{seed}: {linkage.shape}, step {step:g}, {found.rows} rows, {found.worst:.0e}, {found.ends} ends{amiss}"
    yield (
        f"{count} linkages, {rows} rows in both, at most {worst:.0e} apart; all that is shown closes to {gap:.0e}; "
        f"{ends} limits, {told} losses told; {refused} refused in words"
    )


def over_a_turn(linkage: Drawn) -> tuple[Compared, float]:
    """In steps of `STEP`, or in the step that is said to work. Raises MechsheetError for what is no mechanism."""
    step = STEP
    for _ in range(TRIES):
        try:
            return compared(linkage.text(min(round(360 / step) + 1, MOST_ROWS), step)), step
        except MechsheetError as error:
            works = re.search(r"a step of ([\d.e-]+) works", str(error))
            if works is None:
                raise
            step = float(works[1])
    raise ValueError("a step that was said to work does not")


def engine(first: int, last: int) -> Iterator[str]:
    """Built workbooks of drawn linkages, recalculated, against the reference."""
    count = cells = 0
    worst = 0.0
    for seed in range(first, last):
        try:
            comparison = judged_by_engine(loads(Drawn(seed).text(25, STEP)))
        except MechsheetError as error:
            yield f"{seed}: {error.faults[0].message}"
            continue
        agrees = "agrees" if comparison.agrees else "DIFFERS"
        count, cells, worst = count + comparison.agrees, cells + comparison.cells, max(worst, comparison.worst)
        yield f"{seed}: {agrees}, {comparison.cells} values, {comparison.worst:.0e}"
    yield f"{count} workbooks agree, {cells} values, at most {worst:.0e}"


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    proofs = {"leaps": (leaps, 102, 136), "rates": (rates, 0, 120), "drawn": (drawn, 0, 300), "engine": (engine, 0, 24)}
    parser.add_argument("what", choices=proofs)
    parser.add_argument("seeds", nargs="*", type=int)
    given = parser.parse_args()
    proof, first, last = proofs[given.what]
    if given.seeds:
        first, last = given.seeds
    for line in proof(first, last):
        print(line, flush=True)


if __name__ == "__main__":
    main()
