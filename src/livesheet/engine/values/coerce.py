"""From any kind of cell to a number, a text or a truth value, the way Excel does it.

A text is the number, date, time or amount that people type so in English.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from datetime import date
from functools import lru_cache
from typing import Any, TypeAlias, TypeVar

import numpy as np

from ...formula.nodes import ErrorValue, Scalar
from .cells import (
    BLANK,
    BOOLEAN,
    ERROR,
    ERROR_NAMES,
    NEAR,
    TEXT,
    VALUE,
    Cells,
    Texts,
    boolean,
    codes_of,
    different,
    error,
    error_code,
    errors_of,
    first_error,
    fitted,
)

_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_FULL = (
    *("january", "february", "march", "april", "may", "june", "july"),
    *("august", "september", "october", "november", "december"),
)
_MONTH = rf"(?P<name>{'|'.join(_FULL)}|{'|'.join(_MONTHS)})\.?"
# patterns as texts, which `re` compiles when they are first used: few workbooks hold such texts
_DATES = (
    r"(?P<year>\d{4})(?P<s>[-/])(?P<month>\d{1,2})(?P=s)(?P<day>\d{1,2})",
    r"(?P<month>\d{1,2})(?P<s>[-/])(?P<day>\d{1,2})(?P=s)(?P<year>\d{4}|\d{1,2})",
    r"(?P<month>\d{1,2})[-/](?P<day>\d{1,2})",
    r"(?P<month>\d{1,2})[-/](?P<year>\d{4})",
    rf"(?P<day>\d{{1,2}})[-/ ]{_MONTH}(?:[-/ ,]\s*(?P<year>\d{{4}}|\d{{2}}))?",
    rf"{_MONTH}[-/ ](?P<day>\d{{1,2}}),?\s+(?P<year>\d{{4}})",
    rf"{_MONTH}[-/ ](?P<year>\d{{4}})",
    rf"{_MONTH}[-/ ](?P<day>\d{{1,2}})",
)
_TIME = (
    r"(?P<hour>\d{1,4}):(?P<minute>\d{1,2})(?::(?P<second>\d{1,2}(?:\.\d*)?))?(?:\s*(?P<half>[ap]m?))?"
    r"|(?P<hour12>\d{1,2})\s+(?P<half12>[ap]m?)"
)
_MONEY = "$€£¥"
_AMOUNT = rf"(?P<open>\()?(?P<sign>[-+])?\s*[{_MONEY}]?\s*(?P<inner>[-+])?(?P<number>[\d.,]+)\s*€?\s*(?P<close>\))?"
_FRACTION = r"(?P<sign>[-+])?(?P<whole>\d+) (?P<above>\d{1,5})/(?P<below>\d{1,5})"
_GROUPED = r"(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d*)?|\.\d+"
_ZERO = date(1899, 12, 30).toordinal()


class Serial(float):
    """A day as a number, counted from 1900: workbooks that count from 1904 show it smaller."""


@lru_cache(maxsize=4096)
def shown_number(text: str) -> float | None:
    """The number of a text that shows a date, a time, both, an amount of money or a mixed fraction; else None."""
    body = text.strip()
    if (
        not body
        or not (body[0] in f"(+-.{_MONEY}" or body[0].isalnum())
        or not any(c.isdigit() for c in body)
        or len(body) > 64
    ):
        return None
    for kind in (amount, fraction, date_and_time):
        if kind is date_and_time and body != text:
            return None  # Excel takes no date with spaces around it
        found = kind(body)
        if found is not None:
            return found
    return None


def amount(body: str) -> float | None:
    """`$1,234.50`, `-$5`, `(5)`."""
    match = re.fullmatch(_AMOUNT, body)
    if match is None or not re.fullmatch(_GROUPED, match["number"]) or bool(match["open"]) != bool(match["close"]):
        return None
    signs = [sign for sign in (match["sign"], match["inner"]) if sign]
    if len(signs) > 1 or (signs and match["open"]):
        return None
    value = float(match["number"].replace(",", ""))
    return -value if match["open"] or "-" in signs else value


def fraction(body: str) -> float | None:
    """`2 1/2`."""
    match = re.fullmatch(_FRACTION, body)
    if match is None or int(match["below"]) == 0:
        return None
    value = int(match["whole"]) + int(match["above"]) / int(match["below"])
    return -value if match["sign"] == "-" else value


def date_and_time(body: str) -> float | None:
    """A date, a time, or a date and a time, as one number: a Serial where there is a date."""
    parts = day_and_time(body)
    if parts is None:
        return None
    return Serial(parts[0] + parts[1]) if parts[0] else parts[1]


def day_and_time(body: str) -> tuple[float, float] | None:
    """(day number, part of a day) of a date, a time, or a date and a time with a space (or a T) between them."""
    for day, time in ((body, ""), ("", body), *_splits(body)):
        days = _day_number(day) if day else 0.0
        hours = time_part(time) if time else 0.0
        if days is not None and hours is not None:
            return days, hours
    return None


def _splits(body: str) -> list[tuple[str, str]]:
    return [(body[: m.start()].rstrip(" ,"), body[m.end() :].strip()) for m in re.finditer(r"\s+|(?<=\d)T(?=\d)", body)]


def time_part(body: str) -> float | None:
    """A time as a part of a day, without whole days; hours beyond 24 count on."""
    match = re.fullmatch(_TIME, body, re.IGNORECASE)
    if match is None:
        return None
    hour = int(match["hour"] or match["hour12"])
    half = (match["half"] or match["half12"] or "")[:1].lower()
    minute, second = int(match["minute"] or 0), float(match["second"] or 0)
    if minute > 59 or second >= 60 or (half and not 0 <= hour <= 12):
        return None
    if half:
        hour = hour % 12 + (12 if half == "p" else 0)
    return (hour * 3600 + minute * 60 + second) / 86400


def _day_number(body: str) -> float | None:
    for pattern in _DATES:
        match = re.fullmatch(pattern, body, re.IGNORECASE)
        if match is None:
            continue
        parts = match.groupdict()
        month = _MONTHS.index(parts["name"][:3].lower()) + 1 if parts.get("name") else int(parts["month"])
        found = _serial(_year(parts.get("year")), month, int(parts.get("day") or 1))
        if found is not None:
            return found
    return None


def _year(shown: str | None) -> int:
    if shown is None:
        return date.today().year
    year = int(shown)
    return year if len(shown) == 4 else year + (2000 if year < 30 else 1900)


def _serial(year: int, month: int, day: int) -> float | None:
    if (year, month, day) == (1900, 2, 29):
        return 60.0
    try:
        serial = date(year, month, day).toordinal() - _ZERO
    except ValueError:
        return None
    serial -= serial < 61
    return float(serial) if serial > 0 else None


Key: TypeAlias = tuple[tuple[float, int], ...]
"""(number, code) of several values."""
Found = TypeVar("Found")

_NO_TEXT = ("", "")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")


def text_to_number(text: str) -> float | None:
    """The number that a text shows ("2.5", "1e3", "50%", "$3", "3/14/2026", "6:30 PM"), None when it shows none."""
    body = text.strip()
    percent = body.endswith("%")
    if percent:
        body = body[:-1].rstrip()
    if "," in body and re.fullmatch(r"[+-]?[0-9]{1,3}(?:,[0-9]{3})+(?:\.[0-9]*)?", body):
        body = body.replace(",", "")
    if not _NUMBER.fullmatch(body):
        return None if percent else shown_number(text)
    value = float(body)
    if not np.isfinite(value):
        return None
    return value / 100 if percent else value


def number_shown(text: str, texts: Texts) -> float | None:
    """As `text_to_number`, a date counted as the workbook counts days; None for one before its calendar begins."""
    value = text_to_number(text)
    if not isinstance(value, Serial):
        return value
    return float(value) - texts.epochs if value >= texts.epochs else None


def number_to_text(value: float) -> str:
    """A number as General shows it in a text: up to 15 digits, 1E+21 and 1E-10 in powers of ten."""
    if -1e15 < value < 1e15 and value == int(value):
        return str(int(value))
    text = f"{value:.15g}"
    mantissa, _, exponent = text.partition("e")
    if exponent:
        power = int(exponent)
        if -10 < power < 21:
            return f"{value:.{max(0, len(mantissa.replace('-', '').replace('.', '')) - 1 - power)}f}"
        return f"{mantissa}E{power:+03d}"
    return "0" if text == "-0" else text


def to_text(value: Scalar) -> str:
    """A scalar as & joins it. Errors never come here."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "TRUE" if value else "FALSE"
    return number_to_text(value) if isinstance(value, float) else str(value)


MOST_CHARACTERS = 32767
"""As many characters as a cell can hold."""


def joined(*values: Scalar) -> str | ErrorValue:
    """Scalars one after another, as & joins them; #VALUE! where that is more than a cell holds, as in Excel.

    Without a limit, forty cells that each double the one above would take all memory.
    """
    text = "".join(map(to_text, values))
    return text if len(text) <= MOST_CHARACTERS else ErrorValue("#VALUE!")


def text_of(cells: Cells, texts: Texts) -> str | Cells:
    """The text of one value, or the error it is; of an array the first cell."""
    value = texts.decode(float(np.ravel(cells.numbers)[0]), int(np.ravel(codes_of(cells))[0]))
    return texts.constant(value) if isinstance(value, ErrorValue) else to_text(value)


def numbers_of(cells: Cells, texts: Texts) -> tuple[Any, Any]:
    """(numbers, error codes or None): blanks are 0, truth values 0 and 1, texts what they show, other texts #VALUE!."""
    if cells.codes is None:
        return cells.numbers, None
    is_text = cells.codes == TEXT
    if not np.count_nonzero(is_text):
        return cells.numbers, errors_of(cells)
    numbers, codes = np.broadcast_arrays(cells.numbers, cells.codes)
    numbers, errors = numbers.copy(), np.where(codes >= ERROR, codes, np.uint8(0))
    is_text = codes == TEXT
    for key in different(numbers[is_text]):
        value = number_shown(texts.text(key), texts)
        here = is_text & (numbers == key)
        # Marked first, written afterwards: a text's number must not be taken for another text's key.
        if value is None:
            errors = np.where(here, np.uint8(VALUE), errors)
        numbers = np.where(here, np.nan if value is None else value, numbers)
        is_text = is_text & ~here
    return numbers, (errors if np.count_nonzero(errors) else None)


def truths_of(cells: Cells, texts: Texts) -> tuple[Any, Any]:
    """(mask, error codes or None): numbers are true when not 0; the texts TRUE and FALSE count, others are #VALUE!."""
    if cells.codes is None:
        return np.not_equal(cells.numbers, 0), None
    is_text = cells.codes == TEXT
    if not np.count_nonzero(is_text):
        return np.not_equal(cells.numbers, 0) & (cells.codes < ERROR), errors_of(cells)
    numbers, codes = np.broadcast_arrays(cells.numbers, cells.codes)
    is_text = codes == TEXT
    mask = np.not_equal(numbers, 0) & ~is_text & (codes < ERROR)
    errors = np.where(codes >= ERROR, codes, np.uint8(0))
    for key in different(numbers[is_text]):
        here = is_text & (numbers == key)
        word = texts.text(key).strip().upper()
        if word == "TRUE":
            mask = mask | here
        elif word != "FALSE":
            errors = np.where(here, np.uint8(VALUE), errors)
    return mask, (errors if np.count_nonzero(errors) else None)


def once_each(compute: Callable[[Key], Found], cells: Sequence[Cells]) -> tuple[list[Found], tuple[int, ...]]:
    """What `compute` gives for the values of some cells at each place of their common shape, and that shape: asked once for
    values that are alike. A key is the (number, code) of each; the number of an error is 0."""
    shape = np.broadcast_shapes(*(part.shape for part in cells))
    if shape == ():
        key = (_key(float(part.numbers), 0 if part.codes is None else int(part.codes)) for part in cells)
        return [compute(tuple(key))], shape
    columns = [
        map(_key, *(np.broadcast_to(values, shape).ravel().tolist() for values in (part.numbers, codes_of(part))))
        for part in cells
    ]
    keys = list(zip(*columns, strict=True))
    known = {key: compute(key) for key in dict.fromkeys(keys)}
    return [known[key] for key in keys], shape


def _key(number: float, code: int) -> tuple[float, int]:
    return (0.0 if code >= ERROR else number), code


def shaped(found: Sequence[tuple[float, int]], shape: tuple[int, ...]) -> Cells:
    """Numbers and their codes along a shape."""
    if shape == ():
        number, code = found[0]
        return Cells(np.float64(number), np.uint8(code) if code else None)
    numbers = np.array([number for number, _ in found], np.float64).reshape(shape)
    codes = np.array([code for _, code in found], np.uint8).reshape(shape)
    return Cells(numbers, codes if codes.any() else None)


def each(function: Callable[..., Scalar], args: tuple[Cells, ...], texts: Texts, spend: Callable[[int], None]) -> Cells:
    """A function of scalars, cell by cell: the slow way, for texts. Errors in arguments come first, from the left.

    spend  is told how many cells an array has
    """

    def one(key: Key) -> tuple[float, int]:
        wrong = next((code for _, code in key if code >= ERROR), 0)
        return (np.nan, wrong) if wrong else texts.encode(function(*(texts.decode(*value) for value in key)))

    args = fitted(*args)
    size = np.broadcast_shapes(*(cells.shape for cells in args))
    if len(size) > 2:
        spend(size[0] * size[1])
    return shaped(*once_each(one, args))


def compared(op: str, left: Cells, right: Cells, texts: Texts) -> Cells:
    """A comparison. Numbers come before texts (compared without regard to case, or with it), texts before truth values.

    A blank is 0, "" or FALSE, as the other side asks.
    """
    if left.codes is None and right.codes is None:
        return boolean(compare_numbers(op, left.numbers, right.numbers))
    errors = first_error(errors_of(left), errors_of(right))
    a, a_rank, b, b_rank = _ranked(left, right, texts)
    same = a_rank == b_rank
    if op in ("=", "<>"):
        equal = same & compare_numbers("=", a, b)
        mask = equal if op == "=" else ~equal
    else:
        mask = np.where(same, compare_numbers(op, a, b), np.less(a_rank, b_rank) if op[0] == "<" else a_rank > b_rank)
    result = boolean(mask)
    if errors is None:
        return result
    return Cells(np.where(errors != 0, np.nan, result.numbers), np.where(errors != 0, errors, np.uint8(BOOLEAN)))


def compare_numbers(op: str, left: Any, right: Any) -> Any:
    """A comparison of numbers in which nearly equal ones (NEAR) are equal."""
    margin = NEAR * np.abs(right)
    match op:
        case "<":
            return np.less(left, right - margin)
        case "<=":
            return np.less_equal(left, right + margin)
        case ">":
            return np.greater(left, right + margin)
        case ">=":
            return np.greater_equal(left, right - margin)
        case "=":
            return np.greater_equal(left, right - margin) & np.less_equal(left, right + margin)
        case _:
            return ~(np.greater_equal(left, right - margin) & np.less_equal(left, right + margin))


def _ranked(left: Cells, right: Cells, texts: Texts) -> tuple[Any, Any, Any, Any]:
    """Both sides' sort keys and kinds: 0 number, 1 text, 2 truth value; a blank takes the other side's kind."""
    a, ac = np.broadcast_arrays(left.numbers, codes_of(left))
    b, bc = np.broadcast_arrays(right.numbers, codes_of(right))
    a_rank, b_rank = _kind(ac), _kind(bc)
    places = _text_places(texts, (a, ac), (b, bc))
    a_blank, b_blank = ac == BLANK, bc == BLANK
    a_key = np.where(a_blank, np.where(b_rank == 1, places[_NO_TEXT], 0.0), _keys(a, ac, texts, places))
    b_key = np.where(b_blank, np.where(a_rank == 1, places[_NO_TEXT], 0.0), _keys(b, bc, texts, places))
    return a_key, np.where(a_blank, b_rank, a_rank), b_key, np.where(b_blank, a_rank, b_rank)


def _kind(codes: Any) -> Any:
    return np.where(codes == TEXT, 1, np.where(codes == BOOLEAN, 2, 0))


def _text_places(texts: Texts, *sides: tuple[Any, Any]) -> dict[tuple[str, str], float]:
    """What a text is compared by -> its place in the order of all texts at hand."""
    words = {_NO_TEXT}
    for numbers, codes in sides:
        words.update(texts.key(texts.text(key)) for key in different(numbers[codes == TEXT]))
    return {word: float(place) for place, word in enumerate(sorted(words))}


def _keys(numbers: Any, codes: Any, texts: Texts, places: dict[tuple[str, str], float]) -> Any:
    is_text = codes == TEXT
    keys = numbers
    for key in different(numbers[is_text]):
        keys = np.where(is_text & (numbers == key), places[texts.key(texts.text(key))], keys)
    return keys


# one value at a time, for plain functions


class Problem(Exception):  # noqa: N818 - an error value on its way to the cell, not a failure of the program
    """An error value as a function's result."""

    def __init__(self, code: str) -> None:
        super().__init__(code)
        self.code = code


def caught(kernel: Callable[..., Cells]) -> Callable[..., Cells]:
    """The kernel with the error value in place of a `Problem`."""

    def catching(*args: Any) -> Cells:
        try:
            return kernel(*args)
        except Problem as problem:
            return error(error_code(problem.code))

    return catching


def need(*conditions: bool) -> None:
    """#NUM! unless all conditions hold."""
    if not all(conditions):
        raise Problem("#NUM!")


def to_number(value: Scalar) -> float:
    """A scalar as a number; a text that shows none is #VALUE!."""
    if isinstance(value, str):
        number = text_to_number(value)
        if number is None:
            raise Problem("#VALUE!")
        return number
    if isinstance(value, ErrorValue):
        raise Problem(value.code)
    return 0.0 if value is None else float(value)


def since_epoch(day: float, epochs: float) -> float:
    """A day that a text shows as the workbook counts days; #VALUE! for one before its calendar begins."""
    if day < epochs:
        raise Problem("#VALUE!")
    return float(day) - epochs


def to_truth(value: Scalar) -> bool:
    """A scalar as a truth value: TRUE and FALSE also as texts."""
    if isinstance(value, str):
        word = value.strip().upper()
        if word not in ("TRUE", "FALSE"):
            raise Problem("#VALUE!")
        return word == "TRUE"
    return to_number(value) != 0


def to_strict_number(value: Scalar) -> float:
    """A number, or a text that is one; a truth value is none."""
    if isinstance(value, bool):
        raise Problem("#VALUE!")
    return to_number(value)


def raise_first(codes: Any) -> None:
    """Raise the first error among codes, row by row."""
    bad = np.flatnonzero(codes >= ERROR)
    if len(bad):
        raise Problem(ERROR_NAMES[int(codes.flat[bad[0]]) - ERROR])
