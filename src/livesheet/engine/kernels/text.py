"""Functions of texts: characters, searching and replacing, joining and splitting."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from ...formula.book import Settings
from ...formula.functions import FUNCTIONS
from ...formula.nodes import MAX_COLUMNS, MAX_ROWS, ErrorValue, Scalar
from ...formula.printer import quote_sheet
from ...formula.references import column_letters
from ..interpreter.calling import Args, called
from ..interpreter.closures import Evaluation
from ..texts.patterns import expression, pattern_of
from ..values.cells import Cells, Frame, codes_of
from ..values.coerce import (
    MOST_CHARACTERS,
    Problem,
    Serial,
    each,
    joined,
    since_epoch,
    text_to_number,
    to_number,
    to_text,
)

VALUE = ErrorValue("#VALUE!")


def number_or_none(value: Scalar) -> float | None:
    """A scalar as a number, None for a text that shows none."""
    return text_to_number(value) if isinstance(value, str) else to_number(value)


def left(text: str, many: float = 1.0) -> str:
    """LEFT."""
    return mid(text, 1.0, many)


def right(text: str, many: float = 1.0) -> str:
    """RIGHT."""
    return mid(text, max(1.0, len(text) - math.trunc(many) + 1.0), many)


def mid(text: str, first: float, many: float) -> str:
    """MID: from the `first`-th character (counted from 1)."""
    if first < 1 or many < 0:
        raise Problem("#VALUE!")
    return text[math.trunc(first) - 1 : math.trunc(first) - 1 + math.trunc(many)]


def rept(text: str, many: float) -> str:
    """REPT: #VALUE! beyond what a cell can hold."""
    if many < 0 or len(text) * math.trunc(many) > MOST_CHARACTERS:
        raise Problem("#VALUE!")
    return text * math.trunc(many)


def value_(shown: Scalar, epochs: float = 0.0) -> Scalar:
    """VALUE: the number that a text shows."""
    number = None if isinstance(shown, bool) else number_or_none(shown)
    if isinstance(number, Serial):
        return since_epoch(number, epochs)
    return VALUE if number is None else number


def _value(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    kernel: Callable[..., Cells] = _each(lambda shown: value_(shown, ev.texts.epochs))
    return kernel(ev, args, frame, spread)


def _each(function: Callable[..., Scalar]) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        cells = tuple(ev.value(arg, frame, spread) for arg in args)
        return each(function, cells, ev.texts, ev.around.budget.spend)

    return kernel


def concat(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """CONCAT: like CONCATENATE, but takes ranges too, row by row."""
    del spread
    parts: list[Cells] = []
    for arg in args:
        cells = ev.value(arg, frame, spread=True)
        if len(cells.shape) <= 2:
            parts.append(cells)
            continue
        shape = cells.shape
        ev.around.budget.spend(shape[0] * shape[1])
        numbers, codes = np.broadcast_to(cells.numbers, shape), np.broadcast_to(codes_of(cells), shape)
        for i in range(shape[0]):
            for j in range(shape[1]):
                tail = tuple(n for n in shape[2:] if n > 1) or ()
                parts.append(Cells(numbers[i, j].reshape(tail), codes[i, j].reshape(tail)))
    return each(joined, tuple(parts), ev.texts, ev.around.budget.spend)


# --- characters, searching, replacing, joining, splitting ------------------------------------------------------------


def character(number: float) -> str:
    """CHAR: of the code page 1252, as Excel for Windows has it."""
    code = math.trunc(number)
    if not 1 <= code <= 255:
        raise Problem("#VALUE!")
    return bytes([code]).decode("cp1252", errors="replace").replace("\ufffd", chr(code))


def code(text: str) -> float:
    """CODE of the first character; 63 (?) for those outside the code page."""
    if not text:
        raise Problem("#VALUE!")
    if 0x80 <= ord(text[0]) < 0xA0:
        return float(ord(text[0]))
    return float(text[0].encode("cp1252", errors="replace")[0])


def unicode_character(number: float) -> str:
    """UNICHAR."""
    point = math.trunc(number)
    if not 1 <= point <= 0x10FFFF:
        raise Problem("#VALUE!")
    if 0xD800 <= point <= 0xDFFF or point in (0xFFFE, 0xFFFF):
        raise Problem("#N/A")
    return chr(point)


def code_point(text: str) -> float:
    """UNICODE."""
    if not text:
        raise Problem("#VALUE!")
    return float(ord(text[0]))


def proper(text: str) -> str:
    """PROPER: capitals after everything that is no letter."""
    out, after_letter = "", False
    for letter in text:
        out += letter.lower() if after_letter else letter.upper()
        after_letter = letter.isalpha()
    return out


# --- searching -------------------------------------------------------------------------------------------------------


def _start(within: str, start: float) -> int:
    place = math.trunc(start) - 1
    if not 0 <= place < max(len(within), 1):
        raise Problem("#VALUE!")
    return place


def find(wanted: str, within: str, start: float = 1.0) -> float:
    """FIND: case counts."""
    place = within.find(wanted, _start(within, start))
    if place < 0:
        raise Problem("#VALUE!")
    return place + 1.0


def search(settings: Settings, wanted: str, within: str, start: float = 1.0) -> float:
    """SEARCH: without regard to case, with wildcards, or as the workbook has it."""
    place = pattern_of(wanted, settings).search(within, _start(within, start))
    if place < 0:
        raise Problem("#VALUE!")
    return place + 1.0


def _search(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    kernel: Callable[..., Cells] = called(FUNCTIONS["SEARCH"], partial(search, ev.texts.settings))
    return kernel(ev, args, frame, spread)


def substitute(text: str, old: str, new: str, instance: float | None = None) -> str:
    """SUBSTITUTE: every occurrence, or one of them."""
    which = 1 if instance is None else math.trunc(instance)
    if which < 1:
        raise Problem("#VALUE!")
    if not old:
        return text
    if instance is None:
        return _fits(text.replace(old, new))
    place = -1
    begin = 0
    for _ in range(which):
        place = text.find(old, begin)
        if place < 0:
            return text
        begin = place + len(old)
    return _fits(text[:place] + new + text[place + len(old) :])


def replace(text: str, start: float, many: float, new: str) -> str:
    """REPLACE: so many characters from a place on."""
    first, count = math.trunc(start), math.trunc(many)
    if first < 1 or count < 0:
        raise Problem("#VALUE!")
    return _fits(text[: first - 1] + new + text[first - 1 + count :])


def _fits(text: str) -> str:
    if len(text) > MOST_CHARACTERS:
        raise Problem("#VALUE!")
    return text


# --- regular expressions ---------------------------------------------------------------------------------------------


def regex_extract(text: str, pattern: str, mode: float = 0.0, ignore_case: float = 0.0) -> Any:
    """REGEXEXTRACT: the first match (0), all matches in a row (1), the groups of the first one in a row (2)."""
    matches = list(expression(pattern, text, ignore_case).finditer(text))
    if not matches:
        raise Problem("#N/A")
    if mode == 0:
        return matches[0].group()
    if mode == 1:
        return [[match.group() for match in matches]]
    if mode != 2 or not matches[0].groups():
        raise Problem("#VALUE!" if mode != 2 else "#N/A")
    return [[group or "" for group in matches[0].groups()]]


def regex_replace(text: str, pattern: str, new: str, which: float = 0.0, ignore_case: float = 0.0) -> str:
    """REGEXREPLACE: all matches (0), one of them from the front, or from the end; $1 stands for a group."""
    matches = list(expression(pattern, text, ignore_case).finditer(text))
    place = math.trunc(which)
    chosen = matches if place == 0 else matches[place - 1 : place] if place > 0 else matches[place : place + 1 or None]
    out, end = "", 0
    for match in chosen:
        shown = re.sub(r"\$(\d+)", lambda found, match=match: match.group(int(found[1])) or "", new)  # type: ignore[misc]
        out, end = out + text[end : match.start()] + shown, match.end()
    return _fits(out + text[end:])


# --- joining and splitting -------------------------------------------------------------------------------------------


def _texts(values: list[Scalar] | None) -> list[str]:
    found = []
    for value in values or [None]:
        if isinstance(value, ErrorValue):
            raise Problem(value.code)
        found.append(to_text(value))
    return found


def text_join(delimiters: list[Scalar] | None, skip_empty: Any, *lists: list[Scalar]) -> str:
    """TEXTJOIN: with one delimiter, or several in turn."""
    between = _texts(delimiters)
    parts = [part for values in lists for part in _texts(values) if part or not skip_empty]
    pieces: list[str] = []
    length = 0
    for place, part in enumerate(parts):
        piece = (between[(place - 1) % len(between)] if place else "") + part
        length += len(piece)
        if length > MOST_CHARACTERS:
            raise Problem("#CALC!")
        pieces.append(piece)
    return "".join(pieces)


def _any_of(delimiters: list[Scalar] | None, ignore_case: Any) -> re.Pattern[str]:
    words = sorted(_texts(delimiters), key=len, reverse=True)
    return re.compile("|".join(map(re.escape, words)), re.IGNORECASE if ignore_case else 0)


def _divided(before: bool) -> Callable[..., Scalar]:
    """TEXTBEFORE and TEXTAFTER."""

    def of(
        text: str,
        delimiters: list[Scalar] | None,
        instance: float = 1.0,
        mode: float = 0.0,
        end: float = 0.0,
        otherwise: Scalar = ErrorValue("#N/A"),  # noqa: B008 - an immutable value
    ) -> Scalar:
        which = math.floor(instance)
        if mode not in (0, 1) or end not in (0, 1):
            raise Problem("#VALUE!")
        if which == 0 or abs(which) > len(text) > 0:
            raise Problem("#VALUE!")
        if all(len(word) > len(text) for word in _texts(delimiters)):
            raise Problem("#VALUE!")
        pattern = _any_of(delimiters, mode)
        if pattern.fullmatch("") and "" in _texts(delimiters):
            return "" if before == (which > 0) else text
        places = [match.span() for match in pattern.finditer(text)]
        if end:
            places = [*places, (len(text), len(text))] if which > 0 else [(0, 0), *places]
        index = which - 1 if which > 0 else len(places) + which
        if not 0 <= index < len(places):
            return otherwise
        return text[: places[index][0]] if before else text[places[index][1] :]

    return of


def text_split(
    text: str,
    columns: list[Scalar] | None = None,
    rows: list[Scalar] | None = None,
    skip_empty: bool = False,
    mode: float = 0.0,
    pad: Scalar = ErrorValue("#N/A"),  # noqa: B008 - an immutable value
) -> list[list[Scalar]]:
    """TEXTSPLIT: into columns, and into rows; rows that are too short are padded."""
    if (columns is None and rows is None) or any("" in _texts(part) for part in (columns, rows) if part is not None):
        raise Problem("#VALUE!")
    lines = [text] if rows is None else _any_of(rows, mode).split(text)
    table: list[list[Scalar]] = []
    for line in lines:
        if skip_empty and not line:
            continue
        parts = [line] if columns is None else _any_of(columns, mode).split(line)
        table.append([part for part in parts if part or not skip_empty])
    width = max((len(row) for row in table), default=0)
    if not width:
        raise Problem("#CALC!")
    return [row + [pad] * (width - len(row)) for row in table]


def _shown(value: Scalar, strict: bool) -> str:
    if isinstance(value, str) and strict:
        return '"' + value.replace('"', '""') + '"'
    return value.code if isinstance(value, ErrorValue) else to_text(value)


def _style(style: float) -> bool:
    if math.trunc(style) not in (0, 1):
        raise Problem("#VALUE!")
    return math.trunc(style) == 1


def array_to_text(rows: list[list[Scalar]], style: float = 0.0) -> str:
    """ARRAYTOTEXT: concise (0) or as an array is written (1)."""
    strict = _style(style)
    if not strict:
        return _fits(", ".join(_shown(value, False) for row in rows for value in row))
    return _fits("{" + ";".join(",".join(_shown(value, True) for value in row) for row in rows) + "}")


def address(row: float, col: float, kind: float = 1.0, a1: bool = True, sheet: Scalar = None) -> str:
    """ADDRESS: 1 $A$1, 2 A$1, 3 $A1, 4 A1; or in R1C1 form."""
    down, right, which = math.trunc(row), math.trunc(col), math.trunc(kind)
    if not (1 <= down <= MAX_ROWS and 1 <= right <= MAX_COLUMNS and which in (1, 2, 3, 4)):
        raise Problem("#VALUE!")
    row_fixed, col_fixed = which in (1, 2), which in (1, 3)
    if a1:
        cell = f"{'$' * col_fixed}{column_letters(right - 1)}{'$' * row_fixed}{down}"
    else:
        cell = f"R{down if row_fixed else f'[{down}]'}C{right if col_fixed else f'[{right}]'}"
    return cell if sheet is None else f"{quote_sheet(to_text(sheet)) if sheet != '' else ''}!{cell}"


# --- texts that show numbers -----------------------------------------------------------------------------------------


def number_value(text: str, decimal: str = ".", group: str = ",") -> float:
    """NUMBERVALUE: with the signs for decimals and groups given."""
    if not decimal or not group:
        raise Problem("#VALUE!")
    point, comma = decimal[0], group[0]
    body = re.sub(r"\s", "", text)
    percents = len(body) - len(body.rstrip("%"))
    body = body.rstrip("%")
    whole, sign, rest = body.partition(point)
    if point in rest or comma in rest:
        raise Problem("#VALUE!")
    plain = whole.replace(comma, "") + ("." + rest if sign else "")
    if not plain:
        return 0.0
    return to_number(plain) / 100.0**percents


def encode_url(text: str) -> str:
    """ENCODEURL."""
    from urllib.parse import quote  # which few workbooks need, and takes as long to load as all of this module

    return quote(text, safe="-_.~")


KERNELS: dict[str, Any] = {
    "VALUE": _value, "CONCAT": concat, "CONCATENATE": _each(joined),
    "SEARCH": _search, "SEARCHB": _search,
}  # fmt: skip

PLAIN: dict[str, Callable[..., Any]] = {
    **dict.fromkeys(("LEN", "LENB"), lambda text: float(len(text))),
    **dict.fromkeys(("LEFT", "LEFTB"), left),
    **dict.fromkeys(("RIGHT", "RIGHTB"), right),
    **dict.fromkeys(("MID", "MIDB"), mid),
    **dict.fromkeys(("FIND", "FINDB"), find),
    **dict.fromkeys(("REPLACE", "REPLACEB"), replace),
    "REPT": rept,
    "UPPER": str.upper,
    "LOWER": str.lower,
    "TRIM": lambda text: re.sub(" +", " ", text).strip(" "),
    "EXACT": lambda first, second: first == second,
    "CHAR": character,
    "CODE": code,
    "UNICHAR": unicode_character,
    "UNICODE": code_point,
    "CLEAN": lambda text: "".join(letter for letter in text if ord(letter) > 31),
    "PROPER": proper,
    "SUBSTITUTE": substitute,
    "REGEXTEST": lambda text, pattern, ignore_case=0.0: expression(pattern, text, ignore_case).search(text) is not None,
    "REGEXEXTRACT": regex_extract,
    "REGEXREPLACE": regex_replace,
    "TEXTJOIN": text_join,
    "TEXTBEFORE": _divided(True),
    "TEXTAFTER": _divided(False),
    "TEXTSPLIT": text_split,
    "VALUETOTEXT": lambda value, style=0.0: _shown(value, _style(style)),
    "ARRAYTOTEXT": array_to_text,
    "ADDRESS": address,
    "HYPERLINK": lambda link, *shown: (0.0 if shown[0] is None else shown[0]) if shown else link,
    "NUMBERVALUE": number_value,
    "ENCODEURL": encode_url,
}
