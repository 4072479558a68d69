"""What the cells of dimensions are called: as the description says, after their symbols, or after their labels."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection

from livesheet.formula.names import folded, safe_name
from mechsheet.model import Dimension, Mechanism
from mechsheet.words.catalogue import words

_WORD = re.compile(r"[^\W\d_]{3,}")
"""A word by which a person would call a length: letters only, and more than a pin's name has."""


def names_of_dimensions(
    mechanism: Mechanism, dimensions: Collection[Dimension], taken: set[str], kept: Collection[str]
) -> dict[str, str]:
    """Symbol -> the name of its cell, different from all of `taken` (folded), to which they are added.

    A symbol of one letter, which no spreadsheet takes for a name, is called by the word of its label, where that has
    one that no other label has. Such a name is chosen after all that need no choice, so that c1 is c_1 beside any c.

    kept  names that other cells are to have: no label's word takes them
    """
    labels = {dim.symbol: _word(dim, mechanism.language) for dim in mechanism.dimensions}
    often = Counter(map(folded, labels.values()))
    free = {symbol: word for symbol, word in labels.items() if often[folded(word)] == 1 and folded(word) not in kept}
    found: dict[str, str] = {}
    for dim in sorted(dimensions, key=lambda dim: len(dim.symbol) == 1):
        found[dim.symbol] = dim.cell or safe_name(dim.symbol, taken, free.get(dim.symbol, ""))
        taken.add(folded(found[dim.symbol]))
    return found


def kept_names(mechanism: Mechanism, further: Collection[str]) -> set[str]:
    """The names (folded) that a workbook gives to other cells than dimensions, and those of the description's symbols.

    further  the keys of what can be said, and of other cells that are called by their keys
    """
    own = [words(mechanism.language, f"name.{key}") for key in ("start", "step", "position")]
    symbols = [each.symbol for each in (*mechanism.dimensions, *mechanism.motion_numbers, *mechanism.outputs)]
    return {folded(name) for name in (*own, *symbols, *further, "verdict")}


def _word(dim: Dimension, language: str) -> str:
    """The word that a label is, points aside (`crank` of "crank A0A"); "" where it is several."""
    label = dim.label.of(language) if dim.label else ""
    name, *rest = label.split() or [""]
    points = all(part[:1].isupper() and not part.islower() for part in rest)
    return name if points and _WORD.fullmatch(name) and name.islower() else ""
