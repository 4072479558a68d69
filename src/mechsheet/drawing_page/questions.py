"""What the page sends, checked: it is a program of ours, and all the same not trusted."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from mechsheet.drawing_page.positions import Point
from mechsheet.words.catalogue import words

LARGEST = 1e9
"""Places farther out than this are no drawing."""


class Refusal(Exception):  # noqa: N818
    """A question that is not understood, or cannot be answered now; `status` as in HTTP."""

    def __init__(self, message: str, status: int = 400) -> None:
        super().__init__(message)
        self.status = status


class Impossible(Exception):  # noqa: N818
    """What cannot be drawn so, in words for the user: a key of the page's words and its parts."""

    def __init__(self, key: str, **parts: str) -> None:
        super().__init__(key)
        self.key = f"impossible.{key}"
        self.parts = parts

    def text(self, language: str) -> str:
        """The sentence in a language."""
        return words(language, f"draw.{self.key}", **self.parts)


def text_in(question: Mapping[str, Any], key: str, default: str | None = None) -> str:
    """A text. Raises Refusal."""
    value = question.get(key, default)
    if not isinstance(value, str):
        raise Refusal(f'"{key}" must be a text')
    return value


def table(value: Any, message: str) -> dict[str, Any]:
    """A table that stands in a question. Raises Refusal with the message for anything else."""
    if not isinstance(value, dict):
        raise Refusal(message)
    return value


def end(value: Any) -> dict[str, Any]:
    """Where something that is drawn begins or ends: {"point": …}, {"at": …} or {"link": …}. Raises Refusal."""
    return table(value, "an end is a table")


def number_in(question: Mapping[str, Any], key: str) -> float | None:
    """A finite number, or None where there is none. Raises Refusal."""
    value = question.get(key)
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) <= LARGEST:
        raise Refusal(f'"{key}" must be a number')
    return float(value)


def point_in(question: Mapping[str, Any], key: str) -> Point:
    """A place [x, y]. Raises Refusal."""
    found = _pair(question.get(key))
    if found is None:
        raise Refusal(f'"{key}" must be a place [x, y]')
    return found


def places_in(question: Mapping[str, Any], key: str) -> dict[str, Point]:
    """Places by the names of points; what is none is left out. Raises Refusal."""
    value = table(question.get(key, {}), f'"{key}" must be a table of places')
    pairs = {name: _pair(place) for name, place in value.items()}
    return {name: place for name, place in pairs.items() if place is not None}


def _pair(value: Any) -> Point | None:
    if not isinstance(value, list) or len(value) != 2:
        return None
    if any(isinstance(part, bool) or not isinstance(part, int | float) or not math.isfinite(part) for part in value):
        return None
    return (float(value[0]), float(value[1])) if max(map(abs, value)) <= LARGEST else None
