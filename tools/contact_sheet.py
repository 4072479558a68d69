"""The drawings of all templates in one picture, to be looked at together, as each of the programs that draw them does it:

    python tools/contact_sheet.py sheet.png                    as `mechsheet plot` draws them
    python tools/contact_sheet.py sheet.png xlsx four-bar      as LibreOffice draws the chart of a workbook; also ods
    python tools/contact_sheet.py sheet.png page lamp.toml     as the page of `mechsheet draw` does

Names are those of templates, or files; without any it is all templates. LibreOffice and pdftoppm, or Chromium, are needed.
"""

import io
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import ceil
from pathlib import Path

from PIL import Image, ImageChops, ImageDraw

from livesheet.formats import write
from livesheet.workbook import Area
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, load
from mechsheet.plotting.pictures import png
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage

TEMPLATES = Path(__file__).parent.parent / "templates"
ACROSS, SIDE, TITLE = 6, 400, 18
"""Drawings in a row; pixels of a drawing's side, and of its name above it."""
COVERED = (22, 7)
"""Rows and columns of the first sheet that the drawing covers."""
FOOTER = 0.1
"""Part of a page's height, from below."""
BROWSER = ["--headless", "--no-sandbox", "--disable-gpu"]


def plotted(paths: Sequence[Path]) -> Iterator[Image.Image]:
    """At the position that a workbook shows first."""
    for path in paths:
        stage = Stage(sample(load(path), None, "en"))
        yield Image.open(io.BytesIO(png(stage.drawing(stage.sample.shown), path.stem)))


def printed(paths: Sequence[Path], form: str) -> Iterator[Image.Image]:
    """The chart with the drawing, alone on its sheet."""
    with tempfile.TemporaryDirectory() as folder:
        targets = []
        for path in paths:
            workbook = compiled_of(load(path, Overrides(language="en"))).workbook
            first, *others = workbook.sheets
            corner = first.charts[0].anchor
            area = Area(corner.row, corner.col, corner.row + COVERED[0], corner.col + COVERED[1])
            setup = replace(first.print_setup, area=area, landscape=True, scale=100)
            first = replace(first, charts=first.charts[:1], print_setup=setup)
            targets.append(Path(folder) / f"{path.stem}.{form}")
            write(replace(workbook, sheets=(first, *(replace(each, hidden=True) for each in others))), targets[-1])
        for pdf in convert_with_libreoffice(targets, "pdf", Path(folder)):
            subprocess.run(["pdftoppm", "-r", "130", "-singlefile", "-png", pdf, pdf.with_suffix("")], check=True)
            page = Image.open(pdf.with_suffix(".png"))
            yield page.crop((0, 0, page.width, round(page.height * (1 - FOOTER))))


def drawn(paths: Sequence[Path]) -> Iterator[Image.Image]:
    """The drawing of the page, as wide as a notebook's screen leaves it."""
    from playwright.sync_api import sync_playwright

    from mechsheet.drawing_page.answers import Studio
    from mechsheet.drawing_page.server import DrawingServer

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as started:
        browser = started.chromium.launch(executable_path="/usr/bin/chromium", args=BROWSER)
        for path in paths:
            copy = Path(folder) / path.name
            copy.write_bytes(path.read_bytes())
            server = DrawingServer(Studio(copy, language="en"))
            server.start()
            window = browser.new_page(viewport={"width": 1366, "height": 768})
            window.goto(server.address)
            window.wait_for_selector("body[data-ready=yes]")
            window.wait_for_timeout(500)
            yield Image.open(io.BytesIO(window.locator("#sheet").screenshot()))
            window.close()
            server.stop()
        browser.close()


def contact_sheet(names: Sequence[str], images: Sequence[Image.Image]) -> Image.Image:
    """The drawings in rows, each under its name."""
    across = min(ACROSS, len(images))
    sheet = Image.new("RGB", (across * SIDE, ceil(len(images) / across) * (SIDE + TITLE)), "white")
    for number, (name, image) in enumerate(zip(names, images, strict=True)):
        down, right = divmod(number, across)
        whole = image.convert("RGB")
        seen = whole.crop(ImageChops.difference(whole, Image.new("RGB", whole.size, "white")).getbbox())
        seen.thumbnail((SIDE - 8, SIDE - 8))
        sheet.paste(seen, (right * SIDE + 4, down * (SIDE + TITLE) + TITLE))
        ImageDraw.Draw(sheet).text((right * SIDE + 6, down * (SIDE + TITLE) + 3), name, fill="black")
    return sheet


def main(target: str, program: str = "plot", *names: str) -> None:
    """The picture of all that are named, by one of the programs."""
    paths = [Path(name) if name.endswith(".toml") else TEMPLATES / f"{name}.toml" for name in names]
    paths = paths or sorted(TEMPLATES.glob("*.toml"))
    takers = {"plot": plotted, "page": drawn}
    images = takers[program](paths) if program in takers else printed(paths, program)
    contact_sheet([path.stem for path in paths], list(images)).save(target)


if __name__ == "__main__":
    main(*sys.argv[1:])
