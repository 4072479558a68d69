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

from mechsheet.sheet.checks import search_rules as rules
from mechsheet.words.catalogue import Language, words

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
Codes = NDArray[np.int8]
Texts = NDArray[np.object_]

ABOUT, BEYOND, BOUNDLESS, ROWS_ONLY, SEVERAL = 1, 2, 3, 4, 5
"""Codes of remarks, 0 for none: of two the larger is said, as on the first sheet."""

OF_DOUBTS: Codes = np.zeros(5, np.int8)
OF_DOUBTS[[rules.ABOUT, rules.BEYOND, rules.ROWS]] = ABOUT, BEYOND, ROWS_ONLY
"""The code of what the sheet of extremes says beside a value, by its number."""

WORDS = {
    ABOUT: "verdict.about",
    BEYOND: "verdict.beyond",
    BOUNDLESS: "verdict.boundless",
    ROWS_ONLY: "verdict.rows.only",
    SEVERAL: "verdict.several",
}


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
