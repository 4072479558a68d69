"""Number formats written as codes (0.00, +0.0" mm", 0%, 0.0E+00) in OpenDocument's elements."""

from __future__ import annotations

import re

from ..xml_text import escaped

_TOKEN = re.compile(
    r"""
      (?P<general>General)
    | "(?P<quoted>[^"]*)"
    | \\(?P<single>.)
    | _(?P<width>.)
    | \*(?P<repeated>.)
    | \[(?P<bracket>[^\]]*)\]
    | (?=[0\#?.])(?P<whole>[0\#?,]*)(?:\.(?P<decimals>[0\#?]*))?(?:E(?P<sign>[+-])(?P<exponent>0+))?
    | (?P<sign_or_space>[-+()/:\ ])
    | (?P<percent>%)
    | (?P<text>@)
    | (?P<other>[^A-Za-z"\\_*\[])
    """,
    re.VERBOSE,
)
_COLORS = {"red": "FF0000", "blue": "0000FF", "green": "008000", "black": "000000"}
_CONDITIONS = {2: ("value()&gt;=0",), 3: ("value()&gt;0", "value()&lt;0")}
"""When the sections before the last one hold: two sections are for numbers from 0 up and below, the third is for 0."""


def number_style(name: str, code: str) -> str:
    """The style elements for a number format; the one called `name` comes last.

    Raises ValueError for a code that has something else in it than digits, texts, %, @, exponents and colours.
    """
    sections = _sections(code)
    if len(sections) > 3:
        raise ValueError(f"the number format {code!r} has more than three sections")
    *first, last = sections
    parts, maps = [], ""
    for i, (section, condition) in enumerate(zip(first, _CONDITIONS.get(len(sections), ()), strict=True)):
        parts.append(_style(f"{name}P{i}", section, "", ' style:volatile="true"'))
        maps += f'<style:map style:condition="{condition}" style:apply-style-name="{name}P{i}"/>'
    return "".join(parts) + _style(name, last, maps, "")


def _sections(code: str) -> list[str]:
    """The code cut at semicolons that stand in no text."""
    return re.findall(r'(?:"[^"]*"|\\.|[^;"\\])+', code) or ["General"]


def _style(name: str, section: str, maps: str, kind: str) -> str:
    element, color, body = "number", "", ""
    position = 0
    while position < len(section):
        match = _TOKEN.match(section, position)
        if match is None or match.end() == position:
            raise ValueError(f"the number format {section!r} cannot be written to .ods")
        position = match.end()
        found = match.groupdict()
        if found["bracket"] is not None:
            if found["bracket"].lower() not in _COLORS:
                raise ValueError(f"the number format {section!r} cannot be written to .ods")
            color = f'<style:text-properties fo:color="#{_COLORS[found["bracket"].lower()]}"/>'
        elif found["text"]:
            element, body = "text", body + "<number:text-content/>"
        elif found["percent"]:
            element, body = "percentage", body + "<number:text>%</number:text>"
        elif found["general"]:
            body += '<number:number number:min-integer-digits="1"/>'
        elif found["whole"] is not None:
            body += _digits(found["whole"], found["decimals"] or "", found["sign"], found["exponent"])
        elif not found["repeated"]:
            text = found["quoted"] or found["single"] or found["sign_or_space"] or found["other"] or " "
            body += f"<number:text>{escaped(text)}</number:text>"
    # Texts that follow one another are one element of the schema.
    body = body.replace("</number:text><number:text>", "")
    return f'<number:{element}-style style:name="{name}"{kind}>{color}{body}{maps}</number:{element}-style>'


def _digits(whole: str, decimals: str, sign: str | None, exponent: str | None) -> str:
    attributes = (
        f'number:decimal-places="{len(decimals)}" number:min-decimal-places="{decimals.count("0")}"'
        f' number:min-integer-digits="{whole.count("0")}"'
    )
    if "," in whole:
        attributes += ' number:grouping="true"'
    if exponent is None:
        return f"<number:number {attributes}/>"
    forced = "true" if sign == "+" else "false"
    return (
        f'<number:scientific-number {attributes} number:min-exponent-digits="{len(exponent)}"'
        f' number:forced-exponent-sign="{forced}"/>'
    )
