"""Files that are no workbooks, broken ones, and ones made to do harm: each is built here, by what is wrong with it."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Callable, Mapping
from typing import NamedTuple

import xls_files as xls
from ods_files import cell, content, number, row, table

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
RELS = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
SHEET = "xl/worksheets/sheet1.xml"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
LAUGHS = "<!DOCTYPE x [<!ENTITY a0 'ha'>" + "".join(
    f"<!ENTITY a{n} '{f'&a{n - 1};' * 10}'>" for n in range(1, 12)
) + "]>"  # fmt: skip

Parts = dict[str, str | bytes]


class Bad(NamedTuple):
    """A file's suffix, what makes its bytes, and what the one message about it says."""

    suffix: str
    make: Callable[[], bytes]
    message: str


def xlsx(rows: str = '<row r="1"><c r="A1"><v>1</v></c></row>', names: str = "") -> Parts:
    """The parts of a small workbook."""
    return {
        "_rels/.rels": f'<Relationships xmlns="{PACKAGE}"><Relationship Id="a" Type="{RELS}/officeDocument"'
        ' Target="xl/workbook.xml"/></Relationships>',
        "xl/workbook.xml": f'<workbook xmlns="{MAIN}" xmlns:r="{RELS}"><sheets><sheet name="S" sheetId="1" r:id="a"/>'
        f"</sheets><definedNames>{names}</definedNames></workbook>",
        "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{PACKAGE}"><Relationship Id="a" Type="{RELS}/worksheet"'
        ' Target="worksheets/sheet1.xml"/></Relationships>',
        SHEET: f'<worksheet xmlns="{MAIN}"><sheetData>{rows}</sheetData></worksheet>',
    }  # fmt: skip


def packed(parts: Mapping[str, str | bytes]) -> bytes:
    """A zip file of these parts."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in parts.items():
            file.writestr(name, data)
    return stream.getvalue()


def ods(inside: str, before: str = "") -> bytes:
    """An .ods with these tables."""
    return packed({"content.xml": content(inside, before=before)})


def changed(**parts: str | bytes | None) -> Parts:
    """The small workbook with one part another, or gone; `sheet` and `rels` and `workbook` name them."""
    places = {
        "sheet": SHEET,
        "rels": "xl/_rels/workbook.xml.rels",
        "workbook": "xl/workbook.xml",
        "root": "_rels/.rels",
    }
    found = xlsx()
    for name, data in parts.items():
        if data is None:
            del found[places[name]]
        else:
            found[places[name]] = data
    return found


def sheet(rows: str) -> bytes:
    """A workbook with these rows."""
    return packed(xlsx(rows))


def formula(text: str) -> bytes:
    """A workbook with this formula in A1."""
    return sheet(f'<row r="1"><c r="A1"><f>{text}</f></c></row>')


def ole(stream: str, sector: int = 0) -> bytes:
    """An OLE file whose directory, in `sector`, names a stream."""
    head = bytearray(512)
    head[:8] = OLE
    head[30:32] = struct.pack("<H", 9)
    head[48:52] = struct.pack("<I", sector)
    directory = b"".join(name.encode("utf-16-le").ljust(128, b"\0") for name in ("Root Entry", "x", "y", stream))
    return bytes(head) + bytes(512 * sector) + directory


def overlapping(copies: int = 3000) -> bytes:
    """A zip file that lists one part thousands of times: small to send, endless to unpack."""
    data = zlib.compress(bytes(4 << 20), 9)[2:-4]
    check = zlib.crc32(bytes(4 << 20))
    sizes = struct.pack("<III", check, len(data), 4 << 20)
    local = b"PK\x03\x04" + struct.pack("<HHHHH", 20, 0, 8, 0, 33) + sizes + struct.pack("<HH", 1, 0) + b"a" + data
    entries = b"".join(
        b"PK\x01\x02" + struct.pack("<HHHHHH", 20, 20, 0, 8, 0, 33) + sizes
        + struct.pack("<HHHHHII", 5, 0, 0, 0, 0, 0, 0) + b"%05d" % n
        for n in range(copies)
    )  # fmt: skip
    return local + entries + b"PK\x05\x06" + struct.pack("<HHHHIIH", 0, 0, copies, copies, len(entries), len(local), 0)


def wrong_sum() -> bytes:
    """A workbook whose sheet has another checksum than the file says."""
    data = bytearray(packed(xlsx()))
    place = data.rfind(SHEET.encode()) - 46 + 16
    data[place : place + 4] = b"\1\2\3\4"
    return bytes(data)


def password_of_zip() -> bytes:
    """A workbook packed with a password (the flag is enough)."""
    data = bytearray(packed(xlsx()))
    for mark, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = data.find(mark)
        while at >= 0:
            data[at + offset] |= 1
            at = data.find(mark, at + 4)
    return bytes(data)


BIG = '<row r="1"><c r="A1"><v>1</v></c></row>' * 1_200_000
"""Forty times a megabyte of the same: packs hundreds to one."""


def zip_of_tomorrow() -> bytes:
    """A workbook in a zip file of a version that there is not."""
    data = bytearray(packed(xlsx()))
    data[data.find(b"PK\x01\x02") + 6] = 234
    return bytes(data)


def damaged(**parts: str | None) -> Callable[[], bytes]:
    """Makes the small workbook with some parts changed."""
    return lambda: packed(changed(**parts))


def rows(text: str) -> Callable[[], bytes]:
    """Makes a workbook with these rows."""
    return lambda: sheet(text)


ONE = xls.number(0, 0, 1.0)
"""A cell of an .xls."""


def more_tables() -> bytes:
    """An .xls whose list of tables goes on in a sector that names itself as the next one."""
    data = bytearray(xls.compound(struct.pack("<I", 3) * 2000))
    data[68:72] = struct.pack("<I", 3)
    return bytes(data)


BAD: dict[str, Bad] = {
    # no workbooks
    "empty": Bad(".xlsx", lambda: b"", "the file is empty"),
    "csv": Bad(".csv", lambda: b"a,b\n1,2\n", "no zip file"),
    "csv-as-xlsx": Bad(".xlsx", lambda: "Länge;1,5\n".encode("cp1252"), "a table as text (.csv)?"),
    "random-bytes": Bad(".xlsx", lambda: bytes(range(256)) * 40, "not a workbook"),
    "xls": Bad(".xlsx", lambda: ole("Workbook"), "an .xls of the old kind"),
    "xls-without-ole": Bad(".xlsx", lambda: b"\x09\x08\x10\x00\x00\x06\x05\x00" + bytes(99), "an .xls of the old kind"),
    "csv-as-xls": Bad(".xls", lambda: b"a,b\n1,2\n", "it does not begin as an .xls does"),
    "xlsx-as-xls": Bad(".xls", lambda: packed(xlsx()), "a zip file with the suffix of an .xls"),
    "xls-empty": Bad(".xls", lambda: b"", "the file is empty"),
    "xls-of-word": Bad(".xls", lambda: xls.compound(bytes(999), "WordDocument"), "no stream in it is called Workbook"),
    "xls-of-95": Bad(".xls", lambda: xls.compound(bytes(999), "Book"), "a workbook of Excel 95 or older"),
    "xls-of-95-inside": Bad(".xls", lambda: xls.stream(("S", ONE), version=0x0500), "a workbook of Excel 95 or older"),
    "xls-of-excel-2": Bad(".xls", lambda: b"\x09\x00\x04\x00\x02\x00\x10\x00", "a workbook of Excel 95 or older"),
    "xls-password": Bad(
        ".xls", lambda: xls.stream(("S", ONE), before=xls.record(0x2F, bytes(6))), "protected by a password"),
    "xls-encrypted": Bad(".xls", lambda: xls.compound(bytes(999), "EncryptedPackage"), "protected by a password"),
    "xls-cut-off": Bad(".xls", lambda: xls.stream(("S", ONE))[:-7], "damaged or cut off (the workbook ends in the middle)"),
    "xls-head-cut-off": Bad(".xls", lambda: OLE + bytes(90), "damaged or cut off (its head is cut off)"),
    "xls-container-cut-off": Bad(".xls", lambda: xls.compound(bytes(4000))[:3000], "damaged or cut off"),
    "xls-stream-in-a-circle": Bad(".xls", lambda: xls.compound(bytes(4000), links={6: 4}), "a stream that runs in a circle"),
    "xls-table-in-a-circle": Bad(".xls", more_tables, "its list of tables runs in a circle"),
    "xls-directory-in-a-circle": Bad(
        ".xls", lambda: xls.compound(bytes(4000), links={1: 1}), "a stream that runs in a circle"),
    "xls-sector-nowhere": Bad(".xls", lambda: xls.compound(bytes(4000), links={4: 9999}), "a sector that is not there"),
    "xls-longer-than-it-is": Bad(".xls", lambda: xls.compound(bytes(4000), size=1 << 31), "is shorter than it says"),
    "xls-no-sheet": Bad(".xls", xls.stream, "the workbook has no sheet with cells"),
    "xls-sheets-in-one-place": Bad(
        ".xls", lambda: xls.stream(("S", ONE), ("T", ONE), at=(60, 60)), "two sheets in the same place"),
    "xls-sheet-in-a-sheet": Bad(
        ".xls", lambda: xls.stream(("S", ONE), ("T", xls.bof(16) + ONE), at=(0, 134)), "is not where the workbook says"),
    "xls-sheet-nowhere": Bad(".xls", lambda: xls.stream(("S", ONE), at=(1 << 30,)), "is not where the workbook says"),
    "xls-sheets-of-one-name": Bad(".xls", lambda: xls.stream(("S", ONE), ("s", ONE)), "two sheets are called"),
    "xls-billions-of-texts": Bad(
        ".xls", lambda: xls.stream(("S", ONE), before=xls.record(0xFC, struct.pack("<IIHBI", 1, 1 << 31, 1, 4, 1 << 31))),
        "a record ends in the middle"),
    "xls-no-such-text": Bad(
        ".xls", lambda: xls.stream(("S", xls.record(0xFD, bytes(10)))), "S!A1: there is no shared text 0"),
    "xls-cell-outside": Bad(".xls", lambda: xls.stream(("S", xls.number(0, 256, 1.0))), "S!IW1: a cell outside the sheet"),
    "xls-not-a-number": Bad(".xls", lambda: xls.stream(("S", xls.number(0, 0, float("nan")))), "S!A1: nan is no number"),
    "xls-short-cell": Bad(".xls", lambda: xls.stream(("S", xls.record(0x203, b"\0\0"))), "a record ends in the middle"),
    "xls-array-of-nothing": Bad(
        ".xls", lambda: xls.stream(("S", xls.array(9, 0, 0, 0, xls.cell(0, 0)))), "an array formula without a proper area"),
    "encrypted": Bad(".xlsx", lambda: ole("EncryptedPackage"), "protected by a password"),
    "encrypted-far-away": Bad(".xlsx", lambda: ole("EncryptedPackage", 400), "protected by a password"),
    "ole-cut-off": Bad(".xlsx", lambda: OLE + b"\xff" * 504, "an .xls of the old kind"),
    "xlsb": Bad(".xlsb", lambda: packed({"xl/workbook.bin": "x"}), "an .xlsb, which is not read"),
    "numbers": Bad(".numbers", lambda: packed({"Index/Document.iwa": "x"}), "Apple Numbers"),
    "docx": Bad(".docx", lambda: packed({"word/document.xml": "<x/>"}), "a text document"),
    "zip": Bad(".zip", lambda: packed({"readme.txt": "x"}), "holds no part xl/workbook.xml"),
    "odt": Bad(".ods", lambda: packed({"mimetype": "application/vnd.oasis.opendocument.text", "content.xml": "<x/>"}),
               "not a spreadsheet but application/vnd.oasis.opendocument.text"),
    "odt-inside": Bad(".ods", lambda: packed({"content.xml": content("", "text")}), "an OpenDocument text"),
    "fods": Bad(".fods", lambda: content(table(row(number(1)))).encode(), "a flat OpenDocument file"),
    "xml-2003": Bad(".xls", lambda: b'<?xml version="1.0"?><Workbook xmlns="urn:schemas-microsoft-com:office:spreadsheet"/>',
                    "an XML spreadsheet of 2003"),
    "web-page": Bad(".xls", lambda: b"\n<HTML><table><tr><td>1</td></tr></table></HTML>", "a web page"),
    "pdf": Bad(".xlsx", lambda: b"%PDF-1.4\n%\xe2\xe3", "a PDF"),
    "xlsx-as-ods": Bad(".ods", lambda: packed(xlsx()), "an .xlsx with another file's suffix"),
    "ods-as-xlsx": Bad(".xlsx", lambda: ods(table(row(number(1)))), "an OpenDocument file"),
    # damaged ones
    "cut-off": Bad(".xlsx", lambda: packed(xlsx())[:-40], "damaged or cut off"),
    "cut-short": Bad(".xlsx", lambda: packed(xlsx())[:200], "damaged or cut off"),
    "wrong-sum": Bad(".xlsx", wrong_sum, f"{SHEET}: the file is damaged (Bad CRC-32"),
    "zip-of-tomorrow": Bad(".xlsx", zip_of_tomorrow, "damaged or cut off (zip file version 23.4)"),
    "zip-password": Bad(".xlsx", password_of_zip, "the part is encrypted with a password"),
    "no-sheet": Bad(".xlsx", damaged(sheet=None), f'{SHEET}: the sheet "S" has no part in the file'),
    "no-relationships": Bad(".xlsx", damaged(rels=None), 'the sheet "S" has no part in the file'),
    "relationship-outside": Bad(
        ".xlsx", lambda: packed(changed(rels=str(xlsx()["xl/_rels/workbook.xml.rels"]).replace(
            "worksheets/sheet1.xml", "../../../../../etc/passwd"))), 'etc/passwd: the sheet "S" has no part'),
    "relationship-elsewhere": Bad(
        ".xlsx", lambda: packed(changed(rels=str(xlsx()["xl/_rels/workbook.xml.rels"]).replace(
            "Id=", 'TargetMode="External" Id='))), 'the sheet "S" has no part'),
    "workbook-not-xml": Bad(".xlsx", damaged(workbook="not XML"), "xl/workbook.xml: the part is no proper XML"),
    "sheet-cut": Bad(".xlsx", damaged(sheet="<worksheet><sheetData><row>"), f"{SHEET}: the part is no proper XML"),
    "sheet-encoding": Bad(".xlsx", lambda: packed(changed(sheet='<?xml version="1.0" encoding="U-8"?><worksheet/>')),
                          "an encoding that is not read (unknown encoding: U-8)"),
    "sheet-encoding-wide": Bad(".xlsx", lambda: packed(changed(sheet='<?xml version="1.0" encoding="big5"?><worksheet/>')),
                               "an encoding that is not read"),
    "two-sheets": Bad(".xlsx", lambda: packed(changed(workbook=str(xlsx()["xl/workbook.xml"]).replace(
        "<sheets>", '<sheets><sheet name="s" sheetId="2" r:id="a"/>'))), 'two sheets are called'),
    "sheets-of-one-part": Bad(".xlsx", damaged(workbook=str(xlsx()["xl/workbook.xml"]).replace(
        "</sheets>", '<sheet name="T" sheetId="2" r:id="a"/></sheets>')), 'the sheets "S" and "T" have the same part'),
    "many-sheets": Bad(".xlsx", damaged(workbook=str(xlsx()["xl/workbook.xml"]).replace(
        "</sheets>", '<sheet name="T" sheetId="2" r:id="a"/>' * 10_000 + "</sheets>")), "10001 sheets, at most 10000"),
    "many-tables": Bad(".ods", lambda: ods("".join(table("", f"T{n}") for n in range(10_001))), "more than 10000 sheets"),
    "two-tables": Bad(".ods", lambda: ods(table("") + table("", "s")), "two sheets are called"),
    "nothing-inside": Bad(".ods", lambda: ods(""), "no sheet"),
    # addresses
    "row-0": Bad(".xlsx", rows('<row r="0"/>'), '"0" is no row of a sheet'),
    "row-beyond": Bad(".xlsx", rows('<row r="1048577"/>'), '"1048577" is no row of a sheet'),
    "row-unnumbered-beyond": Bad(".xlsx", rows('<row r="1048576"/><row/>'), '"1048577" is no row of a sheet'),
    "column-beyond": Bad(".xlsx", rows('<row r="1"><c r="XFE1"/></row>'), '"XFE1" is no cell of row 1'),
    "column-unnumbered-beyond": Bad(
        ".xlsx", rows('<row r="1"><c r="XFD1"><v>1</v></c><c><v>2</v></c></row>'), "outside the sheet"),
    "cell-of-another-row": Bad(".xlsx", rows('<row r="1"><c r="A2"/></row>'), '"A2" is no cell of row 1'),
    "shared-text": Bad(".xlsx", rows('<row r="1"><c r="A1" t="s"><v>9</v></c></row>'), "S!A1: there is no shared text 9"),
    "no-number": Bad(".xlsx", rows('<row r="1"><c r="B1"><v>1,5</v></c></row>'), 'S!B1: "1,5" is no number'),
    "too-large-a-number": Bad(".xlsx", rows('<row r="1"><c r="B1"><v>1e999</v></c></row>'), "S!B1: "),
    "ods-cells-beyond": Bad(".ods", lambda: ods(table(row(number(1, repeated=16385)))), "a cell outside the sheet"),
    "ods-rows-beyond": Bad(".ods", lambda: ods(table(row(number(1), repeated=1048577))), "a cell outside the sheet"),
    "ods-repeated": Bad(".ods", lambda: ods(table(row(number(1), repeated="many"))), '"many" is no number of repetitions'),
    "ods-filled": Bad(
        ".ods", lambda: ods(table(row(number(1, repeated=16384), repeated=1048576))), "repeated more than"),
    "ods-matrix": Bad(".ods", lambda: ods(table(row(cell(
        'table:formula="of:={1}" table:number-matrix-columns-spanned="16384" table:number-matrix-rows-spanned="1048576"')))),
        "array formulas over more than"),
    # entities
    "laughs-sheet": Bad(".xlsx", lambda: packed(changed(sheet=f"{LAUGHS}<worksheet>&a11;</worksheet>")),
                        f"{SHEET}: the part declares a document type"),
    "laughs-workbook": Bad(".xlsx", lambda: packed(changed(workbook=f"{LAUGHS}<workbook>&a11;</workbook>")),
                           "xl/workbook.xml: the part declares a document type"),
    "laughs-relationships": Bad(".xlsx", damaged(rels=f"{LAUGHS}<x>&a11;</x>"), "declares a document type"),
    "laughs-root": Bad(".xlsx", damaged(root=f"{LAUGHS}<x>&a11;</x>"), "declares a document type"),
    "laughs-ods": Bad(".ods", lambda: ods(table(row(number(1))), before=LAUGHS), "declares a document type"),
    "external-entity": Bad(
        ".xlsx", damaged(sheet='<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]><worksheet>&e;</worksheet>'),
        "declares a document type"),
    "external-dtd": Bad(
        ".ods", lambda: ods("", before='<!DOCTYPE x SYSTEM "http://127.0.0.1:9/x.dtd">'), "declares a document type"),
    "unknown-entity": Bad(".xlsx", damaged(sheet="<worksheet>&e;</worksheet>"), "no proper XML"),
    # bombs
    "packed-to-burst": Bad(".xlsx", lambda: sheet(BIG), "packed more than 300 to 1"),
    "one-long-tag": Bad(".xlsx", damaged(sheet=f'<worksheet a="{"x" * (6 << 20)}"/>'), "longer than 4 MB"),
    "one-long-text": Bad(
        ".xlsx", rows(f'<row r="1"><c r="A1" t="str"><v>{"x" * (6 << 20)}</v></c></row>'), "longer than 4 MB"),
    "many-parts": Bad(".xlsx", lambda: packed({str(n): "" for n in range(10_001)}), "10001 parts, at most 10000"),
    "overlapping": Bad(".xlsx", overlapping, "unpacks to more than 4 GiB"),
}  # fmt: skip
"""Name -> a file that must be refused with one message, exit code 2."""
