"""What Excel repairs or refuses, as rules for the parts of an .xlsx.

From ECMA-376-1 (order of elements 18.3.1.99, shared formulas 18.3.1.40, validations 18.3.1.32, numbers of styles 18.8) and
"Excel specifications and limits". `strict_xlsx` has what other strict readers refuse; names of cells are `formula.names`.
"""

from __future__ import annotations

import posixpath
import re
import zipfile
from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache, cached_property
from itertools import pairwise
from pathlib import Path

from lxml import etree

from livesheet.formats.limits import title_fault
from livesheet.formula.functions import FUNCTIONS

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
CHART = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
ORDER = (
    "sheetPr", "dimension", "sheetViews", "sheetFormatPr", "cols", "sheetData", "sheetProtection", "mergeCells",
    "conditionalFormatting", "dataValidations", "hyperlinks", "printOptions", "pageMargins", "pageSetup", "headerFooter",
    "rowBreaks", "colBreaks", "ignoredErrors", "drawing", "legacyDrawing", "AlternateContent", "tableParts", "extLst",
)  # fmt: skip
TEXT = re.compile(r'"(?:[^"]|"")*"')
TITLE = re.compile(r"(?:'((?:[^']|'')*)'|([^\W\d][\w.]*))!")
AREA = re.compile(r"\$?([A-Z]{1,3})\$?(\d+)(?::\$?([A-Z]{1,3})\$?(\d+))?")
ERRORS = {"#N/A", "#DIV/0!", "#NUM!", "#VALUE!", "#REF!", "#NAME?", "#NULL!"}
LONGEST, DEEPEST, MOST_ARGUMENTS, LONGEST_TEXT = 8192, 64, 255, 255
SMALLEST, LARGEST = 2.2250738585072014e-308, 1.7976931348623157e308
FUTURE = {row.name for row in FUNCTIONS.values() if row.ooxml.startswith("_xlfn.")}

Area = tuple[int, int, int, int]
"""First column, first row, last column, last row, from 1."""


class Parts:
    """An .xlsx as its parts, each parsed once."""

    def __init__(self, path: Path) -> None:
        with zipfile.ZipFile(path) as archive:
            self.data = {name: archive.read(name) for name in archive.namelist()}
        self.trees: dict[str, etree._Element] = {}

    def tree(self, name: str) -> etree._Element:
        if name not in self.trees:
            self.trees[name] = etree.fromstring(self.data[name])
        return self.trees[name]

    def under(self, folder: str) -> list[etree._Element]:
        return [self.tree(name) for name in self.data if re.fullmatch(rf"xl/{folder}/[^/]*\.xml", name)]

    @cached_property
    def sheets(self) -> list[etree._Element]:
        return self.under("worksheets")

    @cached_property
    def titles(self) -> list[str]:
        return [sheet.get("name") for sheet in self.tree("xl/workbook.xml").iter(f"{MAIN}sheet")]

    @cached_property
    def formulas(self) -> dict[str, str]:
        """Texts of formulas that differ in more than their numbers -> one of them."""
        found = {}
        for sheet in self.sheets:
            found |= {re.sub(r"\d+", "0", f.text): f.text for f in sheet.iter(f"{MAIN}f") if f.text}
        return found


def column(letters: str) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - 64
    return number


@cache
def area(text: str) -> Area:
    left, top, right, end = AREA.fullmatch(text).groups()
    return column(left), int(top), column(right or left), int(end or top)


def _name(element: etree._Element) -> str:
    return etree.QName(element).localname


def order(parts: Parts) -> Iterator[str]:
    for sheet in parts.sheets:
        places = [ORDER.index(_name(child)) for child in sheet]
        yield from (f"{ORDER[b]} after {ORDER[a]}" for a, b in pairwise(places) if b < a)


def cells(parts: Parts) -> Iterator[str]:
    """Rows and cells go up, none stands outside of the sheet, and each says what it holds."""
    styles = len(parts.tree("xl/styles.xml").find(f"{MAIN}cellXfs"))
    strings = len(parts.tree("xl/sharedStrings.xml"))
    for sheet in parts.sheets:
        before = 0
        for row in sheet.iter(f"{MAIN}row"):
            number, at = int(row.get("r")), 0
            if not before < number <= 1_048_576:
                yield f"row {number} after {before}"
            before = number
            for cell in row:
                col, place = column(cell.get("r").rstrip("0123456789")), cell.get("r")
                if not (at < col <= 16_384 and place.endswith(str(number))):
                    yield f"{place} stands out of order"
                at = col
                if int(cell.get("s", "0")) >= styles:
                    yield f"{place} has style {cell.get('s')} of {styles}"
                value = cell.findtext(f"{MAIN}v")
                if value is not None and not _fits(cell.get("t"), value, strings):
                    yield f"{place} holds {value} as {cell.get('t')}"


def _fits(kind: str | None, value: str, strings: int) -> bool:
    if kind == "s":
        return int(value) < strings
    if kind == "b":
        return value in ("0", "1")
    if kind == "e":
        return value in ERRORS
    if kind == "str":
        return len(value) <= 32_767
    number = abs(float(value))
    return number == 0 or SMALLEST <= number <= LARGEST


def lengths(parts: Parts) -> Iterator[str]:
    """Of formulas: characters, parentheses in parentheses, arguments, texts."""
    for text in parts.formulas.values():
        if len(text) > LONGEST:
            yield f"a formula of {len(text)} characters"
        longest = max((len(quoted.replace('""', '"')) - 2 for quoted in TEXT.findall(text)), default=0)
        if longest > LONGEST_TEXT:
            yield f"a text of {longest} characters in a formula"
        commas = [0]
        for sign in re.sub(r"'[^']*'", "", TEXT.sub("", text)):
            if sign == "(":
                commas.append(0)
            elif sign == ")":
                if commas.pop() >= MOST_ARGUMENTS:
                    yield f"too many arguments: {text[:60]}"
            elif sign == ",":
                commas[-1] += 1
            if len(commas) > DEEPEST:
                yield f"more than {DEEPEST} levels: {text[:60]}"
                break


def prefixes(parts: Parts) -> Iterator[str]:
    """Functions that Excel 2007 did not have carry a prefix; others do not."""
    for text in parts.formulas.values():
        for prefix, name in re.findall(r"(_xlfn\.(?:_xlws\.)?)?\b([A-Z][A-Z0-9.]*)\(", TEXT.sub("", text)):
            if bool(prefix) != (name in FUTURE):
                yield f"{prefix}{name}"


def sharing(parts: Parts) -> Iterator[str]:
    """Each shared formula has one first cell, with its text and its area, and all its cells lie in that."""
    for sheet in parts.sheets:
        areas: dict[str, Area] = {}
        for f in sheet.iter(f"{MAIN}f"):
            if f.get("t") != "shared":
                continue
            place, number = f.getparent().get("r"), f.get("si")
            if f.text:
                if number in areas:
                    yield f"shared formula {number} begins twice"
                areas[number] = area(f.get("ref"))
            left, top, right, end = areas.get(number, (0, 0, 0, 0))
            col, row = area(place)[:2]
            if not (left <= col <= right and top <= row <= end):
                yield f"{place} is no cell of shared formula {number}"


def titles(parts: Parts) -> Iterator[str]:
    """Sheets: names that may be, that differ, and that formulas, names and charts mean."""
    yield from (f"{title} {title_fault(title)}" for title in parts.titles if title_fault(title))
    yield from (f"two sheets {t}" for t, n in Counter(t.casefold() for t in parts.titles).items() if n > 1)
    texts = [name.text for name in parts.tree("xl/workbook.xml").iter(f"{MAIN}definedName")]
    texts += [f.text for chart in parts.under("charts") for f in chart.iter(f"{CHART}f")] + [*parts.formulas.values()]
    named = {quoted.replace("''", "'") or plain for t in texts for quoted, plain in TITLE.findall(TEXT.sub("", t))}
    yield from (f"no sheet {title}" for title in sorted(named - set(parts.titles)))


def names(parts: Parts) -> Iterator[str]:
    """Names of cells: their scope is a sheet, and no two are the same in it."""
    seen = set()
    for name in parts.tree("xl/workbook.xml").iter(f"{MAIN}definedName"):
        key = name.get("localSheetId"), name.get("name").casefold()
        if key in seen or len(key[1]) > 255:
            yield f"name {key[1]}"
        if key[0] is not None and int(key[0]) >= len(parts.titles):
            yield f"{key[1]} is of sheet {key[0]}"
        seen.add(key)


def views(parts: Parts) -> Iterator[str]:
    """The sheet that opens is shown."""
    book = parts.tree("xl/workbook.xml")
    active = int(next(book.iter(f"{MAIN}workbookView")).get("activeTab", "0"))
    states = [sheet.get("state", "visible") for sheet in book.iter(f"{MAIN}sheet")]
    if states[active : active + 1] != ["visible"]:
        yield f"sheet {active} opens and is hidden"
    for sheet in parts.sheets:
        for pane in sheet.iter(f"{MAIN}pane"):
            across, down = int(pane.get("xSplit", "0")), int(pane.get("ySplit", "0"))
            col, row = area(pane.get("topLeftCell"))[:2]
            if col <= across or row <= down:
                yield f"the pane shows {pane.get('topLeftCell')}, which is frozen"


def validations(parts: Parts) -> Iterator[str]:
    for sheet in parts.sheets:
        found = list(sheet.iter(f"{MAIN}dataValidation"))
        told = [int(each.get("count")) for each in sheet.iter(f"{MAIN}dataValidations")]
        if told != [len(found)] * len(told):
            yield f"{told} validations are {len(found)}"
        for rule in found:
            yield from (f"{key} is long" for key in ("promptTitle", "errorTitle") if len(rule.get(key, "")) > 32)
            yield from (f"{key} is long" for key in ("prompt", "error") if len(rule.get(key, "")) > 255)
            yield from (f"{f.text[:40]} is long" for f in rule if len(f.text) > (257 if f.text[0] == '"' else 255))


def conditions(parts: Parts) -> Iterator[str]:
    looks = parts.tree("xl/styles.xml").find(f"{MAIN}dxfs")
    for sheet in parts.sheets:
        rules = list(sheet.iter(f"{MAIN}cfRule"))
        counts = Counter(rule.get("priority") for rule in rules)
        yield from (f"{number} rules of priority {key}" for key, number in counts.items() if number > 1 or int(key) < 1)
        yield from (f"no look {rule.get('dxfId')}" for rule in rules if int(rule.get("dxfId", "0")) >= len(looks))


def charts(parts: Parts) -> Iterator[str]:
    """Copies of values are as long as their ranges, numbers of series differ, axes are those that are described."""
    for chart in parts.under("charts"):
        for ref in [*chart.iter(f"{CHART}numRef"), *chart.iter(f"{CHART}strRef")]:
            text = ref.findtext(f"{CHART}f")
            left, top, right, end = area(text.rpartition("!")[2])
            for count in ref.iter(f"{CHART}ptCount"):
                places = [int(point.get("idx")) for point in count.itersiblings(f"{CHART}pt")]
                if int(count.get("val")) != (right - left + 1) * (end - top + 1):
                    yield f"{text} has {count.get('val')} values"
                if places != sorted(set(places)) or (places and places[-1] >= int(count.get("val"))):
                    yield f"{text}: numbers of values"
        for kind in ("idx", "order"):
            numbers = [series.find(f"{CHART}{kind}").get("val") for series in chart.iter(f"{CHART}ser")]
            if len(set(numbers)) < len(numbers) or len(numbers) > 255:
                yield f"{kind} of series: {numbers}"
        asked = {axis.get("val") for plot in chart.iter(f"{CHART}scatterChart") for axis in plot.iter(f"{CHART}axId")}
        there = {axis.find(f"{CHART}axId").get("val") for axis in chart.iter(f"{CHART}valAx")}
        crossed = {axis.get("val") for axis in chart.iter(f"{CHART}crossAx")}
        if not asked == there == crossed:
            yield f"axes {asked}, {there}, {crossed}"


def merges(parts: Parts) -> Iterator[str]:
    """Merged cells do not overlap, and only the first of them holds something."""
    for sheet in parts.sheets:
        covered: dict[tuple[int, int], tuple[int, int]] = {}
        for merge in sheet.iter(f"{MAIN}mergeCell"):
            left, top, right, end = area(merge.get("ref"))
            for place in ((row, col) for row in range(top, end + 1) for col in range(left, right + 1)):
                if place in covered:
                    yield f"{merge.get('ref')} overlaps"
                covered[place] = top, left
        for value in sheet.iter(f"{MAIN}v") if covered else ():
            col, row = area(value.getparent().get("r"))[:2]
            if covered.get((row, col), (row, col)) != (row, col):
                yield f"{value.getparent().get('r')} lies under merged cells"


def sizes(parts: Parts) -> Iterator[str]:
    """Columns follow one another; widths, heights, outlines, footers and scales are within Excel's ranges."""
    for sheet in parts.sheets:
        spans = [(int(col.get("min")), int(col.get("max"))) for col in sheet.iter(f"{MAIN}col")]
        yield from (f"columns {a} and {b}" for a, b in pairwise(spans) if b[0] <= a[1])
        for col in sheet.iter(f"{MAIN}col"):
            if not 0 <= float(col.get("width", "9")) <= 255 or int(col.get("outlineLevel", "0")) > 7:
                yield f"column {dict(col.attrib)}"
        heights = [float(row.get("ht")) for row in sheet.iter(f"{MAIN}row") if row.get("ht")]
        yield from (f"a row of {height} points" for height in heights if not 0 <= height <= 409.5)
        footers = [e.text for e in sheet.iter(f"{MAIN}oddFooter", f"{MAIN}oddHeader") if len(e.text) > 255]
        yield from (f"a footer of {len(text)} characters" for text in footers)
        scales = [int(setup.get("scale", "100")) for setup in sheet.iter(f"{MAIN}pageSetup")]
        yield from (f"printed at {scale} %" for scale in scales if not 10 <= scale <= 400)


def styles(parts: Parts) -> Iterator[str]:
    """What a look refers to is there, and the counts are those of the lists."""
    root = parts.tree("xl/styles.xml")
    lists = {_name(child): child for child in root}
    for name, each in lists.items():
        if each.get("count") is not None and int(each.get("count")) != len(each):
            yield f"{each.get('count')} {name} are {len(each)}"
    own = {int(f.get("numFmtId")) for f in root.iter(f"{MAIN}numFmt")}
    for xf in [*lists["cellXfs"], *lists["cellStyleXfs"]]:
        for kind in ("font", "fill", "border"):
            if int(xf.get(f"{kind}Id")) >= len(lists[f"{kind}s"]):
                yield f"no {kind} {xf.get(f'{kind}Id')}"
        number = int(xf.get("numFmtId"))
        if number >= 164 and number not in own:
            yield f"no number format {number}"
    yield from (f"number format {number} is Excel's own" for number in own if number < 164)


def relations(parts: Parts) -> Iterator[str]:
    """Every part is listed with its type and meant by another one, every relation leads to a part; no calcChain."""
    root = parts.tree("[Content_Types].xml")
    listed = {each.get("PartName") for each in root if _name(each) == "Override"}
    endings = {each.get("Extension") for each in root if _name(each) == "Default"}
    meant = {"/[Content_Types].xml"}
    for name in (name for name in parts.data if name.endswith(".rels")):
        meant.add(f"/{name}")
        folder, of = name.split("_rels/")
        ids = [relation.get("Id") for relation in parts.tree(name)]
        yield from (f"{name}: {key} twice" for key, number in Counter(ids).items() if number > 1)
        meant |= {posixpath.normpath(posixpath.join("/", folder, each.get("Target"))) for each in parts.tree(name)}
        owner = folder + of.removesuffix(".rels")
        if owner.endswith(".xml"):
            used = re.findall(r'r:(?:id|embed)="([^"]*)"', parts.data[owner].decode())
            yield from (f"{owner} has no relation {key}" for key in used if key not in ids)
    there = {f"/{name}" for name in parts.data}
    yield from (f"no part {name}" for name in sorted((meant | listed) - there))
    yield from (f"nothing means {name}" for name in sorted(there - meant))
    yield from (f"{name} has no type" for name in there - listed if name.rpartition(".")[2] not in endings)
    yield from (name for name in there if "calcChain" in name)


def notes(parts: Parts) -> Iterator[str]:
    """One note a cell, by an author that is listed."""
    for name in parts.data:
        if name.startswith("xl/comments"):
            root = parts.tree(name)
            authors = len(list(root.iter(f"{MAIN}author")))
            counts = Counter(note.get("ref") for note in root.iter(f"{MAIN}comment"))
            yield from (f"{number} notes at {place}" for place, number in counts.items() if number > 1)
            wrote = {int(note.get("authorId")) for note in root.iter(f"{MAIN}comment")}
            yield from (f"no author {number}" for number in wrote if number >= authors)


RULES: dict[str, Callable[[Parts], Iterator[str]]] = {
    rule.__name__: rule
    for rule in (
        order, cells, lengths, prefixes, sharing, titles, names, views, validations, conditions, charts, merges, sizes,
        styles, relations, notes,
    )
}  # fmt: skip
