"""Criteria of COUNTIF and its relatives: ">3", "=x*", 5, "<>"."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from ...formula.nodes import ErrorValue, Scalar
from ..values.cells import BLANK, BOOLEAN, ERROR_NAMES, NUMBER, TEXT, Cells, Texts, codes_of, different, error_code
from ..values.coerce import compare_numbers, number_shown, number_to_text
from .patterns import pattern_of

Test = Callable[[Cells], Any]
"""Cells -> which of them fit."""

_CRITERION = re.compile(r"(<=|>=|<>|<|>|=)?(.*)", re.DOTALL)


def criterion(value: Scalar, texts: Texts) -> Test:
    """The test that a criterion makes."""
    if isinstance(value, ErrorValue):
        wanted = error_code(value.code)
        return lambda cells: codes_of(cells) == wanted
    if isinstance(value, bool):
        return _flag("=", value)
    if not isinstance(value, str):
        return _number("=", float(value or 0), texts)
    match = _CRITERION.fullmatch(value)
    op, word = (match[1] or "=", match[2]) if match else ("=", value)
    shown = number_shown(word, texts)
    if shown is not None:
        return _number(op, shown, texts)
    if word.upper() in ERROR_NAMES and op in ("=", "<>"):
        wanted = error_code(word)
        return lambda cells: (codes_of(cells) == wanted) ^ (op == "<>")
    if word.upper() in ("TRUE", "FALSE") and op in ("=", "<>"):
        return _flag(op, word.upper() == "TRUE")
    if word == "":
        return _empty(op, match is not None and match[1] is not None, texts)
    return _text(op, word, texts)


def _flag(op: str, flag: bool) -> Test:
    return lambda cells: ((codes_of(cells) == BOOLEAN) & (cells.numbers == flag)) ^ (op == "<>")


def _number(op: str, number: float, texts: Texts) -> Test:
    """Numbers by their size; equal to a number is also a text that shows it."""

    def test(cells: Cells) -> Any:
        codes = codes_of(cells)
        if op not in ("=", "<>"):
            return (codes == NUMBER) & compare_numbers(op, cells.numbers, number)
        found = (codes == NUMBER) & compare_numbers("=", cells.numbers, number)
        if op == "<>":
            return ~found
        is_text = codes == TEXT
        for key in different(cells.numbers[is_text]):
            shown = number_shown(texts.text(key), texts)
            if shown is not None and compare_numbers("=", np.float64(shown), number):
                found = found | (is_text & (cells.numbers == key))
        return found

    return test


def _empty(op: str, written: bool, texts: Texts) -> Test:
    """ "=" blanks, "<>" all others; nothing at all: blanks and empty texts."""
    if not written:
        empty = texts.number("")
        return lambda cells: (codes_of(cells) == BLANK) | ((codes_of(cells) == TEXT) & (cells.numbers == empty))
    if op == "=":
        return lambda cells: codes_of(cells) == BLANK
    if op == "<>":
        return lambda cells: codes_of(cells) != BLANK
    return lambda cells: np.zeros(np.shape(cells.numbers), bool)


def _text(op: str, word: str, texts: Texts) -> Test:
    pattern, folded = pattern_of(word, texts.settings), word.casefold()
    tests: dict[str, Callable[[str], bool]] = {
        "=": pattern.fits,
        "<>": lambda text: not pattern.fits(text),
        "<": lambda text: text.casefold() < folded,
        "<=": lambda text: text.casefold() <= folded,
        ">": lambda text: text.casefold() > folded,
        ">=": lambda text: text.casefold() >= folded,
    }

    def test(cells: Cells) -> Any:
        is_text = codes_of(cells) == TEXT
        result = np.zeros(np.shape(cells.numbers), bool) if op != "<>" else ~is_text
        for key in different(cells.numbers[is_text]):
            if tests[op](texts.text(key)):
                result = result | (is_text & (cells.numbers == key))
        if pattern.of_numbers and op in ("=", "<>"):
            is_number = codes_of(cells) == NUMBER
            for key in different(cells.numbers[is_number]):
                here = is_number & (cells.numbers == key)
                result = np.where(here, tests[op](number_to_text(float(key))), result)
        return result

    return test
