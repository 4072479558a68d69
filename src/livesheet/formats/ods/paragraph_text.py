"""The text of a paragraph of OpenDocument: spaces count once, except those that are elements."""

from __future__ import annotations

import re
from collections.abc import Mapping

from .words import Words

MAX_SPACES = 32_767
"""Most spaces that one element stands for: a cell holds no more."""
_SPACES = re.compile("[ \t\r\n]+")
_SPACE, _TAB, _BREAK = "\x01", "\x02", "\x03"
"""Stand for what elements mean until the other spaces are gone; no character of XML."""
_MEANT = str.maketrans({_SPACE: " ", _TAB: "\t", _BREAK: "\n"})


class ParagraphText:
    """Gathers one paragraph after the other in `texts`, which the parser fills.

    tags  the elements that `mark` wants to know of
    """

    def __init__(self, words: Words, texts: list[str]) -> None:
        self._texts = texts
        self._count = words.space_count
        self._space = words.space
        self._tab = words.tab
        self.tags = frozenset((words.space, words.tab, words.line_break))
        self._kept = 0

    def mark(self, tag: str, attributes: Mapping[str, str]) -> None:
        """An element that stands for characters."""
        if tag == self._space:
            count = attributes.get(self._count, "1")
            number = int(count) if count.isdecimal() and len(count) < 10 else 1
            self._texts.append(_SPACE * min(number, MAX_SPACES))
        else:
            self._texts.append(_TAB if tag == self._tab else _BREAK)

    def pause(self) -> None:
        """What follows is not the cell's text, until `go_on`."""
        self._kept = len(self._texts)

    def go_on(self) -> None:
        """Forget what came since `pause`."""
        del self._texts[self._kept :]

    def text(self) -> str:
        """The paragraph."""
        return _SPACES.sub(" ", "".join(self._texts)).strip(" ").translate(_MEANT)
