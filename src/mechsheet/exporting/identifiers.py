"""Symbols as names in programming languages: ASCII letters, digits and _, each different from all others."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterable
from itertools import chain, count

from mechsheet.words.symbols import GREEK

_SPELLED = str.maketrans({"ı": "i", "İ": "I", "ß": "ss", "ø": "o", "Ø": "O", "æ": "ae", "Æ": "AE", "ł": "l", "Ł": "L"})
_GREEK = str.maketrans({letter: name for name, letter in GREEK.items()})


def ascii_word(text: str) -> str:
    """The text in letters, digits and _ of ASCII, beginning with a letter: `C.x` is C_x, `çıkış` is cikis, `θ13` theta13."""
    plain = unicodedata.normalize("NFC", text).translate(_SPELLED).translate(_GREEK)
    plain = "".join(letter for letter in unicodedata.normalize("NFKD", plain) if not unicodedata.combining(letter))
    plain = re.sub(r"[^A-Za-z0-9_]", "_", plain)
    return plain if plain[:1].isalpha() else f"x{plain}" if plain.strip("_") else "x"


def identifiers(symbols: Iterable[str], reserved: Collection[str]) -> dict[str, str]:
    """Symbol -> its name. Names differ by more than case (some languages do not see it), also from all of `reserved`."""
    taken = {word.casefold() for word in reserved}
    found: dict[str, str] = {}
    for symbol in symbols:
        plain = ascii_word(symbol)
        candidates = chain([plain, f"{plain}_"], (f"{plain}_{number}" for number in count(2)))
        found[symbol] = next(name for name in candidates if name.casefold() not in taken)
        taken.add(found[symbol].casefold())
    return found
