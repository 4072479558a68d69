"""How many sheets of paper workbooks print on, and how small: from the PDF that LibreOffice makes of them.

    python tools/paper.py                            # all templates, both layouts: some twenty minutes
    python tools/paper.py four-bar slider-crank
    python tools/paper.py --pdf FOLDER               # PDFs that are there already (FOLDER/sheets, FOLDER/page)

One line a workbook: pages, and the smallest print in points of numbers in cells, of formulas, and of anything else; beside
them pages that are nearly empty. `tests/sheet/on_paper.py` reads the PDFs, `tests/sheet/test_paper.py` holds some templates.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "tests" / "sheet")]

from on_paper import Page, pages_of, printed  # noqa: E402

LAYOUTS = ("sheets", "page")
EMPTY = 0.25
"""A page whose lowest print is above this part of its height is nearly empty, the footer left out."""


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("templates", nargs="*")
    parser.add_argument("--pdf", type=Path)
    given = parser.parse_args()
    names = given.templates or sorted(path.stem for path in (ROOT / "templates").glob("*.toml"))
    print(f"{'template':26} {'layout':6} {'pages':>5} {'numbers':>8} {'formulas':>8} {'words':>6}  sheets")
    with tempfile.TemporaryDirectory(prefix="mechsheet-paper-") as place:
        for layout in LAYOUTS:
            folder = (given.pdf or Path(place)) / layout
            files = (
                {path.stem: path for path in folder.glob("*.pdf")} if given.pdf else printed(names, layout, Path(place))
            )
            for name in names:
                if name in files:
                    print(_line(name, layout, pages_of(files[name])))


def _line(name: str, layout: str, pages: list[Page]) -> str:
    def least(kind: str) -> str:
        sizes = [size for page in pages if (size := page.smallest(kind))]
        return f"{min(sizes):.1f}" if sizes else ""

    sheets: dict[str, list[str]] = {}
    for page in pages:
        size = page.smallest("number")
        sheets.setdefault(page.sheet, []).append(f"{size:.1f}" if size else "-")
        if page.reach < EMPTY:
            sheets[page.sheet][-1] += f" EMPTY({page.reach:.2f})"
    listed = ", ".join(f"{sheet}: {' '.join(sizes)}" for sheet, sizes in sheets.items())
    return (
        f"{name:26} {layout:6} {len(pages):5} {least('number'):>8} {least('formula'):>8} {least('word'):>6}  {listed}"
    )


if __name__ == "__main__":
    main()
