"""Values of cells as OpenDocument spells them: dates, times, errors, and the texts of paragraphs."""

from __future__ import annotations

import re
from collections.abc import Mapping
from datetime import date, timedelta

from livesheet.formula.nodes import ErrorValue

from .words import Words

_DURATION = re.compile(r"(-?)P(?:([0-9]+)D)?(?:T(?:([0-9]+)H)?(?:([0-9]+)M)?(?:([0-9]+(?:[.,][0-9]+)?)S)?)?")
_LIBREOFFICE = re.compile(r"Err:[0-9]{3}")
_LOCAL: Mapping[str, str] = {
    local: error
    for error, names in {
        "#NULL!": "#NUL! #¡NULO! #NULLO! #NULO! #BOŞ! #LEEG!",
        "#DIV/0!": "#¡DIV/0! #SAYI/0! #DEEL/0!",
        "#REF!": "#BEZUG! #¡REF! #RIF! #BAŞV! #VERW!",
        "#NAME?": "#NOM? #¿NOMBRE? #NOME? #AD? #NAAM?",
        "#NUM!": "#ZAHL! #NOMBRE! #¡NUM! #NÚM! #SAYI! #GETAL!",
        "#N/A": "#NV #N/D #YOK #N/B",
    }.items()
    for local in names.split()
}
"""Excel's errors in German, French, Spanish, Italian, Portuguese, Turkish and Dutch, but for those of #VALUE!."""
_FOREIGN = re.compile(r"#[^\W\d_]+[!?]|#[A-Z]{2,}")
_CODES: Mapping[str, str] = {"Err:503": "#NUM!", "Err:521": "#NULL!", "Err:524": "#REF!", "Err:525": "#NAME?"}
"""LibreOffice's numbers of errors that have a code of their own; all others are #VALUE!, as its own .xlsx export has it."""
_ERRORS = frozenset(("#NULL!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#N/A"))


def error_of(text: str) -> ErrorValue | None:
    """The error that a cell shows as `text`, None when it shows none."""
    if text in _ERRORS:
        return ErrorValue(text)
    return ErrorValue(_CODES.get(text, "#VALUE!")) if _LIBREOFFICE.fullmatch(text) else None


def error_shown(text: str) -> ErrorValue | None:
    """The error that a cell with the number 0 shows, which is how Excel writes errors, in its user's language."""
    error = error_of(text)
    if error is None and (text in _LOCAL or _FOREIGN.fullmatch(text)):
        error = ErrorValue(_LOCAL.get(text, "#VALUE!"))
    return error


def time_number(text: str) -> float | None:
    """The duration `PT12H30M00S` as a part of a day, None when it is none."""
    match = _DURATION.fullmatch(text)
    if match is None or len(text) > 40:
        return None
    sign, days, hours, minutes, seconds = match.groups()
    total = 3600 * int(hours or 0) + 60 * int(minutes or 0) + float((seconds or "0").replace(",", "."))
    return (-1 if sign else 1) * (int(days or 0) + total / 86400)


def date_text(number: float, null_date: date) -> str | None:
    """Days since `null_date` as a date, with the time of day where there is one; None beyond the years 1 to 9999."""
    days, milliseconds = divmod(round(number * 86_400_000), 86_400_000)
    try:
        day = null_date + timedelta(days)
    except OverflowError:
        return None
    if not milliseconds:
        return day.isoformat()
    hours, rest = divmod(milliseconds, 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    return f"{day.isoformat()}T{hours:02}:{minutes:02}:{_seconds(rest)}"


def time_text(number: float) -> str:
    """A part of a day as a duration."""
    hours, rest = divmod(round(abs(number) * 86_400_000), 3_600_000)
    minutes, rest = divmod(rest, 60_000)
    return f"{'-' if number < 0 else ''}PT{hours:02}H{minutes:02}M{_seconds(rest)}S"


def _seconds(milliseconds: int) -> str:
    return f"{milliseconds // 1000:02}" + (f".{milliseconds % 1000:03}" if milliseconds % 1000 else "")


MAX_SPACES = 32_767
"""Most spaces that one element stands for: a cell holds no more."""
_SPACES = re.compile("[ \t\r\n]+")
_SPACE, _TAB, _BREAK = "\x01", "\x02", "\x03"
"""Stand for what elements mean until the other spaces are gone; no character of XML."""
_MEANT = str.maketrans({_SPACE: " ", _TAB: "\t", _BREAK: "\n"})


class ParagraphText:
    """Gathers one paragraph after the other in `texts`, which the parser fills.

    tags  the elements that `mark` wants to know of
    """

    def __init__(self, words: Words, texts: list[str]) -> None:
        self._texts = texts
        self._count = words.space_count
        self._space = words.space
        self._tab = words.tab
        self.tags = frozenset((words.space, words.tab, words.line_break))
        self._kept = 0

    def mark(self, tag: str, attributes: Mapping[str, str]) -> None:
        """An element that stands for characters."""
        if tag == self._space:
            count = attributes.get(self._count, "1")
            number = int(count) if count.isdecimal() and len(count) < 10 else 1
            self._texts.append(_SPACE * min(number, MAX_SPACES))
        else:
            self._texts.append(_TAB if tag == self._tab else _BREAK)

    def pause(self) -> None:
        """What follows is not the cell's text, until `go_on`."""
        self._kept = len(self._texts)

    def go_on(self) -> None:
        """Forget what came since `pause`."""
        del self._texts[self._kept :]

    def text(self) -> str:
        """The paragraph."""
        return _SPACES.sub(" ", "".join(self._texts)).strip(" ").translate(_MEANT)
