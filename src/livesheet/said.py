"""Messages that know what they are made of, so that they can be said in another language, too.

A message is written in English where it is raised, `say("no link is called {name}", name=name)`. It is a text like any
other, and keeps its pattern and its parts, so that a catalogue of GNU gettext can say it in another language.
"""

from __future__ import annotations

from collections.abc import Mapping
from gettext import NullTranslations
from typing import Any


class Words:
    """What has a wording in every language, as the label of a group has."""

    __slots__ = ()

    def of(self, language: str) -> str:
        """The wording in a language."""
        raise NotImplementedError


class Said(str):
    """An English text with the pattern and the parts that it is made of; parts may be said themselves.

    many    the pattern for several things, where it counts things; `pattern` is then that for one
    number  how many there are
    """

    pattern: str
    parts: Mapping[str, Any]
    many: str = ""
    number: int = 1


def say(pattern: str, /, **parts: Any) -> Said:
    """The text of a pattern, `{name}` standing for a part as in `str.format`; without parts the pattern as it stands."""
    text = Said(
        _filled(pattern, {name: part.of("en") if isinstance(part, Words) else part for name, part in parts.items()})
    )
    text.pattern, text.parts = pattern, parts
    return text


def say_count(one: str, many: str, count: int, /, **parts: Any) -> Said:
    """The text about so many things: of `one` where there is one, of `many` elsewhere; `{count}` stands for the number.

    Another language chooses among its own plural forms.
    """
    text = say(one if count == 1 else many, count=count, **parts)
    text.pattern, text.many, text.number = one, many, count
    return text


def reason(error: Exception) -> str:
    """What an exception says."""
    first = error.args[0] if error.args else ""
    return first if isinstance(first, Said) else str(error)


def translated(text: str, catalogue: NullTranslations, language: str) -> str:
    """A text with its patterns looked up in a catalogue; what was not said stays as it is."""
    if not isinstance(text, Said) or not text:
        return text  # of "" a catalogue knows who has made it
    parts = {name: _part_translated(part, catalogue, language) for name, part in text.parts.items()}
    if text.many:
        return _filled(catalogue.ngettext(text.pattern, text.many, text.number), parts)
    return _filled(catalogue.gettext(text.pattern), parts)


def _part_translated(part: Any, catalogue: NullTranslations, language: str) -> Any:
    if isinstance(part, str):
        return translated(part, catalogue, language)
    return part.of(language) if isinstance(part, Words) else part


def _filled(pattern: str, parts: Mapping[str, Any]) -> str:
    return pattern.format(**parts) if parts else pattern
