"""Block triangular form of a square sparsity pattern (Dulmage and Mendelsohn): which unknowns are solved together, in order.

Only the pattern counts, never a number: the blocks are the same in every position of a mechanism.
"""

from __future__ import annotations

from collections.abc import Sequence

Pattern = Sequence[Sequence[int]]
"""For each equation the unknowns that stand in it."""


def matching(pattern: Pattern) -> list[int] | None:
    """For each equation an unknown of its own, or None when there is none (augmenting paths, in the order given)."""
    owner: dict[int, int] = {}

    def claim(equation: int, tried: set[int]) -> bool:
        for unknown in pattern[equation]:
            if unknown not in tried:
                tried.add(unknown)
                if unknown not in owner or claim(owner[unknown], tried):
                    owner[unknown] = equation
                    return True
        return False

    if not all(claim(equation, set()) for equation in range(len(pattern))):
        return None
    chosen = [0] * len(pattern)
    for unknown, equation in owner.items():
        chosen[equation] = unknown
    return chosen


def blocks(pattern: Pattern) -> list[tuple[list[int], list[int]]] | None:
    """Irreducible diagonal blocks (equations, unknowns), each after those it needs; None when none exists.

    Equations and unknowns inside a block ascend, so that the sign of the block's determinant is well defined.
    """
    chosen = matching(pattern)
    if chosen is None:
        return None
    equation_of = {unknown: equation for equation, unknown in enumerate(chosen)}
    needs = [[equation_of[unknown] for unknown in unknowns] for unknowns in pattern]
    return [(sorted(part), sorted(chosen[equation] for equation in part)) for part in _components(needs)]


def _components(needs: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected components, each after those it needs (Tarjan 1972, without recursion)."""
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    on_stack: set[int] = set()
    found: list[list[int]] = []
    for root in range(len(needs)):
        if root in index:
            continue
        work = [(root, 0)]
        while work:
            node, position = work.pop()
            if position == 0:
                index[node] = low[node] = len(index)
                stack.append(node)
                on_stack.add(node)
            else:
                low[node] = min(low[node], low[needs[node][position - 1]])
            for place in range(position, len(needs[node])):
                other = needs[node][place]
                if other not in index:
                    work += [(node, place + 1), (other, 0)]
                    break
                if other in on_stack:
                    low[node] = min(low[node], index[other])
            else:
                if low[node] == index[node]:
                    cut = stack.index(node)
                    found.append(stack[cut:])
                    on_stack.difference_update(stack[cut:])
                    del stack[cut:]
    return found
