"""Lines of TOML that are written with a remark behind: what the value is, in the language of the page."""

from __future__ import annotations

from mechsheet.description.text.index import key_text
from mechsheet.drawing_page.editing.sheet import Sheet
from mechsheet.words.catalogue import words

WIDE = 26
"""Characters before a remark, so that those of one table stand below one another."""


def said(sheet: Sheet, key: str, **parts: str) -> str:
    """Words of the page in its language."""
    return words(sheet.language, f"draw.{key}", **parts)


def noted(sheet: Sheet, value: str, key: str, **parts: str) -> str:
    """A value with a remark behind it; `key`: what it is the value of, if that is written elsewhere."""
    note = said(sheet, f"insert.note.{key}", **parts)
    return f"{value:<{WIDE - len(key) - 3}}  # {note}"


def line(sheet: Sheet, key: str, value: str, **parts: str) -> str:
    """A line of TOML, `key = value`, with a remark behind it."""
    return f"{key} = {noted(sheet, value, key, **parts)}"


def quoted_key(name: str) -> str:
    """A name as a text of TOML."""
    text = key_text(name)
    return text if text.startswith(('"', "'")) else f'"{text}"'
