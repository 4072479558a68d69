"""`make demo`: build every template into a folder, judge every file, print the table of worst differences."""

from __future__ import annotations

import gc
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from mechsheet.checking import Report, check
from mechsheet.description import Overrides, load
from mechsheet.description.reader import with_settings
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.building import FORMATS, Target, build, told, write_all

SMALLEST = "five-bar-robot"
"""The template of the fewest formulas is also judged by the library `formulas`, which needs 10 ms a cell and more; the tests
ask it about others."""

PAGES = ("adjustable-pump", "fivelink", "four-bar", "slider-crank")
"""Templates that are built in both layouts."""

JUDGES = {"stored values": 13, "reference": 11, "search": 11, "formulas": 11}
"""Whose worst differences are printed, in columns so wide."""


def demo(templates: Path, generated: Path) -> bool:
    """Build and check, one template a process; True when everything agrees."""
    descriptions = sorted(templates.glob("*.toml"))
    if not descriptions:
        print(f"no descriptions in {templates}", file=sys.stderr)
        return False
    generated.mkdir(exist_ok=True)
    print(" ".join([f"{'workbook':<30}", *(f"{judge:>{width}}" for judge, width in JUDGES.items())]), flush=True)
    fine = True
    # millions of tree nodes and few cycles: what is left over is collected once a template, not while it is worked on
    with ProcessPoolExecutor(max_workers=os.cpu_count(), initializer=gc.disable) as pool:
        for lines, agrees in pool.map(partial(_built, generated=generated), descriptions):
            print(lines, flush=True)
            fine = fine and agrees
    print("all agree" if fine else "SOMETHING DIFFERS")
    return fine


def _built(description: Path, generated: Path) -> tuple[str, bool]:
    """The lines of a template's workbooks, and whether all judges agree."""
    lines, fine = [], True
    mechanism = load(description)
    files = build(mechanism, generated, FORMATS, force=True)
    # not pages: there `formulas` counts empty texts as texts, and so rows that close wrongly
    asked = {path for path in files if path.suffix == ".xlsx" and description.stem == SMALLEST}
    if description.stem in PAGES:
        pages = [Target(generated / f"{description.stem}-page.{ending}", ending) for ending in FORMATS]
        files += write_all(told(with_settings(mechanism, Overrides(layout="page"))), pages)
    for path in files:
        report = check(path, ["formulas"] if path in asked else [])
        fine = fine and report.agrees
        lines.append(_line(path.name, report))
    gc.collect()
    return "\n".join(lines), fine


def _line(name: str, report: Report) -> str:
    found = {item.judge: item for item in report.comparisons}
    cells = []
    for judge, width in JUDGES.items():
        item = found.get(judge)
        text = "" if item is None else (f"{item.worst:.1e}" if item.agrees else f"DIFFERS {item.where}")
        cells.append(f"{text:>{width}}")
    return f"{name:<30} {' '.join(cells)}"


if __name__ == "__main__":
    try:
        sys.exit(0 if demo(Path(sys.argv[1]), Path(sys.argv[2])) else 1)
    except MechsheetError as error:
        print(error, file=sys.stderr)
        sys.exit(2)
