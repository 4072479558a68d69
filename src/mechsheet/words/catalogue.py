"""What is said in each language: one catalogue of GNU gettext a language, read when it first says something.

A text is known by a key, as "verdict.line.all", whose English stands in `en.po`; or by its English, as messages are,
which `en.po` need not have. What a catalogue lacks is said in English.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from gettext import GNUTranslations, NullTranslations
from io import BytesIO
from pathlib import Path
from typing import TypeAlias

from livesheet.diagnostics import Fault
from livesheet.said import Words, translated

FOLDER = Path(__file__).with_name("catalogues")

ENGLISH = "en"

LANGUAGES = (ENGLISH, *sorted({path.stem for path in FOLDER.glob("*.[mp]o")} - {ENGLISH}))
"""The languages that there are, by the names of their catalogues (ISO 639)."""

Language: TypeAlias = str
"""One of `LANGUAGES`."""


class _InEnglish(NullTranslations):
    """Says what a catalogue lacks; the English one is read only then."""

    def gettext(self, message: str) -> str:
        return catalogue(ENGLISH).gettext(message)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return catalogue(ENGLISH).ngettext(msgid1, msgid2, n)


@cache
def catalogue(language: str) -> GNUTranslations:
    """The texts of a language, compiled when the package was built, or now."""
    path = FOLDER / f"{language}.mo"
    if path.exists():
        data = path.read_bytes()
    else:
        from .compiling import compiled

        data = compiled(path.with_suffix(".po").read_text(encoding="utf-8"))
    found = GNUTranslations(BytesIO(data))
    if language != ENGLISH:
        found.add_fallback(_InEnglish())
    return found


def words(language: str, key: str, **parts: object) -> str:
    """The text of a key, `{name}` standing for a part as in `str.format`; without parts the text as it stands."""
    text = catalogue(language).gettext(key)
    if text == key:
        raise KeyError(key)
    return _filled(text, language, parts)


def words_of_count(language: str, key: str, count: int, **parts: object) -> str:
    """The text of a key that has plural forms, about so many things; `{count}` stands for the number."""
    text = catalogue(language).ngettext(key, key, count)
    if text == key:
        raise KeyError(key)
    return _filled(text, language, {"count": count, **parts})


def _filled(text: str, language: str, parts: Mapping[str, object]) -> str:
    if not parts:
        return text
    return text.format(**{name: part.of(language) if isinstance(part, Words) else part for name, part in parts.items()})


@dataclass(frozen=True, slots=True)
class Phrase(Words):
    """The text of a key and its parts, for whoever knows the language."""

    key: str
    parts: tuple[tuple[str, object], ...] = ()

    def of(self, language: str) -> str:
        """The text in a language, as `words` has it."""
        return words(language, self.key, **dict(self.parts))


@dataclass(frozen=True, slots=True)
class Term(Words):
    """A word of the field that stands for itself in English, as the usual name of a link; others have their context."""

    context: str
    word: str

    def of(self, language: str) -> str:
        """The word in a language; one that no catalogue has, as a name of somebody's own, stays as it is."""
        return catalogue(language).pgettext(self.context, self.word)


@dataclass(frozen=True, slots=True)
class Listed(Words):
    """Names one after another."""

    names: tuple[Words, ...]
    between: str

    def of(self, language: str) -> str:
        """All of them in a language."""
        return self.between.join(name.of(language) for name in self.names)


def is_key(key: str) -> bool:
    """Whether there is a text of this key."""
    return catalogue(ENGLISH).gettext(key) != key


def texts(language: str, begins: str) -> dict[str, str]:
    """All texts whose keys begin so, by the rest of their keys: for a page, which looks them up itself."""
    keys = [key for key in catalogue(ENGLISH)._catalog if isinstance(key, str) and key.startswith(begins)]  # type: ignore[attr-defined]
    return {key.removeprefix(begins): words(language, key) for key in sorted(keys)}


def text_in(text: str, language: str) -> str:
    """A message in a language."""
    return text if language == ENGLISH else translated(text, catalogue(language), language)


def in_language(fault: Fault, language: str) -> Fault:
    """A fault with its message and its hint in a language."""
    return replace(fault, message=text_in(fault.message, language), hint=text_in(fault.hint, language))


def marks_of(language: str, marks: float, of: float) -> str:
    """ "62.5 of 100 marks"; a part of a mark is spoken of as several are."""
    return words_of_count(language, "homework.marks", math.ceil(of), marks=f"{marks:g}", of=f"{of:g}")


def said(language: str, key: str, **parts: object) -> str:
    """The text of a key of audits, exercises and marks, with its parts."""
    return words(language, f"homework.{key}", **parts)
