"""Symbols and names of points as the figure has them, wherever they stand in a text: θ with 13 lowered, A with 0 lowered."""

from __future__ import annotations

import re
from collections.abc import Iterable

from livesheet.workbook import Rich
from mechsheet.compiled import Compiled
from mechsheet.homework.headings import aliases_of, called
from mechsheet.sheet.mathematics import Part, merged
from mechsheet.words.symbols import parts as letters
from mechsheet.words.symbols import plain


class Names:
    """The symbols of a mechanism, and the names of its points."""

    def __init__(self, compiled: Compiled) -> None:
        mechanism = compiled.mechanism
        points = {point for link in mechanism.links for point in link.points}
        self.symbols = {each.symbol for each in (*compiled.equations.constants, *compiled.equations.columns)}
        self.symbols |= {each.symbol for each in (*mechanism.dimensions, *mechanism.all_drivers)}
        self.symbols |= {output.symbol for output in (*mechanism.outputs, *mechanism.motion_outputs)}
        self.symbols |= {summary.symbol for summary in mechanism.summaries}
        symbol, point = (
            "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True)) or "(?!)"
            for names in (self.symbols, points)
        )
        self.name = re.compile(rf"(?<![\w.])(?:(?:{symbol})(?![\w.])|(?:{point})+(?!\w))")
        self.point = re.compile(point)

    def _parts(self, name: str) -> list[str]:
        """The symbol, or the points of a name such as A0A."""
        return [name] if name in self.symbols else self.point.findall(name)

    def set(self, parts: Iterable[Part]) -> list[Part]:
        """The pieces of a line with every name in it set."""
        found: list[Part] = []
        for text, style in parts:
            at = 0
            for name in self.name.finditer(text) if not style else ():
                found.append((text[at : name.start()], ""))
                for letter, lowered in map(letters, self._parts(name[0])):
                    found += [(letter, ""), (lowered, "sub")]
                at = name.end()
            found.append((text[at:], style))
        return merged([(piece, style) for piece, style in found if piece])

    def rich(self, content: Rich | str) -> Rich:
        """The same for a cell."""
        return Rich(tuple(self.set(content.parts if isinstance(content, Rich) else [(content, "")])))

    def head(self, text: str, symbol: str) -> Rich | str:
        """What stands over a column or beside a cell, set as elsewhere if `mark` still reads the symbol in it."""
        found = self.rich(text)
        return found if called((found.plain,), aliases_of((symbol,))).alone else text

    def plain(self, text: str) -> str:
        """A text with its names set, where there is one size of letters."""
        return self.name.sub(lambda name: "".join(map(plain, self._parts(name[0]))), text)
