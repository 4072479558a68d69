"""Numbers of things in English sentences: one row, two rows."""

from __future__ import annotations


def counted(count: int, one: str, many: str = "", spec: str = "") -> str:
    """The count and what there are so many of: `1 row`, `25 rows`, `0 rows`.

    many  the words for any other count than 1, where they are not those for one with an s
    spec  how the count is written
    """
    return f"{count:{spec}} {one if count == 1 else many or one + 's'}"
