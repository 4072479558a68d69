"""What a function in Basic is made of, as plain data; expressions are trees of formulas, variables are symbols in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from ..formula.nodes import Node


@dataclass(frozen=True, slots=True)
class Assign:
    """A variable gets a value."""

    name: str
    value: Node


@dataclass(frozen=True, slots=True)
class If:
    """Conditions with what is done where the first of them holds, and what is done where none does."""

    branches: tuple[tuple[Node, Statements], ...]
    otherwise: Statements = ()


@dataclass(frozen=True, slots=True)
class For:
    """A variable that counts."""

    name: str
    first: Node
    last: Node
    step: Node
    body: Statements


@dataclass(frozen=True, slots=True)
class Do:
    """Again and again while the conditions hold: `before` each round, `after` it; None: always."""

    before: Node | None
    after: Node | None
    body: Statements


@dataclass(frozen=True, slots=True)
class Exit:
    """Out of the innermost "for" or "do", or of the "function"."""

    kind: str


@dataclass(frozen=True, slots=True)
class GoTo:
    """On at a label."""

    label: str


@dataclass(frozen=True, slots=True)
class Label:
    """A place to go to."""

    name: str


@dataclass(frozen=True, slots=True)
class OnError:
    """From here on an error goes on at a label; an empty one: it ends the function."""

    label: str


Statement: TypeAlias = Assign | If | For | Do | Exit | GoTo | Label | OnError
Statements: TypeAlias = tuple[Statement, ...]


@dataclass(frozen=True, slots=True)
class Parameter:
    """`by_value` False: what the function assigns to it would change the caller's variable."""

    name: str
    optional: bool = False
    by_value: bool = False


@dataclass(frozen=True, slots=True)
class Function:
    """A function.

    name       as it is written; all other names are in small letters
    whole      variables that hold whole numbers: what is assigned to them is rounded
    constants  of the module and of the function
    """

    name: str
    line: int
    parameters: tuple[Parameter, ...]
    body: Statements
    whole: frozenset[str]
    constants: dict[str, Node]
