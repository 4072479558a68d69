"""What a workbook is on paper: pages and sizes of print, read from the PDF that LibreOffice makes of it.

pdftohtml (poppler) says of every text its colour and fonts, pdftotext how high it is to a thousandth of a point. Charts have
a colour of letters of their own, formulas as mathematics slant; what has no more than the letters of a number is a number.
"""

from __future__ import annotations

import html
import re
import subprocess
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from folders import TEMPLATES
from livesheet.formats import write
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.description import Overrides, load
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.building import compile_workbook

HEIGHT_OF_SIZE = 1.3005
"""Of Liberation Sans, which stands in for Arial: how high poppler says a text is, for each point of its size (from widths
of digits, 0.556 of the size)."""
SIZE_OF_INDEX = 0.62
"""Of the letters beside it; LibreOffice prints them at 0.58."""
TOUCHING = 0.6
"""So near its end [points] a smaller word is an index of another."""
IN_CHARTS = "#404040"
FOOTER = 0.94
"""What begins below this part of the height of a page is the footer; in its middle stand the sheet and the page."""
NUMBER = re.compile(r"[-−+]?\d+([.,]\d+)?(E[-+]\d+)?")
ZOOM = 3
"""Of pdftohtml: it takes no more, and counts in whole pixels."""


@dataclass(frozen=True)
class Print:
    """A word on paper; `kind`: number or word in a cell, formula (slanted), chart (any in one), index; size in points."""

    text: str
    kind: str
    size: float
    bottom: float


@dataclass(frozen=True)
class Page:
    """A sheet of paper: the sheet of the workbook that it shows, and what is printed on it without the footer."""

    sheet: str
    height: float
    words: tuple[Print, ...]

    @property
    def reach(self) -> float:
        """How far down it is printed, as a part of its height."""
        return max((word.bottom for word in self.words), default=0.0) / self.height

    def smallest(self, kind: str) -> float | None:
        """The smallest print of a kind, in points."""
        return min((word.size for word in self.words if word.kind == kind), default=None)


def printed(names: Sequence[str], layout: str, folder: Path, language: str = "") -> dict[str, Path]:
    """Templates that this layout can hold -> their PDFs."""
    books = []
    for name in names:
        try:
            own = Overrides(layout=layout, language=language or None)
            workbook, _ = compile_workbook(load(TEMPLATES / f"{name}.toml", own))
        except MechsheetError:
            continue
        books.append(folder / f"{name}.xlsx")
        write(workbook, books[-1])
    target = folder / layout
    target.mkdir(exist_ok=True)
    return {path.stem: path for path in convert_with_libreoffice(books, "pdf", target)}


def pages_of(path: Path) -> list[Page]:
    """The pages of a PDF."""
    tagged = _output("pdftohtml", "-xml", "-i", "-nodrm", "-zoom", str(ZOOM), "-stdout", str(path))
    boxes = _output("pdftotext", "-bbox", str(path), "-")
    return [_page(*pair) for pair in zip(_parts(tagged, "page"), _parts(boxes, "page"), strict=True)]


def _output(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True).stdout.decode("utf-8", "replace")


def _parts(text: str, tag: str) -> list[str]:
    return re.findall(rf"<{tag} .*?</{tag}>", text, re.DOTALL)


def _page(tagged: str, boxes: str) -> Page:
    width, height = (float(re.search(rf'{side}="([\d.]+)"', boxes)[1]) for side in ("width", "height"))
    areas, found = list(_areas(tagged)), list(_words(boxes))
    words, footer = [], []
    for place, text in found:
        if place[1] > FOOTER * height:
            if width / 3 < place[0] < 2 * width / 3:
                footer.append(text)
            continue
        colour, slants = _around(areas, place)
        if _is_index(place, found):
            kind = "index"
        elif colour == IN_CHARTS:
            kind = "chart"
        else:
            kind = "formula" if slants else "number" if NUMBER.fullmatch(text) else "word"
        words.append(Print(text, kind, (place[3] - place[1]) / HEIGHT_OF_SIZE, place[3]))
    return Page(" ".join(footer).rpartition(", ")[0], height, _without_indexes(words))


def _without_indexes(words: Sequence[Print]) -> tuple[Print, ...]:
    """An index below a dotted letter, or above an index, touches no letters: it is as small beside the page's words."""
    sizes = Counter(round(word.size, 1) for word in words if word.kind in ("number", "word"))
    usual = sizes.most_common(1)[0][0] if sizes else 0.0
    return tuple(
        replace(word, kind="index") if word.kind == "number" and word.size < SIZE_OF_INDEX * usual else word
        for word in words
    )


_COLOURS: dict[str, str] = {}
"""Fonts of pages before: pdftohtml names each once in a file."""

Box = tuple[float, float, float, float]
"""Left, top, right, bottom in points."""


def _areas(tagged: str) -> Iterator[tuple[Box, str, bool]]:
    """Texts of a page: where, colour, whether they slant."""
    _COLOURS.update(re.findall(r'<fontspec id="(\d+)".*?color="(#\w+)"', tagged))
    pattern = r'<text top="(-?\d+)" left="(-?\d+)" width="(\d+)" height="(\d+)" font="(\d+)">(.*?)</text>'
    for *place, font, inside in re.findall(pattern, tagged, re.DOTALL):
        top, left, wide, high = (int(value) / ZOOM for value in place)
        yield (left, top, left + wide, top + high), _COLOURS[font], "<i>" in inside


def _words(boxes: str) -> Iterator[tuple[Box, str]]:
    pattern = r'<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)</word>'
    for *place, text in re.findall(pattern, boxes, re.DOTALL):
        left, top, right, bottom = map(float, place)
        yield (left, top, right, bottom), html.unescape(text)


def _around(areas: Sequence[tuple[Box, str, bool]], word: Box) -> tuple[str, bool]:
    """Colour and slant of the text in which a word stands: the smallest around its middle."""
    x, y = (word[0] + word[2]) / 2, (word[1] + word[3]) / 2
    around = [one for one in areas if one[0][0] - 1 <= x <= one[0][2] + 1 and one[0][1] - 1 <= y <= one[0][3] + 1]
    if not around:
        return "", False
    _, colour, slants = min(around, key=lambda one: abs((one[0][1] + one[0][3]) / 2 - y))
    return colour, slants


def _is_index(word: Box, found: Sequence[tuple[Box, str]]) -> bool:
    """Whether it is small beside a word that ends where it begins."""
    return any(
        abs(other[2] - word[0]) < TOUCHING
        and other[1] < word[3]
        and word[1] < other[3]
        and word[3] - word[1] < 0.8 * (other[3] - other[1])
        for other, _ in found
    )
