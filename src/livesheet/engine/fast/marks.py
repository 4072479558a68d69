"""What kinds of values blocks and runs of constants hold, during one evaluation."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ..layout import Layout
from ..values.cells import TEXT


@dataclass(slots=True)
class Marks:
    """By the numbers of producers (`Layout.producers`).

    dirty  hold something other than numbers;  texts  those of them that hold texts and nothing else
    """

    dirty: set[int] = field(default_factory=set)
    texts: set[int] = field(default_factory=set)

    def copy(self) -> Marks:
        """Marks that can be changed apart from these."""
        return Marks(set(self.dirty), set(self.texts))

    def note(self, producer: int, codes: Any) -> None:
        """Take note of (some of) the codes of what a producer holds."""
        if codes.any():
            self.dirty.add(producer)
        if producer in self.texts and not (codes == TEXT).all():
            self.texts.discard(producer)

    def note_one(self, producer: int, code: int) -> None:
        """The same of the code of one cell."""
        if code:
            self.dirty.add(producer)
        if code != TEXT:
            self.texts.discard(producer)


def marks_of_constants(layout: Layout) -> Marks:
    """What the constants hold."""
    marks = Marks()
    for producer, run in enumerate(layout.constants, len(layout.blocks)):
        if run.codes is not None:
            marks.dirty.add(producer)
            if (run.codes == TEXT).all():
                marks.texts.add(producer)
    return marks
