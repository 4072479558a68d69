"""Make the pictures of README and docs from the built workbooks, and the README's gallery: `make pictures`.

Needs LibreOffice, pdftoppm, ImageMagick, Xvfb and xdotool
(apt-get install libreoffice-calc poppler-utils imagemagick xvfb xdotool).
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

from screenshot import screenshot

from mechsheet.checking import check
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.description import load
from mechsheet.library.building import build
from mechsheet.plotting import plot

ROOT = Path(__file__).parent.parent
PICTURES = ROOT / "docs" / "pictures"
START, END = "<!-- gallery -->", "<!-- /gallery -->"


def picture(pdf: Path, target: Path, dpi: int, page_number: int = 1, corner: str = "", part: str = "") -> None:
    """A page of a PDF as a PNG, margins and footer cut off, in few colours; or a part ("40%x60%") at a corner of it."""
    page = pdf.with_suffix("")
    one_page = ["-f", str(page_number), "-l", str(page_number), "-singlefile", "-png"]
    subprocess.run(["pdftoppm", "-r", str(dpi), *one_page, str(pdf), str(page)], check=True)
    paper = ["-gravity", "south", "-chop", "0x7%", "-gravity", "northwest", "-trim", "+repage"]
    crop = ["-gravity", corner, "-crop", f"{part}+0+0", "+repage"] if part else []
    trim = [
        *paper,
        *crop,
        "-trim",
        "+repage",
        "-bordercolor",
        "white",
        "-border",
        "8",
        "+dither",
        "-colors",
        "64",
        "-strip",
    ]
    subprocess.run(
        ["convert", f"{page}.png", *trim, "-define", "png:exclude-chunks=date,time", str(target)], check=True
    )


def page_of(pdf: Path, sheet: str) -> int:
    """The number of the first page of a sheet, which its footer names."""
    text = subprocess.run(["pdftotext", "-layout", str(pdf), "-"], check=True, capture_output=True, text=True).stdout
    return next(number for number, page in enumerate(text.split("\f"), 1) if f"{sheet}, {number} /" in page)


def parts_of_the_workbook(four_bar: Path, pump: Path) -> None:
    """The pictures of docs/workbook.md."""
    pages = {"positions": "Positions", "checks": "Checks", "notes": "Notes"}
    picture(four_bar, PICTURES / "workbook-mechanism.png", 100)
    picture(four_bar, PICTURES / "workbook-blocks.png", 150, corner="northwest", part="38%x100%")
    picture(four_bar, PICTURES / "workbook-charts.png", 120, corner="northeast", part="61%x90%")
    for name, sheet in pages.items():
        picture(four_bar, PICTURES / f"workbook-{name}.png", 110, page_of(four_bar, sheet))
    picture(pump, PICTURES / "workbook-table.png", 100, page_of(pump, "Table s15"))


def main() -> None:
    """Build every template, take its picture, write the gallery, and draw the four-bar in motion."""
    plot(load(ROOT / "templates" / "four-bar.toml"), PICTURES / "four-bar.gif")
    templates = sorted((ROOT / "templates").glob("*.toml"))
    rows = ["| mechanism | first sheet | source | worst difference to the reference |", "|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        mechanisms = [load(template) for template in templates]
        books = [path for mechanism in mechanisms for path in build(mechanism, place)]
        pages = convert_with_libreoffice(books, "pdf", place)
        for mechanism, book, page in zip(mechanisms, books, pages, strict=True):
            picture(page, PICTURES / f"{mechanism.name}.png", 130 if mechanism.name == "four-bar" else 70)
            report = check(book)
            worst = next(item.worst for item in report.comparisons if item.judge == "reference")
            image = f"![{mechanism.title.en}](docs/pictures/{mechanism.name}.png)"
            link = f"[{mechanism.title.en}](templates/{mechanism.name}.toml)"
            rows.append(f"| {link} | {image} | {mechanism.source.en} | {worst:.0e} |")
        opened = build(load(ROOT / "templates" / "four-bar.toml"), place, ["ods"])[0]
        screenshot(opened, PICTURES / "opened.png", clicks=5)
        pump = build(load(ROOT / "templates" / "adjustable-pump.toml", language="en"), place)
        four_bar = next(page for page in pages if page.stem == "four-bar")
        parts_of_the_workbook(four_bar, convert_with_libreoffice(pump, "pdf", place)[0])
    readme = ROOT / "README.md"
    text = readme.read_text(encoding="utf-8")
    before, rest = text.split(START)
    after = rest.split(END)[1]
    gallery = "\n".join(rows)
    readme.write_text(f"{before}{START}\n{gallery}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
