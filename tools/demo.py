"""`make demo`: build every template into a folder, judge every file, print the table of worst differences."""

from __future__ import annotations

import sys
from pathlib import Path

from mechsheet.checking import Report, check
from mechsheet.description import load
from mechsheet.diagnostics import MechsheetError
from mechsheet.kinematics.solve import dimension_values, driver_values
from mechsheet.library.building import FORMATS, build
from mechsheet.model import Mechanism

SMALL = 20
"""Workbooks of up to so many rows are also judged by `formulas`, which needs 10 to 20 ms a cell with our long formulas."""

PAGES = ("adjustable-pump", "fivelink", "four-bar", "slider-crank")
"""Templates that are built in both layouts."""


def demo(templates: Path, generated: Path) -> bool:
    """Build and check; True when everything agrees."""
    descriptions = sorted(templates.glob("*.toml"))
    if not descriptions:
        print(f"no descriptions in {templates}", file=sys.stderr)
        return False
    generated.mkdir(exist_ok=True)
    print(f"{'workbook':<30} {'stored values':>13} {'reference':>11} {'formulas':>11}")
    fine = True
    for description in descriptions:
        mechanism = load(description)
        files = build(mechanism, generated, FORMATS, force=True)
        if description.stem in PAGES:
            for ending in FORMATS:
                path = generated / f"{description.stem}-page.{ending}"
                files += build(mechanism, path, force=True, layout="page")
        for path in files:
            programs = ["formulas"] if path.suffix == ".xlsx" and _rows(mechanism) <= SMALL else []
            report = check(path, programs)
            fine = fine and report.agrees
            print(_line(path.name, report), flush=True)
    print("all agree" if fine else "SOMETHING DIFFERS")
    return fine


def _rows(mechanism: Mechanism) -> int:
    return len(driver_values(mechanism, dimension_values(mechanism)))


def _line(name: str, report: Report) -> str:
    found = {item.judge: item for item in report.comparisons}
    cells = []
    for judge, width in (("stored values", 13), ("reference", 11), ("formulas", 11)):
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
