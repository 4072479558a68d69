"""Make the pictures of README and docs from the built workbooks, and the README's gallery: `make pictures`.

Needs LibreOffice, pdftoppm and ImageMagick (apt-get install libreoffice-calc poppler-utils imagemagick).
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

from mechsheet.building import build
from mechsheet.checking import check
from mechsheet.description import load
from mechsheet.plotting import plot
from mechsheet.programs import convert_with_libreoffice

ROOT = Path(__file__).parent.parent
PICTURES = ROOT / "docs" / "pictures"
START, END = "<!-- gallery -->", "<!-- /gallery -->"


def picture(pdf: Path, target: Path, dpi: int) -> None:
    """The first page of a PDF as a PNG, its white margins cut off, in few colours."""
    page = pdf.with_suffix("")
    first_page = ["-f", "1", "-l", "1", "-singlefile", "-png"]
    subprocess.run(["pdftoppm", "-r", str(dpi), *first_page, str(pdf), str(page)], check=True)
    trim = ["-trim", "+repage", "-bordercolor", "white", "-border", "8", "-colors", "64", "-strip"]
    subprocess.run(
        ["convert", f"{page}.png", *trim, "-define", "png:exclude-chunks=date,time", str(target)], check=True
    )


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
    readme = ROOT / "README.md"
    text = readme.read_text(encoding="utf-8")
    before, rest = text.split(START)
    after = rest.split(END)[1]
    gallery = "\n".join(rows)
    readme.write_text(f"{before}{START}\n{gallery}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
