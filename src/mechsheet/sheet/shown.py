"""How quantities are shown and typed, wherever they stand: symbols, units, what a cell takes, names of cells."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection

from livesheet.formula.names import folded, safe_name
from livesheet.formula.nodes import Number, Unary
from livesheet.workbook import Area, Rich, Validation
from mechsheet.model import Dimension, Mechanism
from mechsheet.sheet.plan import Plan
from mechsheet.units import Unit
from mechsheet.words.catalogue import words
from mechsheet.words.symbols import parts, plain


def unit_of_column(plan: Plan, symbol: str) -> Unit:
    """The unit in which a column is shown."""
    return plan.mechanism.shown(plan.unit_of(symbol))


def shown_unit(plan: Plan, symbol: str) -> str:
    """The same as text: `°`."""
    return unit_of_column(plan, symbol).text


def input_validation(plan: Plan, area: Area, symbol: str) -> Validation:
    """What may be typed into cells that hold values of `symbol`: a number; of a length between joints one above 0."""
    positive = symbol in plan.equations.positive
    key = "positive" if positive else "number"
    title, message = plan.text(f"hint.{key}.title"), plan.text(f"hint.{key}", symbol=plain(symbol))
    return Validation(
        area,
        "decimal",
        ">" if positive else "between",
        Number(0.0) if positive else Unary("-", Number(1e100)),
        None if positive else Number(1e100),
        input_title=title,
        input_message=message,
        error_title=title,
        error_message=message,
    )


def label_of(plan: Plan, dim: Dimension) -> str:
    """The label that the description has for a dimension; "" where it has none."""
    return dim.label.of(plan.language) if dim.label else ""


def words_of(plan: Plan, symbol: str) -> str:
    """What a quantity is: of an equation, or one that is given row by row beside the driver."""
    mechanism = plan.mechanism
    if symbol not in mechanism.given_by_row:
        return plan.equations.of(symbol).label.of(plan.language)
    if symbol in mechanism.listed_symbols:
        return plan.text("drivers.listed")
    keys = dict(zip(mechanism.driver_rates, ("speed", "acceleration"), strict=True))
    return plan.text(f"given.{keys.get(symbol, symbol)}")


def rich(symbol: str, after: str = "") -> Rich | str:
    """The symbol with its subscript, for a cell; `after` is appended as it is (" [°]")."""
    letter, subscript = parts(symbol)
    if not subscript:
        return letter + after
    return Rich(tuple(part for part in ((letter, "italic"), (subscript, "sub"), (after, "")) if part[0]))


def rich_both(first: str, second: str) -> Rich:
    """Two symbols, for a row that has both: those of x and y of a force."""
    ways = [rich(first), ", ", rich(second)]
    return Rich(tuple(part for each in ways for part in ([(each, "")] if isinstance(each, str) else each.parts)))


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
