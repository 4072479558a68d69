"""What may be the name of a cell, in every spreadsheet program at once.

Sources: ECMA-376-1 18.17.2.5; Microsoft "Names in formulas"; what LibreOffice and Excel do with the four i's of Turkish
is not the same, so names that differ only there count as equal.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection
from itertools import chain, count

from livesheet.formula.functions import FUNCTIONS

from ..said import say

MAX_LENGTH = 255
_SHAPE = re.compile(r"[^\W\d][\w.]*")
_CELL = re.compile(r"[a-z]{1,3}\d+", re.IGNORECASE)
_COMMON = ("math", "logic", "fold", "lookup", "conditional", "text")
_FUNCTIONS = frozenset(row.name for row in FUNCTIONS.values() if row.module in _COMMON)
"""Functions that everybody knows: a cell called so would be legal and misleading. (`phi` is a good name of an angle.)"""
_R1C1 = re.compile(r"[rzlfws]\d*[csko]\d*", re.IGNORECASE)
"""R1C1 and RC as the Excels of other languages spell them: Z1S1 (German), L1C1 (French), F1C1 (Spanish), W1K1 (Polish) ...

Each letter of a row with each of a column: which of them belong together is documented nowhere, and few names are lost.
"""
_TRUTHS = (
    "true", "false", "wahr", "falsch", "vrai", "faux", "doğru", "yanlış", "verdadero", "falso", "verdadeiro", "vero",
    "waar", "onwaar", "sant", "falskt", "sand", "falsk", "sann", "usann", "tosi", "epätosi", "prawda", "fałsz", "pravda",
    "nepravda", "igaz", "hamis", "adevărat", "fals", "истина", "ложь", "αληθησ", "ψευδησ",
)  # fmt: skip
"""TRUE and FALSE in the languages of Excel."""


def folded(name: str) -> str:
    """A name as spreadsheets compare names: no case, and the four i's of Turkish as one."""
    for letter in "ıİI":
        name = name.replace(letter, "i")
    return unicodedata.normalize("NFKC", name).casefold()


_FOLDED_TRUTHS = frozenset(folded(word) for word in _TRUTHS)


def name_fault(name: str) -> str:
    """Why a name cannot be a cell's, in words that complete "the cell name X ..."; "" when it can."""
    if not name:
        return say("is empty")
    if len(name) > MAX_LENGTH:
        return say("has {count} characters; {most} are allowed", count=len(name), most=MAX_LENGTH)
    if unicodedata.normalize("NFC", name) != name or any(unicodedata.combining(letter) for letter in name):
        return say("has combining marks: write accented letters as single characters")
    if not _SHAPE.fullmatch(name):
        return say("must begin with a letter or _ and go on with letters, digits, _ or .")
    if _CELL.fullmatch(name):
        return say("looks like the address of a cell")
    if len(name) == 1:
        return say(
            "is a single letter, and letters stand for a row or a column in some language's Excel: R and C, Z and S, ..."
        )
    if _R1C1.fullmatch(name):
        return say("looks like an address in R1C1 form, in some language")
    if folded(name) in _FOLDED_TRUTHS or name.lower().startswith(("_xlnm", "_xlfn", "_xlpm")):
        return say("is reserved by spreadsheet programs")
    if name.upper() in _FUNCTIONS:
        return say("is the name of a function")
    return ""


def safe_name(symbol: str, taken: Collection[str], word: str = "") -> str:
    """A legal cell name like `symbol` (a1 becomes a_1, r becomes r_1) that differs from all of `taken` (folded names).

    word  what to call it rather than with a number behind it, if that is legal and free
    """
    plain = unicodedata.normalize("NFC", symbol).replace(".", "_")
    plain = re.sub(r"[^\w.]", "_", plain) or "_"
    candidates = [plain, re.sub(r"(?<=[^\W\d])(\d+)$", r"_\1", plain)]
    candidates += [word] if word.upper() not in FUNCTIONS else []
    further = (f"{plain}_{number}" for number in count(1))
    return next(name for name in chain(candidates, further) if not name_fault(name) and folded(name) not in taken)
