"""How large the workbooks are, all templates, both layouts, and what building costs: the budgets that tests hold.

Sizes are counted on the workbook as it is laid out (`tests/sheet/budgets.py`, which has the budgets), files are those in
generated/. Times are CPU of whole builds in this process, as ratios within one run: to the four-bar of 25 rows, and to
XlsxWriter writing the same number of rows of 17 bare numbers.

    python benchmarks/bench_budgets.py
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import xlsxwriter

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tests" / "sheet")]

from budgets import ALL, PAGES, PLAIN, PLAIN_TOGETHER, compiled, many_rows, size_of  # noqa: E402

from folders import TEMPLATE_NAMES  # noqa: E402
from mechsheet.library.building import build  # noqa: E402

ROWS = (25, 361, 36_001)


def table():
    """A line for each template and layout; the four-bar, which has anchors, with names, too."""
    heads = ("formulas", "table", "columns", "longest", "elsewhere", "kB")
    print(f"{'template':<22}{'layout':<15}" + "".join(f"{head:>10}" for head in heads))
    for name in TEMPLATE_NAMES:
        line(name, "sheets", f"{name}.xlsx")
        if name == "four-bar":
            line(name, "sheets", "", "names")
        if name in PAGES:
            line(name, "page", f"{name}-page.xlsx")
    total = sum(size_of(compiled(name)).cells for name in TEMPLATE_NAMES)
    print(f"{'all':<22}{'sheets':<15}{total:>10,}   (budget {ALL:,})")
    plain = sum(size_of(compiled(name)).cells for name in PLAIN)
    print(f"{'the first 29':<22}{'sheets':<15}{plain:>10,}   (budget {PLAIN_TOGETHER:,})")


def line(name, layout, file, references=""):
    """One workbook: counted, and the size of its file."""
    size = size_of(compiled(name, layout, references))
    kilobytes = f"{(ROOT / 'generated' / file).stat().st_size / 1000:.0f}" if file else ""
    label = f"{layout}, {references}" if references else layout
    numbers = (size.cells, size.table, size.columns, size.longest, size.elsewhere)
    print(f"{name:<22}{label:<15}" + "".join(f"{number:>10,}" for number in numbers) + f"{kilobytes:>10}", flush=True)


def bare_numbers(path, rows):
    """As many rows of as many numbers as the four-bar's table has columns of numbers, nothing else."""
    with xlsxwriter.Workbook(path) as book:
        sheet = book.add_worksheet()
        for row in range(rows):
            sheet.write_row(row, 0, [row / 7 + col for col in range(17)])


def cpu(act):
    """CPU seconds, best of two."""
    best = float("inf")
    for _ in range(2):
        start = time.process_time()
        act()
        best = min(best, time.process_time() - start)
    return best


def times():
    """What more rows cost, with names and with anchors."""
    print(f"\n{'four-bar, rows':>14} {'references':<11}{'CPU s':>8}{'to 25 rows':>12}{'to bare numbers':>17}{'MB':>7}")
    with tempfile.TemporaryDirectory() as folder:
        for references in ("names", "anchors"):
            first = None
            for rows in ROWS:
                target, mechanism = Path(folder) / f"{rows}.xlsx", many_rows(rows, references)
                used = cpu(lambda: build(mechanism, target, force=True))  # noqa: B023
                bare = cpu(lambda: bare_numbers(Path(folder) / "bare.xlsx", rows))  # noqa: B023
                first = first or used
                size = target.stat().st_size / 1e6
                costs = f"{used:>8.2f}{used / first:>12.2f}{used / bare:>17.2f}{size:>7.2f}"
                print(f"{rows:>14,} {references:<11}{costs}", flush=True)


if __name__ == "__main__":
    table()
    times()
