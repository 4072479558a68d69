"""Single cells of any kind: by code, where a step has been interpreted so often that making it pays, else interpreted."""

from __future__ import annotations

from ...formula.book import Block
from ...formula.nodes import Node, shifted
from ..interpreter.evaluator import Evaluator
from ..layout import Layout
from ..values.frames import Frame
from .any_kind import CellCode, cell_code
from .memory import Memory


class CellCodes:
    """The cells of a step's blocks, column by column.

    patience  how often cells are interpreted before code is made, which takes as long as interpreting a cell twice or
              three times
    alone     as of `cell_code`
    """

    def __init__(self, layout: Layout, patience: int, alone: bool = True) -> None:
        self.layout = layout
        self.patience = patience
        self.alone = alone
        self._made: dict[tuple[int, int, bool], CellCode] = {}

    def due(self) -> bool:
        """Another time that cells are computed: whether by code, as far as there is some."""
        self.patience -= 1
        return self.patience < 0

    def compute(self, memory: Memory, number: int, formula: Node, down: int, right: int = 0) -> None:
        """Compute a cell of a block: as far as can be by code, else by the interpreter."""
        place = self.layout.block_offsets[number] + right * self.layout.blocks[number].rows + down
        if not memory.fill(self.code(memory.ev, number, formula, right), down, place):
            self.interpret(memory.ev, number, formula, down, right)

    def interpret(self, ev: Evaluator, number: int, formula: Node, down: int, right: int) -> None:
        """Compute a cell of a block by the interpreter."""
        block = self.layout.blocks[number]
        frame = Frame(self.layout.block_sheets[number], block.row + down, block.col + right, 1, 1, down, right)
        found = ev.result(formula, frame)
        place = self.layout.block_offsets[number] + right * block.rows + down
        ev.numbers[place] = found.numbers
        ev.codes[place] = 0 if found.codes is None else found.codes

    def code(self, ev: Evaluator, number: int, formula: Node, right: int = 0, by_code: bool = True) -> CellCode:
        """The code of a column of a block, without `by_code` no more than what costs nothing to make."""
        key = number, right, by_code
        if key not in self._made:
            block, sheet = self.layout.blocks[number], self.layout.block_sheets[number]
            seen = shifted(formula, 0, right) if right else formula
            column = Block(block.row, block.col + right, block.rows, 1, seen)
            self._made[key] = cell_code(self.layout, sheet, column, ev.around.arithmetic, self.alone, not by_code)
        return self._made[key]
