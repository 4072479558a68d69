"""How build time grows with groups and rows: seconds per group and per row stay level when growth is linear.

Each line is a whole build in this process (solve, lay out, compute, write .xlsx), CPU seconds, best of two.
"""

import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

from mechsheet.description import load, loads
from mechsheet.library.building import build
from random_mechanisms import Grower

ROOT = Path(__file__).parent.parent
DYADS = (2, 5, 10, 20, 40)
DYADS_ROWS = 361
ROWS = (361, 3_601, 36_001)


def cpu(mechanism, folder):
    """CPU seconds of a build, best of two."""
    best = float("inf")
    for _ in range(2):
        start = time.process_time()
        build(mechanism, folder)
        best = min(best, time.process_time() - start)
    return best


def main():
    with tempfile.TemporaryDirectory() as folder:
        print(f"{'dyads':>7} {'rows':>7} {'CPU s':>8} {'ms a dyad':>10}")
        for dyads in DYADS:
            used = cpu(loads(Grower(7, dyads, ("RRR",)).text(DYADS_ROWS, 1.0)), folder)
            print(f"{dyads:>7} {DYADS_ROWS:>7} {used:>8.2f} {1000 * used / dyads:>10.1f}", flush=True)
        print(f"{'dyads':>7} {'rows':>7} {'CPU s':>8} {'us a row':>10}")
        for rows in ROWS:
            text = (ROOT / "templates" / "watt-ii.toml").read_text(encoding="utf-8")
            step = f"step = {360 / (rows - 1)!r}"
            lines = [step if line.startswith("step") else line for line in text.splitlines()]
            used = cpu(loads("\n".join(lines)), folder)
            print(f"{2:>7} {rows:>7} {used:>8.2f} {1e6 * used / rows:>10.1f}", flush=True)


if __name__ == "__main__":
    assert load(ROOT / "templates" / "watt-ii.toml").name == "watt-ii"
    main()
