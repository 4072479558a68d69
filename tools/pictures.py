"""Make the pictures of README and docs from the workbooks as they are built now: `make pictures`.

Needs LibreOffice, pdftoppm, Xvfb and xdotool (apt-get install libreoffice-calc poppler-utils xvfb xdotool); the gallery's
drawings need matplotlib only, the page of `mechsheet draw` Chromium. Names of pictures make only those:
`python tools/pictures.py workbook-page opened`.
"""

from __future__ import annotations

import io
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import openpyxl
from openpyxl.utils import get_column_letter
from PIL import Image, ImageChops, ImageOps
from screenshot import screenshot

import mechsheet
from livesheet.formats import write
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, load, loads
from mechsheet.homework.classroom.exercise import KEY, exercise
from mechsheet.homework.classroom.marks import mark
from mechsheet.homework.classroom.marks_book import marks_workbook
from mechsheet.library.building import build
from mechsheet.plotting import plot
from mechsheet.plotting.pictures import few_colors

ROOT = Path(__file__).parent.parent
TEMPLATES = ROOT / "templates"
PICTURES = ROOT / "docs" / "pictures"
DRAWN = 320
"""Pixels of a side of a drawing of the gallery."""
COLORS, APART = 128, 10
"""Of a picture; how far they are apart at least: pale fields keep their own."""
FOOTER = 0.07
"""Part of a page's height, from below."""
BORDER = 8

BESIDE_THE_TEXT = ("slider-crank", "fivelink", "six-link-dwell-positions")
"""Workbooks of docs/beside-the-text.md, as one sheet, that no other page shows."""

PATTERN = re.compile(r"```toml\n(.*?)```", re.DOTALL)
"""A description of docs/patterns.md."""

Corner = tuple[float, float, float, float]
"""Left, top, right, bottom as parts of what is printed."""


def drawing(linkage: mechsheet.Linkage) -> Image.Image:
    """A linkage a sixth of its way into the sweep, where its links stand apart, as its workbook draws it."""
    motion = linkage.solve()
    values = motion[linkage.driver.symbol][motion.exists]
    with tempfile.TemporaryDirectory() as folder:
        found = plot(linkage, Path(folder) / "drawing.png", at=float(values[len(values) // 6]))
        return Image.open(found).convert("RGB").resize((DRAWN, DRAWN), Image.Resampling.LANCZOS)


def assemblies() -> Image.Image:
    """The four-bar at 75 degrees in its two assemblies, side by side."""
    both = Image.new("RGB", (2 * DRAWN, DRAWN), "white")
    with tempfile.TemporaryDirectory() as folder:
        for place, mode in enumerate((1, -1)):
            found = plot(mechsheet.template("four-bar", {"mode_1": mode}), Path(folder) / f"{place}.png", at=75)
            one = Image.open(found).convert("RGB").resize((DRAWN, DRAWN), Image.Resampling.LANCZOS)
            both.paste(one, (place * DRAWN, 0))
    return both


def drawn_page(theme: str) -> Image.Image:
    """The page of `mechsheet draw` with the four-bar, its crank at 60 degrees, in a window of a small notebook."""
    from playwright.sync_api import sync_playwright

    from mechsheet.drawing_page.answers import Studio
    from mechsheet.drawing_page.server import DrawingServer

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as started:
        path = Path(folder) / "four-bar.toml"
        text = (TEMPLATES / "four-bar.toml").read_text(encoding="utf-8")
        path.write_text(text[text.index("format = 1") :], encoding="utf-8")  # the mechanism, without its long comment
        server = DrawingServer(Studio(path, language="en"))
        server.start()
        flags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"]
        browser = started.chromium.launch(executable_path="/usr/bin/chromium", args=flags)
        window = browser.new_page(
            viewport={"width": 1366, "height": 768}, color_scheme="dark" if theme == "dark" else "light"
        )
        window.goto(server.address)
        window.wait_for_selector("body[data-ready=yes]")
        window.locator("#position").fill("32")
        window.locator("#position").evaluate("each => each.blur()")
        window.wait_for_timeout(500)
        content = window.screenshot()
        browser.close()
        server.stop()
    return Image.open(io.BytesIO(content)).convert("RGB")


def page(pdf: Path, number: int, dpi: int, part: Corner | None = None) -> Image.Image:
    """A page of a PDF without its margins and its footer; or a part of it."""
    target = pdf.with_name(f"page-{number}")
    one = ["-f", str(number), "-l", str(number), "-singlefile", "-png"]
    subprocess.run(["pdftoppm", "-r", str(dpi), *one, str(pdf), str(target)], check=True)
    whole = Image.open(f"{target}.png").convert("RGB")
    printed = trimmed(whole.crop((0, 0, whole.width, round(whole.height * (1 - FOOTER)))))
    if part:
        size = (printed.width, printed.height) * 2
        printed = trimmed(printed.crop(tuple(round(a * b) for a, b in zip(part, size, strict=True))))  # type: ignore[arg-type]
    return ImageOps.expand(printed, BORDER, "white")


def trimmed(image: Image.Image) -> Image.Image:
    """Without the white around it."""
    return image.crop(ImageChops.difference(image, Image.new("RGB", image.size, "white")).getbbox())


def page_of(pdf: Path, sheet: str) -> int:
    """The number of the first page of a sheet, which its footer names."""
    text = subprocess.run(["pdftotext", "-layout", str(pdf), "-"], check=True, capture_output=True, text=True).stdout
    return next(number for number, page in enumerate(text.split("\f"), 1) if f"{sheet}, {number} /" in page)


class Prints:
    """What LibreOffice prints of the workbooks of docs/workbook.md, each made when it is first asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.made: dict[tuple[str, str], Path] = {}

    def pdf(self, name: str, layout: str) -> Path:
        """A template's workbook, in English, as it is printed with the sheets of the proof in sight."""
        if (name, layout) not in self.made:
            target = self.folder / f"{name}-{layout}.xlsx"
            mechanism = load(TEMPLATES / f"{name}.toml", Overrides(language="en", layout=layout))
            workbook = compiled_of(mechanism).workbook
            *sheets, description = workbook.sheets
            seen = (*(replace(sheet, hidden=False) for sheet in sheets), description)
            write(replace(workbook, sheets=seen), target)
            self.made[name, layout] = convert_with_libreoffice([target], "pdf", self.folder)[0]
        return self.made[name, layout]

    def sheet(
        self, sheet: str, dpi: int, part: Corner | None = None, name: str = "four-bar", further: int = 0
    ) -> Image.Image:
        """The first page of a sheet, or one further on."""
        pdf = self.pdf(name, "sheets")
        return page(pdf, page_of(pdf, sheet) + further, dpi, part)

    def opened(self) -> Image.Image:
        """The four-bar on the screen, in its sixth position."""
        target = self.folder / "opened.ods"
        return screenshot(build(load(TEMPLATES / "four-bar.toml"), target)[0], {"position": "5"})


CLASS = ("Ayşe Yılmaz", "Bora Kaya", "Can Demir", "Deniz Arslan", "Ece Şahin")
SOLVED = (
    ("fi", "RADIANS({crank})"), ("xA", "{a2}*COS({fi})"), ("yA", "{a2}*SIN({fi})"), ("s", "SQRT(({a1}-{xA})^2+{yA}^2)"),
    ("beta", "ATAN2({a1}-{xA},-{yA})"), ("gamma", "ACOS(({a3}^2+{s}^2-{a4}^2)/(2*{a3}*{s}))"), ("theta13", "{beta}+{gamma}"),
    ("xB", "{xA}+{a3}*COS({theta13})"), ("yB", "{yA}+{a3}*SIN({theta13})"), ("theta14", "ATAN2({xB}-{a1},{yB})"),
)  # fmt: skip
"""A student's columns, the four-bar by its diagonal."""
SLIPS: tuple[dict[str, str], ...] = ({}, {"fi": "{crank}"}, {}, {"beta": "ATAN2(-{yA},{a1}-{xA})"})
"""What each student has otherwise; the last hands nothing in."""


def marked(folder: Path) -> Image.Image:
    """The marks of a small class, whose workbooks are filled in here as students do."""
    text = (TEMPLATES / "four-bar.toml").read_text(encoding="utf-8")
    asked = "[exercise]\nasked = { theta13 = 2, theta14 = 2 }\nvary = { a2 = [30, 38, 0.5], a3 = [60, 66, 0.5] }"
    mechanism = loads(f"{text}\n{asked}\n", "four-bar.toml", Overrides(language="en"))
    people = folder / "class.csv"
    people.write_text("\n".join(["id,name", *(f"{1001 + n},{name}" for n, name in enumerate(CLASS))]), encoding="utf-8")
    made = exercise(mechanism, people, folder / "week")
    for student, slips in zip(made.students, SLIPS, strict=False):
        filled(folder / "week" / "student" / f"{student.file}.xlsx", folder / "in" / f"{student.file}.xlsx", slips)
    target = folder / "marks.xlsx"
    write(marks_workbook(mark(folder / "in", folder / "week" / KEY)), target)
    return page(convert_with_libreoffice([target], "pdf", folder)[0], 1, 120)


def filled(task: Path, target: Path, slips: Mapping[str, str]) -> None:
    """A student's sheet with columns to the right of it."""
    book = openpyxl.load_workbook(task)
    sheet = book.active
    places = {str(sheet.cell(row, 1).value).split(" ")[0]: row for row in range(1, sheet.max_row + 1)}
    cells = {name: f"$B${places[name]}" for name in ("a1", "a2", "a3", "a4")}
    top = places["θ12"]
    letters = {"crank": "A"} | {name: get_column_letter(col) for col, (name, _) in enumerate(SOLVED, 5)}
    for name, formula in SOLVED:
        sheet[f"{letters[name]}{top}"] = name
        for row in range(top + 1, sheet.max_row + 1):
            here = cells | {other: f"{letter}{row}" for other, letter in letters.items()}
            sheet[f"{letters[name]}{row}"] = "=" + slips.get(name, formula).format(**here)
    target.parent.mkdir(exist_ok=True)
    book.save(target)


def wanted(prints: Prints) -> Iterator[tuple[str, Callable[[], Image.Image]]]:
    """Every picture: its name, and what makes it."""
    for template in sorted(TEMPLATES.glob("*.toml")):
        yield template.stem, lambda path=template: drawing(mechsheet.load(path))  # type: ignore[misc]
    for text in PATTERN.findall((ROOT / "docs" / "patterns.md").read_text(encoding="utf-8")):
        linkage = mechsheet.loads(text)
        yield f"pattern-{linkage.name}", lambda linkage=linkage: drawing(linkage)  # type: ignore[misc]
    yield "assemblies", assemblies
    yield "opened", prints.opened
    yield "workbook-blocks", lambda: prints.sheet("Mechanism", 110)
    yield "workbook-charts", lambda: prints.sheet("Mechanism", 110, further=1)
    yield "workbook-positions", lambda: prints.sheet("Positions", 110)
    yield "workbook-checks", lambda: prints.sheet("Checks", 110)
    yield "workbook-notes", lambda: prints.sheet("Notes", 110)
    yield "workbook-table", lambda: prints.sheet("Table s15", 100, name="adjustable-pump")
    yield "marks", lambda: marked(prints.folder)
    for theme in ("light", "dark"):
        yield f"draw-{theme}", lambda theme=theme: drawn_page(theme)  # type: ignore[misc]
    yield "workbook-page", lambda: page(prints.pdf("four-bar", "page"), 1, 120)
    for name in BESIDE_THE_TEXT:
        yield f"page-{name}", lambda name=name: page(prints.pdf(name, "page"), 1, 100)  # type: ignore[misc]


def save(image: Image.Image, name: str) -> None:
    """As a PNG of few colours; the same picture gives the same bytes."""
    codes = np.asarray(image, dtype=np.int32) @ np.array([65536, 256, 1], dtype=np.int32)
    few_colors([codes], COLORS, APART)[0].save(PICTURES / f"{name}.png", optimize=True)


def main() -> None:
    """All pictures, or those that are named."""
    names = set(sys.argv[1:])
    if not names or "motion" in names:
        plot(load(TEMPLATES / "four-bar.toml"), PICTURES / "four-bar.gif")
    with tempfile.TemporaryDirectory() as folder:
        for name, make in wanted(Prints(Path(folder))):
            if not names or name in names:
                save(make(), name)


if __name__ == "__main__":
    main()
