"""A long differential campaign: random formulas computed here and by other programs.

    python tools/compare_random_formulas.py SEED COUNT [--write]

Prints the formulas whose value no other program confirms, and those on which two others agree otherwise. The confirmed ones
can be written to `tests/cases/engine/random`.
"""

from __future__ import annotations

import multiprocessing
import queue
import random
import sys
from collections import Counter
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from asking import PROGRAMS, agree, asked, code_agrees, ours, outvoted  # noqa: E402
from engine_cases import FOLDER, quoted, spelt  # noqa: E402
from livesheet.formula.nodes import ErrorValue  # noqa: E402
from random_formulas import Formulas, random_cells  # noqa: E402

BATCH, SECONDS = 500, 60


def asked_in_time(texts: list[str], grid: list[Any]) -> dict[str, list[object]]:
    """What the programs give, batch by batch; nothing for a batch on which a program does not answer in time."""
    found: dict[str, list[object]] = {program: [] for program in PROGRAMS}
    for start in range(0, len(texts), BATCH):
        batch = texts[start : start + BATCH]
        for program in PROGRAMS:
            answer: multiprocessing.Queue[list[object]] = multiprocessing.Queue()
            process = multiprocessing.Process(target=_ask, args=(program, batch, grid, answer))
            process.start()
            try:
                given = answer.get(timeout=SECONDS)
            except queue.Empty:
                print(f"{program} does not answer on formulas {start} to {start + len(batch)}")
                given = [ErrorValue("#NAME?")] * len(batch)
                process.kill()
            process.join()
            found[program] += given
    return found


def _ask(program: str, batch: list[str], grid: list[Any], answer: multiprocessing.Queue[list[object]]) -> None:
    answer.put(asked(batch, grid, (program,), arrays=False)[program])


def main() -> None:
    """Compare and count."""
    seed, count = int(sys.argv[1]), int(sys.argv[2])
    chance = random.Random(seed)
    grid, formulas = list(random_cells(chance)), Formulas(chance)
    texts = [formulas.formula() for _ in range(count)]
    mine, theirs = ours(texts, grid), asked_in_time(texts, grid)
    tally: Counter[str] = Counter()
    agreed: list[Any] = []
    for place, text in enumerate(texts):
        given = {program: values[place] for program, values in theirs.items()}
        known = {p: v for p, v in given.items() if str(v) not in ("#NAME?", "#N/IMPL!", "#ERROR!", "Err:508")}
        if not known:
            tally["known nowhere else"] += 1
            continue
        confirmed = any(agree(mine[place], other) for other in known.values()) and code_agrees(mine[place], known)
        kind = "unconfirmed" if not confirmed else "outvoted" if outvoted(mine[place], known) else "confirmed"
        tally[kind] += 1
        if kind != "confirmed":
            print(f"{kind:12s}{text:70s} ours {mine[place]!s:22} " + "  ".join(f"{p} {v!s}" for p, v in known.items()))
        else:
            agreed.append((text, mine[place]))
    print(*sorted(tally.items()), sep="\n")
    if "--write" in sys.argv:
        write(seed, grid, agreed)


def write(seed: int, grid: list[Any], agreed: list[Any]) -> None:
    """The cells, and the formulas whose values are confirmed."""
    lines = ["# made by tools/compare_random_formulas.py", "cells = ["]
    lines += [f"  [{row}, {col}, {spelt(value)}]," for row, col, value in grid]
    lines += ["]", "cases = [", *(f"  [{quoted(text)}, {spelt(value)}]," for text, value in agreed), "]", ""]
    (FOLDER / "random" / f"seed_{seed}.toml").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
