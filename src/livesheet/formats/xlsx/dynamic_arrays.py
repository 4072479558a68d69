"""Which cells of an .xlsx hold dynamic arrays: `<c cm="1">` points into the part metadata.xml, which says so."""

from __future__ import annotations

from collections.abc import Mapping
from xml.parsers import expat

from ..reading.package import Package, attribute, local_name

_TYPE = "XLDAPR"
"""The type of metadata that marks dynamic arrays (Microsoft, [MS-XLSX] 2.4.87)."""


def dynamic_marks(package: Package, links: Mapping[str, tuple[str, str]]) -> frozenset[str]:
    """The values of `cm` that mean a dynamic array."""
    part = next((target for kind, target in links.values() if kind == "sheetMetadata"), "")
    if part not in package:
        return frozenset()
    types: list[str] = []
    dynamic: list[bool] = []
    cells: list[tuple[str, str]] = []
    inside: list[str] = []
    owner = ""

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal owner
        name = local_name(tag)
        inside.append(name)
        if name == "metadataType":
            types.append(attributes.get("name", ""))
        elif name == "futureMetadata":
            owner = attributes.get("name", "")
        elif name == "bk" and owner == _TYPE and "futureMetadata" in inside:
            dynamic.append(False)
        elif name == "dynamicArrayProperties" and dynamic:
            dynamic[-1] = (attribute(attributes, "fDynamic") or "1") in ("1", "true")
        elif name == "bk" and "cellMetadata" in inside:
            cells.append(("", ""))
        elif name == "rc" and "cellMetadata" in inside and cells:
            cells[-1] = attributes.get("t", ""), attributes.get("v", "")

    def end(tag: str) -> None:
        inside.pop()
        del tag

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    parser.EndElementHandler = end
    package.parse(part, parser)

    def is_dynamic(kind: str, place: str) -> bool:
        if not (kind.isdecimal() and place.isdecimal() and 1 <= int(kind) <= len(types)):
            return False
        return types[int(kind) - 1] == _TYPE and int(place) < len(dynamic) and dynamic[int(place)]

    return frozenset(str(number) for number, found in enumerate(cells, 1) if is_dynamic(*found))
