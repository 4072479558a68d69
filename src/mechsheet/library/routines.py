"""Functions that a workbook calls and no spreadsheet program has, put into the book as names for LAMBDA: its macros never
run.

Those that stand in modules of Basic beside it; else the function routines of the text's Appendix 2: Boy, Açı, AçıCos,
KolKızak, DörtÇubuk, AyarlıPompa, by their English names (Mag, Ang, AngCos, SlottedLever, FourBar, AdjustablePump) and in
plain letters (Aci, DortCubuk) too, with the others that `mechsheet export --to vba` writes. They are the same routines. A
macro that is only called so keeps its stored values.
"""

from __future__ import annotations

import itertools
import math
import unicodedata
from collections.abc import Collection, Iterator, Sequence
from copy import copy
from functools import cache
from pathlib import Path

from livesheet.diagnostics import Fault, WorkbookError, readable_name
from livesheet.engine import evaluate
from livesheet.formula.book import Block, Book, BookSheet, DefinedName
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.names import folded
from livesheet.formula.nodes import Call, Node, Number, calls
from livesheet.said import say
from mechsheet.words.catalogue import ENGLISH, LANGUAGES, Language

PUMP = "adjustable-pump"
"""The mechanism that the text has a routine of its own for."""
SAME = 1e-5
"""The routine of the text has a pi of 3.1415926: what is stored may differ so far from what is computed."""
MOST_COMPARED = 50


def with_routines(book: Book, modules: Sequence[Path] = ()) -> Book:
    """The book with the routines that its formulas call and that nothing in it defines, and a remark that says which.

    modules  files in Basic that define functions for it
    """
    book = with_modules(book, modules)
    defined = {folded(one.name) for one in book.names}
    called = {name for sheet in book.sheets for name in _called(sheet) if folded(name) not in defined}
    known = {name: language for name in sorted(called) if (language := _language(name)) is not None}
    if not known:
        return book
    whole = _named(book, known, defined)
    others = _of_another_meaning(whole, known)
    meant = {name: known[name] for name in known if name not in others}
    if not meant:
        return book
    found = _named(book, meant, defined) if others else whole
    names = ", ".join(_routines(language)[_plain(name)][0] for name, language in meant.items())
    message = say("{names}: computed as the textbook's functions, as this file gives no other definition", names=names)
    found.remarks = [*book.remarks, Fault(message, file=book.source, about="routine")]
    return found


def _called(sheet: BookSheet) -> Iterator[str]:
    """The functions that a sheet's formulas call and no spreadsheet program has."""
    for block in sheet.blocks:
        yield from (name for name in calls(block.formula) if name not in FUNCTIONS)


def _language(name: str) -> Language | None:
    return next((language for language in _LANGUAGES if _plain(name) in _routines(language)), None)


_LANGUAGES = (*LANGUAGES[1:], ENGLISH)
"""English last: what its routines are called may be a word of another program."""


def _plain(name: str) -> str:
    """A name in small letters without their marks: Açı, AÇI and Aci are one."""
    letters = unicodedata.normalize("NFKD", name.replace("ı", "i").replace("İ", "i"))
    return "".join(letter for letter in letters if not unicodedata.combining(letter)).casefold()


@cache
def _routines(language: Language) -> dict[str, tuple[str, Node]]:
    """Plain name -> (name, LAMBDA) of all routines of a language; configurations of the pump are those of its sketch."""
    from mechsheet.compiled import Compiled
    from mechsheet.description import Overrides, loads
    from mechsheet.description.templates import template_text
    from mechsheet.exporting.functions.all_functions import functions_of
    from mechsheet.exporting.functions.lambdas import named_functions
    from mechsheet.exporting.functions.routines import Source

    mechanism = loads(template_text(PUMP), PUMP, Overrides(language=language))
    compiled = Compiled(mechanism)
    functions = functions_of(Source(compiled), language)
    names = {function.key: function.name for function in functions}
    found = named_functions(functions, names, lambda symbol: Number(float(compiled.modes[symbol])))
    return {_plain(one.name): (one.name, one.formula) for one in found}


def _named(book: Book, known: dict[str, Language], defined: Collection[str]) -> Book:
    """The book with names for what is called, and for what those call."""
    added: dict[str, DefinedName] = {}
    for name, language in known.items():
        routines = _routines(language)
        waiting = [(name, routines[_plain(name)][1])]
        while waiting:
            called, formula = waiting.pop()
            if folded(called) not in defined and folded(called) not in added:
                added[folded(called)] = DefinedName(called, formula)
                waiting += [routines[_plain(one)] for one in sorted(calls(formula)) if _plain(one) in routines]
    found = copy(book)
    found.names = [*book.names, *added.values()]
    return found


def _of_another_meaning(book: Book, known: Collection[str]) -> set[str]:
    """Those of the names that give something else here than what the file has stored for their cells."""
    values = evaluate(book)
    others: set[str] = set()
    for sheet in book.sheets:
        for block in sheet.blocks:
            called = set(known).intersection(calls(block.formula))
            if called and not all(
                _alike(values.get(sheet.title, *place), sheet.cached.get(*place)) for place in _cells(block)
            ):
                others |= called
    return others


def _cells(block: Block) -> Iterator[tuple[int, int]]:
    cells = ((block.row + down, block.col + right) for right in range(block.cols) for down in range(block.rows))
    return itertools.islice(cells, MOST_COMPARED)


def _alike(computed: object, stored: object) -> bool:
    """Whether a computed value is the stored one, angles in another turn included; yes where no number is stored."""
    if not isinstance(stored, float):
        return True
    if not isinstance(computed, float):
        return False
    apart = abs(computed - stored)
    turned = min(abs(math.remainder(computed - stored, turn)) for turn in (math.tau, 360.0))
    return min(apart, turned) <= SAME * max(1.0, abs(stored))


def routine_names(book: Book) -> list[DefinedName]:
    """The names of a book that stand for functions."""
    return [one for one in book.names if isinstance(one.formula, Call) and one.formula.name == "LAMBDA"]


# --- modules of Basic -------------------------------------------------------------------------------------------------

MOST_BYTES = 2_000_000
"""A module is text that somebody wrote."""


def with_modules(book: Book, files: Sequence[Path]) -> Book:
    """The book with the functions of modules; what the book defines itself stays. What cannot be read is a remark.

    Raises WorkbookError where a file cannot be read, or holds no function.
    """
    if not files:
        return book
    from livesheet.basic import functions_in, lambdas

    found = copy(book)
    found.names, found.remarks = list(book.names), list(book.remarks)
    taken = {folded(name.name) for name in book.names}
    for file in files:
        shown = readable_name(file)
        functions, faults = functions_in(_text(file), shown)
        names, further = lambdas(functions, shown)
        if not functions and not faults:
            raise WorkbookError(Fault(say("no function in Basic is in it"), shown, key="--functions"))
        found.remarks += [*faults, *further]
        for name in names:
            if folded(name.name) not in taken:
                taken.add(folded(name.name))
                found.names.append(name)
    return found


def _text(file: Path) -> str:
    from livesheet.basic import decoded

    try:
        with file.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except OSError as error:
        raise WorkbookError(
            Fault(say("cannot be read: {reason}", reason=error.strerror), readable_name(file))
        ) from None
    if len(content) > MOST_BYTES or b"\0" in content:
        raise WorkbookError(Fault(say("is no module of Basic"), readable_name(file), key="--functions"))
    return decoded(content)
