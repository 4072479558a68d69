"""What the words beside cells mean: θ13, theta 13, Teta13 (Derece), xC, C_x."""

from __future__ import annotations

import itertools
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from livesheet.formula.names import folded
from mechsheet.homework.formula_strips import Place, Work
from mechsheet.model import Mechanism
from mechsheet.words.catalogue import LANGUAGES

_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "θ": "theta", "ϑ": "theta", "φ": "phi", "ϕ": "phi", "ψ": "psi",
    "ω": "omega", "μ": "mu", "µ": "mu", "η": "eta", "λ": "lambda", "ξ": "xi", "ρ": "rho", "σ": "sigma", "τ": "tau",
}  # fmt: skip
_SPELLED = (("tetha", "theta"), ("teta", "theta"), ("alfa", "alpha"), ("fi", "phi"), ("th", "theta"))
_TOKEN = re.compile(r"[^\W_]+(?:[._][^\W_]+)*'?")
FARTHEST = 3
"""Cells between a table and its heading, and rows that a heading may have."""


def plain(text: str) -> str:
    """A text in small letters, Greek ones by name, raised and lowered signs as ordinary ones."""
    text = "".join(_GREEK.get(sign, sign) for sign in unicodedata.normalize("NFKC", text))
    return folded(text)


def tokens(text: str) -> list[str]:
    """The words of a text, each as `plain`, letters and digits alone."""
    return [_bare(token) for token in _TOKEN.findall(plain(text))]


def _bare(token: str) -> str:
    return re.sub(r"[._'\s]", "", token)


def _spelled(token: str) -> str:
    """A token with the usual spellings of Greek letters made one."""
    match = re.fullmatch(r"([a-z]+?)(\d.*|)", token)
    if match is None:
        return token
    letters, rest = match.groups()
    return dict(_SPELLED).get(letters, letters) + rest


def says(text: str, symbol: str) -> bool:
    """Whether a heading names a symbol: a word of it, or two words together (`theta 13`, `x C`)."""
    wanted = _aliases(symbol)
    words = tokens(text)
    joined = [one + other for one, other in itertools.pairwise(words)]
    return any(_spelled(word) in wanted or word in wanted for word in (*words, *joined))


_UNITS = frozenset(
    ("rad", "radian", "radians", "radyan", "deg", "degree", "degrees", "derece", "mm", "cm", "m", "n", "nm", "rpm", "s")
)
_FUNCTIONS = frozenset(("sin", "cos", "tan", "cot", "asin", "acos", "atan", "atan2", "arcsin", "arccos", "arctan"))


_RATE = re.compile("[′″‴∂Δ∆]|[sxyzθϑφϕψω][0-9]*[\u0307\u0308]")
"""A rate or a difference: s′4, θ̇14, ∂s/∂a2, Δs."""
_BRACKETS = re.compile(r"\[[^\]]*\]")
_COMPUTED = re.compile("[=+*·/^√|−]")
"""Signs of a formula, which names what it reads."""


@dataclass(frozen=True, slots=True)
class Called:
    """What a heading names: `symbols` of the mechanism; `alone` where one of its cells says nothing else but a unit."""

    symbols: frozenset[str] = frozenset()
    alone: bool = False


def called(cells: Iterable[str], aliases: Mapping[str, str]) -> Called:
    """The symbols that the cells of a heading name: those that a cell says alone (`theta14 [rad]`); else those that stand in
    other words (`rocker angle theta14`), with a number or a point in them: `mu` alone may be another word.

    aliases  symbols by the words that stand for them, see `aliases_of`
    """
    alone: set[str] = set()
    among: set[str] = set()
    for cell in cells:
        bare = _BRACKETS.sub("", cell)  # [N·m] is a unit, whatever its letters are
        found, rest = _named(bare if tokens(bare) else cell, aliases)
        if _COMPUTED.search(bare):
            continue
        if len(found) == 1 and rest <= _UNITS:
            alone |= found
        else:
            among |= {symbol for symbol in found if "." in symbol or any(map(str.isdigit, symbol))}
    return Called(frozenset(alone or among), bool(alone))


def _named(cell: str, aliases: Mapping[str, str]) -> tuple[set[str], set[str]]:
    """The symbols that a cell names, and its other words; none where it is of a sine, a rate or a difference."""
    words = tokens(cell)
    if _FUNCTIONS.intersection(words) or _RATE.search(unicodedata.normalize("NFD", cell)):
        return set(), set(words)
    found: set[str] = set()
    rest = dict(enumerate(words))
    for number, word in enumerate(words):
        pair = word + words[number + 1] if number + 1 < len(words) else ""
        for said, places in ((pair, (number, number + 1)), (word, (number,))):
            symbol = aliases.get(_spelled(said), aliases.get(said))
            if symbol is not None and number in rest:
                found.add(symbol)
                for place in places:
                    rest.pop(place, None)
    return found, set(rest.values())


@lru_cache(maxsize=8)
def aliases_of(symbols: tuple[str, ...]) -> Mapping[str, str]:
    """The symbols by the words that stand for them."""
    return {alias: symbol for symbol in symbols for alias in _aliases(symbol)}


def _aliases(symbol: str) -> set[str]:
    point, dot, axis = plain(symbol).partition(".")
    if dot and axis in ("x", "y"):
        return {point + axis, axis + point}
    return {_spelled(_bare(plain(symbol))), _bare(plain(symbol))}


def contains(text: str, label: str) -> bool:
    """Whether all words of a label stand in a text."""
    words = [word for word in tokens(label) if len(word) > 1]
    return bool(words) and set(words) <= set(tokens(text))


def heading(work: Work, sheet: str, pos: int, line: int) -> list[str]:
    """The texts before the first cell of a line, nearest last; of several cells one after the other all."""
    found: list[str] = []
    for back in range(1, FARTHEST + 3):
        if pos - back < 0:
            break
        value = work.value((sheet, pos - back, line))
        if isinstance(value, str) and value.strip():
            found.append(value)
            if len(found) == FARTHEST:
                break
        elif found or (value is not None and not isinstance(value, str)) or back > FARTHEST:
            break
    return found[::-1]


def around(work: Work, place: Place) -> list[str]:
    """The words beside a single cell: to the left (two cells), above, to the right; the likeliest first."""
    sheet, pos, line = place
    steps = [(0, -1), (0, -2), (-1, 0), (0, 1)]
    if work.across:
        steps = [(-1, 0), (-2, 0), (0, -1), (1, 0)]
    found: list[str] = []
    for step, (along, aside) in enumerate(steps):
        if step == 1 and found:
            continue
        if pos + along < 0 or line + aside < 0:
            continue
        value = work.value((sheet, pos + along, line + aside))
        if isinstance(value, str) and value.strip():
            found.append(value)
    return found


def labels_of(work: Work, place: Place) -> tuple[str, str]:
    """The text directly beside a single cell, and the one directly over it where there is none beside it; "" for none."""
    sheet, pos, line = place
    left, above = (sheet, pos, line - 1), (sheet, pos - 1, line)
    values = (
        work.value(cell) if min(cell[1:]) >= 0 else None for cell in ((above, left) if work.across else (left, above))
    )
    beside, over = (value if isinstance(value, str) and value.strip() else "" for value in values)
    return beside, "" if beside else over


def labels(mechanism: Mechanism, symbol: str) -> Sequence[str]:
    """What a description calls an output, or a link's angle."""
    found: list[str] = []
    for output in mechanism.outputs:
        if output.symbol == symbol and output.label is not None:
            found += [output.label.of(language) for language in LANGUAGES]
    for summary in mechanism.summaries:
        if summary.symbol == symbol and summary.label is not None:
            found += [summary.label.of(language) for language in LANGUAGES]
    return list(dict.fromkeys(found))


def names_over(work: Work, places: Iterable[Place]) -> list[str]:
    """The workbook's names of these cells, or of the line that they are."""
    from livesheet.formula.nodes import CellRef, RangeRef

    cells = set(places)
    found = []
    for defined in work.book.names:
        node = work.names.get(defined.name.casefold())
        corner = node.start if isinstance(node, RangeRef) else node
        if isinstance(corner, CellRef) and (corner.sheet or defined.sheet or "", corner.row, corner.col) in cells:
            found.append(defined.name)
    return found
