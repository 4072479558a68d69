"""Text to tokens: one regular expression per dialect."""

from __future__ import annotations

import re
from functools import cache
from typing import NamedTuple

from ..diagnostics import Fault, FormulaError
from ..said import say
from .tables import BRACKETS


class Token(NamedTuple):
    """kind: the name of its group in the pattern, or "end"; column: 1-based, for messages."""

    kind: str
    text: str
    column: int


_make = tuple.__new__
"""As `Token._make` does, without its call: a book has tokens by the hundred thousand."""

_NUMBER = r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"

_ERROR_NAMES = (
    r"(?:N/A|DIV/0!|NUM!|VALUE!|REF!|NAME\?|NULL!|SPILL!|CALC!|FIELD!|BLOCKED!|UNKNOWN!|CONNECT!"
    r"|BUSY!|EXTERNAL!|PYTHON!|GETTING_DATA)"
)
_DELETED = r"\#REF!\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6}(?::\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6})?"
"""As Excel writes a reference to cells of a sheet that was deleted."""

_ERRORS = rf"(?P<error>{_DELETED}|\#{_ERROR_NAMES})"

_DESCRIPTION = rf"""
    (?P<space>\s+) | {_NUMBER}
    | (?P<name>[^\W\d]\w*(?:\.[^\W\d]\w*)?)
    | (?P<op>[-+*/^]) | (?P<open>\() | (?P<close>\)) | (?P<separator>,)
"""

QUOTED = r"'(?:[^']|'')+'"
_PLAIN = r"[^\W\d][\w.]*"
_TWO_SHEETS = rf"(?!\$?[A-Za-z]{{1,3}}\$?[0-9]+:){_PLAIN}:{_PLAIN}"

# what is frequent and begins like nothing else comes first: every alternative before it is tried
_EXCEL = rf"""
    (?P<separator>,) | (?P<open>\() | (?P<close>\)) | (?P<op><>|<=|>=|[-+*/^&=<>%:~@]|\#(?!{_ERROR_NAMES}))
    | (?P<function>[^\W\d][\w.]*(?=\())
    | (?P<rows>\$?[1-9][0-9]{{0,6}}:\$?[1-9][0-9]{{0,6}}(?![\w.(]))
    | {_NUMBER}
    | (?P<sheet>(?:{QUOTED}(?::{QUOTED})?|\[[^\[\]']+\][\w.:]*|{_PLAIN}|{_TWO_SHEETS})!)
    | (?P<table>(?:(?:[^\W\d]|\\)[\w.?\\]*)?{BRACKETS})
    | (?P<cell>\$?[A-Za-z]{{1,3}}\$?[1-9][0-9]{{0,6}}(?![\w.(\[?\\$]))
    | (?P<columns>\$?[A-Za-z]{{1,3}}:\$?[A-Za-z]{{1,3}}(?![\w.(!?\\$]))
    | (?P<name>(?:[^\W\d]|\\)[\w.?\\]*)
    | (?P<text>"(?:[^"]|"")*") | (?P<space>[ \t\r\n]+) | {_ERRORS}
    | (?P<array>\{{) | (?P<array_end>\}}) | (?P<row_separator>;)
"""

_OPENFORMULA = rf"""
    (?P<space>[ \t\r\n]+)
    | (?P<text>"(?:[^"]|"")*")
    | (?P<reference>\[(?:{QUOTED}|[^\]'])*\])
    | {_ERRORS}
    | {_NUMBER}
    | (?P<sheet>\$(?:{QUOTED}|[^\W\d]\w*)\.)
    | (?P<function>[^\W\d][\w.]*(?=\s*\())
    | (?P<name>(?:\$\$)?[^\W\d][\w.]*)
    | (?P<op><>|<=|>=|[-+*/^&=<>%:!~])
    | (?P<open>\() | (?P<close>\)) | (?P<array>\{{) | (?P<array_end>\}})
    | (?P<separator>;) | (?P<row_separator>\|)
"""

_TOKENS = {"description": _DESCRIPTION, "excel": _EXCEL, "openformula": _OPENFORMULA}


@cache
def _pattern(dialect: str) -> re.Pattern[str]:
    return re.compile(_TOKENS[dialect], re.VERBOSE)


def fail(text: str, column: int, message: str, hint: str = "") -> FormulaError:
    """The error that refuses `text` and says where."""
    return FormulaError(
        Fault(say("{message} at column {column}", message=message, column=column), source=text, hint=hint)
    )


def tokenise(text: str, dialect: str) -> list[Token]:
    """The tokens of `text`, ended by one of kind "end". Raises FormulaError at a character that fits nowhere."""
    tokens: list[Token] = []
    end = 0
    for match in _pattern(dialect).finditer(text):
        start = end
        if match.start() != start:
            raise _refusal(text, start, dialect)
        end = match.end()
        tokens.append(_make(Token, (match.lastgroup, text[start:end], start + 1)))
    if end != len(text):
        raise _refusal(text, end, dialect)
    tokens.append(Token("end", "", end + 1))
    return tokens


def _refusal(text: str, position: int, dialect: str) -> FormulaError:
    character = text[position]
    if character == '"' and dialect != "description":
        return fail(text, position + 1, say("a text without its closing quotation mark"))
    hint = _HINTS.get(character, "")
    if dialect == "description":
        degrees = _BEFORE.search(text, 0, position) if character == "°" else None
        if degrees:
            hint = say("write radians({number}) for {number} degrees", number=degrees[1])
        elif character in _COMPARISONS:
            hint = say("{how}: {write}", how=COMPARED, write=_COMPARISONS[character])
    return fail(text, position + 1, say('unexpected character "{character}"', character=character), hint)


COMPARED = say("expressions have no comparisons; where(x, a, b) is a where x is greater than 0, otherwise b")
_COMPARISONS = {
    **dict.fromkeys("<≤", say('for "u < v" write where(v - u, a, b)')),
    **dict.fromkeys(">≥", say('for "u > v" write where(u - v, a, b)')),
    **dict.fromkeys("=", say('for "u = v" there is where(d - abs(u - v), a, b), with a small d')),
}
_BEFORE = re.compile(rf"(?<![\w.]){_NUMBER}\s*$")
"""The number behind which something stands."""

_HINTS = {
    "°": say('angles are in radians here; write "radians(30)" for 30 degrees'),
    "×": say('multiply with "*"'),
    "·": say('multiply with "*"'),
    "÷": say('divide with "/"'),
    "−": say('write the minus sign "-"'),
    "–": say('write the minus sign "-"'),
    "√": say('write "sqrt(...)"'),
    "[": say("use round parentheses"),
    "{": say("use round parentheses"),
}
