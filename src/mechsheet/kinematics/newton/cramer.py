"""J^-1 F in formulas: Cramer's rule for up to three unknowns, minors of two rows (Laplace) for four."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol

Matrix = Sequence[Sequence[Node]]


@dataclass(frozen=True, slots=True)
class Cramer:
    """The determinant of J, and what is divided by it; `minors` are named parts that they read."""

    minors: tuple[tuple[str, Node], ...]
    determinant: Node
    numerators: tuple[Node, ...]


def cramer(matrix: Matrix, right: Sequence[Node]) -> Cramer:
    """The solution of  matrix d = right  for one to four unknowns."""
    if len(matrix) == 4:
        return _four(matrix, right)
    columns = range(len(matrix))
    numerators = (
        _determinant([[right[row] if at == column else matrix[row][at] for at in columns] for row in columns])
        for column in columns
    )
    return Cramer((), _determinant(matrix), tuple(numerators))


def _determinant(m: Matrix) -> Node:
    if len(m) == 1:
        return m[0][0]
    if len(m) == 2:
        return al.sub(al.mul(m[0][0], m[1][1]), al.mul(m[0][1], m[1][0]))
    parts = [al.mul(m[0][at], _determinant([[*row[:at], *row[at + 1 :]] for row in m[1:]])) for at in range(3)]
    return al.add(al.sub(parts[0], parts[1]), parts[2])


_PAIRS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


def _four(m: Matrix, right: Sequence[Node]) -> Cramer:
    """By the minors of the upper and of the lower two rows. Source: D. Eberly, The Laplace Expansion Theorem."""
    minors: list[tuple[str, Node]] = []

    def minor(letter: str, top: int, pair: tuple[int, int]) -> Node:
        i, j = pair
        node = al.sub(al.mul(m[top][i], m[top + 1][j]), al.mul(m[top + 1][i], m[top][j]))
        if al.is_simple(node):
            return node
        name = f"{letter}{i + 1}{j + 1}"
        minors.append((name, node))
        return Symbol(name)

    s = [minor("S", 0, pair) for pair in _PAIRS]
    c = [minor("C", 2, pair) for pair in _PAIRS]

    def combined(*terms: tuple[int, Node, Node]) -> Node:
        total: Node = al.ZERO
        for sign, one, other in terms:
            part = al.mul(one, other)
            total = al.add(total, part) if sign > 0 else al.sub(total, part)
        return total

    determinant = combined((1, s[0], c[5]), (-1, s[1], c[4]), (1, s[2], c[3]),
                           (1, s[3], c[2]), (-1, s[4], c[1]), (1, s[5], c[0]))  # fmt: skip
    f = right
    # the minors of pairs of rows with the right side in them: u of the upper two rows, w of the lower two
    u = [al.sub(al.mul(f[0], m[1][at]), al.mul(f[1], m[0][at])) for at in range(4)]
    w = [al.sub(al.mul(f[2], m[3][at]), al.mul(f[3], m[2][at])) for at in range(4)]
    named: list[list[Node]] = []
    for letter, nodes in (("U", u), ("W", w)):
        row: list[Node] = []
        for at, node in enumerate(nodes):
            if not al.is_simple(node):
                minors.append((f"{letter}{at + 1}", node))
                node = Symbol(f"{letter}{at + 1}")
            row.append(node)
        named.append(row)
    upper, lower = named
    numerators = (
        combined((1, upper[1], c[5]), (-1, upper[2], c[4]), (1, upper[3], c[3]),
                 (1, s[3], lower[3]), (-1, s[4], lower[2]), (1, s[5], lower[1])),
        combined((-1, upper[0], c[5]), (1, upper[2], c[2]), (-1, upper[3], c[1]),
                 (-1, s[1], lower[3]), (1, s[2], lower[2]), (-1, s[5], lower[0])),
        combined((1, upper[0], c[4]), (-1, upper[1], c[2]), (1, upper[3], c[0]),
                 (1, s[0], lower[3]), (-1, s[2], lower[1]), (1, s[4], lower[0])),
        combined((-1, upper[0], c[3]), (1, upper[1], c[1]), (-1, upper[2], c[0]),
                 (-1, s[0], lower[2]), (1, s[1], lower[1]), (-1, s[3], lower[0])),
    )  # fmt: skip
    return Cramer(tuple(minors), determinant, numerators)
