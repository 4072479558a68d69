"""Modules of Basic inside an .ods: the library Standard as LibreOffice stores it (its own addition to OpenDocument)."""

from __future__ import annotations

from collections.abc import Sequence
from xml.sax.saxutils import escape

from mechsheet.sheet.workbook import Module

from ..xml_text import attribute

_HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n'
_DOCTYPE = '<!DOCTYPE {0}:{1} PUBLIC "-//OpenOffice.org//DTD OfficeDocument 1.0//EN" "{2}.dtd">\n'
_LIBRARY = 'xmlns:library="http://openoffice.org/2000/library"'


def macro_parts(modules: Sequence[Module]) -> dict[str, str]:
    """Name -> content of every part that the modules need; none without modules."""
    if not modules:
        return {}
    elements = "".join(f'<library:element library:name="{attribute(module.name)}"/>' for module in modules)
    parts = {
        "Basic/script-lc.xml": f"{_HEAD}{_DOCTYPE.format('library', 'libraries', 'libraries')}"
        f'<library:libraries {_LIBRARY} xmlns:xlink="http://www.w3.org/1999/xlink">'
        '<library:library library:name="Standard" library:link="false"/></library:libraries>',
        "Basic/Standard/script-lb.xml": f"{_HEAD}{_DOCTYPE.format('library', 'library', 'library')}"
        f'<library:library {_LIBRARY} library:name="Standard" library:readonly="false"'
        f' library:passwordprotected="false">{elements}</library:library>',
    }
    for module in modules:
        parts[f"Basic/Standard/{module.name}.xml"] = (
            f"{_HEAD}{_DOCTYPE.format('script', 'module', 'module')}"
            f'<script:module xmlns:script="http://openoffice.org/2000/script" script:name="{attribute(module.name)}"'
            f' script:language="StarBasic">{escape(module.text)}</script:module>'
        )
    return parts
