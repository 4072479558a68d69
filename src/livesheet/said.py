"""Messages that know what they are made of, so that they can be said in another language, too.

A message is written in English where it is raised, `say("no link is called {name}", name=name)`. It is a text like any
other, and keeps its pattern and its parts; `words/messages/` has the Turkish of every pattern.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, runtime_checkable


@runtime_checkable
class InBoth(Protocol):
    """What has words of its own in both languages, as the label of a group has."""

    en: str
    tr: str


class Said(str):
    """An English text with the pattern and the parts that it is made of; parts may be said themselves."""

    pattern: str
    parts: Mapping[str, Any]


def say(pattern: str, /, **parts: Any) -> Said:
    """The text of a pattern, `{name}` standing for a part as in `str.format`; without parts the pattern as it stands."""
    text = Said(_filled(pattern, {name: part.en if isinstance(part, InBoth) else part for name, part in parts.items()}))
    text.pattern, text.parts = pattern, parts
    return text


def reason(error: Exception) -> str:
    """What an exception says."""
    first = error.args[0] if error.args else ""
    return first if isinstance(first, Said) else str(error)


def in_turkish(text: str, patterns: Mapping[str, str]) -> str:
    """A text with its patterns replaced, English -> Turkish; what is not said, or has no Turkish, stays as it is."""
    if not isinstance(text, Said):
        return text
    parts = {name: _part_in_turkish(part, patterns) for name, part in text.parts.items()}
    return _filled(patterns.get(text.pattern, text.pattern), parts)


def _part_in_turkish(part: Any, patterns: Mapping[str, str]) -> Any:
    if isinstance(part, InBoth):
        return part.tr
    return in_turkish(part, patterns) if isinstance(part, str) else part


def _filled(pattern: str, parts: Mapping[str, Any]) -> str:
    return pattern.format(**parts) if parts else pattern
