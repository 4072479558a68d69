"""The words of audits, exercises and marks."""

from __future__ import annotations

import math

from .catalogue import words, words_of_count


def marks_of(language: str, marks: float, of: float) -> str:
    """ "62.5 of 100 marks"; a part of a mark is spoken of as several are."""
    return words_of_count(language, "homework.marks", math.ceil(of), marks=f"{marks:g}", of=f"{of:g}")


def said(language: str, key: str, **parts: object) -> str:
    """The text of a key with its parts."""
    return words(language, f"homework.{key}", **parts)
