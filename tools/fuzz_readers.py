"""Throw damaged workbooks and formulas at the readers and the engine: `python tools/fuzz_readers.py SECONDS [SEED]`.

A case is well when it is read, or refused with a MechsheetError, in a few seconds and within bounded memory. Anything else
is printed and kept in the folder FOUND. What was found once stands in tests/formats/bad_files.py.
"""

from __future__ import annotations

import io
import random
import resource
import signal
import sys
import tempfile
import time
import traceback
import zipfile
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import xlsxwriter

from livesheet.engine import compile_book, evaluate
from livesheet.formats import read, update_values
from livesheet.formula.book import Book, BookSheet, DefinedName
from livesheet.formula.nodes import CellRef, walk
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.description import load
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.building import build

ROOT = Path(__file__).parent.parent
FOUND = Path(tempfile.gettempdir()) / "fuzz-found"
LIMIT = 10
"""Seconds that a case may take."""
MEMORY = 2 << 30

Parts = dict[str, bytes]

WORDS = [
    b"<", b">", b"/>", b"</c>", b"<c>", b"<row>", b"</row>", b'<c r="A1">', b'r="XFD1048576"', b'r="A0"',
    b'r="1048577"', b't="shared"', b't="array"', b't="dataTable"', b'si="0"', b'si="99"', b'ref="A1:XFD1048576"',
    b'ref="B2:A1"', b't="s"', b't="e"', b't="d"', b't="str"', b't="inlineStr"', b't="b"', b"<f>", b"</f>", b"<v>",
    b"</v>", b"<is><t>", b"1e999", b"-1", b"99999999999999999999", b"nan", b"\x00", b"\xff", b"&#x0;", b"&#1114111;",
    b"&a;", b"<![CDATA[", b"]]>", b"<!--", b"<!DOCTYPE a>", b"_x0000_", b"_xD800_",
    b'table:number-rows-repeated="1048576"', b'xmlns="urn:x"', b'table:number-columns-repeated="16384"',
    b'table:formula="of:=[.A1]"', b'table:number-matrix-rows-spanned="1048576"',
    b'table:number-matrix-columns-spanned="99999"', b'office:value-type="float"', b'office:value="1e400"',
    b"<text:s text:c='9'/>", b'cm="1"', b'Target="../../../../etc/passwd"', b'Target="/"', b'Target=""',
    b'TargetMode="External"', b'localSheetId="0"',
]  # fmt: skip
FORMULA = [
    "A1", "$A$1", "A:A", "1:1", "Sheet1!A1", "'It''s'!B2", "[1]S!A1", "S1:S3!A1", "T[c]", "T[[#This Row],[c]]",
    "T[@]", "@A1", "A1#", "{1,2;3,4}", "{", "}", "(", ")", "SUM(", "IF(", "LET(x,1,", "LAMBDA(x,", "_xlfn.",
    "_xlpm.x", "_xlws.", ",", ";", "|", "~", "!", " ", ":", "+", "-", "*", "/", "^", "&", "=", "<>", "<=", "%", "1",
    "1e308", "1e309", ".5", "1.", "TRUE", '"', '"a"', "#N/A", "#REF!", "#", "x", "R1C1", "\\", "ü", "[.A1]",
    "[.$A$1:.B2]", "[$Sheet1.A1]", "[#REF!]", "XFD1048576", "XFE1", "A1048577",
]  # fmt: skip


def seeds() -> list[tuple[str, Parts]]:
    """Small workbooks of several origins, as (suffix, parts)."""
    found: list[tuple[str, Parts]] = []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.xlsx"
        with xlsxwriter.Workbook(path) as workbook:
            sheet, other = workbook.add_worksheet(), workbook.add_worksheet("It's")
            workbook.define_name("rate", "=Sheet1!$A$1")
            for row in range(6):
                sheet.write_row(row, 0, [row, f"text {row}", row % 2 == 0])
                sheet.write_formula(row, 4, f"=A{row + 1}*rate+SUM(A$1:A{row + 1})", value=row)
                sheet.write_formula(row, 5, f'=IF(C{row + 1},"yes",NA())', value="yes")
            sheet.write_array_formula("G1:G6", "{=A1:A6*2}", value=1)
            sheet.write_dynamic_array_formula("H1:H3", "=SEQUENCE(3)", value=1)
            sheet.add_table("J1:K4", {"columns": [{"header": "a"}, {"header": "b", "formula": "=[@a]*2"}]})
            other.write_formula("A1", "=Sheet1!E3", value=4)
        found.append((".xlsx", parts_of(path.read_bytes())))
        for built in build(load(ROOT / "templates" / "scotch-yoke.toml"), Path(folder), ("xlsx", "ods")):
            found.append((built.suffix, parts_of(built.read_bytes())))
    shared = "".join(f'<row r="{r}"><c r="A{r}"><f t="shared" si="0"/><v>1</v></c></row>' for r in range(2, 9))
    first = '<row r="1"><c r="A1"><f t="shared" ref="A1:A9" si="0">B1+1</f><v>1</v></c>'
    first += '<c t="inlineStr"><is><t>x</t></is></c></row>'
    xlsx = dict(found[0][1])
    xlsx["xl/worksheets/sheet1.xml"] = f"<worksheet><sheetData>{first}{shared}</sheetData></worksheet>".encode()
    found.append((".xlsx", xlsx))
    return found


def parts_of(data: bytes) -> Parts:
    """The parts of a zip file, without pictures."""
    with zipfile.ZipFile(io.BytesIO(data)) as file:
        return {name: file.read(name) for name in file.namelist() if not name.endswith((".png", ".bin"))}


def packed(parts: Parts) -> bytes:
    """A zip file of these parts."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in parts.items():
            file.writestr(name, data)
    return stream.getvalue()


def damaged(data: bytes, rng: random.Random) -> bytes:
    """Bytes with a few things done to them."""
    for _ in range(rng.choice((1, 1, 2, 4, 9))):
        at = rng.randrange(len(data) + 1)
        end = min(len(data), at + rng.choice((1, 2, 9, 60, 500)))
        match rng.randrange(7):
            case 0:
                data = data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]
            case 1 | 2:
                data = data[:at] + rng.choice(WORDS) + data[at + rng.randrange(12) :]
            case 3:
                data = data[:at] + data[end:]
            case 4:
                data = data[:at] + data[at:end] * rng.choice((2, 3, 40)) + data[end:]
            case 5:
                to = rng.randrange(len(data) + 1)
                data = data[:to] + data[at:end] + data[to:]
            case _:
                formula = expression(rng, 4).replace("<", "&lt;")
                start = data.find(b"<f>", at)
                if start >= 0:
                    data = data[: start + 3] + formula.encode() + data[data.find(b"<", start + 3) :]
                else:
                    start = data.find(b':formula="of:=', at)
                    if start >= 0:
                        start += len(b':formula="of:=')
                        data = data[:start] + formula.replace('"', "").encode() + data[data.find(b'"', start) :]
    return data


def workbook_case(sources: list[tuple[str, Parts]], rng: random.Random, folder: Path) -> Callable[[], None]:
    """Read a damaged workbook, recalculate it with a cell set, write it back and read that."""
    suffix, parts = rng.choice(sources)
    parts = dict(parts)
    if rng.random() < 0.15:
        data = damaged(packed(parts), rng)
    else:
        important = [
            name for name in parts if "sheet" in name or "content" in name or "workbook" in name or "rels" in name
        ]
        for _ in range(rng.choice((1, 1, 1, 2))):
            name = rng.choice(important if rng.random() < 0.9 else list(parts))
            parts[name] = damaged(parts[name], rng)
        data = packed(parts)
    path = folder / f"case{suffix}"
    path.write_bytes(data)

    def run() -> None:
        book = read(path)
        changes = {(book.sheets[0].title, 3, 2): 5.0}

        values = compile_book(book).evaluate(changes)
        update_values(path, folder / f"out{suffix}", book, values, changes)
        read(folder / f"out{suffix}")

    return run


DIALECTS = ("excel", "openformula")
OPERANDS = [
    "A1", "$A$1", "A:A", "1:1", "Sheet1!A1", "'It''s'!B2:C3", "[1]S!A1", "S1:S3!A1", "T[c]", "T[[#This Row],[c]]", "A1#",
    "A1:B2 B1:C9", "rate", "{1,2;3,4}", "1", "1e308", ".5", "1.", "TRUE", '"a""b"', "#N/A", "#REF!", "XFD1048576",
]  # fmt: skip
OPERATORS = ["+", "-", "*", "/", "^", "&", "=", "<>", "<=", ":", " ", ","]
FUNCTIONS = [
    "SUM",
    "IF",
    "_xlfn.LET",
    "_xlfn.LAMBDA",
    "OFFSET",
    "NOSUCH",
    "_xlfn._xlws.FILTER",
    "INDEX",
    "IFERROR",
    "@SUM",
]


def expression(rng: random.Random, depth: int) -> str:
    """A formula that is mostly well formed."""
    kind = rng.randrange(8) if depth else 0
    if kind < 3:
        return rng.choice(OPERANDS)
    if kind == 3:
        return f"({expression(rng, depth - 1)})"
    if kind == 4:
        return rng.choice("-+") + expression(rng, depth - 1) + rng.choice(("", "%"))
    if kind == 5:
        args = (expression(rng, depth - 1) if rng.random() < 0.9 else "" for _ in range(rng.randrange(4)))
        return f"{rng.choice(FUNCTIONS)}({','.join(args)})"
    return expression(rng, depth - 1) + rng.choice(OPERATORS) + expression(rng, depth - 1)


def formula_case(rng: random.Random) -> tuple[str, Callable[[], None]]:
    """Parse a formula of random pieces, compute it, print it and parse it again."""
    if rng.random() < 0.3:
        text, dialect = "".join(rng.choices(FORMULA, k=rng.choice((1, 3, 8, 30, 400)))), rng.choice(DIALECTS)
    else:
        text, dialect = expression(rng, rng.choice((1, 3, 6, 9))), "excel"
        if rng.random() < 0.2:
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(FORMULA) + text[at + rng.randrange(3) :]

    def run() -> None:
        node = parse_formula(text, dialect)
        hash(node)
        sum(1 for _ in walk(node))
        sheet = BookSheet("Sheet1")
        sheet.constants.extend(0, 0, [1.0, "a", True, None, 2.5])
        sheet.block(0, 5, 3, 1, node)
        evaluate(Book([sheet], [DefinedName("rate", CellRef(0, 0, True, True, "Sheet1"))]))
        again = parse_formula(print_formula(node, dialect), dialect)
        if again != node and dialect == "excel":
            raise AssertionError(f"{text} comes back as {print_formula(node, dialect)}")

    return text, run


def too_long(signum: int, frame: FrameType | None) -> None:
    """End a case that takes too long."""
    raise TimeoutError


def main(seconds: float, seed: int) -> None:
    """Run cases until the time is over."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, too_long)
    FOUND.mkdir(exist_ok=True)
    rng = random.Random(seed)
    sources, tally, known = seeds(), Counter[str](), set[str]()
    end = time.monotonic() + seconds
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        while time.monotonic() < end:
            text = ""
            if rng.random() < 0.5:
                run = workbook_case(sources, rng, folder)
            else:
                text, run = formula_case(rng)
            signal.alarm(LIMIT)
            try:
                run()
                tally["well"] += 1
            except MechsheetError:
                tally["refused"] += 1
            except Exception as error:
                signal.alarm(0)
                tally["FOUND"] += 1
                where = traceback.extract_tb(error.__traceback__)[-1]
                key = f"{type(error).__name__} {Path(where.filename).name}:{where.lineno}"
                if key not in known:
                    known.add(key)
                    number = f"{seed}-{len(known)}"
                    print(number, key, str(error)[:200], text[:300], flush=True)
                    if text:
                        (FOUND / f"{number}.txt").write_text(text, encoding="utf-8")
                    else:
                        for left in folder.glob("case.*"):
                            (FOUND / f"{number}{left.suffix}").write_bytes(left.read_bytes())
            signal.alarm(0)
            for left in folder.iterdir():
                left.unlink()
    print(f"seed {seed}: {dict(tally)}")


if __name__ == "__main__":
    main(float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)
