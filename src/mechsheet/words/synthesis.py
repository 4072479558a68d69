"""The words of synthesis, in both languages: of tasks, of the steps of their solutions, of what is said of these."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.model import Words

from .catalogue import words

ENDS = (
    Words(words("en", "step.end.first"), words("tr", "step.end.first")),
    Words(words("en", "step.end.last"), words("tr", "step.end.last")),
)


def step_words(key: str, **parts: object) -> Words:
    """What an input of a task or a step of its solution is, its {parts} filled in; words are parts in each language."""
    return Words(_filled(words("en", f"step.{key}"), parts, "en"), _filled(words("tr", f"step.{key}"), parts, "tr"))


def _filled(text: str, parts: Mapping[str, object], language: str) -> str:
    spelt = {name: part.of(language) if isinstance(part, Words) else part for name, part in parts.items()}
    return text.format(**spelt)
