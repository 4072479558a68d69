"""What the workbook says of a number beside it, of many designs at once; and which designs are set apart because of it.

The words and the limits are those of the first sheet (`sheet/checks/extremes.py`, `boundless.py`): *(about)* where the
last probe still changed the extreme, *(or beyond)* where it may be beside another row or in a spike, *(grows without
bound)* where there is none, *(rows only)* where nobody looked between the rows. A design is set apart where a condition or
an objective reads a number of the last two kinds: it is kept and told of, but not compared with others.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from mechsheet.sheet.checks.boundless import GROWN, LEAST_ROWS, STRAIGHT, STRAIGHT_SIGNED
from mechsheet.sheet.checks.one_extreme import SETTLED
from mechsheet.words.catalogue import Language, words

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Codes = NDArray[np.int8]
Texts = NDArray[np.object_]

ABOUT, BEYOND, BOUNDLESS, ROWS_ONLY = 1, 2, 3, 4
"""Codes of remarks, 0 for none: of two the larger is said, as on the first sheet."""

WORDS = {
    ABOUT: "verdict.about",
    BEYOND: "verdict.beyond",
    BOUNDLESS: "verdict.boundless",
    ROWS_ONLY: "verdict.rows.only",
}


def unsettled(value: Array, last: Array, before: Array, worst: Array, at_end: Mask) -> Mask:
    """Whether an extreme is about right only: the last probe is worse than it, or it alone is that good.

    last    what the last probe has found;  before: the best of what was known before it
    worst   the other extreme of the rows
    at_end  where the extreme is at an end of the motion, where it is as it should be
    """
    span = np.abs(value - worst)
    return np.asarray(~at_end & ((np.abs(value - last) > SETTLED * span) | (np.abs(value - before) > SETTLED * span)))


def beyond_rows(value: Array, of_rows: Array, others: Array, rows: NDArray[np.int64]) -> Mask:
    """Whether extremes are far beyond the rows.

    of_rows, others  the best and the worst of the rows;  rows: how many the stretch has
    """
    return np.asarray((rows >= LEAST_ROWS) & (np.abs(value - of_rows) > GROWN * np.abs(of_rows - others)))


def at_pole(before: Array, here: Array, after: Array, signed: bool) -> Mask:
    """Whether quantities have a pole beside the middle one of three rows.

    signed  whether their signs are those of what stands in an absolute value
    """
    straight = STRAIGHT_SIGNED if signed else STRAIGHT
    turns = np.minimum(before * here, after * here) < 0
    return np.asarray(turns & (np.abs(1 / before - 2 / here + 1 / after) < straight * np.abs(1 / before - 1 / after)))


def said(codes: Mapping[str, Codes], language: Language, count: int) -> Texts:
    """The remarks of designs, as one text each: "swing (rows only), v_max (grows without bound)"; None without any.

    codes  of each quantity, by its name
    """
    found: Texts = np.full(count, None, object)
    for name, column in codes.items():
        for place in np.flatnonzero(column):
            text = name + words(language, WORDS[int(column[place])])
            found[place] = text if found[place] is None else f"{found[place]}, {text}"
    return found


def apart(codes: Mapping[str, Codes], decisive: Iterable[str], count: int) -> Mask:
    """Which designs are set apart; `decisive`: names of quantities that conditions and objectives read."""
    found = np.zeros(count, bool)
    for name in decisive:
        found |= codes[name] >= BOUNDLESS
    return found
