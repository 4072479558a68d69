"""Random links of class III and IV in other programs: the figures of docs/proof.md.

python tools/chains_elsewhere.py [COUNT] [--with libreoffice,gnumeric]

Each of COUNT (20) mechanisms, with velocities and joint forces, is built as .xlsx and .ods; the engine and each program
compute both, and every cell is compared with the engine, positions, rates and forces with the reference. Then one dimension
is typed with which Newton's method lands elsewhere than in the described assembly, and the programs' first sheets are read.
Prints a table in Markdown; with COUNT left out it is put into docs/proof.md.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
NEEDED = ("tests", "tests/sheet", "tests/sheet/table", "tests/dynamics", "tests/differential", "src")
sys.path[:0] = [str(ROOT / folder) for folder in NEEDED]

from chain_workbooks import Case, Elsewhere, compared, descriptions, elsewhere, written  # noqa: E402
from proof import put  # noqa: E402

from mechsheet.checking import Comparison  # noqa: E402
from mechsheet.checking.programs import Answers, answers_to_all  # noqa: E402

COUNT, BATCH = 20, 10
"""Linkages, and how many of them are computed at once."""

Compared = dict[tuple[str, str], list[Comparison]]


def main() -> None:
    """Run, print, and put in its place."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", type=int, nargs="?", default=0)
    parser.add_argument("--with", dest="programs", default="libreoffice,gnumeric")
    given = parser.parse_args()
    programs = [name for name in given.programs.split(",") if name]
    found: Compared = {}
    told: dict[str, list[bool]] = {name: [] for name in programs}
    linkages = list(descriptions(given.count or COUNT))
    for start in range(0, len(linkages), BATCH):
        with tempfile.TemporaryDirectory() as folder:
            _batch(linkages[start : start + BATCH], Path(folder), programs, found, told)
        print(f"{min(start + BATCH, len(linkages))} of {len(linkages)}", file=sys.stderr, flush=True)
    lines = [f"{len(linkages)} linkages.", "", *_table(found), "", _told(told)]
    print("\n".join(lines))
    if not given.count:
        put("chains-elsewhere", lines)


def _batch(
    linkages: list[tuple[int, str]], folder: Path, programs: list[str], found: Compared, told: dict[str, list[bool]]
) -> None:
    """Some linkages, all files of which each program computes at once."""
    cases = [
        Case(text, written(text, folder / f"chain-{seed}.{suffix}"))
        for seed, text in linkages
        for suffix in ("xlsx", "ods")
    ]
    changes: list[Elsewhere] = [change for seed, _ in linkages if (change := elsewhere(seed)) is not None]
    moved = [change.written(folder / f"moved-{number}.ods") for number, change in enumerate(changes)]
    paths = [*(case.path for case in cases), *moved]
    answers: dict[str, list[Answers]] = {name: list(answers_to_all(name, paths)) for name in programs}
    for key, comparisons in compared(cases, answers).items():
        found.setdefault(key, []).extend(comparisons)
    for name, values in answers.items():
        told[name] += [change.told(each) for change, each in zip(changes, values[len(cases) :], strict=True)]


def _table(found: Compared) -> Iterator[str]:
    yield "| file | compared | cells | files that differ | worst |"
    yield "|---|---|---|---|---|"
    for (suffix, what), comparisons in found.items():
        cells, differ = (sum(values) for values in zip(*((c.cells, not c.agrees) for c in comparisons), strict=True))
        worst = max(comparison.worst for comparison in comparisons)
        yield f"| .{suffix} | {what} | {cells:,} | {differ} of {len(comparisons)} | {worst:.0e} |"
        for comparison in comparisons:
            if not comparison.agrees:
                print(suffix, what, comparison, file=sys.stderr)


def _told(told: dict[str, list[bool]]) -> str:
    said = ", ".join(f"{name} {sum(each)} of {len(each)}" for name, each in told.items())
    return f"Changes after which Newton's method lands elsewhere, and the first sheet says so: {said}."


if __name__ == "__main__":
    main()
