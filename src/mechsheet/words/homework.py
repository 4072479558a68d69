"""The words of audits, exercises and marks."""

from __future__ import annotations

from .catalogue import words


def marks_of(language: str, marks: float, of: float) -> str:
    """ "62.5 of 100 marks"."""
    return said(language, "marks.of_one" if of == 1 else "marks", marks=f"{marks:g}", of=f"{of:g}")


def said(language: str, key: str, **parts: object) -> str:
    """The text of a key with its parts."""
    return words(language, f"homework.{key}", **parts)
