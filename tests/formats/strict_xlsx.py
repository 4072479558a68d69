"""What strict readers want of an .xlsx: rules for its raw XML, as the published formats and Excel's own files have it."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

from lxml import etree

from livesheet.formula.names import name_fault
from livesheet.formula.nodes import Call, walk
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import longest_spelling

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
CHART = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
DRAWING = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
XDR = "{http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing}"

ANCHOR = re.compile(r"\d+(?:, ?\d+){7}")
TEXT = re.compile(r'"(?:[^"]|"")*"')
QUOTED = re.compile(r"'(?:[^']|'')*'")
DIGITS = re.compile(r"(?<![\w.$])(\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w.(!])")
NOT_SHARED = re.compile(r"[!{\[]|#REF|\bLET\(|\bLAMBDA\(|_xlfn")
LONGEST_FORMULA = 8192


def faults(path: Path) -> list[str]:
    """All that a strict reader would refuse, and all that Excel would show otherwise than it is meant."""
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    found = [f"{name}: {fault}" for name, data in parts.items() for fault in _part(name, data)]
    return (
        found + [f"workbook: {fault}" for fault in _functions(parts)] + [f"styles: {fault}" for fault in _fonts(parts)]
    )


def _part(name: str, data: bytes) -> Iterator[str]:
    if name.endswith(".vml"):
        yield from (
            f"anchor {a}" for a in re.findall(r"<x:Anchor>(.*?)</x:Anchor>", data.decode()) if not ANCHOR.fullmatch(a)
        )
    elif name.startswith("xl/worksheets/sheet"):
        yield from _sheet(etree.fromstring(data))
    elif name.startswith("xl/charts/"):
        corners = [element.get("val") for element in etree.fromstring(data).iter(f"{CHART}roundedCorners")]
        if corners != ["0"]:
            yield "round corners"
        yield from (f"value {v.text}" for v in etree.fromstring(data).iter(f"{CHART}v") if v.text == "-0")
    elif name.startswith("xl/drawings/drawing"):
        places = (
            e for e in etree.fromstring(data).iter() if e.tag in {XDR + t for t in ("col", "row", "colOff", "rowOff")}
        )
        yield from (f"{e.tag} {e.text}" for e in places if not e.text.isdigit())
    elif name == "xl/workbook.xml":
        names = [e.get("name") for e in etree.fromstring(data).iter(f"{MAIN}definedName")]
        yield from (f"name {n}" for n in names if not n.startswith("_xlnm.") and name_fault(n))


def _sheet(root: etree._Element) -> Iterator[str]:
    for cell in root.iter(f"{MAIN}c"):
        formula, value = cell.find(f"{MAIN}f"), cell.findtext(f"{MAIN}v")
        if value is not None and re.fullmatch(r"-0(?:\.0*)?", value):
            yield f"{cell.get('r')} holds {value}"
        if formula is None:
            if cell.get("t") is None and value is not None and _digits(value) > 15:
                yield f"{cell.get('r')} holds {value}: more than 15 digits"
        elif formula.text is not None:
            yield from (f"{cell.get('r')}: {fault}" for fault in _formula(formula))
    for rule in root.iter(f"{MAIN}conditionalFormatting"):
        texts = [element.text or "" for element in rule.iter(f"{MAIN}formula")]
        yield from (f"the rule {text} reads another sheet" for text in texts if "!" in TEXT.sub("", text))
    seen = set()
    for ignored in root.iter(f"{MAIN}ignoredError"):
        ranges = set(ignored.get("sqref").split())
        if seen & ranges:
            yield f"ignored twice: {seen & ranges}"
        seen |= ranges


def _formula(formula: etree._Element) -> Iterator[str]:
    text = formula.text
    bare = TEXT.sub('""', text)
    if formula.get("t") == "shared" and NOT_SHARED.search(bare):
        yield f"shared: {text[:80]}"
    numbers = DIGITS.findall(QUOTED.sub("", bare))
    yield from (f"{n} has more than 15 digits" for n in numbers if _digits(n) > 15)
    if re.search(r"(?<![\w)])-0(?![\d.])", bare):
        yield f"-0 in {text[:80]}"
    if 3 * len(text) > LONGEST_FORMULA and (length := longest_spelling(parse_formula(text))) > LONGEST_FORMULA:
        yield f"{length} characters in another language"


def _digits(number: str) -> int:
    """Digits that count."""
    return len(re.sub(r"[eE].*|[-.]", "", number).lstrip("0").rstrip("0"))


def _functions(parts: dict[str, bytes]) -> Iterator[str]:
    """Calls of functions that are names: each a dynamic array, with the part that says so."""
    names = etree.fromstring(parts["xl/workbook.xml"]).iter(f"{MAIN}definedName")
    functions = {e.get("name") for e in names if "LAMBDA(" in (e.text or "")}
    if not functions:
        return
    if b"XLDAPR" not in parts.get("xl/metadata.xml", b""):
        yield "no metadata for dynamic arrays"
    for name in parts:
        if name.startswith("xl/worksheets/sheet"):
            for cell in etree.fromstring(parts[name]).iter(f"{MAIN}c"):
                formula = cell.find(f"{MAIN}f")
                if formula is None or not formula.text or not any(f"{word}(" in formula.text for word in functions):
                    continue
                called = {node.name for node in walk(parse_formula(formula.text)) if isinstance(node, Call)}
                alone = (cell.get("cm"), formula.get("t"), formula.get("ref")) == ("1", "array", cell.get("r"))
                if called & functions and not alone:
                    yield f"{name} {cell.get('r')} calls a LAMBDA and is no dynamic array"


def _fonts(parts: dict[str, bytes]) -> Iterator[str]:
    """Fonts that follow the theme, and name another one than the theme has."""
    theme = etree.fromstring(parts["xl/theme/theme1.xml"])
    of_theme = {
        kind: theme.find(f".//{DRAWING}{kind}Font/{DRAWING}latin").get("typeface") for kind in ("major", "minor")
    }
    for name, data in parts.items():
        if name == "xl/styles.xml" or name == "xl/sharedStrings.xml" or name.startswith("xl/comments"):
            for scheme in etree.fromstring(data).iter(f"{MAIN}scheme"):
                font = next(e for e in scheme.getparent() if e.tag in (f"{MAIN}name", f"{MAIN}rFont"))
                if of_theme.get(scheme.get("val")) != font.get("val"):
                    yield f"{name}: {font.get('val')}, and the theme's font"
