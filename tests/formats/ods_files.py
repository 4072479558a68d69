"""Small .ods files written by hand, as other programs might have written them."""

from __future__ import annotations

import zipfile

NAMESPACES = {
    "office": "urn:oasis:names:tc:opendocument:xmlns:office:1.0",
    "table": "urn:oasis:names:tc:opendocument:xmlns:table:1.0",
    "text": "urn:oasis:names:tc:opendocument:xmlns:text:1.0",
    "draw": "urn:oasis:names:tc:opendocument:xmlns:drawing:1.0",
    "of": "urn:oasis:names:tc:opendocument:xmlns:of:1.2",
    "calcext": "urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0",
}
MIMETYPE = "application/vnd.oasis.opendocument.spreadsheet"


def content(inside: str, kind: str = "spreadsheet", namespaces: dict[str, str] = NAMESPACES, before: str = "") -> str:
    declared = "".join(f' xmlns:{prefix}="{uri}"' for prefix, uri in namespaces.items())
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>{before}<office:document-content{declared} office:version="1.3">'
        f"<office:body><office:{kind}>{inside}</office:{kind}></office:body></office:document-content>"
    )


def table(rows: str, title: str = "S") -> str:
    return f'<table:table table:name="{title}">{rows}</table:table>'


def row(*cells: str, repeated: int | str = 1) -> str:
    times = f' table:number-rows-repeated="{repeated}"' if repeated != 1 else ""
    return f"<table:table-row{times}>{''.join(cells)}</table:table-row>"


def cell(attributes: str = "", inside: str = "", repeated: int | str = 1, covered: bool = False) -> str:
    name = "covered-table-cell" if covered else "table-cell"
    times = f' table:number-columns-repeated="{repeated}"' if repeated != 1 else ""
    return f"<table:{name}{times} {attributes}>{inside}</table:{name}>"


def number(value: object, formula: str = "", repeated: int | str = 1) -> str:
    attributes = f'office:value-type="float" office:value="{value}"'
    return cell(f'table:formula="of:={formula}" {attributes}' if formula else attributes, repeated=repeated)


def text(words: str) -> str:
    return cell('office:value-type="string"', f"<text:p>{words}</text:p>")


def write_ods(path, xml: str | bytes, others: dict[str, str | bytes] | None = None, part: str = "content.xml"):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(zipfile.ZipInfo("mimetype"), MIMETYPE)
        for name, data in {part: xml, **(others or {})}.items():
            archive.writestr(name, data)
    return path
