"""The names in which expressions about a synthesis are written, and the symbols that they mean."""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula.nodes import Node, Symbol, with_symbols
from mechsheet.formula.parser import parse_description
from mechsheet.model import Synthesis


class Naming:
    """Results mean the mechanism's dimensions where it takes them, else, or where asked for, their exact values."""

    def __init__(self, task: Synthesis, exact: bool = False) -> None:
        self.symbols: Mapping[str, str] = {**task.names, **task.results, **({} if exact else task.used)}

    def tree(self, text: str | Node) -> Node:
        """The tree of an expression in the description's notation."""
        tree = parse_description(text) if isinstance(text, str) else text
        return with_symbols(tree, {name: Symbol(symbol) for name, symbol in self.symbols.items()})
