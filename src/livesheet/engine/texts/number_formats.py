"""Number formats as TEXT takes them: `0.00`, `#,##0;(#,##0)`, `0.0E+00`, `# ?/?`, `yyyy-mm-dd hh:mm`, `[h]:mm:ss`, `@`."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from decimal import ROUND_HALF_UP, Context, Decimal
from fractions import Fraction
from functools import lru_cache

from ..values.coerce import number_to_text
from .calendar import LAST_DAY, Day, day_of, weekday

_DATE_TOKEN = r"AM/PM|A/P|y+|m+|d+|h+|s+(?:\.0+)?|e+"
"""A regular expression for the tokens of dates."""
_TOKEN = re.compile(
    r'"(?P<quoted>[^"]*)"|\\(?P<escaped>.)|_(?P<space>.)|\*(?P<fill>.)|\[(?P<bracket>[^\]]*)\]'
    r"|(?P<general>General)|(?P<exponent>E[+-])"
    rf"|(?P<date>{_DATE_TOKEN})|(?P<digit>[0#?])|(?P<mark>[.,%/@])|(?P<other>.)",
    re.IGNORECASE | re.DOTALL,
)
_CONDITION = re.compile(r"(<=|>=|<>|<|>|=)\s*(-?[\d.]+(?:E[+-]?\d+)?)", re.IGNORECASE)
_COLOURS = re.compile(r"(black|blue|cyan|green|magenta|red|white|yellow|color\s*\d+)", re.IGNORECASE)
_COMPARISONS = {
    "<": float.__lt__, "<=": float.__le__, ">": float.__gt__, ">=": float.__ge__, "=": float.__eq__, "<>": float.__ne__,
}  # fmt: skip


WIDE = Context(prec=700)
"""All digits of any number, and as many decimals."""


@dataclass(frozen=True, slots=True)
class Section:
    """One of up to four sections: its tokens (kind, text), and the condition written in front."""

    tokens: tuple[tuple[str, str], ...]
    condition: tuple[str, float] | None = None

    def has(self, *kinds: str) -> bool:
        """Whether there is a token of these kinds."""
        return any(kind in kinds for kind, _ in self.tokens)


@dataclass(slots=True)
class _Digits:
    """Placeholders of a number's whole part or fraction, with what stands between them."""

    places: list[tuple[str, str]] = field(default_factory=list)

    @property
    def count(self) -> int:
        return sum(kind == "digit" for kind, _ in self.places)


@lru_cache(maxsize=512)
def sections(pattern: str) -> tuple[Section, ...] | None:
    """The sections of a format; None when it is none."""
    if len(pattern) > 255:
        return None
    found: list[Section] = []
    for part in _split(pattern):
        section = _section(part)
        if section is None:
            return None
        found.append(section)
    return tuple(found) if len(found) <= 4 else None


def _split(pattern: str) -> list[str]:
    """The parts between semicolons that are not quoted."""
    parts, start, place = [], 0, 0
    while place < len(pattern):
        character = pattern[place]
        if character == '"':
            end = pattern.find('"', place + 1)
            place = len(pattern) if end < 0 else end
        elif character in "\\_*":
            place += 1
        elif character == ";":
            parts.append(pattern[start:place])
            start = place + 1
        place += 1
    return [*parts, pattern[start:]]


def _section(part: str) -> Section | None:
    tokens: list[tuple[str, str]] = []
    condition = None
    for match in _TOKEN.finditer(part):
        kind, text = match.lastgroup or "", match[match.lastgroup or 0]
        if kind == "bracket":
            compared = _CONDITION.fullmatch(text)
            if compared is not None:
                condition = compared[1], float(compared[2])
            elif text.startswith("$"):
                tokens.append(("literal", text[1:].partition("-")[0]))
            elif re.fullmatch("h+|m+|s+", text, re.IGNORECASE):
                tokens.append(("elapsed", text.lower()))
            elif not _COLOURS.fullmatch(text):
                return None
        elif kind in ("quoted", "escaped"):
            tokens.append(("literal", text))
        elif kind == "space":
            tokens.append(("literal", " "))
        elif kind == "other":
            if text in 'bgnBGN"':  # other letters stand for themselves
                return None
            tokens.append(("literal", text))
        elif kind != "fill":
            tokens.append((kind, text))
    return Section(tuple(tokens), condition)


def formatted(value: float | str, pattern: str, epochs: float = 0.0) -> str | None:
    """A value as a format shows it; None when the format is none. `epochs`: added to day numbers."""
    found = sections(pattern)
    if found is None:
        return None
    if isinstance(value, str):
        return _text(value, found)
    section, size = _chosen(value, found)
    if section is None:
        return "#" * 10
    if section.has("date", "elapsed") and section.has("digit", "exponent"):
        return None
    if section.has("date", "elapsed"):
        return moment(section.tokens, value + epochs)
    if section.has("general"):
        shown = general(abs(size))
        return _sign(size) + "".join(shown if kind == "general" else text for kind, text in section.tokens)
    if section.has("mark") and not section.has("digit") and ("mark", "@") in section.tokens:
        return _sign(size) + _with_text(section, number_to_text(abs(size)))
    return _number(section, size)


def general(size: float) -> str:
    """A number as a cell shows it that has no format: in eleven characters."""
    if size == 0:
        return "0"
    if 1e-4 <= size < 99999999999.5 or (size < 1 and float(f"{size:.9f}") == size):
        whole = len(str(int(size)))
        text = f"{Decimal(f'{size:.15g}').quantize(Decimal(1).scaleb(-max(0, 10 - whole)), ROUND_HALF_UP, WIDE):f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, _, power = f"{size:.5E}".partition("E")
    return f"{mantissa.rstrip('0').rstrip('.')}E{power[0]}{power[1:].lstrip('0').rjust(2, '0')}"


def _sign(size: float) -> str:
    return "-" if size < 0 else ""


def _text(value: str, found: tuple[Section, ...]) -> str:
    section = found[3] if len(found) == 4 else found[-1] if ("mark", "@") in found[-1].tokens else None
    return value if section is None else _with_text(section, value)


def _with_text(section: Section, value: str) -> str:
    return "".join(value if (kind, text) == ("mark", "@") else text for kind, text in section.tokens)


def _chosen(value: float, found: tuple[Section, ...]) -> tuple[Section | None, float]:
    """(the section for a number, the number as it is shown there: without its sign in a section for negative ones)."""
    numeric = found[:3]
    if not any(section.condition for section in numeric):
        if len(numeric) > 1 and value < 0:
            return numeric[1], -value
        return (numeric[2] if len(numeric) > 2 and value == 0 else numeric[0]), value
    for place, section in enumerate(numeric):
        if section.condition is None:
            implied = (value > 0, value < 0, True)[place] if len(numeric) > 2 and place < 2 else True
            if implied:
                return section, abs(value) if place == 1 and value < 0 else value
        elif _COMPARISONS[section.condition[0]](value, section.condition[1]):
            below = section.condition[0] in ("<", "<=") and section.condition[1] <= 0
            return section, abs(value) if below else value
    return None, value


# --- numbers ---------------------------------------------------------------------------------------------------------


def _number(section: Section, value: float) -> str:
    tokens = list(section.tokens)
    if ("mark", "/") in tokens and section.has("digit"):
        return _fraction(tokens, value)
    percents = sum(token == ("mark", "%") for token in tokens)
    whole, decimals, exponent, thousands, scale = _parts(tokens)
    if not whole.count and not decimals.count:
        body = "".join(text for _, text in tokens)
        return _sign(value) + body
    size = Decimal(f"{abs(value):.15g}").scaleb(2 * percents - 3 * scale)
    power = 0
    if exponent is not None and size:
        step = max(whole.count, 1)
        power = (size.adjusted() // step) * step if step > 1 else size.adjusted()
        rounded = size.scaleb(-power).quantize(Decimal(1).scaleb(-decimals.count), ROUND_HALF_UP, WIDE)
        if rounded.adjusted() >= step:
            power += step
        size = size.scaleb(-power)
    size = size.quantize(Decimal(1).scaleb(-decimals.count), ROUND_HALF_UP, WIDE)
    before, _, after = f"{size:f}".partition(".")
    body = _whole_part(whole, before, thousands) + _rest(tokens, decimals, after, exponent, power)
    return (_sign(value) if size else "") + body


def _parts(tokens: list[tuple[str, str]]) -> tuple[_Digits, _Digits, str | None, bool, int]:
    """(whole part, decimals, sign of the exponent or None, thousands separated, how many thousands it is divided by)."""
    whole, decimals, exponent = _Digits(), _Digits(), None
    current, thousands, scale = whole, False, 0
    last_digit = max((i for i, (kind, _) in enumerate(tokens) if kind == "digit"), default=-1)
    first_digit = next((i for i, (kind, _) in enumerate(tokens) if kind == "digit"), len(tokens))
    for place, (kind, text) in enumerate(tokens):
        if (kind, text) == ("mark", "."):
            current = decimals
        elif kind == "exponent":
            exponent = text[1]
            break
        elif (kind, text) == ("mark", ","):
            following = tokens[place + 1 :]
            digits_follow = any(k == "digit" for k, _ in following)
            if first_digit < place < last_digit and digits_follow and current is whole:
                point = next((i for i, token in enumerate(following) if token == ("mark", ".")), len(following))
                if any(k == "digit" for k, _ in following[:point]):
                    thousands = True
                else:
                    scale += 1
            elif place > first_digit:
                scale += 1
        else:
            current.places.append((kind, text))
    return whole, decimals, exponent, thousands, scale


def _whole_part(whole: _Digits, digits: str, thousands: bool) -> str:
    digits = digits.lstrip("0")
    out: list[str] = []
    left = whole.count
    written = 0

    def put(digit: str) -> None:
        nonlocal written
        if thousands and written and written % 3 == 0 and digit != " ":
            out.append(",")
        out.append(digit)
        written += 1

    for kind, text in reversed(whole.places):
        if kind != "digit":
            out.append(text)
            continue
        left -= 1
        if digits:
            put(digits[-1])
            digits = digits[:-1]
        elif text == "0":
            put("0")
        elif text == "?":
            out.append(" ")
        while left == 0 and digits:
            put(digits[-1])
            digits = digits[:-1]
    while digits and not whole.count:
        put(digits[-1])
        digits = digits[:-1]
    return "".join(reversed(out))


def _rest(tokens: list[tuple[str, str]], decimals: _Digits, after: str, exponent: str | None, power: int) -> str:
    out = "." if ("mark", ".") in tokens else ""
    kept = len(after.rstrip("0"))
    place = 0
    for kind, text in decimals.places:
        if kind != "digit":
            out += text
            continue
        if place < kept or text == "0":
            out += after[place]
        elif text == "?":
            out += " "
        place += 1
    if exponent is None:
        return out
    start = next(i for i, (kind, _) in enumerate(tokens) if kind == "exponent")
    places = [text for kind, text in tokens[start:] if kind == "digit"]
    tail = "".join(text for kind, text in tokens[start:] if kind in ("literal", "mark"))
    least = sum(text in "0?" for text in places)
    mark = "-" if power < 0 else "+" if exponent == "+" else ""
    return f"{out}E{mark}{str(abs(power)).rjust(max(least, 1), '0')}{tail}"


def _fraction(tokens: list[tuple[str, str]], value: float) -> str:
    """`# ?/?`: the nearest fraction whose parts have so many digits; `# ?/8`: of eighths."""
    line = next(i for i, token in enumerate(tokens) if token == ("mark", "/"))
    below = "".join(text for kind, text in tokens[line + 1 :] if kind in ("digit", "literal"))
    fixed = below.strip() if below.strip().isdigit() and below.strip("0") else ""
    above = line
    while above > 0 and tokens[above - 1][0] == "digit":
        above -= 1
    width = line - above
    has_whole = any(kind == "digit" for kind, _ in tokens[:above])
    size = abs(value)
    whole = math.floor(size) if has_whole else 0
    if fixed:
        parts = Fraction(math.floor((size - whole) * int(fixed) + 0.5), 1)
        upper, lower = int(parts), int(fixed)
    else:
        best = Fraction(size - whole).limit_denominator(10 ** max(len(below.strip()), 1) - 1)
        upper, lower = best.numerator, best.denominator
    if has_whole and upper == lower:
        whole, upper = whole + 1, 0
    shown = f"{str(upper).rjust(width)}/{str(lower).ljust(len(below))}"
    if upper == 0 and has_whole:
        shown = " " * len(shown)
    front = "" if not has_whole else (str(whole) if whole or upper == 0 else "")
    gap = "".join(text for kind, text in tokens[:above] if kind == "literal")
    return _sign(value) + (front + gap if has_whole else gap) + shown


MONTHS = (
    *("January", "February", "March", "April", "May", "June", "July"),
    *("August", "September", "October", "November", "December"),
)
WEEKDAYS = ("Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday")

Tokens = Sequence[tuple[str, str]]


def moment(tokens: Tokens, value: float) -> str | None:
    """A day and time by the tokens of a format; None where there is none (negative, or after the year 9999)."""
    decimals = max((len(text.partition(".")[2]) for kind, text in tokens if kind == "date"), default=0)
    if not 0 <= value < LAST_DAY + 1:
        return None
    ticks = math.floor(value * 86400 * 10**decimals + 0.5)
    seconds, part = divmod(ticks, 10**decimals)
    days, second = divmod(seconds, 86400)
    if days > LAST_DAY:
        return None
    marked = any(kind == "date" and text.upper() in ("AM/PM", "A/P") for kind, text in tokens)
    day = day_of(days)
    out = ""
    for place, (kind, text) in enumerate(tokens):
        if kind == "elapsed":
            out += str(seconds // {"h": 3600, "m": 60, "s": 1}[text[0]]).rjust(len(text), "0")
        elif kind == "date":
            out += _piece(tokens, place, day, days, second, part, decimals, marked)
        else:
            out += text
    return out


def _piece(tokens: Tokens, place: int, day: Day, days: int, second: int, part: int, decimals: int, marked: bool) -> str:
    text = tokens[place][1]
    letter, length = text[0].lower(), len(text)
    if letter == "y" or letter == "e":
        return f"{day.year % 100:02d}" if letter == "y" and length <= 2 else f"{day.year:04d}"
    if letter == "m" and not _is_minute(tokens, place):
        return _month(day.month, length)
    if letter == "d":
        return _day(day.day, days, length)
    if letter == "a":
        half = "AM" if second < 43200 else "PM"
        return half if "/P" in text.upper() and length > 3 else half[0] if text[0].isupper() else half[0].lower()
    if letter == "h":
        hour = second // 3600
        return str((hour - 1) % 12 + 1 if marked else hour).rjust(min(length, 2), "0")
    if letter == "m":
        return str(second // 60 % 60).rjust(min(length, 2), "0")
    whole, _, fraction = text.partition(".")
    shown = str(second % 60).rjust(min(len(whole), 2), "0")
    return f"{shown}.{str(part).rjust(decimals, '0')[: len(fraction)]}" if fraction else shown


def _month(month: int, length: int) -> str:
    name = MONTHS[month - 1]
    return {1: str(month), 2: f"{month:02d}", 3: name[:3], 5: name[0]}.get(length, name)


def _day(day: int, days: int, length: int) -> str:
    name = WEEKDAYS[weekday(days)]
    return {1: str(day), 2: f"{day:02d}", 3: name[:3]}.get(length, name)


def _is_minute(tokens: Tokens, place: int) -> bool:
    """Whether an m means minutes: after hours, or before seconds."""
    if len(tokens[place][1]) > 2:
        return False
    before = [
        text[0].lower() for kind, text in tokens[:place] if kind in ("date", "elapsed") and text[0].lower() != "a"
    ]
    after = [text[0].lower() for kind, text in tokens[place + 1 :] if kind in ("date", "elapsed")]
    return before[-1:] == ["h"] or after[:1] == ["s"]
